// main.cpp: runs the tests. Options are doctest's (--help); the last line is `N passed, N failed`, counting test cases.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <iostream>
#include <optional>

namespace {

std::optional<doctest::TestRunStats> run;   // empty when only help or a list was asked for

struct Counter : doctest::IReporter {
    explicit Counter(const doctest::ContextOptions&) {}
    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats& stats) override { run = stats; }
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("counter", 1, Counter);

}   // namespace

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int status = context.run();
    if (run) {
        const unsigned ran = run->numTestCasesPassingFilters, skipped = run->numTestCases - ran;
        std::cout << ran - run->numTestCasesFailed << " passed, " << run->numTestCasesFailed << " failed";
        if (skipped > 0) std::cout << ", " << skipped << " skipped";
        std::cout << std::endl;
    }
    return status;
}

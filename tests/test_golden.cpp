// The conformance kit under golden/: the program passes it, and the kit notices a golden that is wrong or missing.

#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace {

struct Run {
    bool passed;
    std::string output;
};

Run compare(const std::string& golden = "") {
    const std::string log = std::string(POLYLAB_BUILD_DIR) + "/golden.log";
    const std::string command =
        "'" POLYLAB_SOURCE_DIR "/tools/golden.sh' compare '" POLYLAB_PROGRAM "' " + golden + " >'" + log + "' 2>&1";
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(log).rdbuf();
    return {status == 0, text.str()};
}

// A kit of one case, to be spoilt.
fs::path copy_of(const std::string& name) {
    const fs::path copy = fs::path(POLYLAB_BUILD_DIR) / "golden-copy";
    fs::remove_all(copy);
    fs::create_directories(copy / "cases");
    fs::copy(fs::path(POLYLAB_SOURCE_DIR) / "golden/cases" / name, copy / "cases" / name, fs::copy_options::recursive);
    return copy;
}

}   // namespace

TEST_CASE("golden: every stage of every case is as committed") {
    const Run run = compare();
    INFO(run.output);
    CHECK(run.passed);
}

TEST_CASE("golden: a corrupted line is found and shown") {
    const fs::path copy = copy_of("cube_12");
    const fs::path file = copy / "cases/cube_12/09-labels.txt";
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    std::string labels = text.str();
    REQUIRE(labels.size() > 4);
    const char old = labels[4];   // the third label
    labels[4] = old == '5' ? '0' : '5';
    std::ofstream(file) << labels;
    const Run run = compare("-d '" + copy.string() + "'");
    CHECK_FALSE(run.passed);
    CHECK(run.output.find("cube_12: stage 09-labels differs first at line 3") != std::string::npos);
    CHECK(run.output.find(std::string("found:    ") + old) != std::string::npos);
}

TEST_CASE("golden: a missing golden is an error, and so is an empty kit") {
    const fs::path copy = copy_of("cube_12");
    fs::remove(copy / "cases/cube_12/03-naive.txt");
    Run run = compare("-d '" + copy.string() + "'");
    CHECK_FALSE(run.passed);
    CHECK(run.output.find("cube_12: stage 03-naive: no golden file") != std::string::npos);
    fs::remove_all(copy / "cases");
    CHECK_FALSE(compare("-d '" + copy.string() + "'").passed);
}

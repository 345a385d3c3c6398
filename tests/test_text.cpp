// Files as whole strings, tokens with line numbers, numbers without a locale.
#include "polylab/text.h"

#include "shapes.h"

#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

using namespace polylab;
namespace fs = std::filesystem;

namespace {

// A new, empty directory; it goes away with its content.
struct Scratch {
    fs::path at;
    Scratch() {
        at = fs::path(POLYLAB_BUILD_DIR) / ("test_text." + std::to_string(::getpid()));
        fs::remove_all(at);
        fs::create_directories(at);
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(at, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    std::string operator/(const char* name) const { return (at / name).string(); }
    std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(at), {})); }
};

// What the InputError says, or nothing where there is none.
template <class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool begins(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

// write_file refuses, in one line that names the file and gives a reason.
void check_refused(const std::string& path, const std::string& reason = "") {
    const std::string error = error_of([&] { write_file(path, "content"); });
    CAPTURE(path);
    CAPTURE(error);
    CHECK(begins(error, path + ": can't be written: " + reason));
    CHECK(error.find('\n') == std::string::npos);
}

// A device to write to, or nothing where there is none. Root gets one of its own: a write_file gone wrong would replace
// the system's, which nobody else can.
std::string device(const Scratch& dir, const char* name, unsigned number) {
    const std::string system = std::string("/dev/") + name, own = dir / name;
    if (::geteuid() != 0) return fs::exists(system) ? system : "";
    if (::mknod(own.c_str(), S_IFCHR | 0666, makedev(1, number)) != 0) return "";
    const int opened = ::open(own.c_str(), O_WRONLY);   // some file systems have no devices
    if (opened >= 0) ::close(opened);
    return opened >= 0 ? own : "";
}

unsigned mode(const std::string& path) { return static_cast<unsigned>(fs::status(path).permissions()); }

std::uint64_t bits(double x) {
    std::uint64_t b;
    std::memcpy(&b, &x, sizeof b);
    return b;
}

double number(const std::string& token) {
    const double x = Scanner("", "f").to_number(token, "a number");
    CHECK(bits(Scanner(" " + token + "\n", "f").number("a number")) == bits(x));
    return x;
}
Index integer(const std::string& token) { return Scanner("", "f").to_integer(token, "an integer"); }

}   // namespace

TEST_CASE("text: blanks separate tokens, a comment runs to the end of its line") {
    Scanner in(" \ta\vb,c \f-1#d e\n\n#\n  # f\n g# h", "f");
    CHECK(in.token() == "a");
    CHECK(in.token() == "b,c");
    CHECK(in.token() == "-1");
    CHECK(in.line() == 1);
    CHECK(in.token() == "g");
    CHECK(in.line() == 5);
    CHECK(in.token() == "");
    CHECK(in.token() == "");
    CHECK(in.bytes_left() == 0);
}

TEST_CASE("text: lines end with any of the three line ends, and an empty line counts") {
    const struct {
        const char* between;
        Index lines;   // line ends in it
    } cases[] = {{" ", 0},      {"\n", 1},   {"\r\n", 1}, {"\r", 1},     {"\n\r", 2},
                 {"\r\r\n", 2}, {"\r\r", 2}, {"\n\n", 2}, {" # c\r", 1}, {"\r\n#\r\n\r\n", 3}};
    for (const auto& c : cases) {
        CAPTURE(c.lines);
        const std::string text = std::string("a") + c.between + "b";
        Scanner tokens(text, "f");
        CHECK(tokens.token() == "a");
        CHECK(tokens.line() == 1);
        CHECK(tokens.token() == "b");
        CHECK(tokens.line() == 1 + c.lines);
        Scanner lines(text, "f");   // the same by lines
        Index steps = 0;
        while (lines.next_line()) steps++;
        CHECK(steps == c.lines);
    }
}

TEST_CASE("text: reading by lines does not cross the end of a line") {
    Scanner in("a b # c\r\n\n d", "f");
    CHECK(in.token_in_line() == "a");
    CHECK(in.token_in_line() == "b");
    CHECK(in.token_in_line() == "");
    CHECK(in.token_in_line() == "");
    CHECK(in.line() == 1);
    CHECK(in.next_line());
    CHECK(in.token_in_line() == "");
    CHECK(in.next_line());
    CHECK(in.token_in_line() == "d");
    CHECK(in.line() == 3);
    CHECK_FALSE(in.next_line());
    Scanner rest("a b c\nd", "f");   // next_line drops what is left
    rest.token();
    CHECK(rest.next_line());
    CHECK(rest.token() == "d");
}

TEST_CASE("text: an error names the file, the line of the token and what was found") {
    Scanner in("1\n\n  x2 3\n", "a.obj");
    CHECK(in.number("a number") == 1);
    CHECK(error_of([&] { in.number("a number"); }) == "a.obj:3: expected a number, found 'x2'");
    CHECK(in.integer("an index") == 3);
    CHECK(error_of([&] { in.fail("a b", in.token_in_line()); }) == "a.obj:3: expected a b, found the end of the line");
    CHECK(error_of([] { Scanner("", "f").integer("an index"); }) == "f:1: expected an index, found the end of the file");
    // Whatever the token holds, the message stays one short printable line.
    const std::string odd("1\0\x01\xff\x7f", 5), error = error_of([&] { number(odd + std::string(100000, 'x')); });
    CHECK(begins(error, "f:1: expected a number, found '1"));
    CHECK(std::none_of(error.begin(), error.end(), [](unsigned char c) { return c < 32 || c == 127; }));
    CHECK(error.size() < 120);
    // A zero byte is no blank: it can't stand for nothing.
    Scanner zero(std::string_view("1 \0 2", 5), "f");
    CHECK(zero.number("a number") == 1);
    CHECK(begins(error_of([&] { zero.number("a number"); }), "f:1: expected a number, found '"));
}

TEST_CASE("text: numbers are correctly rounded, whatever their notation") {
    const std::string zeros(400, '0');
    struct Case {
        std::string token;
        double value;
    };
    // clang-format off
    const Case cases[] = {
        {"0", 0}, {"+7", 7}, {"-7.5", -7.5}, {".5", 0.5}, {"5.", 5}, {"+.5e1", 5}, {"1e5", 1e5}, {"1E+05", 1e5}, {"-1e-2", -0.01},
        {"0.1000000000000000055511151231257827021181583404541015625", 0.1}, {"1.7976931348623157e308", 1.7976931348623157e308},
        {"9007199254740993", 9007199254740992.0},                               // 2^53 + 1 is a tie: to even
        {"9007199254740993.000000000000000000000000001", 9007199254740994.0},   // and this is above it
        {"4.9e-324", 4.9e-324}, {"3e-324", 4.9e-324}, {"0e999", 0}, {"1" + zeros + "e-400", 1}, {"0." + zeros + "1e401", 1},
        {"2e-324", 0}, {"1e-400", 0}, {"-1e-400", 0}, {"1e-99999999999999999999", 0},   // underflow: zero
        {"0." + zeros + "1", 0}, {"-0." + zeros + "1e+20", 0}};                         // the same without negative exponent
    // clang-format on
    for (const auto& c : cases) {
        CAPTURE(c.token);
        double x = -1;
        CHECK_NOTHROW(x = number(c.token));
        CHECK(x == c.value);
    }
    CHECK(std::signbit(number("-0")));
    CHECK_FALSE(std::signbit(number("0")));
}

TEST_CASE("text: what is not a finite number is refused") {
    const std::string zeros(400, '0');
    std::vector<std::string> tokens = {"", "1" + zeros, "1" + zeros + "e-10"};
    std::istringstream more(
        "x 1x --1 +-1 ++1 + - . e5 1e 1e+ 1e5.0 1.2.3 0x10 inf -inf +inf nan nan(1) infinity 1,5 1d5 1e400 -1e400 "
        "1e99999999999999999999");
    for (std::string token; more >> token;) tokens.push_back(token);
    for (const std::string& token : tokens) {
        CAPTURE(token);
        const std::string error = error_of([&] { number(token); });
        CHECK(begins(error, "f:1: expected a number, found "));
        if (!token.empty()) CHECK(error_of([&] { Scanner(token + "\n", "f").number("a number"); }) == error);
    }
}

TEST_CASE("text: integers are whole tokens within the range of an index") {
    CHECK(integer("+7") == 7);
    CHECK(integer("-7") == -7);
    CHECK(integer("0007") == 7);
    CHECK(integer("2147483647") == 2147483647);
    CHECK(integer("-2147483648") == std::numeric_limits<Index>::min());
    for (const char* token : {"", "x", "1x", "+", "-", "+-1", "++1", "1.0", "1e3", "0x1", "2147483648", "-2147483649",
                              "4294967296", "99999999999999999999"}) {
        CAPTURE(token);
        CHECK(begins(error_of([&] { integer(token); }), "f:1: expected an integer, found "));
    }
}

TEST_CASE("text: a number is written in the fewest characters that read back as the same bits") {
    const auto text = [](double x) {
        std::string out;
        append(out, x);
        return out;
    };
    CHECK(text(0.1) == "0.1");
    CHECK(text(-3) == "-3");
    CHECK(text(1e-300) == "1e-300");
    CHECK(bits(number(text(-0.0))) == bits(-0.0));
    std::uint64_t random = 1;
    for (int i = 0; i < 20000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        // Half of them any bits at all, half of them coordinates of few digits.
        double x = static_cast<double>(random >> 40) / 1000;
        if (i % 2 == 0) std::memcpy(&x, &random, sizeof x);
        if (!std::isfinite(x)) continue;
        const std::string s = text(x);
        CAPTURE(s);
        REQUIRE(bits(number(s)) == bits(x));
        char longer[400];   // the shortest of printf's texts that do the same
        int digits = 1;
        do std::snprintf(longer, sizeof longer, "%.*g", digits++, x);
        while (std::strtod(longer, nullptr) != x);
        REQUIRE(s.size() <= std::strlen(longer));
    }
    std::string out = "f ";
    append(out, Index(-2147483647 - 1));
    append(out, Index(0));
    CHECK(out == "f -21474836480");
}

TEST_CASE("text: no locale changes a number") {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));   // for C++ streams
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", ""})                // for C, where one is installed
        if (std::setlocale(LC_ALL, name) && *std::localeconv()->decimal_point == ',') break;
    std::string out;
    append(out, 1234567.5);
    append(out, Index(-1234567));
    const double x = number("1234567.5");
    const std::string error = error_of([] { number("1,5"); });
    std::locale::global(before);
    std::setlocale(LC_ALL, "C");
    CHECK(out == "1234567.5-1234567");
    CHECK(x == 1234567.5);
    CHECK(error == "f:1: expected a number, found '1,5'");
}

TEST_CASE("text: a file is read as it is") {
    const Scratch dir;
    std::string content("\0\r\n\xff", 4);
    while (content.size() < 300000) content += content;   // more than one buffer
    for (const std::string& c : {std::string(), std::string("x"), content}) {
        write_file(dir / "f", c);
        CHECK(read_file(dir / "f") == c);
    }
    CHECK(read_file("/dev/null") == "");
    if (fs::exists("/proc/self/status")) CHECK(begins(read_file("/proc/self/status"), "Name:"));   // says its size is 0
    CHECK(begins(error_of([&] { read_file(dir / "none"); }), dir / "none: "));
    CHECK(begins(error_of([&] { read_file(dir.at.string()); }), dir.at.string() + ": expected a file"));
    CHECK(begins(error_of([&] { read_file(""); }), ": "));
}

TEST_CASE("text: a file is written as a whole, and keeps its permissions") {
    const Scratch dir;
    const mode_t mask = ::umask(027);
    write_file(dir / "f", "old");
    ::umask(mask);
    CHECK(mode(dir / "f") == 0640);   // a new file: what the user's mask leaves
    for (const unsigned m : {0600u, 0755u}) {
        ::chmod((dir / "f").c_str(), m);
        write_file(dir / "f", "new");
        CHECK(mode(dir / "f") == m);
    }
    CHECK(read_file(dir / "f") == "new");
    CHECK(dir.entries() == 1);   // no part file is left
    const fs::path cwd = fs::current_path();
    fs::current_path(dir.at);   // a bare name has no directory
    write_file("g", "there");
    fs::current_path(cwd);
    CHECK(read_file(dir / "g") == "there");
}

TEST_CASE("text: symbolic links are followed and stay links") {
    const Scratch dir;
    fs::create_directory(dir.at / "sub");
    fs::create_symlink("sub/f", dir.at / "link");                        // relative to the link's directory, dangling
    fs::create_symlink(fs::absolute(dir.at) / "link", dir.at / "far");   // absolute, two steps
    for (const char* name : {"link", "far", "link"}) {
        write_file(dir / name, name);
        CHECK(fs::is_symlink(dir.at / name));
        CHECK_FALSE(fs::is_symlink(dir.at / "sub/f"));
        CHECK(read_file(dir / "sub/f") == name);
    }
    CHECK(dir.entries() == 3);
    fs::create_symlink("b", dir.at / "a");
    fs::create_symlink("a", dir.at / "b");
    check_refused(dir / "a");   // a circle leads to no file
    CHECK(fs::is_symlink(dir.at / "a"));
    CHECK(fs::is_symlink(dir.at / "b"));
    CHECK(dir.entries() == 5);
}

TEST_CASE("text: what can't be written is refused in one line, and nothing changes") {
    const Scratch dir;
    fs::create_directory(dir.at / "sub");
    write_file(dir / "f", "old");
    check_refused(dir / "sub", "it is a directory");
    check_refused(dir / "none/f");
    check_refused(dir / "f/f");
    check_refused("");
    if (::geteuid() != 0) {   // nothing is forbidden to root
        ::chmod((dir / "f").c_str(), 0444);
        check_refused(dir / "f");
        ::chmod((dir / "sub").c_str(), 0555);
        check_refused(dir / "sub/f");
        ::chmod((dir / "sub").c_str(), 0755);
    }
    CHECK(read_file(dir / "f") == "old");
    CHECK(dir.entries() == 2);
    CHECK(fs::is_empty(dir.at / "sub"));
}

TEST_CASE("text: a disk that fills up leaves the old file") {
    const Scratch dir;
    write_file(dir / "f", "old");
    rlimit limit;
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &limit) == 0);
    const rlimit small = {4096, limit.rlim_max};   // the nearest thing to a full disk: files end at 4 KiB
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string error = error_of([&] { write_file(dir / "f", std::string(100000, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, handler);
    CHECK(begins(error, dir / "f: can't be written: "));
    CHECK(read_file(dir / "f") == "old");
    CHECK(dir.entries() == 1);
    const std::string full = device(dir, "full", 7);
    if (!full.empty()) {
        check_refused(full, std::strerror(ENOSPC));
        CHECK(fs::is_character_file(full));
    }
}

TEST_CASE("text: pipes and devices are written through") {
    const Scratch dir;
    const std::string null = device(dir, "null", 3);
    if (!null.empty()) {
        write_file(null, "content");
        CHECK(fs::is_character_file(null));
        CHECK(read_file(null) == "");
    }
    const std::size_t before = dir.entries();
    REQUIRE(::mkfifo((dir / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("pipe", dir.at / "link");
    const int end = ::open((dir / "pipe").c_str(), O_RDONLY | O_NONBLOCK);   // a pipe without reader would block
    REQUIRE(end >= 0);
    for (const char* name : {"pipe", "link"}) {
        write_file(dir / name, name);
        char got[16] = {};
        CHECK(::read(end, got, sizeof got - 1) == 4);
        CHECK(std::string(got) == name);
    }
    ::close(end);
    CHECK(fs::is_fifo(dir.at / "pipe"));
    CHECK(dir.entries() == before + 2);
}

TEST_CASE("text: a dash is standard output and standard input") {
    const Scratch dir;
    std::fflush(stdout);
    const int out = ::dup(1), in = ::dup(0);
    REQUIRE(std::freopen((dir / "f").c_str(), "wb", stdout));
    write_file("-", "a\nb");   // complete on return, without a flush by the caller
    const std::string written = read_file(dir / "f");
    ::dup2(out, 1);
    REQUIRE(std::freopen((dir / "f").c_str(), "rb", stdin));
    const std::string got = read_file("-");
    if (in >= 0) ::dup2(in, 0);
    std::clearerr(stdin);
    ::close(out);
    if (in >= 0) ::close(in);
    CHECK(written == "a\nb");
    CHECK(got == "a\nb");
    CHECK(dir.entries() == 1);
}

TEST_CASE("text: numbers are those of from_chars, also on the short way") {
    shapes::Lcg random(14);
    for (int round = 0; round < 200000; round++) {
        std::string token = random.below(3) == 0 ? "-" : "";
        const Index digits = 1 + random.below(22), point = random.below(24);
        for (Index i = 0; i < digits; i++) {
            if (i == point) token += '.';
            token += static_cast<char>('0' + (random.below(4) == 0 ? 0 : random.below(10)));
        }
        if (random.below(8) == 0) token += "e-" + std::to_string(random.below(30));
        double expected = 0;
        std::from_chars(token.data(), token.data() + token.size(), expected);
        const double x = Scanner(random.below(2) == 0 ? token : token + " 1", "x").number_in_line("a number");
        if (x != expected || std::signbit(x) != std::signbit(expected)) FAIL_CHECK(token);
    }
}

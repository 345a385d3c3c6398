#include "polylab/text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#if !defined(__cpp_lib_to_chars)
#error "polylab needs std::from_chars and std::to_chars for double (libstdc++ 11 or later)"
#endif

namespace polylab {

namespace fs = std::filesystem;

namespace {

std::string reason() { return std::strerror(errno); }

struct File {
    std::FILE* handle;
    explicit File(std::FILE* f) : handle(f) {}
    ~File() {
        if (handle && handle != stdin && handle != stdout) std::fclose(handle);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    bool close() {
        std::FILE* f = handle;
        handle = nullptr;
        return std::fclose(f) == 0;
    }
};

bool write_all(std::FILE* f, std::string_view content) {
    return std::fwrite(content.data(), 1, content.size(), f) == content.size() && std::fflush(f) == 0;
}

// A name beside `target` that no file has: fopen's "x" mode decides, so two runs never share one.
std::FILE* open_beside(const fs::path& target, fs::path& name) {
    for (int i = 0; i < 1000; i++) {
        name = target;
        name += ".part" + std::to_string(i);
        if (std::FILE* f = std::fopen(name.c_str(), "wbx")) return f;
        if (errno != EEXIST) break;
    }
    return nullptr;
}

// `path` with its symbolic links resolved, also where the last link points to a file that is not there yet.
fs::path link_target(fs::path path) {
    std::error_code error;
    for (int links = 0; links < 40 && fs::is_symlink(path, error); links++) {
        const fs::path to = fs::read_symlink(path, error);
        path = to.is_absolute() ? to : path.parent_path() / to;
    }
    return path;
}

// Whether a decimal number, not zero, is below one in magnitude.
bool below_one(std::string_view digits) {
    const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
    const std::size_t point = std::min(digits.find('.'), e), first = digits.find_first_of("123456789");
    // The power of ten of the first digit that counts.
    const std::int64_t power = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first) - (first < point);
    std::int64_t exponent = 0;
    for (const char c : digits.substr(e))
        if (c >= '0' && c <= '9' && exponent < 1000000000000) exponent = 10 * exponent + (c - '0');
    return power + (digits.substr(e).find('-') == 1 ? -exponent : exponent) < 0;
}

}   // namespace

std::string read_file(const std::string& path) {
    std::error_code error;
    if (path != "-" && fs::is_directory(path, error)) throw InputError(path, 0, "expected a file, found a directory");
    const File file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"));
    if (!file.handle) throw InputError(path, 0, "can't be read: " + reason());
    std::string content;
    const auto size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
    content.resize(error || size == 0 ? 65536 : size + 1);   // one more: the end is met without asking for more memory
    std::size_t end = 0;
    while (const std::size_t got = std::fread(&content[end], 1, content.size() - end, file.handle)) {
        end += got;
        if (end == content.size()) content.resize(2 * end);
    }
    content.resize(end);
    if (std::ferror(file.handle)) throw InputError(path, 0, "can't be read: " + reason());
    return content;
}

namespace {

[[noreturn]] void refuse_output(const std::string& path, const std::string& why) {
    throw InputError(path, 0, "can't be written: " + why);
}

// An output on its way: in a new file beside its place, or nothing of it yet where the place is no regular file.
struct Part {
    fs::path target, part;   // `part` is empty for pipes, devices and standard output
};

Part write_part(const Output& output) {
    Part result;
    if (output.path == "-") return result;
    std::error_code error;
    // Before links are resolved: what /dev/stdout points to has no name where it is a pipe.
    const fs::file_status given = fs::status(output.path, error);
    if (fs::exists(given) && !fs::is_regular_file(given) && !fs::is_directory(given)) return result;
    result.target = link_target(output.path);
    if (fs::is_symlink(result.target, error)) refuse_output(output.path, "too many symbolic links");
    const fs::file_status status = fs::status(result.target, error);
    if (fs::is_directory(status)) refuse_output(output.path, "it is a directory");
    // A file that its owner made read-only stays as it is, although renaming over it would be allowed.
    if (fs::exists(status)) {
        const File file(std::fopen(result.target.c_str(), "r+b"));
        if (!file.handle) refuse_output(output.path, reason());
    }
    File file(open_beside(result.target, result.part));
    if (!file.handle) refuse_output(output.path, reason());
    if (!write_all(file.handle, output.content) || !file.close()) {
        const std::string why = reason();
        fs::remove(result.part, error);
        refuse_output(output.path, why);
    }
    if (fs::exists(status)) fs::permissions(result.part, status.permissions(), error);
    return result;
}

void write_through(const Output& output) {
    if (output.path == "-") {
        if (!write_all(stdout, output.content)) refuse_output(output.path, reason());
        return;
    }
    File file(std::fopen(output.path.c_str(), "wb"));
    if (!file.handle || !write_all(file.handle, output.content) || !file.close()) refuse_output(output.path, reason());
}

}   // namespace

void write_files(const std::vector<Output>& outputs) {
    const auto place = [](const fs::path& path) {   // one name for x, ./x and folder/../x
        std::error_code none;
        return fs::weakly_canonical(fs::absolute(path, none), none);
    };
    std::vector<Part> parts;
    std::error_code error;
    try {
        for (const Output& output : outputs) {
            parts.push_back(write_part(output));
            for (std::size_t i = 0; i + 1 < parts.size(); i++)
                if (!parts[i].part.empty() && place(parts[i].target) == place(parts.back().target))
                    refuse_output(output.path, "it is the place of another output too");
        }
        for (std::size_t i = 0; i < outputs.size(); i++)
            if (parts[i].part.empty()) write_through(outputs[i]);
        for (std::size_t i = 0; i < outputs.size(); i++) {
            if (parts[i].part.empty()) continue;
            fs::rename(parts[i].part, parts[i].target, error);
            if (error) refuse_output(outputs[i].path, error.message());
        }
    } catch (const InputError&) {
        for (const Part& part : parts)
            if (!part.part.empty()) fs::remove(part.part, error);
        throw;
    }
}

void write_file(const std::string& path, std::string_view content) { write_files({{path, content}}); }

void append(std::string& out, double x) {
    char buffer[32];
    out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}

void append(std::string& out, Index i) {
    char buffer[16];
    out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, i).ptr);
}

namespace {

enum class CharacterKind : char { ordinary, blank, line_end, hash, zero };

constexpr std::array<CharacterKind, 256> kinds() {
    std::array<CharacterKind, 256> table = {};
    for (const char c : {' ', '\t', '\v', '\f'}) table[static_cast<unsigned char>(c)] = CharacterKind::blank;
    table['\n'] = table['\r'] = CharacterKind::line_end;
    table['#'] = CharacterKind::hash;
    table[0] = CharacterKind::zero;
    return table;
}
constexpr std::array<CharacterKind, 256> kCharacterKind = kinds();

inline CharacterKind kind(char c) { return kCharacterKind[static_cast<unsigned char>(c)]; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

}   // namespace

inline void Scanner::skip_blanks() {
    const std::size_t size = text_.size();
    std::size_t at = at_;
    while (at < size && kind(text_[at]) == CharacterKind::blank) at++;
    if (at < size && text_[at] == '#')
        while (at < size && kind(text_[at]) != CharacterKind::line_end) at++;
    at_ = at;
}

std::string_view Scanner::token_in_line() {
    skip_blanks();
    const std::size_t begin = at_, size = text_.size();
    std::size_t end = begin;
    while (end < size && kind(text_[end]) == CharacterKind::ordinary) end++;
    // A run of zero bytes is a (wrong) token of its own.
    if (end == begin)
        while (end < size && kind(text_[end]) == CharacterKind::zero) end++;
    at_ = end;
    return text_.substr(begin, end - begin);
}

Index Scanner::plain_index_in_line() {
    skip_blanks();
    const std::size_t last = std::min(text_.size(), at_ + 9);
    std::size_t end = at_;
    Index value = 0;
    for (; end < last && is_digit(text_[end]); end++) value = 10 * value + (text_[end] - '0');
    const bool ends =
        end == text_.size() || kind(text_[end]) == CharacterKind::blank || kind(text_[end]) == CharacterKind::line_end;
    if (end == at_ || !ends) return kNone;
    at_ = end;
    return value;
}

std::string_view Scanner::token() {
    while (true) {
        const std::string_view t = token_in_line();
        if (!t.empty() || at_ >= text_.size()) return t;
        next_line();
    }
}

bool Scanner::next_line() {
    while (at_ < text_.size() && kind(text_[at_]) != CharacterKind::line_end) at_++;
    if (at_ >= text_.size()) return false;
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
    line_++;
    return true;
}

namespace {

constexpr double kPowerOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Appends the digits of t from `at` on to a number, and returns where they end.
inline std::size_t read_digits(std::string_view t, std::size_t at, std::uint64_t& number) {
    std::uint64_t value = number;
    for (; at < t.size() && is_digit(t[at]); at++) value = 10 * value + static_cast<std::uint64_t>(t[at] - '0');
    number = value;
    return at;
}

// What most files hold: up to 2^53 times or divided by a power of ten up to 10^22. Both are doubles, so that the one
// operation rounds correctly (W. D. Clinger. How to Read Floating Point Numbers Accurately. PLDI 1990). Anything else,
// right or wrong, is left to from_chars: false, and `first` stays.
bool read_simple(std::string_view t, std::size_t& first, double& x) {
    std::uint64_t mantissa = 0;
    const bool negative = first < t.size() && t[first] == '-';
    const std::size_t begin = first + negative, point = read_digits(t, begin, mantissa);
    const bool has_point = point < t.size() && t[point] == '.';
    const std::size_t end = has_point ? read_digits(t, point + 1, mantissa) : point;
    const std::size_t digits = end - begin - has_point, after_point = has_point ? end - point - 1 : 0;
    const bool ends = end == t.size() || kind(t[end]) != CharacterKind::ordinary;
    // 19 digits may have gone beyond 64 bits.
    if (!ends || digits == 0 || digits > 18 || mantissa > std::uint64_t{1} << 53) return false;
    x = static_cast<double>(mantissa) / kPowerOfTen[after_point];
    if (negative) x = -x;
    first = end;
    return true;
}

}   // namespace

double Scanner::number_in_line(const char* what) {
    skip_blanks();
    double x = 0;
    return read_simple(text_, at_, x) ? x : to_number(token_in_line(), what);
}

double Scanner::number(const char* what) {
    for (skip_blanks(); at_ < text_.size() && kind(text_[at_]) == CharacterKind::line_end; skip_blanks()) next_line();
    return number_in_line(what);
}

double Scanner::to_number(std::string_view token, const char* what) const {
    std::string_view digits = token;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double x = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (error == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
        if (below_one(digits)) return 0;   // gmsh writes such noise; too large a number is an error
    }
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(x)) fail(what, token);
    return x;
}

Index Scanner::to_integer(std::string_view token, const char* what) const {
    std::string_view digits = token;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    Index i = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), i);
    if (error != std::errc() || end != digits.data() + digits.size()) fail(what, token);
    return i;
}

void Scanner::fail(const std::string& expected, std::string_view found) const {
    std::string shown;
    for (const char c : found.substr(0, 40)) shown += c >= 32 && c < 127 ? c : '?';
    if (found.size() > 40) shown += "…";
    throw InputError(
        file_, line_,
        "expected " + expected + ", found " +
            (found.empty() ? "the end of the " + std::string(at_ >= text_.size() ? "file" : "line") : "'" + shown + "'"));
}

}   // namespace polylab

// text.h: files as whole strings, tokens with line numbers, numbers without a locale.
#pragma once

#include "polylab/base.h"

#include <string>
#include <string_view>
#include <vector>

namespace polylab {

// The whole file (or standard input for "-"). Throws InputError where it can't be read.
std::string read_file(const std::string& path);

struct Output {
    std::string path;
    std::string_view content;
};

// Writes all of the outputs, or none: each into a new file beside its path, then, when all are complete, renamed over it.
// Symbolic links are followed; what is not a regular file (pipe, device) is written through; "-" is standard output.
// Throws InputError.
void write_files(const std::vector<Output>& outputs);
void write_file(const std::string& path, std::string_view content);

// Appends a number; of a double, the shortest text that reads back as the same double.
void append(std::string& out, double x);
void append(std::string& out, Index i);

// Reads a text token by token. Blanks separate tokens; '#' starts a comment that runs to the end of the line; lines end
// with \n, \r\n or \r. Every error is an InputError with file and line. O(1) per character, nothing is copied.
class Scanner {
public:
    Scanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

    // Next token of the file, or of the current line; empty at its end.
    std::string_view token();
    std::string_view token_in_line();
    // The next token of the line, if it is digits only, nine at most, as nearly all indices are; else kNone, and it stays.
    Index plain_index_in_line();
    // Steps over the rest of the line; false at the end of the file.
    bool next_line();

    // The next token of the file, or of the current line, as a number. `what` names it in errors: "expected `what`, found …".
    double number(const char* what);
    double number_in_line(const char* what);
    Index integer(const char* what) { return to_integer(token(), what); }

    // A token as a number: the whole token, correctly rounded, finite. A leading '+' is allowed.
    double to_number(std::string_view token, const char* what) const;
    Index to_integer(std::string_view token, const char* what) const;

    [[noreturn]] void fail(const std::string& expected, std::string_view found) const;
    const std::string& file() const { return file_; }
    Index line() const { return line_; }   // of the token read last
    std::size_t bytes_left() const { return text_.size() - at_; }

private:
    void skip_blanks();   // and comments, within the line

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    Index line_ = 1;
};

}   // namespace polylab

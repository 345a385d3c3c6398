#include "polylab/json.h"

namespace polylab {

void JsonWriter::begin(std::string_view key) {
    if (!empty_) out_ += ',';
    if (depth_ > 0) out_ += '\n' + std::string(4 * depth_, ' ');
    empty_ = false;
    if (key.empty()) return;
    quote(key);
    out_ += ": ";
}

void JsonWriter::open(std::string_view key, char bracket) {
    begin(key);
    out_ += bracket;
    depth_++;
    empty_ = true;
}

void JsonWriter::close(char bracket) {
    depth_--;
    if (!empty_) out_ += '\n' + std::string(4 * depth_, ' ');
    out_ += bracket;
    empty_ = false;
}

void JsonWriter::value(std::string_view key, Index i) {
    begin(key);
    append(out_, i);
}

void JsonWriter::value(std::string_view key, double x) {
    begin(key);
    const std::size_t at = out_.size();
    append(out_, x);
    if (out_.find_first_of(".en", at) == std::string::npos) out_ += ".0";
}

void JsonWriter::value(std::string_view key, bool b) {
    begin(key);
    out_ += b ? "true" : "false";
}

void JsonWriter::value(std::string_view key, std::string_view text) {
    begin(key);
    quote(text);
}

void JsonWriter::quote(std::string_view text) {
    constexpr const char* kHex = "0123456789abcdef";
    out_ += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out_ += '\\';
            out_ += c;
        } else if (static_cast<unsigned char>(c) < 32) {
            out_ += "\\u00";
            out_ += kHex[c / 16];
            out_ += kHex[c % 16];
        } else {
            out_ += c;
        }
    }
    out_ += '"';
}

}   // namespace polylab

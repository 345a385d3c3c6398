// json.h: writes JSON the way the ecosystem's statistics files look: four blanks per level, one entry per line.
#pragma once

#include "polylab/text.h"

#include <string>
#include <string_view>

namespace polylab {

// Entries come out in the order of the calls. `key` is empty inside arrays.
class JsonWriter {
public:
    void open_object(std::string_view key = {}) { open(key, '{'); }
    void open_array(std::string_view key) { open(key, '['); }
    void close_object() { close('}'); }
    void close_array() { close(']'); }

    void value(std::string_view key, Index i);
    void value(std::string_view key, double x);   // shortest text with the same double; 1 is written 1.0
    void value(std::string_view key, bool b);
    void value(std::string_view key, std::string_view text);
    void value(std::string_view key, const char* text) { value(key, std::string_view(text)); }   // not the bool

    const std::string& text() const { return out_; }

private:
    void open(std::string_view key, char bracket);
    void close(char bracket);
    void begin(std::string_view key);
    void quote(std::string_view text);

    std::string out_;
    int depth_ = 0;
    bool empty_ = true;   // nothing in the innermost bracket yet
};

}   // namespace polylab

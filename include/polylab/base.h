// base.h: index type, error type, and the floating-point guards that determinism rests on.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#if defined(__FAST_MATH__)
#error "polylab promises the same bytes everywhere: build without -ffast-math"
#endif

namespace polylab {

static_assert(std::numeric_limits<double>::is_iec559, "polylab needs IEEE-754 doubles");

using Index = std::int32_t;          // vertex, facet, half-edge, chart, boundary, corner
inline constexpr Index kNone = -1;   // "no such element"

// The one exception of the library: the input is wrong. what() is one line,
// `file:line: expected …, found …`, without the parts that are not known.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(message), message_(message) {}
    InputError(const std::string& file, Index line, const std::string& message)
        : std::runtime_error(line > 0 ? file + ":" + std::to_string(line) + ": " + message : file + ": " + message),
          message_(message), line_(line) {}

    // The same error, said of a file (for errors found after reading, when only the caller knows the name).
    InputError in(const std::string& file) const { return InputError(file, line_, message_); }

private:
    std::string message_;
    Index line_ = 0;
};

// Asked between steps of long work: true ends it early. It stays true once it is. Empty: never.
using Stop = std::function<bool()>;

// Every comparison of floating-point numbers that decides a label reports by how much it was decided; 0 is an exact tie,
// which goes by a rule. Nothing happens but in the tie audit (tools/tie_audit.cpp), which is built with the macro.
#if defined(POLYLAB_TIE_AUDIT)
void audit(const char* comparison, double margin);
#else
inline void audit(const char*, double) {}
#endif

}   // namespace polylab

#include "polylab/costs.h"

#include "polylab/base.h"

namespace polylab {

namespace {

// -log of exp(-(x/sigma)^2 / 2).
double exponent(double x, double sigma) {
    const double t = x / sigma;
    return 0.5 * (t * t);
}

// exp(-exponent). Up to 2^-54 it rounds to 1.
double gaussian(double exponent) {
    audit("top of a bell, relative", std::abs(exponent / 0x1p-54 - 1));
    return exponent <= 0x1p-54 ? 1 : std::exp(-exponent);
}

// Exponents from kTail to kFarTail need no exp for scales up to 10^5: scale * exp(-12) < 1, and 1 - exp(-34) is still
// some units of its last place below 1. From kNothing on, 1 - exp(-exponent) rounds to 1.
constexpr double kTail = 12, kFarTail = 34, kNothing = 40;
constexpr int kLargestScale = 100000;

// Truncates toward zero; how far the value was from the next integer is what rounding noise would have to bridge.
int truncated(double cost, double top) {
    const double nearest = std::floor(cost + 0.5);
    if (nearest > 0 && nearest < top) audit("cost before truncation", std::abs(cost - nearest));
    return static_cast<int>(cost);
}

}   // namespace

int bell_cost(double x, double sigma, int scale) {
    const double e = exponent(x, sigma);
    if (e >= kTail && scale <= kLargestScale) return 0;
    return truncated(scale * gaussian(e), scale);
}

int well_cost(double x, double sigma, int scale) {
    const double e = exponent(x, sigma);
    if (e >= kNothing) return scale;
    if (e >= kTail && e <= kFarTail && scale > 0 && scale <= kLargestScale) return scale - 1;
    return truncated(scale * (1 - gaussian(e)), scale);
}

std::int32_t angle_cost(double c) {
    const double clamped = c < -1 ? -1 : c > 1 ? 1 : c;
    return static_cast<std::int32_t>(std::acos(clamped) * 1e6 + 0.5);
}

std::int32_t angle_cost(const Vec3& a, const Vec3& b) {
    const double lengths = norm(a) * norm(b);
    return lengths > 0 ? angle_cost(dot(a, b) / lengths) : 0;
}

std::int64_t steps(double x) {
    const double scaled = x * 1073741824, below = std::floor(scaled);
    audit("choice in steps", std::abs(scaled - below - 0.5));
    return static_cast<std::int64_t>(scaled - below < 0.5 ? below : below + 1);
}

SinCos sin_cos(double radians) {
    double sine = 0, cosine = 0, term = 1;
    // 120 terms are more than enough for one turn; beyond it the alternating terms cancel digits.
    for (int i = 0; i < 120; i += 2) {
        cosine += term;
        term *= radians / (i + 1);
        sine += term;
        term *= -radians / (i + 2);
    }
    return {sine, cosine};
}

}   // namespace polylab

#include "polylab/costs.h"

namespace polylab {

namespace {

double gaussian(double x, double sigma) {
    const double t = x / sigma;
    return std::exp(-0.5 * (t * t));
}

}   // namespace

int bell_cost(double x, double sigma, int scale) { return static_cast<int>(scale * gaussian(x, sigma)); }

int well_cost(double x, double sigma, int scale) { return static_cast<int>(scale * (1 - gaussian(x, sigma))); }

std::int32_t angle_cost(double c) {
    const double clamped = c < -1 ? -1 : c > 1 ? 1 : c;
    return static_cast<std::int32_t>(std::acos(clamped) * 1e6 + 0.5);
}

std::int32_t angle_cost(const Vec3& a, const Vec3& b) {
    const double lengths = norm(a) * norm(b);
    return lengths > 0 ? angle_cost(dot(a, b) / lengths) : 0;
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

// costs.h: the only module that calls libm, and each call becomes an integer at once.
//
// exp and acos differ in the last bit between C libraries, and between CPUs under one library. Truncated or rounded
// to an integer the difference is gone (but for an argument within 1e-16 of a step), so that everything above
// this module compares integers and gives the same labels everywhere.
#pragma once

#include "polylab/vec3.h"

#include <cstdint>

namespace polylab {

// trunc(scale * exp(-0.5 * (t * t))) with t = x / sigma, a bell: `scale` at x = 0.        port: truncation toward zero, not
// rounding
int bell_cost(double x, double sigma, int scale);

// trunc(scale * (1 - exp(-(x/sigma)^2 / 2))), its complement: 0 at x = 0. port: not scale - bell_cost
int well_cost(double x, double sigma, int scale);

// The angle whose cosine is c (clamped to [-1, 1]), in microradians, trunc(1e6 acos(c) + 0.5): 0..3141593.
std::int32_t angle_cost(double c);

// The angle between two vectors in microradians; 0 where one of them has no length.
std::int32_t angle_cost(const Vec3& a, const Vec3& b);

// x in steps of 2^-30, rounded to the nearest, halves up. Choices between directions, labels or lengths compare these: on a
// symmetric part rounding noise would decide between equals; in steps they are equal, and a rule decides.   tie: by order,
// wherever it is used
std::int64_t steps(double x);

// Sine and cosine of an angle of at most one turn (error below 1e-13), by their Taylor series: + * / only, so the same bits
// everywhere.
struct SinCos {
    double sin, cos;
};
SinCos sin_cos(double radians);

}   // namespace polylab

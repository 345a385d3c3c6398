#include "polylab/costs.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

using namespace polylab;

namespace {

const double kPi = std::acos(-1.0);

double cos_degrees(double angle) { return std::cos(angle * kPi / 180); }

// Out of line and on values that are unknown to the compiler, so that it can't be folded.
[[gnu::noinline]] double multiply_add(const volatile double* v) {
    const double a = v[0], b = v[1], c = v[2];
    return a * b + c;
}

}   // namespace

TEST_CASE("costs: the compiler does not contract a * b + c") {
    // (1 + u)(1 - u) = 1 - u^2 rounds to 1 for u = 2^-30; a fused multiply-add would leave -2^-60.
    const double u = 1.0 / (1 << 30);
    const volatile double values[3] = {1 + u, 1 - u, -1};
    CHECK_MESSAGE(multiply_add(values) == 0, "build with -ffp-contract=off");
}

TEST_CASE("costs: bell and well at known angles") {
    // 300 (1 - exp(-((cos a - 1) / 0.2)^2 / 2)) and 100 exp(-((cos a - 1) / 0.25)^2 / 2), cut to integers. By calculator, at
    // 45 degrees: cos a - 1 = -0.29289; well: 300 (1 - exp(-1.07233)) = 197.3; bell: 100 exp(-0.68629) = 50.3.
    struct Row {
        double angle;
        int well, bell;
    };
    const Row table[] = {{0, 0, 100},   {10, 0, 99},   {20, 13, 97}, {30, 60, 86}, {40, 148, 64}, {45, 197, 50},
                         {50, 239, 36}, {60, 286, 13}, {70, 298, 3}, {75, 299, 1}, {90, 299, 0},  {180, 300, 0}};
    for (const Row& row : table) {
        CAPTURE(row.angle);
        const double x = cos_degrees(row.angle) - 1;
        CHECK(well_cost(x, 0.20, 300) == row.well);
        CHECK(bell_cost(x, 0.25, 100) == row.bell);
    }
}

TEST_CASE("costs: bell and well are cut, not rounded, and each by itself") {
    // exp(-1/2) = 0.60653: at one sigma the bell is 60.65, the well 39.35.
    CHECK(bell_cost(1, 1, 100) == 60);
    CHECK(well_cost(1, 1, 100) == 39);
    CHECK(bell_cost(-3, 3, 1000) == 606);
    CHECK(well_cost(-3, 3, 1000) == 393);
    CHECK(bell_cost(0, 0.2, 7) == 7);
    CHECK(well_cost(0, 0.2, 7) == 0);
    CHECK(bell_cost(1e3, 1, 100000) == 0);
    CHECK(well_cost(1e3, 1, 100000) == 100000);
}

TEST_CASE("costs: angles in microradians") {
    CHECK(angle_cost(1.0) == 0);
    CHECK(angle_cost(0.5) == 1047198);    // pi / 3 = 1.0471975512
    CHECK(angle_cost(0.0) == 1570796);    // pi / 2 = 1.5707963268
    CHECK(angle_cost(-0.5) == 2094395);   // 2 pi / 3 = 2.0943951024
    CHECK(angle_cost(-1.0) == 3141593);   // pi = 3.1415926536
    // Rounding may leave a cosine just beyond 1.
    CHECK(angle_cost(1 + 1e-12) == 0);
    CHECK(angle_cost(-1 - 1e-12) == 3141593);
    CHECK(angle_cost(50.0) == 0);
}

TEST_CASE("costs: angles between vectors do not depend on their lengths") {
    for (const double length : {1.0, 3.0, 1e-20, 1e30}) {
        CAPTURE(length);
        const Vec3 x = {length, 0, 0}, y = {0, 7, 0};
        CHECK(angle_cost(x, x) == 0);
        CHECK(angle_cost(x, y) == 1570796);
        CHECK(angle_cost(x, -x) == 3141593);
        CHECK(angle_cost(x, {1, 1, 0}) == 785398);     // pi / 4 = 0.7853981634
        CHECK(angle_cost({-1, 0, 1}, x) == 2356194);   // 3 pi / 4 = 2.3561944902
        CHECK(angle_cost(x, Vec3{}) == 0);
        CHECK(angle_cost(Vec3{}, x) == 0);
    }
    CHECK(angle_cost(Vec3{}, Vec3{}) == 0);
}

TEST_CASE("costs: sine and cosine agree with the library's") {
    for (int i = -1000; i <= 1000; i++) {
        const double x = i / 1000.0;
        const SinCos sc = sin_cos(x);
        CHECK(std::abs(sc.sin - std::sin(x)) < 1e-15);
        CHECK(std::abs(sc.cos - std::cos(x)) < 1e-15);
    }
    CHECK(sin_cos(0).sin == 0);
    CHECK(sin_cos(0).cos == 1);
    // The largest terms of the series are 85 at one turn: 85 * 2^-53 * some roundings.
    for (int i = -100; i <= 100; i++) {
        const double x = 2 * kPi * i / 100;
        const SinCos sc = sin_cos(x);
        CHECK(std::abs(sc.sin - std::sin(x)) < 1e-13);
        CHECK(std::abs(sc.cos - std::cos(x)) < 1e-13);
    }
}

TEST_CASE("costs: what is answered without exp is what exp gives") {
    const auto gaussian = [](double x, double sigma) {
        const double t = x / sigma;
        return std::exp(-(0.5 * (t * t)));
    };
    // Exponents from 0 to beyond 40, densely around the limits, and every kind of scale.
    for (const int scale : {0, 1, 7, 100, 256, 257, 300, 65535, 99999, 100000, 100001, 3000000})
        for (const double sigma : {0.2, 0.25, 1.0})
            for (int i = 0; i <= 4000; i++) {
                const double x = -sigma * i * 0.0025;
                const int bell = bell_cost(x, sigma, scale), well = well_cost(x, sigma, scale);
                if (bell != static_cast<int>(scale * gaussian(x, sigma)) ||
                    well != static_cast<int>(scale * (1 - gaussian(x, sigma))))
                    FAIL_CHECK("scale " << scale << ", sigma " << sigma << ", x " << x);
            }
}

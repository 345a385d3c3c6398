// vec3.h: three doubles. Only + - * / and sqrt are used: they are exact to the last bit on every IEEE machine.
#pragma once

#include <cmath>

namespace polylab {

struct Vec3 {
    double x = 0, y = 0, z = 0;

    double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

    Vec3 operator+(const Vec3& b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vec3 operator-(const Vec3& b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vec3 operator-() const { return {-x, -y, -z}; }
    Vec3 operator*(double s) const { return {x * s, y * s, z * s}; }
    Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
    bool operator==(const Vec3& b) const { return x == b.x && y == b.y && z == b.z; }
};

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

// a / |a|, or the zero vector where |a| is at most 1e-30 (a facet without area has no normal).
inline Vec3 unit(const Vec3& a) {
    const double length = norm(a);
    return length > 1e-30 ? a * (1 / length) : Vec3{};
}

}   // namespace polylab

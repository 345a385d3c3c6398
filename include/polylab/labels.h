// labels.h: the six labels of a polycube (paper, Section 3.1).
//
//   label      0   1   2   3   4   5         axis(l)     = l / 2     0 = X, 1 = Y, 2 = Z
//   direction  +X  -X  +Y  -Y  +Z  -Z        opposite(l) = l xor 1
#pragma once

#include "polylab/vec3.h"

#include <cstdint>
#include <vector>

namespace polylab {

using Label = std::int8_t;             // 0..5; kNoLabel where a file or a lock leaves it open
using Labeling = std::vector<Label>;   // one label per facet, in the order of the file
inline constexpr int kLabels = 6;
inline constexpr Label kNoLabel = -1;
inline constexpr const char* kLabelName[kLabels] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

constexpr int axis(Label l) { return l / 2; }
constexpr Label opposite(Label l) { return static_cast<Label>(l ^ 1); }
constexpr bool orthogonal(Label a, Label b) { return axis(a) != axis(b); }

inline Vec3 direction(Label l) {
    Vec3 d;
    d[axis(l)] = l % 2 == 0 ? 1.0 : -1.0;
    return d;
}

// How much of n goes along l: dot(n, direction(l)) without the multiplications.
inline double along(const Vec3& n, Label l) { return l % 2 == 0 ? n[axis(l)] : -n[axis(l)]; }

}   // namespace polylab

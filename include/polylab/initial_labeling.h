// initial_labeling.h: the labelings that need no repair yet (paper, Section 5).
#pragma once

#include "polylab/alpha_expansion.h"
#include "polylab/costs.h"
#include "polylab/mesh.h"

#include <vector>

namespace polylab {

struct InitialOptions {
    int compactness = 1;          // weight of the pairwise cost, 0..1000
    int fidelity = 3;             // weight of the data cost, 0..1000; paper: ratio 1/3
    double sensitivity = 1e-9;    // facets whose two best labels are closer than this are tilted (published code; paper: 1e-10)
    double angle = 0.05;          // rad, by which they are tilted around X, then Y, then Z
    bool free_features = false;   // whether borders on kept feature edges cost nothing; not in the paper, see search.h
};

// The label closest to each normal; the first of equals; +X for a facet without area. O(n)
// port: on facets at exactly 45 degrees rounding decides (the paper's reason for the tilt): compute normals as mesh.h does,
// in the same order of operations.
Labeling naive_labeling(const TriMesh& mesh);

// Facets at which the two largest of the six along(normal, l), negative ones counting as 0, differ by less than `sensitivity`:
// near 45 degrees, where rounding would decide. A facet without area is one of them; tilting leaves its zero normal.
std::vector<char> facets_to_tilt(const TriMesh& mesh, double sensitivity);

// R n with R = Rz Ry Rx, c and s of the angle, as one matrix:
//   [ c c   s c (s-1)     s (c c + s) ]   the published matrix: first around X, (y, z) -> (c y - s z, s y + c z), then around
//   [ s c   s s s + c c   s c (s-1)   ]   Y, (x, z) -> (c x + s z, c z - s x), then around Z, (x, y) -> (c x - s y, s x + c y)
//   [ -s    s c           c c         ]
Vec3 tilted(const Vec3& normal, const SinCos& angle);

// trunc(100 fidelity (1 - exp(-((n.d - 1)/0.2)^2 / 2))): what it costs to give label l to a facet with this normal.
int data_cost(const Vec3& normal, Label l, int fidelity);

// trunc(100 compactness exp(-((n.m - 1)/0.25)^2 / 2)): what it costs to separate facets with these normals.
int pairwise_cost(const Vec3& normal, const Vec3& neighbour, int compactness);

// The whole energy: one site per facet, one edge per mesh edge, tilted normals in the data cost only.
PottsEnergy labeling_energy(const TriMesh& mesh, const InitialOptions& options = {});

// Alpha-expansion of that energy, two cycles from +X everywhere. O(n) but for the max-flow.
// Facets with a label in `locks` (empty: none) get it: any other costs 100000 more.
// Once `stop` says so, which is asked before each of the twelve moves: the labels so far or the naive ones, whichever have
// less energy.
Labeling graphcut_labeling(const TriMesh& mesh, const InitialOptions& options = {}, const Labeling& locks = {},
                           const Stop& stop = {});

}   // namespace polylab

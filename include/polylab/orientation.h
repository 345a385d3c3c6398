// orientation.h: which way each component of a closed surface has to face.
//
// Outer shells face outward and the shells of cavities inward, decided per component by signed volume and nesting;
// the published code tests one vertex of the whole mesh and labels an inward second component with flipped signs.
#pragma once

#include "polylab/base.h"
#include "polylab/vec3.h"

#include <vector>

namespace polylab {

struct Orientation {
    std::vector<char> turn;   // facet -> 1 where it has to be turned
    Index components = 0;     // edge-connected
    Index cavities = 0;
    Index turned_components = 0;   // of which every facet has to be turned
};

// `origin` has three vertices per facet, `opposite` pairs the half-edges 3f+k of the edges, whatever direction their
// facets have. Throws InputError where a component can't be oriented. Facets are first turned like the
// smallest one of their component; then the whole is turned if its signed volume (about its first vertex) has the wrong sign:
// negative, or positive where an odd number of components contain it. Without volume it stays like its smallest facet.
// O(n) for the volumes; nesting: boxes of all pairs of components that overlap along x, then one point location
// for each component whose box is inside another's.
Orientation orient(const std::vector<Vec3>& points, const std::vector<Index>& origin, const std::vector<Index>& opposite);

}   // namespace polylab

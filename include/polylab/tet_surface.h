// tet_surface.h: from a tetrahedral mesh to its surface and back (paper, Figure 2: the labeling is on the surface of a
// tet mesh, the hex mesher wants it on the tetrahedra's facets).
//
//        3          facet k of a tetrahedron is opposite to its vertex k. Seen from outside, counter-clockwise:
//       /|\           0: 1 2 3    1: 0 3 2    2: 3 0 1    3: 0 2 1
//      0-|-2
//       \|/         surface map: one number per triangle, 4 * tetrahedron + k
//        1          volume labels: one label per tetrahedron facet, at 4 * tetrahedron + k; kNoLabel inside
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace polylab {

struct SurfaceMap {
    Index tets = 0;
    std::vector<Index> tet_facet;   // triangle -> 4 * tetrahedron + k, strictly increasing
};

struct TetSurface {
    MeshData surface;   // facets by tetrahedron, then k; vertices of the surface only, in the order of the file
    SurfaceMap map;
};

// The facets that belong to one tetrahedron only. Feature edges with both ends on the surface are kept.
// Throws InputError: no tetrahedron, a repeated vertex, a facet of more than two tetrahedra. O(n)
TetSurface extract_surface(const MeshData& data);

// Labels of the tetrahedra's facets from those of the surface. Throws InputError where the sizes differ.
Labeling volume_labels(const Labeling& surface_labels, const SurfaceMap& map);

// `N triangles`, `M tetrahedra`, then one number per triangle.
std::string surface_map_text(const SurfaceMap& map);
SurfaceMap read_surface_map(const std::string& path);
SurfaceMap read_surface_map_text(std::string_view text, const std::string& name);

}   // namespace polylab

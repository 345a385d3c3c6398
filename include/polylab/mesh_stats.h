// mesh_stats.h: what there is to count and measure in a mesh file, of triangles, tetrahedra or hexahedra.
#pragma once

#include "polylab/mesh.h"

#include <array>
#include <string>
#include <vector>

namespace polylab {

struct PrincipalAxes {
    Vec3 centre;                    // mean of the vertices
    std::array<Vec3, 3> axis;       // orthogonal unit vectors, the longest extent first; largest coordinate positive
    std::array<double, 3> extent;   // standard deviation along each
};

// Of the vertices, which must not be none. O(n)
PrincipalAxes principal_axes(const std::vector<Vec3>& points);

// Least over the eight corners of a hexahedron (MEDIT's order) of the determinant of the unit vectors along its edges there:
// 1 for a box, 0 or less where it is folded, also where an edge has no length.
double scaled_jacobian(const std::array<Vec3, 8>& hex);

// JSON in the layout of the statistics files, with the published names:
//   cells     by_type.{hexahedra,tetrahedra}, edges, facets, nb, quality.hex_SJ.{avg,max,min,sd}, volume
//   edges     nb: edges that the file lists
//   facets    area.{avg,max,min,sd,sum}, edges, nb, normals_outward: triangles that the file lists
//   vertices  nb, principal_axes (three unit vectors), x, y, z.{avg,max,min,sd}
// What there is nothing to measure of is left out; the counts always stand. sd: over all of them, not of a sample.
// Throws InputError where an element has a vertex that is not there. O(n log n)
std::string mesh_stats_json(const MeshData& data);

}   // namespace polylab

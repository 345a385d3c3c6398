// shapes.h: small meshes by name, for the tests.
//
// Coordinates are integers, so that normals of equal planes are equal to the last bit; facets face outward and surfaces
// are closed, unless the name says otherwise. None has feature edges; creased() adds them.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace polylab::shapes {

// Pseudo-random integers, the same on every machine: a linear congruential generator, its upper bits.
class Lcg {
public:
    explicit Lcg(std::uint64_t seed) : state_(seed) { below(1); }

    // 0 .. n-1
    Index below(Index n) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<Index>((state_ >> 33) % static_cast<std::uint64_t>(n));
    }

    // 0 .. n-1 in random order
    std::vector<Index> permutation(Index n);

private:
    std::uint64_t state_;
};

// ---- shapes ----

MeshData tetrahedron();                 // corner at the origin, the other vertices at distance 1 along X, Y, Z
MeshData octahedron();                  // vertices at distance 1 along +X -X +Y -Y +Z -Z, in this order
MeshData box(int nx, int ny, int nz);   // from the origin; squares of side 1, 2 facets each; facets in the order of labels:
MeshData cube(int n);                   // facet f of cube(n) faces direction(f / (2 n n))

// The surface of the union of unit cells [x,x+1] x [y,y+1] x [z,z+1]. Facets cell by cell, 2 per free side in the order of
// labels. Cells that share only a vertex give one vertex with two fans; cells that share only an edge an edge with four
// facets, which is no mesh.
using Cell = std::array<int, 3>;
MeshData voxels(const std::vector<Cell>& cells);

//   y                   z
//   2 +---+             3        +---+          3 +---+---+---+
//     |   |             2    +---+   |          2 |   +---+   |
//   1 +   +---+         1 +--+       |          1 |   +---+   |
//   0 +---+---+         0 +--+---+---+          0 +---+---+---+        all of thickness 1
//     0   1   2 x         0  1   2   3 x          0   1   2   3 x
//      l_shape()           stair(3)                frame(), genus 1
MeshData l_shape();
MeshData stair(int steps);
MeshData frame();
MeshData hollow_box();              // 3 x 3 x 3 with a cavity of one cell
MeshData two_cubes_at_a_vertex();   // two components, two fans at their common vertex (1,1,1)
MeshData pinched_ring();            // a bent bar, one component, whose ends touch in the vertex (1,1,2)

// A polygon (z = 0, counter-clockwise from above, all of it seen from point 0) extruded along +Z. Vertices: polygon below,
// polygon above. Facets: two per side, first those from point 0 to point 1; then the lower face, then the upper one.
MeshData prism(const std::vector<Vec3>& polygon, int height);
MeshData triangular_prism(int a, int b, int height);   // polygon (0,0) (a,0) (0,b): the first slanted facets are 2 and 3
MeshData pyramid(int n);   // n-gon of radius 1000, apex at height 1000: facets 0..n-1 at the sides, then the base

// ---- unusual ones ----

MeshData pillow();                        // two facets on the same three vertices, facing opposite ways
MeshData tetrahedron_with_flat_facet();   // facet 4 has no area: vertex 4 is the middle of its edge 0-1
MeshData mobius_strip(int n);             // 2n facets, not closed
MeshData projective_plane();              // closed, 10 facets, one side only

// ---- from shape to shape ----

void append(MeshData& data, const MeshData& other);   // vertex numbers of `other` shifted
MeshData joined(MeshData a, const MeshData& b);
MeshData moved(MeshData data, const Vec3& by);
MeshData scaled(MeshData data, double by);
MeshData turned(MeshData data);                                  // every facet with its vertices 1 and 2 exchanged
MeshData turned(MeshData data, const std::vector<char>& turn);   // facets with turn[f] only

// Every facet cut in four at the middles of its edges, coordinates doubled. Vertices keep their numbers; facet f becomes
// 4f..4f+3, the first three at its vertices 0, 1, 2. Feature edges are cut in two.
MeshData refined(const MeshData& data);

// All edges whose two facets lie in different planes, each once, 2 vertices per edge; and the shape with them as its
// feature edges. The surface may be non-closed or turned.
std::vector<Index> creases(const MeshData& data);
MeshData creased(MeshData data);

// The same shape with facets, vertices and feature edges in random order, and the vertices of each facet and feature edge
// rotated. Old facet f is new facet `facet[f]`, old vertex v new vertex `vertex[v]`.
struct Renumbered {
    MeshData data;
    std::vector<Index> facet, vertex;

    Labeling labels(const Labeling& old) const;   // the same labels on the new facets
};
Renumbered renumbered(const MeshData& data, Lcg& random);

// The shape after a symmetry of the axes, without rounding; facets still face outward, and keep their numbers.
struct Mapped {
    MeshData data;
    std::array<Label, kLabels> image;   // label -> what it becomes

    Labeling labels(Labeling old) const;
};
Mapped rotated_axes(const MeshData& data, int i);   // i = 0..23, the rotations; 0 changes nothing
Mapped mirrored(const MeshData& data, int axis);    // coordinate `axis` negated

}   // namespace polylab::shapes

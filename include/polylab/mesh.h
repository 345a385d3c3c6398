// mesh.h: the triangle mesh everything stands on (paper, Section 3; input of the whole method).
//
// A half-edge is a number: h = 3f + k runs inside facet f from its vertex k to its vertex (k+1)%3. Facets are
// counter-clockwise seen from outside, so facet(h) is at the left of h and facet(opposite(h)) at its right.
//
//              to(h)
//               o                       next(h), prev(h)   around the facet, counter-clockwise
//      left    /|\    right             ccw(h)             the next half-edge counter-clockwise around from(h)
//    facet(h) / | \  facet(opposite(h)) cw(h)              the next one clockwise around from(h)
//            o  |h o
//             \ | /                     ccw(h) has facet(h) at its right: ccw(h) = opposite(prev(h))
//               o                       cw(h) has the right facet at its left: cw(h) = next(opposite(h))
//             from(h)
//
// The mesh is closed: every half-edge has an opposite. One array of opposites is all that is stored of the connectivity.
// A vertex where several solids touch has several fans; turning around a half-edge's origin stays in its fan.
#pragma once

#include "polylab/base.h"
#include "polylab/vec3.h"

#include <algorithm>
#include <string>
#include <vector>

namespace polylab {

// What a mesh file holds: flat arrays of vertex indices counted from 0, in the file's order. Indices are in range
// and coordinates are finite when it comes from a reader; nothing else is promised.
struct MeshData {
    std::vector<Vec3> points;
    std::vector<Index> edges;       // 2 per edge: feature edges
    std::vector<Index> triangles;   // 3 per triangle
    std::vector<Index> tets;        // 4 per tetrahedron
    std::vector<Index> hexes;       // 8 per hexahedron, in MEDIT's order
};

// Facet normals whose cosine is below this (angle of 0.5 rad, 28.6 degrees) make a sharp edge. paper: "ignored" edges
// are those of low dihedral angle; the published code's threshold. An edge of a facet without area is never sharp.
inline constexpr double kFeatureCos = 0.87758256189037276;

struct FeatureOptions {
    bool detect = false;   // true: all sharp edges of the geometry, instead of those that the file names
    double cosine = kFeatureCos;
};

constexpr Index facet(Index h) { return h / 3; }
constexpr Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

struct TriMesh {
    std::vector<Vec3> points;      // vertex -> position, model units
    std::vector<Index> origin;     // half-edge -> vertex it leaves; facet f has the vertices origin[3f..3f+2]
    std::vector<Index> opposite;   // half-edge -> the other half-edge of its edge, never kNone
    std::vector<Vec3> normal;      // facet -> unit normal, outward; zero where the facet has no area
    std::vector<char> feature;     // half-edge -> 1 on a kept feature edge (both half-edges have it)
    std::vector<Index> outgoing;   // vertex -> the smallest half-edge that leaves it, kNone without facet
    std::vector<Index> fans;       // of vertices with several fans: the smallest half-edge of each further fan, by vertex
    double mean_edge = 0;          // mean length of all half-edges, added by number: the unit of lengths of all operators

    // What construction met, for messages and statistics.
    Index components = 0;          // edge-connected
    Index cavities = 0;            // components that bound a hole inside another one
    Index turned_components = 0;   // components turned as a whole
    Index turned_facets = 0;       // facets whose direction differs from the file's
    Index isolated_vertices = 0;   // vertices without facet, kept in the numbering
    Index flat_facets = 0;         // facets without area
    Index features_given =
        0;   // feature edges of the file, as listed (an OBJ polyline of n vertices has n - 1); 0 where they are detected
    Index features_kept = 0;   // distinct edges with feature[h] set
    Index features_off = 0;    // those of the file, as listed, that are not edges of the surface

    Index vertices() const { return static_cast<Index>(points.size()); }
    Index facets() const { return static_cast<Index>(normal.size()); }
    Index halfedges() const { return static_cast<Index>(origin.size()); }

    Index from(Index h) const { return origin[h]; }
    Index to(Index h) const { return origin[next(h)]; }
    Index left(Index h) const { return facet(h); }
    Index right(Index h) const { return facet(opposite[h]); }
    Index ccw(Index h) const { return opposite[prev(h)]; }
    Index cw(Index h) const { return next(opposite[h]); }
    Index edge(Index h) const { return h < opposite[h] ? h : opposite[h]; }   // one number per edge

    // Calls visit(h) for each half-edge that leaves the vertex: fan by fan, each counter-clockwise from its smallest one.
    template <class Visit>
    void for_each_leaving(Index vertex, const Visit& visit) const {
        const auto turn = [&](Index first) {
            Index h = first;
            do {
                visit(h);
                h = ccw(h);
            } while (h != first);
        };
        if (outgoing[vertex] != kNone) turn(outgoing[vertex]);
        auto fan = std::lower_bound(fans.begin(), fans.end(), vertex, [&](Index h, Index v) { return from(h) < v; });
        for (; fan != fans.end() && from(*fan) == vertex; fan++) turn(*fan);
    }

    Vec3 vector(Index h) const { return points[to(h)] - points[from(h)]; }
    // Normal of a facet times twice its area.
    Vec3 area_vector(Index f) const {
        const Vec3& p = points[origin[3 * f]];
        return cross(points[origin[3 * f + 1]] - p, points[origin[3 * f + 2]] - p);
    }
};

// Builds the mesh: connectivity, orientation (outer shells outward, the shells of cavities inward), normals, feature
// edges. Vertices and facets keep their numbers; a facet that has to be turned has its vertices 1 and 2 exchanged.
// Tetrahedra and hexahedra of `data` are left aside.
// Throws InputError, naming the element (counted from 0): no facet, a repeated vertex in a facet, an index out of range,
// a coordinate that is not finite or beyond 1e75, an edge with one facet or more than two, a duplicate facet, facets
// that can't be turned consistently (a Möbius strip).
// O(n), but for nested components: one point location per candidate pair of components.
TriMesh build_mesh(MeshData data, const FeatureOptions& features = {});

// One sentence for each thing that construction repaired or tolerated; empty for a clean file.
std::vector<std::string> notes(const TriMesh& mesh);

// Throws std::logic_error where an invariant of TriMesh does not hold. For tests. O(n)
void validate(const TriMesh& mesh);

}   // namespace polylab

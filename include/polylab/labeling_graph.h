// labeling_graph.h: charts, boundaries and corners of a labeling, and which of them are invalid (paper, Sections 3.2, 3.3
// and 4).
//
// Chart      edge-connected facets with one label.
// Boundary   a chain of half-edges between two charts, from corner to corner, or closed.
// Corner     a vertex at which three or more boundary edges meet within one fan of facets.
//
//                 left chart              half-edges h[0] .. h[k-1], all with the left chart at their left;
//    start o-----o-----o-----o end        closed through one corner: start == end;
//                 right chart             closed without corner:     start == end == kNone
//
// Numbers follow a local rule, so that two programs agree on them: charts by their smallest facet, corners by vertex,
// boundaries by the smallest half-edge they hold, on either side; a boundary runs the way that half-edge does, and a
// closed one without corner starts there.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>
#include <vector>

namespace polylab {

// A run of entries in one of the graph's flat arrays.
struct Range {
    Index first = 0, last = 0;   // first .. last - 1

    Index size() const { return last - first; }
};

struct Chart {
    Label label = 0;
    Index smallest_facet = kNone;
    Index facets = 0;     // number of them
    Range boundaries;     // in LabelingGraph::chart_boundaries, by increasing number
    bool valid = false;   // at least 4 boundaries: published code; paper: adjacent charts. differs on closed contacts
};

struct Boundary {
    Index smallest = kNone;              // half-edge, on either side
    Range halfedges;                     // in LabelingGraph::halfedges, in order
    Index left = kNone, right = kNone;   // charts
    Index start = kNone, end = kNone;    // corners
    int axis = kNone;                    // the axis it follows in the polycube; kNone between opposite labels
    bool on_features = false;            // every edge is a kept feature edge
    bool valid = false;                  // orthogonal labels; or opposite ones, if allowed, where no edge is_convex()

    bool closed() const { return start == end; }   // through one corner, or without corner
};

// A corner has one ring per fan of facets in which three or more boundary edges meet.
struct Ring {
    Index corner = kNone;
    Range halfedges;   // in LabelingGraph::ring_halfedges: border half-edges that leave the vertex,
                       // counter-clockwise, the smallest first
    bool valid = false;
};

struct Corner {
    Index vertex = kNone;
    Range rings;          // in LabelingGraph::rings
    Index valence = 0;    // boundary edges that meet here
    bool valid = false;   // every ring is
};

struct LabelingGraph {
    bool allow_opposite = true;   // accept boundaries between opposite labels over edges of 180 degrees or more

    std::vector<Chart> charts;
    std::vector<Boundary> boundaries;
    std::vector<Corner> corners;
    std::vector<Ring> rings;

    std::vector<Index> chart;              // facet -> chart
    std::vector<Index> boundary;           // half-edge -> boundary; kNone inside charts
    std::vector<Index> corner;             // vertex -> corner or kNone
    std::vector<Index> halfedges;          // of all boundaries
    std::vector<Index> chart_boundaries;   // of all charts
    std::vector<Index> ring_halfedges;     // of all rings

    Index invalid_charts = 0, invalid_boundaries = 0, invalid_corners = 0;

    Index invalid() const { return invalid_charts + invalid_boundaries + invalid_corners; }
    bool valid() const { return invalid() == 0; }

    bool is_border(Index h) const { return boundary[h] != kNone; }
    // Whether the half-edge, of a border, runs with its boundary (or is the opposite of one that does).
    bool runs_with_boundary(Index h) const { return chart[facet(h)] == boundaries[boundary[h]].left; }
    Index neighbour(Index b, Index c) const { return boundaries[b].left == c ? boundaries[b].right : boundaries[b].left; }
    // The border half-edge that follows h counter-clockwise around its origin; h itself if there is no other.
    Index next_border_ccw(const TriMesh& mesh, Index h) const;
    Index next_border_cw(const TriMesh& mesh, Index h) const;
};

// The graph of a labeling. One pass over the half-edges and facets, then work along the boundaries only. O(n)
LabelingGraph build_graph(const TriMesh& mesh, const Labeling& labels, bool allow_opposite = true);

// A change of labels, with what EffectFinder finds out about it.
struct GraphChange {
    std::vector<Index> facets;   // those whose labels change, each once
    std::vector<Index> fans;     // a half-edge in each fan that such a facet is part of
    bool same_charts = false;    // no chart comes, goes, or has another smallest facet
    std::vector<Index> to;       // if so: the chart of each of these facets, in the same order
    std::vector<Index> charts;   // if not: facet -> a number, at most `most_chart`, that the facets of its chart share
    Index most_chart = kNone;
};

// Makes the graph of the labels before a change that of `labels`: the same that build_graph() gives. Boundaries that do not pass
// the change are only moved to their new places. O(length of all boundaries), and O(n) where the charts are not the same
void update_graph(const TriMesh& mesh, const Labeling& labels, const GraphChange& change, LabelingGraph& graph);

inline constexpr Index kLeastBoundaries = 4;   // of a valid chart

// The axis that a boundary between two labels follows in the polycube; kNone between opposite ones.
constexpr int boundary_axis(Label left, Label right) {
    return orthogonal(left, right) ? 3 - axis(left) - axis(right) : static_cast<int>(kNone);
}

// Whether boundary axes around a ring can be those of a polycube's corner (paper, Section 4; the published code's rule).
// axes: of the boundaries in ring order; kNone (-) between opposite labels.
//   1. If allow_opposite is false and some axis is -, the ring is invalid.
//   2. Each axis next to a -, on either side around the ring, is left out: both neighbours of such a boundary turn back there.
//   3. Count what is left per axis. Nothing left: valid (the vertex lies inside the volume). One axis only: valid if it is
//      there exactly twice (the vertex lies on a boundary). Otherwise valid if the three counts are all even or all odd:
//      pairs, or pairs and one trio X Y Z.
// So XXYY, XYZ, XXXYZ, -XX, -XXXX, ---- are valid; XXXX, XXX, XXYZ, -XYZ, -X-XXX are not.
// differs: the paper's words (pairs or one trio); rings of one vertex are judged each alone, where the published code pools them.
bool valid_ring(const std::vector<int>& axes, bool allow_opposite);

// Whether the solid's angle at the edge is less than 180 degrees: the right facet's far vertex p lies below the left facet,
// n . e / (|n| |e|) < -1e-9 with n = area_vector(left(h)), e = p - from(h).
// A flat edge is not convex.   tie: within 1e-9 of the plane counts as 180 degrees. differs: published without tolerance, so
// that rounding noise in a flat seam decides
bool is_convex(const TriMesh& mesh, Index h);

// All of the graph as text, one element per line, numbers only: equal graphs give equal texts, in any program.
std::string graph_text(const LabelingGraph& graph);

// Throws std::logic_error where the graph is not the labeling's: counts, incidences, numbering, directions. For tests.
void validate(const TriMesh& mesh, const Labeling& labels, const LabelingGraph& graph);

}   // namespace polylab

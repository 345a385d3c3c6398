// turning_points.h: where a boundary turns back along its axis (paper, Section 3.4 and Figure 7).
//
// Each edge of a boundary is to go along +axis (1) or -axis (0). A cost per edge for going against its direction and a
// cost per change, from Evocube, make an integer energy on a chain; it is minimised exactly. A turning-point sits at the
// vertex between two edges of different direction.
//
// differs: the published count depends on the direction in which a boundary is traversed and on where a closed one starts,
// because ties are broken along the way and closed boundaries are solved as open chains. Here the answer has, among the
// labelings of least energy, the fewest turning-points, then the smallest sum of their vertices; closed boundaries are
// closed chains. The algorithms use this count for their score; the class of a result and the exit status follow the
// published one, which published_turning_points() reproduces exactly.
#pragma once

#include "polylab/labeling_graph.h"

#include <vector>

namespace polylab {

// The energy of a two-label problem on a chain of n edges. change[i] is between edge i and edge i+1; the last one, between
// the last edge and the first, is used in closed chains only.
struct Chain {
    std::vector<int> cost[2];    // edge -> cost of going along -axis [0], along +axis [1]
    std::vector<int> change;     // edge -> cost of the next edge going the other way
    std::vector<Index> vertex;   // edge -> vertex where it starts

    Index size() const { return static_cast<Index>(change.size()); }
};

// The chain of half-edges given in order, along an axis.
Chain make_chain(const TriMesh& mesh, const std::vector<Index>& halfedges, int axis);

// The turning-points of least energy: positions i where edge i goes the other way than edge i-1 (0 only if closed),
// increasing. tie: fewest, then smallest sum of vertices, then the last edge along +axis. O(n)
std::vector<Index> chain_turns(const Chain& chain, bool closed);

// The same by the published rules: an open chain, ties go to +axis from the end backwards, but all -axis wins if it is as
// good; a closed one has 0 appended last if its ends differ.
std::vector<Index> published_chain_turns(const Chain& chain, bool closed);

struct TurningPoint {
    Index boundary = kNone;
    Index position = kNone;   // in the boundary: the turning-point is where its half-edge number `position` starts
    Index vertex = kNone;
};

struct TurningPoints {
    std::vector<TurningPoint> points;   // by boundary, then position
    Index vertices = 0;                 // distinct ones among them: what the published statistics count
    Index non_monotone_boundaries = 0;
};

// Boundaries of one edge and boundaries between opposite labels have none. O(length of all boundaries)
TurningPoints find_turning_points(const TriMesh& mesh, const LabelingGraph& graph);

// As the published code counts them: boundaries traversed in the order, and from the starts, in which it discovers them
// (depth-first from corners, as Section 3.2 of the paper has it).
TurningPoints published_turning_points(const TriMesh& mesh, const LabelingGraph& graph);

// Whether the turning-point leans to the left of its boundary: to the side with the larger sum of facet angles.
// tie: equal sums lean left
bool leans_left(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t);

// The corner of the boundary that is nearer along it; kNone for closed boundaries without corner. tie: the end
Index closest_corner(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t);

}   // namespace polylab

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

// The chain of half-edges given in order, along an axis. With e = unit vector of an edge, d = e[axis]:
//   u = well_cost(d, 0.9, 100);   d > 0: cost[0] = u, cost[1] = 0;   else: cost[0] = 0, cost[1] = u
//   change = bell_cost(e . e' - 1, 1.0, 100), e' that of the next edge (after the last one, of the first)
Chain make_chain(const TriMesh& mesh, const std::vector<Index>& halfedges, int axis);

// The turning-points of least energy: positions i where edge i goes the other way than edge i-1 (0 only if closed),
// increasing. `closed` is Boundary::closed(), also through one corner: then position 0 is that corner. O(n)
// tie: fewest, then smallest sum of vertices. What is left between equals goes so: the open chain by dynamic programming
// from the first edge on, keeping the direction of the edge before where turning is no better in (energy, turning-points, sum),
// the last edge along +axis; a closed one the first best of (first edge, last edge) along ++, -+, +-, --.
std::vector<Index> chain_turns(const Chain& chain, bool closed);

// The same by the published rules: an open chain; ties go to +axis, for the last edge and for each edge before, from the
// end backwards; but if all edges along -axis have the least energy too, there is no turning-point. If `closed`, position 0
// is appended last where the first and the last edge go different ways.
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

    Range of(Index boundary) const;   // in points; O(log n)
};

// Boundaries of one edge and boundaries between opposite labels have none. O(length of all boundaries)
TurningPoints find_turning_points(const TriMesh& mesh, const LabelingGraph& graph);

// The same, where the points of an earlier graph are known: the boundaries that have not changed since keep theirs.
TurningPoints find_turning_points(const TriMesh& mesh, const LabelingGraph& graph, const std::vector<Boundary>& old_boundaries,
                                  const std::vector<Index>& old_halfedges, const TurningPoints& old);

// As the published code counts them: each boundary traversed in the direction in which that code discovers it. It goes over
// all half-edges h by number. Where from(h) is a corner with a ring in the fan of h, and h is not a border of a ring recorded
// there, the borders of that ring are pushed on a stack, counter-clockwise, beginning with the first border after h (h itself
// last, if it is one); the ring is recorded if its corner has none yet. While the stack is not empty, the top border is taken
// off: if its boundary is not traversed yet, it is, starting there (against its own direction: the opposites of its
// half-edges in reverse order); at its other end, unless that ring is recorded, the ring is recorded and its borders are
// pushed, beginning with the first one after next(last half-edge). Boundaries without corner keep their start and direction.
TurningPoints published_turning_points(const TriMesh& mesh, const LabelingGraph& graph);

// Whether the turning-point leans to the left of its boundary: to the side with the larger sum of facet angles, each
// angle_cost() of the two edges of a facet at the vertex.   tie: equal sums lean left
bool leans_left(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t);

// The corner of the boundary that is nearer along it, by the sums of the edges' lengths before and after the turning-point, in
// the boundary's order: the start where steps(before / mean_edge) < steps(after / mean_edge). kNone for closed boundaries without
// corner. tie: the end
Index closest_corner(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t);

}   // namespace polylab

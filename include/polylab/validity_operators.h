// validity_operators.h: operators that make invalid charts, boundaries and corners valid (paper, Sections 6.3.1 and 6.4.1).
//
// Each takes one element of a state and proposes patches, most faithful to the paper first; where the paper leaves a
// choice open (side, width, label) the variants follow. An empty list is a refusal. The routine tries them and keeps the
// best, if it improves the score. None of them depends on anything but mesh and state.
#pragma once

#include "polylab/paths.h"

#include <vector>

namespace polylab {

using Proposals = std::vector<Patch>;

// The chart takes the label of its neighbours, where these have only one and none of its boundaries lies on feature edges.
// differs: one chart at a time (the published code can exchange two of them for ever).
Proposals remove_surrounded_chart(const TriMesh& mesh, const State& state, Index chart);

// Section 6.4.1, Figure 14. At a vertex where two consecutive boundary edges of the chart's contour follow the same axis (a
// corner, or a turning-point) a third axis is inserted: from the vertex to an equilibrium point along one of the two
// polyedges, a new chart is set into the neighbour, between two paths that leave in the direction of the chart's label.
// differs: every such vertex is tried, on both polyedges; the axis to insert follows from the two it has to differ from.
Proposals increase_chart_valence(const TriMesh& mesh, const State& state, Index chart);

// Section 6.3.1, opposite boundaries (Figure 11): a new chart along an invalid boundary, orthogonal to both its sides.
// Variants: four labels, best first; left, right or both sides; width 1, 2 or 5 rings of facets. Where the boundary turns
// round between two charts of one axis (the rim of a lens, say), also several charts in a row, each where its label fits.
Proposals opposite_boundary(const TriMesh& mesh, const State& state, Index boundary);

// Section 6.3.1, high valence corner: a new chart around an invalid corner, and one along each lost feature edge that
// leaves it. Variants: label, width; last, one of the charts around it gives way along one of its boundaries.
Proposals high_valence_corner(const TriMesh& mesh, const State& state, Index corner);

// Section 6.3.1, chart removal: the facets of the charts take labels of the neighbouring charts by a graph-cut on these
// facets alone, the surroundings being fixed. Variants: compactness 1, 3 and 9 against fidelity 1.
Proposals remove_charts(const TriMesh& mesh, const State& state, const std::vector<Index>& charts);

Proposals remove_chart(const TriMesh& mesh, const State& state, Index chart);

// The charts at one side, the other or both sides of an invalid boundary are removed (Algorithm 1, line 20).
Proposals remove_charts_around_boundary(const TriMesh& mesh, const State& state, Index boundary);

// No proposal of these removals costs less: every facet takes the best label that it may, and the feature edges inside are won
// back. Much quicker than the cuts.
std::int64_t least_loss_of_removal(const Judge& judge, const State& state, const std::vector<Index>& charts);
std::int64_t least_loss_of_removing_chart(const Judge& judge, const State& state, Index chart);
std::int64_t least_loss_of_removing_around(const Judge& judge, const State& state, Index boundary);

// The chart spreads over the facets around it, 1 to 8 rings far, all around or into one neighbour: a chart that is too
// small for its place may reach more neighbours. Not in the paper.
Proposals grow_chart(const TriMesh& mesh, const State& state, Index chart);

// Whether every boundary of the chart lies on kept feature edges: then it is the part's own shape, and not to be removed.
bool surrounded_by_features(const State& state, Index chart);

}   // namespace polylab

// quality_operators.h: operators that remove turning-points (paper, Sections 6.3.2, 6.4.2 to 6.4.5).
//
// As in validity_operators.h: one element in, proposals out, the most faithful to the paper first.
#pragma once

#include "polylab/validity_operators.h"

namespace polylab {

// Section 6.4.2, Figure 15: a turning-point at the end of lost feature edges that lead through a chart to another one gets
// a new chart along them. Variants: side, label, width. Refused where the way does not end at the chart's border.
Proposals join_turning_points(const TriMesh& mesh, const State& state, const TurningPoint& t);

// Section 6.4.3, Figure 16: the boundary that comes next at the closest corner is re-traced so that the corner moves onto
// the turning-point; what lies between takes the label beyond that boundary. Variants: along a lost feature edge or a
// greedy path; the whole region or a thin strip; the other side, the other corner.
// differs: for all turning-points, where the paper pulls to those on feature edges only; what helps is kept, wherever it is.
Proposals pull_closest_corner(const TriMesh& mesh, const State& state, const TurningPoint& t);

// Section 6.4.4, Figure 17: the facets around the turning-point take the label of the side with the larger angle.
// Variants: one, two or four rings; the other side's label (chart propagation, Section 6.3.2).
Proposals move_boundary_near(const TriMesh& mesh, const State& state, const TurningPoint& t);

// Section 6.4.5: the boundary is re-drawn between its ends, each run between kept feature edges on its own, by the edges
// that lead closest to the run's end. differs: runs on feature edges stay, where only whole boundaries did.
Proposals straighten_boundary(const TriMesh& mesh, const State& state, Index boundary);

// Gregson 2011, path smoothing of Evocube: facets with two neighbours of one other label take it, until none is left.
Proposals smooth_boundaries(const TriMesh& mesh, const State& state);

// Directional path (Gregson 2011, Evocube), made deterministic: a chart along a path that leaves the turning-point along an
// axis through one of its two charts. Variants: direction, side, label, width.
Proposals directional_path(const TriMesh& mesh, const State& state, const TurningPoint& t);

}   // namespace polylab

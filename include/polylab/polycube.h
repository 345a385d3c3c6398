// polycube.h: the polycube that a labeling asks for, and what it does to the surface (paper, Section 8: "distortion").
//
// Each chart gets one coordinate along its axis: the vertices of all facets with a label of axis a that hang together share
// their coordinate a. Along the two other axes each facet wants to keep its edges as they are, weighted by its area: least
// squares, one system per axis, solved by conjugate gradients.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <vector>

namespace polylab {

// The position of each vertex in the polycube, model units. Every edge-connected set of components keeps the mean of its
// vertices; vertices without facet stay where they are. A part that is a polycube with its own labels is mapped onto itself,
// to the last bit where coordinates are small integers. All coordinates are finite, whatever the labeling; one that is not
// valid may lay facets over each other or collapse them.
// Pre: one label 0..5 per facet.   O(n) per iteration, some hundred iterations on large parts; 10 000 at most
std::vector<Vec3> surface_polycube(const TriMesh& mesh, const Labeling& labels);

// How the facets of the surface are deformed; s1 >= s2 are the singular values of a facet's map after the polycube is scaled
// to the surface's area, means are weighted by the facets' areas on the surface. 1 is best for all four.
struct Distortion {
    double stretch = 0;     // 1 / (mean of (s1^2 + s2^2) / 2)^2, at most 1: higher is better
    double area = 0;        // mean of (s1 s2 + 1 / (s1 s2)) / 2
    double angle = 0;       // mean of (s1 / s2 + s2 / s1) / 2
    double isometric = 0;   // mean of max(s1, 1 / s2)
    Index collapsed = 0;    // facets with s2 below 1e-6: left out of the last three means (which are 0 if nothing is left)
    Index turned = 0;       // facets whose normal in the polycube is more than 90 degrees from that on the surface
};

// Facets without area on the surface count nowhere. `polycube` has a position for each vertex of the mesh. O(n)
// differs: the published code divides by zero at collapsed facets.
Distortion distortion(const TriMesh& mesh, const std::vector<Vec3>& polycube);

}   // namespace polylab

// paths.h: what the operators of Section 6 share: paths across charts, regions between paths, bands, label choice.
//
// All of them read a state and change nothing. Lengths are in mean edges of the mesh, so nothing depends on its scale.
#pragma once

#include "polylab/alpha_expansion.h"
#include "polylab/state.h"

#include <array>
#include <initializer_list>
#include <vector>

namespace polylab {

using Halfedges = std::vector<Index>;

Halfedges reversed(const TriMesh& mesh, const Halfedges& path);   // the same way back

// A walk through one chart from a vertex of its border, edge by edge as close to the direction as possible, until it
// meets the border again or a turning-point (paper, 6.4.1 and 6.4.3). Each next edge is the one best aligned with a
// target that runs ahead, so the walk comes back to its line. Empty where it turns back or meets itself.
// differs: look-ahead in mean edges, not in model units; never along a border; no vertex twice.
// Kept feature edges within 25 degrees of the line are preferred.   tie: first clockwise
Halfedges greedy_path(const TriMesh& mesh, const State& state, Index vertex, Index chart, const Vec3& direction);

// Along feature edges inside one chart, from half-edge h (a lost feature edge, leaving a vertex of the chart's border)
// until the border, a dead end or a vertex met before. At a junction the straightest edge is taken.
Halfedges lost_feature_path(const TriMesh& mesh, const State& state, Index h);

// The lost feature edges that leave a vertex, in the order of the fan.
Halfedges lost_features_at(const TriMesh& mesh, const State& state, Index outgoing);

// Facets of a chart that are reached from the seeds (facets of it) without crossing the walls (half-edges, either way).
// Empty where both sides of a wall are reached: then the walls enclose nothing.
std::vector<Index> region_between(const TriMesh& mesh, const State& state, Index chart, const std::vector<Index>& seeds,
                                  const Halfedges& walls);

// The facets of a chart, increasing. O(n): one look at each facet from the chart's smallest to its largest
std::vector<Index> facets_of(const State& state, Index chart);

// The facets of a chart at its side of a run of its border, one per half-edge, whichever way the run goes.
std::vector<Index> facets_beside(const TriMesh& mesh, const State& state, const Halfedges& run, Index chart);

// Facets of a chart (kNone: of any) that touch the given vertices, then those that touch these: for each of the widths, which
// increase, so many rings.
std::vector<std::vector<Index>> bands(const TriMesh& mesh, const State& state, const std::vector<Index>& vertices, Index chart,
                                      std::initializer_list<int> widths);
inline std::vector<Index> band(const TriMesh& mesh, const State& state, const std::vector<Index>& vertices, Index chart,
                               int width) {
    return bands(mesh, state, vertices, chart, {width}).front();
}

// The facets at the left of a path through a chart, `width` rings deep inside that chart and connected along the path,
// without those that lie at its right.
std::vector<Index> strip_beside(const TriMesh& mesh, const State& state, const Halfedges& path, int width);

// Whether some boundary passes the origin of the half-edge, within its fan.
bool on_border(const TriMesh& mesh, const State& state, Index outgoing);

std::vector<Index> vertices_of(const TriMesh& mesh, const Halfedges& path);   // in order; a closed path ends with its first one

// The half-edges around a chart, the chart at their left, one list per contour: the contour of its boundary of smallest
// number first, beginning with that boundary.
std::vector<Halfedges> contours(const TriMesh& mesh, const State& state, Index chart);

// A contour cut into the boundaries it consists of, in order.
std::vector<Halfedges> runs_of(const State& state, const Halfedges& contour);

// The energy of labels for some facets, all different (site i is facets[i]), while all others keep theirs: data(f, l) per
// facet, weight(h) per edge between different labels, the same from both sides. An edge to a fixed facet costs its one site.
// `numbers` has the facets' sites: an IndexSet or Marks. O(n) in the facets
template <class Numbers, class Data, class Weight>
void set_local_energy(PottsEnergy& energy, const TriMesh& mesh, const Labeling& labels, const std::vector<Index>& facets,
                      const Numbers& numbers, const Data& data, const Weight& weight) {
    energy.data.resize(facets.size());
    energy.arcs.resize(facets.size());
    for (std::size_t i = 0; i < facets.size(); i++) {
        std::array<Index, kLabels>& cost = energy.data[i];
        for (Label l = 0; l < kLabels; l++) cost[l] = data(facets[i], l);
        for (int k = 0; k < 3; k++) {
            const Index h = 3 * facets[i] + k, g = mesh.right(h), site = numbers.number(g), w = weight(h);
            energy.arcs[i][k] = site == kNone ? PottsEnergy::Arc{static_cast<Index>(i), 0} : PottsEnergy::Arc{site, w};
            if (site != kNone || w == 0) continue;
            for (Label l = 0; l < kLabels; l++) cost[l] += l == labels[g] ? 0 : w;
        }
    }
}

// Sum of the facets' unit normals.
Vec3 mean_normal(const TriMesh& mesh, const std::vector<Index>& facets);

// All labels, the closest to a vector first.   tie: smallest label
std::vector<Label> labels_by_fit(const Vec3& normal);

// The label closest to a vector whose axis is none of the two given.   tie: smallest label
Label best_label(const Vec3& v, int forbidden_axis, int other_forbidden_axis);

Patch relabel(const std::vector<Index>& facets, Label label);

}   // namespace polylab

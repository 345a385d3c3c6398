#include "polylab/validity_operators.h"

#include "polylab/costs.h"
#include "polylab/initial_labeling.h"

#include <algorithm>
#include <array>

namespace polylab {

namespace {

constexpr std::initializer_list<int> kWidths = {1, 2, 5};          // rings of facets of a chart inserted along a boundary
constexpr std::initializer_list<int> kGivenWidths = {1, 3};        // along a boundary that moves
constexpr std::initializer_list<int> kCornerWidths = {1, 2, 4};    // around a corner
constexpr std::initializer_list<int> kGrowWidths = {1, 2, 4, 8};   // around a chart that grows
constexpr std::size_t kShortestSegment = 3;   // edges of a contour that go over to an inserted axis, unless fewer balance
constexpr Index kForbidden = 100000;          // cost of a label that a facet must not take

// ---- increase chart valence (6.4.1)

// A place on a contour where a third axis is to be inserted.
struct Spot {
    Index vertex;
    Halfedges down, up;   // polyedges that leave the vertex along the contour, clockwise and counter-clockwise
};

std::vector<Spot> find_spots(const TriMesh& mesh, const State& state, const Halfedges& contour) {
    std::vector<Spot> spots;
    const std::vector<Halfedges> runs = runs_of(state, contour);
    for (std::size_t r = 0; r < runs.size(); r++) {
        const Halfedges &run = runs[r], &following = runs[(r + 1) % runs.size()];
        const Index b = state.graph.boundary[run[0]];
        const int axis = state.graph.boundaries[b].axis;
        if (axis == kNone) continue;
        for (const TurningPoint& t : state.turning.points) {
            if (t.boundary != b) continue;
            const auto at = std::find_if(run.begin(), run.end(), [&](Index h) { return mesh.from(h) == t.vertex; });
            if (at == run.begin() || at == run.end()) continue;
            spots.push_back({t.vertex, reversed(mesh, {run.begin(), at}), {at, run.end()}});
        }
        const Index corner = mesh.to(run.back());
        if (runs.size() > 1 && state.graph.boundaries[state.graph.boundary[following[0]]].axis == axis &&
            state.graph.corner[corner] != kNone)
            spots.push_back({corner, reversed(mesh, run), following});
    }
    return spots;
}

std::int32_t axis_cost(const TriMesh& mesh, Index h, int axis) {
    const Vec3 e = unit(mesh.vector(h));
    return angle_cost(std::abs(e[axis]));
}

// How many edges of the polyedge, from the spot on, go over to the inserted axis: up to where doing so costs more than
// keeping the current axis beyond.
std::size_t equilibrium(const TriMesh& mesh, const Halfedges& polyedge, int inserted_axis, int current_axis) {
    std::int64_t inserted = 0, current = 0;
    for (const Index h : polyedge) current += axis_cost(mesh, h, current_axis);
    for (std::size_t i = 0; i < polyedge.size(); i++) {
        inserted += axis_cost(mesh, polyedge[i], inserted_axis);
        if (inserted > current) return i;
        current -= axis_cost(mesh, polyedge[i], current_axis);
    }
    return polyedge.size();
}

// The largest angle, over the points, between the direction and the edge that follows it best.
std::int32_t worst_start(const TriMesh& mesh, const std::vector<Index>& leaving, const Vec3& along_direction) {
    std::int32_t worst = 0;
    for (const Index start : leaving) {
        std::int32_t best = angle_cost(-1.0);
        Index h = start;
        do {
            best = std::min(best, angle_cost(mesh.vector(h), along_direction));
            h = mesh.cw(h);
        } while (h != start);
        worst = std::max(worst, best);
    }
    return worst;
}

// The new chart between the first `edges` edges of a polyedge and the paths that leave its two ends, in the chart across.
Patch chart_beside(const TriMesh& mesh, const State& state, Index chart, const Spot& spot, const Halfedges& polyedge,
                   std::size_t edges) {
    const Halfedges segment(polyedge.begin(), polyedge.begin() + static_cast<std::ptrdiff_t>(edges));
    const Index support = state.graph.neighbour(state.graph.boundary[segment[0]], chart);
    const Label label = state.graph.charts[chart].label, support_label = state.graph.charts[support].label;

    const Index far_end = mesh.opposite[segment.back()];
    const Vec3 positive = direction(label);
    const bool forward = worst_start(mesh, {segment[0], far_end}, positive) < worst_start(mesh, {segment[0], far_end}, -positive);
    const Vec3 away = forward ? positive : -positive;

    // At a corner the neighbour's own border is the wall; elsewhere a path is traced.
    Halfedges walls;
    const auto add_wall = [&](Index vertex) {
        if (state.graph.corner[vertex] != kNone) return true;
        const Halfedges path = greedy_path(mesh, state, vertex, support, away);
        walls.insert(walls.end(), path.begin(), path.end());
        return !path.empty();
    };
    if (!add_wall(spot.vertex) || !add_wall(mesh.to(segment.back())) || walls.empty()) return {};

    const std::vector<Index> seeds = facets_beside(mesh, state, segment, support);
    const std::vector<Index> region = region_between(mesh, state, support, seeds, walls);
    return relabel(region, best_label(mean_normal(mesh, region), axis(label), axis(support_label)));
}

// ---- charts along boundaries and around corners

Halfedges boundary_path(const State& state, Index b) {
    const Range r = state.graph.boundaries[b].halfedges;
    return {state.graph.halfedges.begin() + r.first, state.graph.halfedges.begin() + r.last};
}

void propose(Proposals& proposals, const std::vector<Index>& facets, Label label) {
    if (!facets.empty()) proposals.push_back(relabel(facets, label));
}

// How a boundary faces, across the axis, as seen from each facet of a band along it (ordered by ring): carried outward from its
// edges, vertex by vertex, and bent to the facet's own normal.
std::vector<Vec3> facing(const TriMesh& mesh, const Halfedges& path, const std::vector<Index>& facets, int axis) {
    IndexSet known;
    std::vector<Vec3> at;   // by number of a known vertex
    const auto add = [&](Index v, const Vec3& d) {
        if (known.insert(v)) at.emplace_back();
        at[known.number(v)] += d;
    };
    for (const Index h : path) {
        Vec3 d = mesh.area_vector(mesh.left(h)) + mesh.area_vector(mesh.right(h));
        d[axis] = 0;
        add(mesh.from(h), d);
        add(mesh.to(h), d);
    }
    std::vector<Vec3> result;
    for (const Index f : facets) {
        Vec3 sum = mesh.normal[f];
        sum[axis] = 0;
        for (Index h = 3 * f; h < 3 * f + 3; h++)
            if (known.has(mesh.from(h))) sum += unit(at[known.number(mesh.from(h))]);
        result.push_back(unit(sum));
        for (Index h = 3 * f; h < 3 * f + 3; h++)
            if (!known.has(mesh.from(h))) add(mesh.from(h), sum);
    }
    return result;
}

// New charts along a rim that turns, where no label fits all of it: each facet of the band takes a label across the axis of the
// two charts, by the graph-cut of Section 5 on the directions in which the rim faces.
void charts_along_rim(Proposals& proposals, const TriMesh& mesh, const State& state, const Halfedges& path,
                      const std::vector<Index>& facets, int rim_axis) {
    const IndexSet sites(facets);
    const std::vector<Vec3> directions = facing(mesh, path, facets, rim_axis);
    PottsEnergy energy;
    set_local_energy(
        energy, mesh, state.labels, facets, sites,
        [&](Index f, Label l) { return axis(l) == rim_axis ? kForbidden : data_cost(directions[sites.number(f)], l, 3); },
        [&](Index h) { return pairwise_cost(mesh.normal[mesh.left(h)], mesh.normal[mesh.right(h)], 1); });
    const Labeling labels = alpha_expansion(energy, Labeling(facets.size(), rim_axis == 0 ? 2 : 0));
    Patch patch;
    for (std::size_t i = 0; i < facets.size(); i++) patch.push_back({facets[i], labels[i]});
    const bool turns = std::any_of(labels.begin(), labels.end(), [&](Label l) { return l != labels[0]; });
    if (turns) proposals.push_back(std::move(patch));
}

std::vector<Index> joined(std::vector<Index> facets, const std::vector<Index>& others) {
    facets.insert(facets.end(), others.begin(), others.end());
    return facets;
}

// A new chart that covers the vertex.
void chart_around(Proposals& proposals, const TriMesh& mesh, const State& state, Index vertex) {
    for (const std::vector<Index>& around : bands(mesh, state, {vertex}, kNone, kCornerWidths))
        for (const Label l : labels_by_fit(mean_normal(mesh, around))) propose(proposals, around, l);
}

// A new chart beside each lost feature edge of the vertex, along the way that it leads: a boundary that should be there.
void charts_along_lost_features(Proposals& proposals, const TriMesh& mesh, const State& state, Index leaving) {
    for (const Index lost : lost_features_at(mesh, state, leaving)) {
        const Halfedges path = lost_feature_path(mesh, state, lost);
        const Label old = state.labels[mesh.left(lost)];
        for (const Halfedges& side : {path, reversed(mesh, path)}) {
            const std::vector<Index> strip = strip_beside(mesh, state, side, 1);
            for (const Label l : labels_by_fit(mean_normal(mesh, strip)))
                if (orthogonal(l, old)) propose(proposals, strip, l);
        }
    }
}

// One side of a boundary takes the label of the other along it, so that the boundary moves away from its corners.
void sides_give_way(Proposals& proposals, const TriMesh& mesh, const State& state, Index b) {
    const Boundary& boundary = state.graph.boundaries[b];
    const std::vector<Index> vertices = vertices_of(mesh, boundary_path(state, b));
    const Label left = state.graph.charts[boundary.left].label, right = state.graph.charts[boundary.right].label;
    const std::vector<std::vector<Index>> at_left = bands(mesh, state, vertices, boundary.left, kGivenWidths),
                                          at_right = bands(mesh, state, vertices, boundary.right, kGivenWidths);
    for (std::size_t i = 0; i < kGivenWidths.size(); i++) {
        propose(proposals, at_left[i], right);
        propose(proposals, at_right[i], left);
    }
}

// ---- chart removal

// Chart -> the labels that its facets may take when these charts are removed: those of the neighbours that stay.
std::vector<std::array<char, kLabels>> allowed_labels(const LabelingGraph& graph, const std::vector<Index>& charts) {
    std::vector<char> removed(graph.charts.size(), 0);
    std::vector<std::array<char, kLabels>> allowed(graph.charts.size(), std::array<char, kLabels>{});
    for (const Index c : charts) removed[c] = 1;
    for (const Index c : charts)
        for (Index i = graph.charts[c].boundaries.first; i < graph.charts[c].boundaries.last; i++) {
            const Index other = graph.neighbour(graph.chart_boundaries[i], c);
            if (!removed[other]) allowed[c][graph.charts[other].label] = 1;
        }
    return allowed;
}

struct Cut {
    PottsEnergy energy;
    std::vector<Index> facets;   // site -> facet
};

Cut removal_cut(const TriMesh& mesh, const State& state, const std::vector<Index>& charts, int compactness) {
    Cut cut;
    const std::vector<std::array<char, kLabels>> allowed = allowed_labels(state.graph, charts);
    for (const Index c : charts) {
        const std::vector<Index> facets = facets_of(state, c);
        cut.facets.insert(cut.facets.end(), facets.begin(), facets.end());
    }
    std::sort(cut.facets.begin(), cut.facets.end());   // by number, all different
    set_local_energy(
        cut.energy, mesh, state.labels, cut.facets, IndexSet(cut.facets),
        [&](Index f, Label l) { return data_cost(mesh.normal[f], l, 1) + (allowed[state.graph.chart[f]][l] ? 0 : kForbidden); },
        [&](Index h) { return pairwise_cost(mesh.normal[mesh.left(h)], mesh.normal[mesh.right(h)], compactness); });
    return cut;
}

}   // namespace

bool surrounded_by_features(const State& state, Index chart) {
    const Range r = state.graph.charts[chart].boundaries;
    for (Index i = r.first; i < r.last; i++)
        if (!state.graph.boundaries[state.graph.chart_boundaries[i]].on_features) return false;
    return r.size() > 0;
}

Proposals remove_surrounded_chart(const TriMesh&, const State& state, Index chart) {
    const Range r = state.graph.charts[chart].boundaries;
    Label around = kNoLabel;
    for (Index i = r.first; i < r.last; i++) {
        const Index b = state.graph.chart_boundaries[i];
        const Label label = state.graph.charts[state.graph.neighbour(b, chart)].label;
        if (state.graph.boundaries[b].on_features || (around != kNoLabel && label != around)) return {};
        around = label;
    }
    if (around == kNoLabel) return {};
    return {relabel(facets_of(state, chart), around)};
}

Proposals increase_chart_valence(const TriMesh& mesh, const State& state, Index chart) {
    Proposals proposals;
    const int chart_axis = axis(state.graph.charts[chart].label);
    for (const Halfedges& contour : contours(mesh, state, chart)) {
        for (const Spot& spot : find_spots(mesh, state, contour)) {
            const int current = state.graph.boundaries[state.graph.boundary[spot.up[0]]].axis,
                      inserted = 3 - current - chart_axis;
            for (const Halfedges& polyedge : {spot.down, spot.up}) {
                const std::size_t balanced = equilibrium(mesh, polyedge, inserted, current);
                for (std::size_t edges = balanced; edges > 0 && (edges == balanced || edges >= kShortestSegment); edges /= 2) {
                    Patch patch = chart_beside(mesh, state, chart, spot, polyedge, edges);
                    if (!patch.empty()) proposals.push_back(std::move(patch));
                }
            }
        }
    }
    return proposals;
}

Proposals opposite_boundary(const TriMesh& mesh, const State& state, Index boundary) {
    Proposals proposals;
    const Boundary& b = state.graph.boundaries[boundary];
    const Halfedges path = boundary_path(state, boundary);
    Vec3 normal;
    for (const Index h : path) normal += mesh.area_vector(mesh.left(h)) + mesh.area_vector(mesh.right(h));
    const std::vector<Index> vertices = vertices_of(mesh, path);
    const std::vector<std::vector<Index>> at_left = bands(mesh, state, vertices, b.left, kWidths),
                                          at_right = bands(mesh, state, vertices, b.right, kWidths);
    for (std::size_t i = 0; i < kWidths.size(); i++) {
        const std::vector<Index>&left = at_left[i], &right = at_right[i];
        const std::vector<Index> both = joined(left, right);
        for (const Label l : labels_by_fit(normal)) {
            if (!orthogonal(l, state.graph.charts[b.left].label) || !orthogonal(l, state.graph.charts[b.right].label)) continue;
            for (const std::vector<Index>* facets : {&left, &right, &both}) propose(proposals, *facets, l);
        }
        if (axis(state.graph.charts[b.left].label) == axis(state.graph.charts[b.right].label))
            for (const auto* facets : {&left, &right, &both})
                charts_along_rim(proposals, mesh, state, path, *facets, axis(state.graph.charts[b.left].label));
    }
    return proposals;
}

Proposals high_valence_corner(const TriMesh& mesh, const State& state, Index corner) {
    Proposals proposals;
    const Corner& c = state.graph.corners[corner];
    chart_around(proposals, mesh, state, c.vertex);
    for (Index r = c.rings.first; r < c.rings.last; r++) {
        const Range ring = state.graph.rings[r].halfedges;
        charts_along_lost_features(proposals, mesh, state, state.graph.ring_halfedges[ring.first]);
        for (Index i = ring.first; i < ring.last; i++)
            sides_give_way(proposals, mesh, state, state.graph.boundary[state.graph.ring_halfedges[i]]);
    }
    return proposals;
}

Proposals remove_charts(const TriMesh& mesh, const State& state, const std::vector<Index>& charts) {
    Proposals proposals;
    if (charts.empty()) return proposals;
    for (const int compactness : {1, 3, 9}) {
        const Cut cut = removal_cut(mesh, state, charts, compactness);
        const Labeling labels = alpha_expansion(cut.energy, Labeling(cut.facets.size(), 0));
        Patch patch;
        for (std::size_t i = 0; i < cut.facets.size(); i++)
            if (cut.energy.data[i][labels[i]] < kForbidden) patch.push_back({cut.facets[i], labels[i]});
        if (!patch.empty() && (proposals.empty() || proposals.back().size() != patch.size() ||
                               !std::equal(patch.begin(), patch.end(), proposals.back().begin(),
                                           [](const Relabel& a, const Relabel& b) { return a.label == b.label; })))
            proposals.push_back(std::move(patch));
    }
    return proposals;
}

std::int64_t least_loss_of_removal(const Judge& judge, const State& state, const std::vector<Index>& charts) {
    const TriMesh& mesh = judge.mesh();
    const std::vector<std::array<char, kLabels>> allowed = allowed_labels(state.graph, charts);
    std::int64_t loss = 0;
    for (const Index c : charts) {
        std::vector<Label> labels;
        for (Label l = 0; l < kLabels; l++)
            if (allowed[c][l]) labels.push_back(l);
        if (labels.empty()) continue;   // the chart stays
        for (const Index f : facets_of(state, c)) {
            std::int64_t least = judge.locked(f) ? judge.loss(f, state.labels[f]) : kAnyLoss;
            for (const Label l : labels) least = std::min(least, judge.loss(f, l));
            loss += least - judge.loss(f, state.labels[f]);
            for (Index h = 3 * f; h < 3 * f + 3; h++)
                if (mesh.feature[h] && h < mesh.opposite[h] && !state.graph.is_border(h)) loss -= judge.loss_per_feature();
        }
    }
    return loss;
}

std::int64_t least_loss_of_removing_chart(const Judge& judge, const State& state, Index chart) {
    return least_loss_of_removal(judge, state, {chart});
}

// Removing both charts costs what removing each alone costs, or more: neither can take the label of the other.
std::int64_t least_loss_of_removing_around(const Judge& judge, const State& state, Index boundary) {
    const Boundary& b = state.graph.boundaries[boundary];
    const std::int64_t left = least_loss_of_removal(judge, state, {b.left}),
                       right = least_loss_of_removal(judge, state, {b.right});
    return std::min({left, right, left + right});
}

Proposals remove_chart(const TriMesh& mesh, const State& state, Index chart) { return remove_charts(mesh, state, {chart}); }

Proposals remove_charts_around_boundary(const TriMesh& mesh, const State& state, Index boundary) {
    Proposals proposals;
    const Boundary& b = state.graph.boundaries[boundary];
    for (const std::vector<Index>& charts : {std::vector<Index>{b.left}, {b.right}, {b.left, b.right}})
        for (Patch& patch : remove_charts(mesh, state, charts)) proposals.push_back(std::move(patch));
    return proposals;
}

Proposals grow_chart(const TriMesh& mesh, const State& state, Index chart) {
    Proposals proposals;
    std::vector<Index> vertices, neighbours = {kNone};
    for (const Halfedges& contour : contours(mesh, state, chart))
        for (const Index h : contour) {
            vertices.push_back(mesh.from(h));
            neighbours.push_back(state.graph.chart[mesh.right(h)]);
        }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (const Index into : neighbours)
        for (const std::vector<Index>& facets : bands(mesh, state, vertices, into, kGrowWidths))
            propose(proposals, facets, state.graph.charts[chart].label);
    return proposals;
}

}   // namespace polylab

#include "polylab/quality_operators.h"

#include "polylab/costs.h"

#include <algorithm>

namespace polylab {

namespace {

constexpr Index kShortestRun = 3;                               // edges; shorter ones have nothing to straighten
constexpr int kStripWidths[] = {1, 3};                          // rings of facets of a chart along a path
constexpr int kThinWidth = 2;                                   // of the thin chart that a pull may leave
constexpr std::initializer_list<int> kMoveWidths = {1, 2, 4};   // around a turning-point

// The half-edge of the boundary that leaves the turning-point.
Index outgoing(const State& state, const TurningPoint& t) {
    return state.graph.halfedges[state.graph.boundaries[t.boundary].halfedges.first + t.position];
}

void propose_strips(Proposals& proposals, const TriMesh& mesh, const State& state, const Halfedges& path,
                    std::initializer_list<Label> unwanted) {
    for (const int width : kStripWidths) {
        for (const Halfedges& side : {path, reversed(mesh, path)}) {
            const std::vector<Index> strip = strip_beside(mesh, state, side, width);
            if (strip.empty()) continue;
            for (Label l = 0; l < kLabels; l++)
                if (std::find(unwanted.begin(), unwanted.end(), l) == unwanted.end()) proposals.push_back(relabel(strip, l));
        }
    }
}

// ---- pull closest corner (6.4.3)

// One way to pull: chart S at one side of the boundary, the contour of S from the turning-point to the corner, and the run
// of S's contour behind the corner.
struct Pull {
    Index chart;           // S
    Halfedges to_corner;   // S at one side, leaving the turning-point
    Halfedges moved;       // the boundary behind the corner, leaving it
    Label label;           // beyond the moved boundary
};

std::vector<Pull> pulls(const TriMesh& mesh, const State& state, const TurningPoint& t) {
    std::vector<Pull> result;
    const Boundary& boundary = state.graph.boundaries[t.boundary];
    const bool left_first = leans_left(mesh, state.graph, t);
    const Index nearest = closest_corner(mesh, state.graph, t);
    for (const Index chart : {left_first ? boundary.left : boundary.right, left_first ? boundary.right : boundary.left}) {
        for (const Halfedges& contour : contours(mesh, state, chart)) {
            const std::vector<Halfedges> runs = runs_of(state, contour);
            if (runs.size() < 2) continue;
            for (std::size_t r = 0; r < runs.size(); r++) {
                const Halfedges& run = runs[r];
                if (state.graph.boundary[run[0]] != t.boundary) continue;
                const auto at = std::find_if(run.begin(), run.end(), [&](Index h) { return mesh.from(h) == t.vertex; });
                if (at == run.end() || at == run.begin()) continue;
                const Halfedges &after = runs[(r + 1) % runs.size()], &before = runs[(r + runs.size() - 1) % runs.size()];
                Pull forward{chart,
                             {at, run.end()},
                             after,
                             state.graph.charts[state.graph.neighbour(state.graph.boundary[after[0]], chart)].label};
                Pull backward{chart, reversed(mesh, {run.begin(), at}), reversed(mesh, before),
                              state.graph.charts[state.graph.neighbour(state.graph.boundary[before[0]], chart)].label};
                const bool forward_first = nearest != kNone && state.graph.corners[nearest].vertex == mesh.to(run.back());
                result.push_back(forward_first ? forward : backward);
                result.push_back(forward_first ? backward : forward);
            }
        }
    }
    return result;
}

void propose_pull(Proposals& proposals, const TriMesh& mesh, const State& state, const Pull& pull, const Halfedges& path) {
    if (path.empty()) return;
    const std::vector<Index> seeds = facets_beside(mesh, state, pull.to_corner, pull.chart);
    const std::vector<Index> region = region_between(mesh, state, pull.chart, seeds, path);
    if (region.empty()) return;
    proposals.push_back(relabel(region, pull.label));
    // The thin chart: the part of the region beside the path.
    const IndexSet in(region);
    std::vector<Index> strip = band(mesh, state, vertices_of(mesh, path), pull.chart, kThinWidth);
    strip.erase(std::remove_if(strip.begin(), strip.end(), [&](Index f) { return !in.has(f); }), strip.end());
    if (strip.size() < region.size()) proposals.push_back(relabel(strip, pull.label));
}

// ---- straighten (6.4.5)

// From the start of a run to its end by the edges that lead closest to the end, inside the two charts of its boundary.
Halfedges straight_path(const TriMesh& mesh, const State& state, const Boundary& boundary, const Halfedges& run) {
    const Index target = mesh.to(run.back());
    IndexSet visited(std::initializer_list<Index>{mesh.from(run[0])});
    Halfedges path;
    const auto in_charts = [&](Index f) {
        return state.graph.chart[f] == boundary.left || state.graph.chart[f] == boundary.right;
    };
    const auto usable = [&](Index tip_edge) {   // a vertex on the way must be surrounded by the two charts
        if (mesh.to(tip_edge) == target) return true;
        Index h = mesh.opposite[tip_edge];
        do {
            if (!in_charts(facet(h)) || mesh.feature[h]) return false;
            h = mesh.cw(h);
        } while (h != mesh.opposite[tip_edge]);
        return true;
    };
    Index around = run[0];
    while (mesh.from(around) != target) {
        const Vec3 aim = mesh.points[target] - mesh.points[mesh.from(around)];
        Index best = kNone;
        std::int64_t best_value = 0;
        Index h = around;
        do {
            h = mesh.cw(h);
            const double length = norm(mesh.vector(h)) * mesh.mean_edge;
            const std::int64_t value = length > 0 ? steps(dot(mesh.vector(h), aim) / length) : 0;
            if (value > best_value && !visited.has(mesh.to(h)) && in_charts(mesh.left(h)) && in_charts(mesh.right(h)) &&
                usable(h)) {   // tie: first clockwise
                best = h;
                best_value = value;
            }
        } while (h != around);
        if (best == kNone) return {};
        path.push_back(best);
        visited.insert(mesh.to(best));
        around = mesh.opposite[best];
    }
    return path;
}

// What changes when the boundary runs along `path` instead of its present way: facets between the two take the label of the side
// on which they come to lie.
Patch redrawn(const TriMesh& mesh, const State& state, const Boundary& boundary, const Halfedges& path) {
    Patch patch;
    for (const bool left : {true, false}) {
        const Index from = left ? boundary.right : boundary.left, to = left ? boundary.left : boundary.right;
        std::vector<Index> seeds;
        for (const Index h : path) {
            const Index f = left ? mesh.left(h) : mesh.right(h);
            if (state.graph.chart[f] == from) seeds.push_back(f);
        }
        if (seeds.empty()) continue;
        const std::vector<Index> region = region_between(mesh, state, from, seeds, path);
        if (region.empty()) return {};
        for (const Index f : region) patch.push_back({f, state.graph.charts[to].label});
    }
    return patch;
}

}   // namespace

Proposals join_turning_points(const TriMesh& mesh, const State& state, const TurningPoint& t) {
    Proposals proposals;
    const Boundary& boundary = state.graph.boundaries[t.boundary];
    const Label left = state.graph.charts[boundary.left].label, right = state.graph.charts[boundary.right].label;
    for (const Index lost : lost_features_at(mesh, state, outgoing(state, t))) {
        const Halfedges path = lost_feature_path(mesh, state, lost);
        if (!on_border(mesh, state, mesh.opposite[path.back()])) continue;
        propose_strips(proposals, mesh, state, path, {left, right});
    }
    return proposals;
}

Proposals pull_closest_corner(const TriMesh& mesh, const State& state, const TurningPoint& t) {
    Proposals proposals;
    for (const Pull& pull : pulls(mesh, state, t)) {
        const Vec3 along_moved = mesh.points[mesh.to(pull.moved.back())] - mesh.points[mesh.from(pull.moved[0])];
        for (const Index lost : lost_features_at(mesh, state, outgoing(state, t)))
            if (state.graph.chart[facet(lost)] == pull.chart)
                propose_pull(proposals, mesh, state, pull, lost_feature_path(mesh, state, lost));
        propose_pull(proposals, mesh, state, pull, greedy_path(mesh, state, t.vertex, pull.chart, along_moved));
    }
    return proposals;
}

Proposals move_boundary_near(const TriMesh& mesh, const State& state, const TurningPoint& t) {
    Proposals proposals;
    const Boundary& boundary = state.graph.boundaries[t.boundary];
    const bool left = leans_left(mesh, state.graph, t);
    for (const Index to : {left ? boundary.left : boundary.right, left ? boundary.right : boundary.left}) {
        const Index from = to == boundary.left ? boundary.right : boundary.left;
        for (const std::vector<Index>& facets : bands(mesh, state, {t.vertex}, from, kMoveWidths))
            if (!facets.empty()) proposals.push_back(relabel(facets, state.graph.charts[to].label));
    }
    return proposals;
}

Proposals straighten_boundary(const TriMesh& mesh, const State& state, Index b) {
    Proposals proposals;
    const Boundary& boundary = state.graph.boundaries[b];
    if (boundary.start == kNone) return proposals;   // a closed boundary without corner has no ends to keep
    Patch all;
    for (Index i = boundary.halfedges.first; i < boundary.halfedges.last;) {
        Halfedges run;
        for (; i < boundary.halfedges.last && !mesh.feature[state.graph.halfedges[i]]; i++)
            run.push_back(state.graph.halfedges[i]);
        if (run.empty()) i++;
        if (static_cast<Index>(run.size()) <= kShortestRun || mesh.from(run[0]) == mesh.to(run.back())) continue;
        const Halfedges path = straight_path(mesh, state, boundary, run);
        if (path.empty() || path == run) continue;
        Patch patch = redrawn(mesh, state, boundary, path);
        all.insert(all.end(), patch.begin(), patch.end());
        if (!patch.empty()) proposals.push_back(std::move(patch));
    }
    if (proposals.size() > 1) proposals.insert(proposals.begin(), std::move(all));
    return proposals;
}

Proposals smooth_boundaries(const TriMesh& mesh, const State& state) {
    Labeling labels = state.labels;
    const auto majority = [&](Index f) {
        for (Index h = 3 * f; h < 3 * f + 3; h++) {
            const Label l = labels[mesh.right(h)];
            if (l != labels[f] && (l == labels[mesh.right(next(h))] || l == labels[mesh.right(prev(h))])) return l;
        }
        return labels[f];
    };
    // In rounds, so that a row of teeth goes down together. Each change shortens the borders by an edge, so it ends.
    for (bool changed = true; changed;) {
        changed = false;
        for (Index f = 0; f < mesh.facets(); f++) {
            const Label l = majority(f);
            bool keeps_features = true;
            for (Index h = 3 * f; h < 3 * f + 3; h++)
                keeps_features = keeps_features && !(mesh.feature[h] && labels[mesh.right(h)] == l);
            if (l == labels[f] || !keeps_features) continue;
            labels[f] = l;
            changed = true;
        }
    }
    Patch patch;
    for (Index f = 0; f < mesh.facets(); f++)
        if (labels[f] != state.labels[f]) patch.push_back({f, labels[f]});
    return patch.empty() ? Proposals{} : Proposals{patch};
}

Proposals directional_path(const TriMesh& mesh, const State& state, const TurningPoint& t) {
    Proposals proposals;
    const Boundary& boundary = state.graph.boundaries[t.boundary];
    const Label left = state.graph.charts[boundary.left].label, right = state.graph.charts[boundary.right].label;
    for (const Index chart : {boundary.left, boundary.right})
        for (Label d = 0; d < kLabels; d++) {
            const Halfedges path = greedy_path(mesh, state, t.vertex, chart, direction(d));
            if (!path.empty()) propose_strips(proposals, mesh, state, path, {left, right});
        }
    return proposals;
}

}   // namespace polylab

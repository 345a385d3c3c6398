#include "polylab/paths.h"

#include "polylab/costs.h"

#include <algorithm>
#include <array>

namespace polylab {

namespace {

constexpr double kLookAhead = 10;                     // mean edges
constexpr std::int64_t kOne = 1 << 30;                // in steps
constexpr std::int64_t kFeatureAligned = 973140576;   // cos 25 degrees, in steps

// The cosine between two vectors, in steps; that of a right angle if one has no length.
std::int64_t cosine(const Vec3& a, const Vec3& b) {
    const double lengths = norm(a) * norm(b);
    return lengths > 0 ? steps(dot(a, b) / lengths) : 0;
}

bool inside(const TriMesh& mesh, const State& state, Index h, Index chart) {
    return state.graph.chart[mesh.left(h)] == chart && state.graph.chart[mesh.right(h)] == chart;
}

bool is_turning_point(const State& state, Index vertex) {
    return std::any_of(state.turning.points.begin(), state.turning.points.end(),
                       [&](const TurningPoint& t) { return t.vertex == vertex; });
}

// The half-edge around the origin of `around` that runs inside the chart and is best aligned with the direction.
Index most_aligned(const TriMesh& mesh, const State& state, Index around, Index chart, const Vec3& direction) {
    Index best = kNone;
    std::int64_t best_value = 0;   // beyond a right angle it turns back
    Index h = around;
    do {
        h = mesh.cw(h);
        if (!inside(mesh, state, h, chart)) continue;
        const std::int64_t c = cosine(mesh.vector(h), direction);
        const std::int64_t value = mesh.feature[h] && c > kFeatureAligned ? c + kOne : c;
        if (value > best_value) {   // tie: first clockwise
            best = h;
            best_value = value;
        }
    } while (h != around);
    return best;
}

// The smallest half-edge that leaves the vertex from a facet of the chart, or kNone.
Index leaving(const TriMesh& mesh, const State& state, Index vertex, Index chart) {
    Index smallest = kNone;
    mesh.for_each_leaving(vertex, [&](Index h) {
        if (state.graph.chart[facet(h)] == chart && (smallest == kNone || h < smallest)) smallest = h;
    });
    return smallest;
}

}   // namespace

bool on_border(const TriMesh& mesh, const State& state, Index outgoing) {
    Index h = outgoing;
    do {
        if (state.graph.is_border(h)) return true;
        h = mesh.cw(h);
    } while (h != outgoing);
    return false;
}

Halfedges reversed(const TriMesh& mesh, const Halfedges& path) {
    Halfedges back(path.rbegin(), path.rend());
    for (Index& h : back) h = mesh.opposite[h];
    return back;
}

Halfedges greedy_path(const TriMesh& mesh, const State& state, Index vertex, Index chart, const Vec3& direction) {
    const Vec3 step = unit(direction);
    Vec3 target = mesh.points[vertex] + step * (kLookAhead * mesh.mean_edge);
    Halfedges path;
    IndexSet visited(std::initializer_list<Index>{vertex});
    const Index start = leaving(mesh, state, vertex, chart);
    Index h = start == kNone ? kNone : most_aligned(mesh, state, start, chart, step);
    while (h != kNone) {
        path.push_back(h);
        const Index tip = mesh.to(h), back = mesh.opposite[h];
        if (!visited.insert(tip)) return {};
        if (on_border(mesh, state, back) || is_turning_point(state, tip)) return path;
        target += step * norm(mesh.vector(h));
        h = most_aligned(mesh, state, back, chart, target - mesh.points[tip]);
    }
    return {};
}

Halfedges lost_features_at(const TriMesh& mesh, const State& state, Index outgoing) {
    Halfedges lost;
    Index h = outgoing;
    do {
        if (mesh.feature[h] && !state.graph.is_border(h)) lost.push_back(h);
        h = mesh.cw(h);
    } while (h != outgoing);
    return lost;
}

Halfedges lost_feature_path(const TriMesh& mesh, const State& state, Index h) {
    const Index chart = state.graph.chart[facet(h)];
    IndexSet visited(std::initializer_list<Index>{mesh.from(h)});
    Halfedges path;
    while (h != kNone && visited.insert(mesh.to(h))) {
        path.push_back(h);
        const Index back = mesh.opposite[h];
        if (on_border(mesh, state, back)) break;
        Index best = kNone;
        std::int64_t best_cosine = 0;
        for (const Index other : lost_features_at(mesh, state, back)) {
            const std::int64_t c = cosine(mesh.vector(other), mesh.vector(h));
            if (other == back || !inside(mesh, state, other, chart) || (best != kNone && c <= best_cosine)) continue;
            best = other;
            best_cosine = c;
        }
        h = best;
    }
    return path;
}

std::vector<Index> region_between(const TriMesh& mesh, const State& state, Index chart, const std::vector<Index>& seeds,
                                  const Halfedges& walls) {
    IndexSet wall, reached;
    for (const Index h : walls) wall.insert(mesh.edge(h));
    std::vector<Index> region;
    for (const Index f : seeds)
        if (state.graph.chart[f] == chart && reached.insert(f)) region.push_back(f);
    for (std::size_t i = 0; i < region.size(); i++) {
        for (Index h = 3 * region[i]; h < 3 * region[i] + 3; h++) {
            const Index f = mesh.right(h);
            if (state.graph.chart[f] == chart && !wall.has(mesh.edge(h)) && reached.insert(f)) region.push_back(f);
        }
    }
    for (const Index h : walls)
        if (reached.has(mesh.left(h)) && reached.has(mesh.right(h))) return {};
    return region;
}

std::vector<std::vector<Index>> bands(const TriMesh& mesh, const State& state, const std::vector<Index>& vertices, Index chart,
                                      std::initializer_list<int> widths) {
    std::vector<std::vector<Index>> result;
    IndexSet touched, in;
    std::vector<Index> facets, front;   // front: vertices touched last; what touches earlier ones is in, or in another chart
    for (const Index v : vertices)
        if (touched.insert(v)) front.push_back(v);
    for (int r = 0;; r++) {
        if (r == widths.begin()[result.size()]) result.push_back(facets);
        if (result.size() == widths.size()) return result;
        const std::size_t ring = facets.size();
        for (const Index v : front)
            mesh.for_each_leaving(v, [&](Index h) {
                const Index f = facet(h);
                if ((chart == kNone || state.graph.chart[f] == chart) && in.insert(f)) facets.push_back(f);
            });
        std::sort(facets.begin() + static_cast<std::ptrdiff_t>(ring), facets.end());   // by number, all different
        front.clear();
        for (std::size_t i = ring; i < facets.size(); i++)
            for (int k = 0; k < 3; k++)
                if (touched.insert(mesh.origin[3 * facets[i] + k])) front.push_back(mesh.origin[3 * facets[i] + k]);
    }
}

std::vector<Index> strip_beside(const TriMesh& mesh, const State& state, const Halfedges& path, int width) {
    const Index chart = state.graph.chart[mesh.left(path[0])];
    const IndexSet in(band(mesh, state, vertices_of(mesh, path), chart, width));
    // From the left facets on, within the band, not across the path.
    IndexSet wall, right, reached;
    for (const Index h : path) {
        wall.insert(mesh.edge(h));
        right.insert(mesh.right(h));
    }
    std::vector<Index> strip;
    for (const Index h : path)
        if (in.has(mesh.left(h)) && reached.insert(mesh.left(h))) strip.push_back(mesh.left(h));
    for (std::size_t i = 0; i < strip.size(); i++)
        for (Index h = 3 * strip[i]; h < 3 * strip[i] + 3; h++) {
            const Index f = mesh.right(h);
            if (in.has(f) && !wall.has(mesh.edge(h)) && !right.has(f) && reached.insert(f)) strip.push_back(f);
        }
    return strip;
}

std::vector<Index> facets_of(const State& state, Index chart) {
    // A look at each facet's chart is quicker than a walk through the chart, though it has to pass others.
    const Chart& c = state.graph.charts[chart];
    std::vector<Index> facets;
    facets.reserve(c.facets);
    for (Index f = c.smallest_facet; static_cast<Index>(facets.size()) < c.facets; f++)
        if (state.graph.chart[f] == chart) facets.push_back(f);
    return facets;
}

std::vector<Index> facets_beside(const TriMesh& mesh, const State& state, const Halfedges& run, Index chart) {
    std::vector<Index> facets;
    for (const Index h : run) facets.push_back(state.graph.chart[mesh.left(h)] == chart ? mesh.left(h) : mesh.right(h));
    return facets;
}

std::vector<Index> vertices_of(const TriMesh& mesh, const Halfedges& path) {
    std::vector<Index> vertices;
    for (const Index h : path)
        for (const Index v : {mesh.from(h), mesh.to(h)})
            if (vertices.empty() || vertices.back() != v) vertices.push_back(v);
    return vertices;
}

std::vector<Halfedges> contours(const TriMesh& mesh, const State& state, Index chart) {
    const LabelingGraph& graph = state.graph;
    std::vector<Halfedges> result;
    std::vector<char> walked(graph.boundaries.size(), 0);
    for (Index i = graph.charts[chart].boundaries.first; i < graph.charts[chart].boundaries.last; i++) {
        const Boundary& boundary = graph.boundaries[graph.chart_boundaries[i]];
        if (walked[graph.chart_boundaries[i]]) continue;
        const bool runs = boundary.left == chart;
        const Index first =
            runs ? graph.halfedges[boundary.halfedges.first] : mesh.opposite[graph.halfedges[boundary.halfedges.last - 1]];
        Halfedges contour;
        Index h = first;
        do {
            contour.push_back(h);
            walked[graph.boundary[h]] = 1;
            h = graph.next_border_cw(mesh, mesh.opposite[h]);
        } while (h != first);
        result.push_back(std::move(contour));
    }
    return result;
}

std::vector<Halfedges> runs_of(const State& state, const Halfedges& contour) {
    std::vector<Halfedges> runs;
    for (const Index h : contour) {
        const bool same = !runs.empty() && state.graph.boundary[runs.back().back()] == state.graph.boundary[h];
        if (!same) runs.emplace_back();
        runs.back().push_back(h);
    }
    return runs;
}

Vec3 mean_normal(const TriMesh& mesh, const std::vector<Index>& facets) {
    Vec3 sum;
    for (const Index f : facets) sum += mesh.normal[f];
    return sum;
}

std::vector<Label> labels_by_fit(const Vec3& normal) {
    const Vec3 n = unit(normal);
    std::int64_t fit[kLabels];
    for (Label l = 0; l < kLabels; l++) fit[l] = steps(along(n, l));
    std::vector<Label> labels = {0, 1, 2, 3, 4, 5};
    std::stable_sort(labels.begin(), labels.end(), [&](Label a, Label b) { return fit[a] > fit[b]; });   // tie: smallest label
    return labels;
}

Label best_label(const Vec3& v, int forbidden_axis, int other_forbidden_axis) {
    for (const Label l : labels_by_fit(v))
        if (axis(l) != forbidden_axis && axis(l) != other_forbidden_axis) return l;
    return kNoLabel;   // unreachable: two axes leave two labels
}

Patch relabel(const std::vector<Index>& facets, Label label) {
    Patch patch;
    for (const Index f : facets) patch.push_back({f, label});
    return patch;
}

}   // namespace polylab

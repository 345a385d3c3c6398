#include "polylab/turning_points.h"

#include "polylab/costs.h"
#include "polylab/marks.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace polylab {

namespace {

constexpr double kEdgeSigma = 0.9, kChangeSigma = 1.0;   // Evocube's
constexpr int kChainScale = 100;

// What an assignment of directions costs, compared from left to right.
struct Price {
    std::int64_t energy = 0;
    Index turns = 0;
    std::int64_t vertices = 0;   // sum of the turning-points' vertices

    bool operator<(const Price& b) const { return std::tie(energy, turns, vertices) < std::tie(b.energy, b.turns, b.vertices); }
    Price edge(int cost) const { return {energy + cost, turns, vertices}; }
    Price turn(int cost, Index vertex) const { return {energy + cost, turns + 1, vertices + vertex}; }
};

struct Directions {
    Price price;
    std::vector<int> along;   // edge -> 1 along +axis
};

constexpr Price kImpossible = {std::numeric_limits<std::int64_t>::max() / 2, 0, 0};

// The cheapest directions by dynamic programming; those of the first and the last edge are given in a closed chain.
Directions cheapest(const Chain& chain, bool first_known, int first, int last) {
    const Index n = chain.size();
    std::vector<std::array<int, 2>> from(n);   // edge, direction -> direction of the edge before
    std::array<Price, 2> best;
    for (const int d : {0, 1}) best[d] = first_known && d != first ? kImpossible : Price{}.edge(chain.cost[d][0]);
    for (Index i = 1; i < n; i++) {
        std::array<Price, 2> following;
        for (const int d : {0, 1}) {
            const Price stay = best[d], turn = best[!d].turn(chain.change[i - 1], chain.vertex[i]);
            from[i][d] = turn < stay ? !d : d;
            following[d] = (turn < stay ? turn : stay).edge(chain.cost[d][i]);
        }
        best = following;
    }
    Directions result;
    int d = first_known ? last : !(best[0] < best[1]);   // tie: the last edge along +axis
    result.price = best[d];
    if (first_known && first != last) result.price = result.price.turn(chain.change[n - 1], chain.vertex[0]);
    result.along.resize(n);
    for (Index i = n - 1; i >= 0; i--) {
        result.along[i] = d;
        d = from[i][d];
    }
    return result;
}

std::vector<Index> turns(const std::vector<int>& along) {
    std::vector<Index> positions;
    for (std::size_t i = 1; i < along.size(); i++)
        if (along[i] != along[i - 1]) positions.push_back(static_cast<Index>(i));
    return positions;
}

std::vector<Index> boundary_halfedges(const LabelingGraph& graph, Index b) {
    const Range r = graph.boundaries[b].halfedges;
    return {graph.halfedges.begin() + r.first, graph.halfedges.begin() + r.last};
}

void add_points(TurningPoints& result, const std::vector<Index>& positions, Index boundary, const Chain& chain) {
    for (const Index i : positions) result.points.push_back({boundary, i, chain.vertex[i]});
    result.non_monotone_boundaries += !positions.empty();
}

void count_vertices(TurningPoints& result) {
    std::vector<Index> vertices;
    for (const TurningPoint& t : result.points) vertices.push_back(t.vertex);
    std::sort(vertices.begin(), vertices.end());
    result.vertices = static_cast<Index>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

bool can_turn(const Boundary& boundary) { return boundary.halfedges.size() > 1 && boundary.axis != kNone; }

// Depth-first discovery of the boundaries, as the published code does it: a stack of half-edges that leave corners. Only
// the direction of each boundary comes out; closed boundaries without corner start and run as they do here.
class PublishedOrder {
public:
    PublishedOrder(const TriMesh& mesh, const LabelingGraph& graph)
        : mesh_(mesh), graph_(graph), places_(graph.ring_halfedges), ring_of_(graph.ring_halfedges.size()),
          recorded_(graph.rings.size(), 0), met_(graph.corners.size(), 0), reversed_(graph.boundaries.size(), kUnknown) {
        for (Index r = 0; r < static_cast<Index>(graph.rings.size()); r++)
            for (Index i = graph.rings[r].halfedges.first; i < graph.rings[r].halfedges.last; i++) ring_of_[i] = r;
    }

    // boundary -> 1 where it is traversed against its direction here
    std::vector<char> reversed() {
        std::vector<Index> starts;
        for (const Corner& c : graph_.corners) mesh_.for_each_leaving(c.vertex, [&](Index h) { starts.push_back(h); });
        std::sort(starts.begin(), starts.end());
        for (const Index h : starts) {
            const Index corner = graph_.corner[mesh_.from(h)], ring = ring_at(h);
            if (ring == kNone) continue;   // another fan of this vertex is the corner
            if (met_[corner] && graph_.is_border(h) && recorded_[ring_of(h)]) continue;
            if (!met_[corner]) recorded_[ring] = 1;   // later rings are explored, but not recorded
            met_[corner] = 1;
            push_ring(h);
            explore();
        }
        for (char& r : reversed_)
            if (r == kUnknown) r = 0;   // closed without corner
        return std::move(reversed_);
    }

private:
    static constexpr char kUnknown = 2;

    // The first border strictly counter-clockwise of h; h itself if it is the only one of its fan, kNone if there is none.
    Index first_border(Index h) const {
        Index around = h;
        do {
            around = mesh_.ccw(around);
            if (graph_.is_border(around)) return around;
        } while (around != h);
        return kNone;
    }

    // The ring of a border half-edge that leaves a corner; kNone if its fan has none.
    Index ring_of(Index border) const {
        const Index place = places_.number(border);
        return place == kNone ? kNone : ring_of_[place];
    }
    Index ring_at(Index h) const {
        const Index border = first_border(h);
        return border == kNone ? kNone : ring_of(border);
    }

    void push_ring(Index h) {
        const Index first = first_border(h);
        Index around = first;
        do {
            stack_.push_back(around);
            around = graph_.next_border_ccw(mesh_, around);
        } while (around != first);
    }

    void explore() {
        while (!stack_.empty()) {
            const Index h = stack_.back();
            stack_.pop_back();
            const Index b = graph_.boundary[h];
            if (reversed_[b] != kUnknown) continue;
            reversed_[b] = !graph_.runs_with_boundary(h);
            const Range r = graph_.boundaries[b].halfedges;
            const Index last = reversed_[b] ? mesh_.opposite[graph_.halfedges[r.first]] : graph_.halfedges[r.last - 1];
            const Index beyond = next(last), ring = ring_at(beyond), corner = graph_.rings[ring].corner;
            if (met_[corner] && recorded_[ring]) continue;
            met_[corner] = recorded_[ring] = 1;
            push_ring(beyond);
        }
    }

    const TriMesh& mesh_;
    const LabelingGraph& graph_;
    IndexSet places_;              // half-edge -> its place in ring_halfedges
    std::vector<Index> ring_of_;   // place -> ring
    std::vector<char> recorded_;   // ring -> 1 once its corner holds it
    std::vector<char> met_;        // corner -> 1 once it exists
    std::vector<char> reversed_;   // boundary -> result, or kUnknown
    std::vector<Index> stack_;
};

}   // namespace

Chain make_chain(const TriMesh& mesh, const std::vector<Index>& halfedges, int axis) {
    const std::size_t n = halfedges.size();
    std::vector<Vec3> edges(n);
    for (std::size_t i = 0; i < n; i++) edges[i] = unit(mesh.vector(halfedges[i]));
    Chain chain;
    chain.cost[0].resize(n);
    chain.cost[1].resize(n);
    chain.change.resize(n);
    chain.vertex.resize(n);
    for (std::size_t i = 0; i < n; i++) {
        const Vec3 &e = edges[i], &following = edges[i + 1 < n ? i + 1 : 0];
        // An edge across the axis costs nothing in either direction, so that noise in its sign is harmless.
        chain.cost[e[axis] > 0 ? 0 : 1][i] = well_cost(e[axis], kEdgeSigma, kChainScale);
        chain.change[i] = bell_cost(dot(e, following) - 1, kChangeSigma, kChainScale);
        chain.vertex[i] = mesh.from(halfedges[i]);
    }
    return chain;
}

std::vector<Index> chain_turns(const Chain& chain, bool closed) {
    if (!closed) return turns(cheapest(chain, false, 0, 0).along);
    Directions best = cheapest(chain, true, 1, 1);   // tie: the first of these four
    for (const auto& [first, last] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{0, 0}}) {
        Directions other = cheapest(chain, true, first, last);
        if (other.price < best.price) best = std::move(other);
    }
    std::vector<Index> positions = turns(best.along);
    if (best.along.front() != best.along.back()) positions.insert(positions.begin(), 0);
    return positions;
}

std::vector<Index> published_chain_turns(const Chain& chain, bool closed) {
    const Index n = chain.size();
    std::vector<std::array<int, 2>> from(n);
    std::array<std::int64_t, 2> best = {chain.cost[0][0], chain.cost[1][0]};
    std::int64_t all_minus = chain.cost[0][0];
    for (Index i = 1; i < n; i++) {
        const std::array<std::int64_t, 2> before = best;
        for (const int d : {0, 1}) {
            const std::int64_t through0 = before[0] + (d == 0 ? 0 : chain.change[i - 1]),
                               through1 = before[1] + (d == 1 ? 0 : chain.change[i - 1]);
            from[i][d] = through1 <= through0;   // tie: +axis
            best[d] = std::min(through0, through1) + chain.cost[d][i];
        }
        all_minus += chain.cost[0][i];
    }
    if (all_minus == std::min(best[0], best[1])) return {};   // tie: all -axis, whatever else is as good
    std::vector<int> along(n);
    int d = best[1] <= best[0];
    for (Index i = n - 1; i >= 0; i--) {
        along[i] = d;
        d = from[i][d];
    }
    std::vector<Index> positions = turns(along);
    if (closed && along.front() != along.back()) positions.push_back(0);
    return positions;
}

Range TurningPoints::of(Index boundary) const {
    const auto less = [](const TurningPoint& a, const TurningPoint& b) { return a.boundary < b.boundary; };
    const auto found = std::equal_range(points.begin(), points.end(), TurningPoint{boundary, 0, 0}, less);
    return {static_cast<Index>(found.first - points.begin()), static_cast<Index>(found.second - points.begin())};
}

TurningPoints find_turning_points(const TriMesh& mesh, const LabelingGraph& graph) {
    return find_turning_points(mesh, graph, {}, {}, {});
}

TurningPoints find_turning_points(const TriMesh& mesh, const LabelingGraph& graph, const std::vector<Boundary>& old_boundaries,
                                  const std::vector<Index>& old_halfedges, const TurningPoints& old) {
    TurningPoints result;
    auto before = old_boundaries.begin();   // both lists are sorted by the smallest half-edges
    for (Index b = 0; b < static_cast<Index>(graph.boundaries.size()); b++) {
        const Boundary& boundary = graph.boundaries[b];
        if (!can_turn(boundary)) continue;
        while (before != old_boundaries.end() && before->smallest < boundary.smallest) ++before;
        const auto begin = graph.halfedges.begin() + boundary.halfedges.first,
                   end = graph.halfedges.begin() + boundary.halfedges.last;
        if (before != old_boundaries.end() && before->axis == boundary.axis &&
            std::equal(begin, end, old_halfedges.begin() + before->halfedges.first,
                       old_halfedges.begin() + before->halfedges.last)) {
            const Range points = old.of(static_cast<Index>(before - old_boundaries.begin()));
            for (Index i = points.first; i < points.last; i++)
                result.points.push_back({b, old.points[i].position, old.points[i].vertex});
            result.non_monotone_boundaries += points.size() > 0;
            continue;
        }
        const Chain chain = make_chain(mesh, boundary_halfedges(graph, b), boundary.axis);
        add_points(result, chain_turns(chain, boundary.closed()), b, chain);
    }
    count_vertices(result);
    return result;
}

TurningPoints published_turning_points(const TriMesh& mesh, const LabelingGraph& graph) {
    TurningPoints result;
    const std::vector<char> reversed = PublishedOrder(mesh, graph).reversed();
    for (Index b = 0; b < static_cast<Index>(graph.boundaries.size()); b++) {
        if (!can_turn(graph.boundaries[b])) continue;
        std::vector<Index> halfedges = boundary_halfedges(graph, b);
        if (reversed[b]) {
            std::reverse(halfedges.begin(), halfedges.end());
            for (Index& h : halfedges) h = mesh.opposite[h];
        }
        const Chain chain = make_chain(mesh, halfedges, graph.boundaries[b].axis);
        std::vector<Index> positions = published_chain_turns(chain, graph.boundaries[b].closed());
        add_points(result, positions, b, chain);
    }
    count_vertices(result);
    return result;
}

bool leans_left(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t) {
    const Range r = graph.boundaries[t.boundary].halfedges;
    const Index out = graph.halfedges[r.first + t.position];
    const Index in = graph.halfedges[t.position > 0 ? r.first + t.position - 1 : r.last - 1];
    const Index back = mesh.opposite[in];
    std::int64_t left = 0, right = 0;
    // Facets counter-clockwise from `out` are at its left, up to the edge that came in; the others at its right.
    Index h = out;
    for (; h != back; h = mesh.ccw(h)) left += angle_cost(mesh.vector(h), -mesh.vector(prev(h)));
    for (; h != out; h = mesh.ccw(h)) right += angle_cost(mesh.vector(h), -mesh.vector(prev(h)));
    return right <= left;
}

Index closest_corner(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t) {
    const Boundary& boundary = graph.boundaries[t.boundary];
    double before = 0, after = 0;
    for (Index i = boundary.halfedges.first; i < boundary.halfedges.last; i++)
        (i < boundary.halfedges.first + t.position ? before : after) += norm(mesh.vector(graph.halfedges[i]));
    return steps(before / mesh.mean_edge) < steps(after / mesh.mean_edge) ? boundary.start : boundary.end;
}

}   // namespace polylab

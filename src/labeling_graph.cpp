#include "polylab/labeling_graph.h"

#include "polylab/text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polylab {

namespace {

constexpr double kFlat = 1e-9;   // sine of the angle below which an edge counts as flat
constexpr Index kBorder = -2;    // boundary[h] of a border that is not traced yet

// Builds the graph phase by phase, from scratch or from the one before a change, of which boundaries stay.
class Builder {
public:
    Builder(const TriMesh& mesh, const Labeling& labels, LabelingGraph& graph) : mesh_(mesh), labels_(labels), g_(graph) {}

    void build() {
        g_.chart.assign(mesh_.facets(), kNone);
        g_.boundary.assign(mesh_.halfedges(), kNone);
        g_.corner.assign(mesh_.vertices(), kNone);
        for (Index h = 0; h < mesh_.halfedges(); h++) {
            if (!is_border(h)) continue;
            loosen(h);
            g_.corner[mesh_.from(h)]++;   // from kNone = -1: three borders make 2
        }
        find_charts();
        std::vector<Index> vertices;
        for (Index v = 0; v < mesh_.vertices(); v++) {
            if (g_.corner[v] >= 2) vertices.push_back(v);
            g_.corner[v] = kNone;
        }
        build_along_borders(vertices);
    }

    void update(const GraphChange& change) {
        std::vector<Index> vertices;   // corners are where corners were, or where something changes
        for (const Corner& corner : g_.corners) {
            g_.corner[corner.vertex] = kNone;
            vertices.push_back(corner.vertex);
        }
        for (const Index fan : change.fans) vertices.push_back(mesh_.from(fan));
        std::sort(vertices.begin(), vertices.end());   // tie: equal numbers, of which one is kept
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        part_boundaries(change);
        number_charts(change);
        build_along_borders(vertices);
    }

private:
    bool is_border(Index h) const { return labels_[mesh_.left(h)] != labels_[mesh_.right(h)]; }

    // A border whose boundary is to be traced.
    void loosen(Index h) {
        g_.boundary[h] = kBorder;
        loose_.push_back(h);
    }

    void build_along_borders(const std::vector<Index>& vertices) {
        g_.invalid_charts = g_.invalid_boundaries = g_.invalid_corners = 0;
        find_corners(vertices);
        list_boundaries();
        list_chart_boundaries();
        judge_charts();
        judge_corners();
    }

    // ---- charts

    // Charts are numbered by their smallest facet, since each is flooded from the smallest facet that has no chart yet.
    void find_charts() {
        std::vector<Index> stack;
        for (Index seed = 0; seed < mesh_.facets(); seed++) {
            if (g_.chart[seed] != kNone) continue;
            const Index c = new_chart(seed);
            g_.chart[seed] = c;
            stack.push_back(seed);
            while (!stack.empty()) {
                const Index f = stack.back();
                stack.pop_back();
                g_.charts[c].facets++;
                for (Index h = 3 * f; h < 3 * f + 3; h++) {
                    const Index other = mesh_.right(h);
                    if (labels_[other] != labels_[seed] || g_.chart[other] == c) continue;
                    g_.chart[other] = c;
                    stack.push_back(other);
                }
            }
        }
    }

    void number_charts(const GraphChange& change) {
        if (change.same_charts) {
            for (std::size_t i = 0; i < change.facets.size(); i++) {
                Index& c = g_.chart[change.facets[i]];
                g_.charts[c].facets--;
                c = change.to[i];
                g_.charts[c].facets++;
            }
            for (Chart& chart : g_.charts) chart.boundaries = {};
            return;
        }
        g_.charts.clear();
        std::vector<Index> number(change.most_chart + 1, kNone), facets(change.most_chart + 1, 0);
        for (Index f = 0; f < mesh_.facets(); f++) {
            const Index key = change.charts[f];
            facets[key]++;
            if (number[key] == kNone) number[key] = new_chart(f);
            g_.chart[f] = number[key];
        }
        for (std::size_t key = 0; key < number.size(); key++)
            if (number[key] != kNone) g_.charts[number[key]].facets = facets[key];
    }

    Index new_chart(Index smallest_facet) {
        Chart chart;
        chart.label = labels_[smallest_facet];
        chart.smallest_facet = smallest_facet;
        g_.charts.push_back(chart);
        return static_cast<Index>(g_.charts.size()) - 1;
    }

    // ---- corners

    // Among these vertices (increasing).
    void find_corners(const std::vector<Index>& vertices) {
        g_.corners.clear();
        g_.rings.clear();
        g_.ring_halfedges.clear();
        for (const Index v : vertices) {
            Corner corner;
            corner.vertex = v;
            corner.rings.first = static_cast<Index>(g_.rings.size());
            Index begin = static_cast<Index>(g_.ring_halfedges.size()), last = kNone;
            mesh_.for_each_leaving(v, [&](Index h) {
                if (last != kNone && mesh_.ccw(last) != h) begin = end_ring(begin);   // the next fan
                if (is_border(h)) g_.ring_halfedges.push_back(h);
                last = h;
            });
            end_ring(begin);
            corner.rings.last = static_cast<Index>(g_.rings.size());
            if (corner.rings.size() == 0) continue;
            const auto first = g_.rings.begin() + corner.rings.first;
            std::sort(first, g_.rings.end(), [&](const Ring& a, const Ring& b) {   // all different
                return g_.ring_halfedges[a.halfedges.first] < g_.ring_halfedges[b.halfedges.first];
            });
            g_.corner[v] = static_cast<Index>(g_.corners.size());
            for (auto ring = first; ring != g_.rings.end(); ++ring) {
                ring->corner = g_.corner[v];
                corner.valence += ring->halfedges.size();
            }
            g_.corners.push_back(corner);
        }
    }

    // Makes a ring of the borders of a fan that were listed last, if they are enough. Returns where the next one begins.
    Index end_ring(Index begin) {
        const Index end = static_cast<Index>(g_.ring_halfedges.size());
        if (end - begin < 3) {
            g_.ring_halfedges.resize(begin);
            return begin;
        }
        const auto first = g_.ring_halfedges.begin() + begin;
        std::rotate(first, std::min_element(first, g_.ring_halfedges.end()), g_.ring_halfedges.end());
        Ring ring;
        ring.halfedges = {begin, end};
        g_.rings.push_back(ring);
        return end;
    }

    // The corner at which border h starts, or kNone where its fan has two borders only.
    Index corner_at(Index h) const {
        const Index c = g_.corner[mesh_.from(h)];
        if (c == kNone) return kNone;
        for (Index r = g_.corners[c].rings.first; r < g_.corners[c].rings.last; r++)
            for (Index i = g_.rings[r].halfedges.first; i < g_.rings[r].halfedges.last; i++)
                if (g_.ring_halfedges[i] == h) return c;
        return kNone;
    }

    // ---- boundaries

    // Those that pass none of the fans stay, the borders of the others become loose, and so do new borders.
    void part_boundaries(const GraphChange& change) {
        std::vector<char> goes(g_.boundaries.size(), 0);
        for (const Index fan : change.fans) {
            Index h = fan;
            do {
                if (g_.boundary[h] != kNone) goes[g_.boundary[h]] = 1;
                h = mesh_.ccw(h);
            } while (h != fan);
        }
        for (std::size_t b = 0; b < g_.boundaries.size(); b++) {
            if (!goes[b]) {
                kept_.push_back(g_.boundaries[b]);
                continue;
            }
            for (Index i = g_.boundaries[b].halfedges.first; i < g_.boundaries[b].halfedges.last; i++) {
                loosen(g_.halfedges[i]);
                loosen(mesh_.opposite[g_.halfedges[i]]);
            }
        }
        for (const Index f : change.facets)
            for (Index h = 3 * f; h < 3 * f + 3; h++)
                for (const Index side : {h, mesh_.opposite[h]})
                    if (!is_border(side))
                        g_.boundary[side] = kNone;
                    else if (g_.boundary[side] == kNone)
                        loosen(side);
        loose_.erase(std::remove_if(loose_.begin(), loose_.end(), [&](Index h) { return g_.boundary[h] == kNone; }),
                     loose_.end());
        std::sort(loose_.begin(), loose_.end());   // all different
    }

    // All boundaries by their smallest half-edges: those that stay are sorted like that, and of a new one the first loose
    // border is the smallest.
    void list_boundaries() {
        const std::vector<Index> old_halfedges = std::move(g_.halfedges);
        g_.halfedges.clear();
        g_.boundaries.clear();
        auto kept = kept_.begin();
        for (const Index h : loose_) {
            if (g_.boundary[h] != kBorder) continue;
            for (; kept != kept_.end() && kept->smallest < h; ++kept) place(*kept, old_halfedges);
            trace(h);
        }
        for (; kept != kept_.end(); ++kept) place(*kept, old_halfedges);
        for (const Boundary& b : g_.boundaries) g_.invalid_boundaries += !b.valid;
    }

    void place(Boundary boundary, const std::vector<Index>& halfedges) {
        const Range old = boundary.halfedges;
        const Index first = halfedges[old.first], last = halfedges[old.last - 1];
        boundary.halfedges.first = static_cast<Index>(g_.halfedges.size());
        for (Index i = old.first; i < old.last; i++) add_halfedge(halfedges[i]);
        boundary.halfedges.last = static_cast<Index>(g_.halfedges.size());
        boundary.left = g_.chart[mesh_.left(first)];
        boundary.right = g_.chart[mesh_.right(first)];
        if (boundary.start != kNone) boundary.start = g_.corner[mesh_.from(first)];
        if (boundary.end != kNone) boundary.end = g_.corner[mesh_.to(last)];
        g_.boundaries.push_back(boundary);
    }

    void add_halfedge(Index h) {
        g_.halfedges.push_back(h);
        g_.boundary[h] = g_.boundary[mesh_.opposite[h]] = static_cast<Index>(g_.boundaries.size());
    }

    // h is the smallest border half-edge of its boundary: walk back to the start, then forward.
    void trace(Index h) {
        Boundary boundary;
        boundary.smallest = h;
        Index first = h;
        while (corner_at(first) == kNone) {
            // The other border at this vertex arrives here with the same chart at its left.
            const Index before = mesh_.opposite[g_.next_border_ccw(mesh_, first)];
            if (before == h) {
                first = h;
                break;
            }
            first = before;
        }
        boundary.start = corner_at(first);
        boundary.left = g_.chart[facet(h)];
        boundary.right = g_.chart[mesh_.right(h)];
        boundary.axis = boundary_axis(labels_[facet(h)], labels_[mesh_.right(h)]);
        boundary.on_features = true;
        boundary.valid = boundary.axis != kNone || g_.allow_opposite;
        boundary.halfedges.first = static_cast<Index>(g_.halfedges.size());
        Index at = first;
        do {
            add_halfedge(at);
            boundary.on_features = boundary.on_features && mesh_.feature[at];
            if (boundary.valid && boundary.axis == kNone) boundary.valid = !is_convex(mesh_, at);
            const Index back = mesh_.opposite[at];
            boundary.end = corner_at(back);
            if (boundary.end != kNone) break;
            at = g_.next_border_ccw(mesh_, back);
        } while (at != first);
        boundary.halfedges.last = static_cast<Index>(g_.halfedges.size());
        g_.boundaries.push_back(boundary);
    }

    void list_chart_boundaries() {
        for (const Boundary& b : g_.boundaries) {
            g_.charts[b.left].boundaries.last++;
            g_.charts[b.right].boundaries.last++;
        }
        Index total = 0;
        for (Chart& chart : g_.charts) {
            const Index count = chart.boundaries.last;
            chart.boundaries = {total, total};
            total += count;
        }
        g_.chart_boundaries.resize(total);
        for (Index b = 0; b < static_cast<Index>(g_.boundaries.size()); b++) {
            g_.chart_boundaries[g_.charts[g_.boundaries[b].left].boundaries.last++] = b;
            g_.chart_boundaries[g_.charts[g_.boundaries[b].right].boundaries.last++] = b;
        }
    }

    // ---- validity

    void judge_charts() {
        for (Chart& chart : g_.charts) {
            chart.valid = chart.boundaries.size() >= kLeastBoundaries;
            g_.invalid_charts += !chart.valid;
        }
    }

    void judge_corners() {
        std::vector<int> axes;
        for (Corner& corner : g_.corners) {
            corner.valid = true;
            for (Index r = corner.rings.first; r < corner.rings.last; r++) {
                Ring& ring = g_.rings[r];
                axes.clear();
                for (Index i = ring.halfedges.first; i < ring.halfedges.last; i++)
                    axes.push_back(g_.boundaries[g_.boundary[g_.ring_halfedges[i]]].axis);
                ring.valid = valid_ring(axes, g_.allow_opposite);
                corner.valid = corner.valid && ring.valid;
            }
            g_.invalid_corners += !corner.valid;
        }
    }

    const TriMesh& mesh_;
    const Labeling& labels_;
    LabelingGraph& g_;
    std::vector<Index> loose_;     // borders without boundary, increasing
    std::vector<Boundary> kept_;   // boundaries that stay, with their old numbers
};

}   // namespace

Index LabelingGraph::next_border_ccw(const TriMesh& mesh, Index h) const {
    do h = mesh.ccw(h);
    while (boundary[h] == kNone);
    return h;
}

Index LabelingGraph::next_border_cw(const TriMesh& mesh, Index h) const {
    do h = mesh.cw(h);
    while (boundary[h] == kNone);
    return h;
}

LabelingGraph build_graph(const TriMesh& mesh, const Labeling& labels, bool allow_opposite) {
    LabelingGraph graph;
    graph.allow_opposite = allow_opposite;
    Builder(mesh, labels, graph).build();
    return graph;
}

void update_graph(const TriMesh& mesh, const Labeling& labels, const GraphChange& change, LabelingGraph& graph) {
    Builder(mesh, labels, graph).update(change);
}

bool valid_ring(const std::vector<int>& axes, bool allow_opposite) {
    const std::size_t n = axes.size();
    int count[3] = {0, 0, 0};
    for (std::size_t i = 0; i < n; i++) {
        if (axes[i] == kNone && !allow_opposite) return false;
        // Next to a boundary between opposite labels an axis counts for nothing: both neighbours turn back there.
        const bool masked = axes[(i + 1) % n] == kNone || axes[(i + n - 1) % n] == kNone;
        if (axes[i] != kNone && !masked) count[axes[i]]++;
    }
    const int used = (count[0] > 0) + (count[1] > 0) + (count[2] > 0);
    if (used == 0) return true;                                            // the vertex lies inside the volume
    if (used == 1) return count[0] + count[1] + count[2] == 2;             // it lies on a boundary; else parallel lines meet
    return count[0] % 2 == count[1] % 2 && count[1] % 2 == count[2] % 2;   // pairs, or pairs and one trio
}

bool is_convex(const TriMesh& mesh, Index h) {
    const Vec3& far_vertex = mesh.points[mesh.from(prev(mesh.opposite[h]))];
    const Vec3 n = mesh.area_vector(facet(h)), e = far_vertex - mesh.points[mesh.from(h)];
    const double lengths = norm(n) * norm(e), sine = lengths > 0 ? dot(n, e) / lengths : 0;
    audit("convex edge, as a sine", std::abs(sine + kFlat));
    return sine < -kFlat;
}

std::string graph_text(const LabelingGraph& graph) {
    std::string out;
    const auto line = [&](const char* word, std::initializer_list<Index> numbers) {
        out += word;
        for (const Index i : numbers) {
            out += ' ';
            append(out, i);
        }
    };
    for (std::size_t c = 0; c < graph.charts.size(); c++) {
        const Chart& chart = graph.charts[c];
        line("chart", {static_cast<Index>(c), chart.label, chart.smallest_facet, chart.facets, chart.valid});
        for (Index i = chart.boundaries.first; i < chart.boundaries.last; i++) line("", {graph.chart_boundaries[i]});
        out += '\n';
    }
    for (std::size_t b = 0; b < graph.boundaries.size(); b++) {
        const Boundary& boundary = graph.boundaries[b];
        line("boundary", {static_cast<Index>(b), boundary.left, boundary.right, boundary.start, boundary.end, boundary.axis,
                          boundary.on_features, boundary.valid});
        for (Index i = boundary.halfedges.first; i < boundary.halfedges.last; i++) line("", {graph.halfedges[i]});
        out += '\n';
    }
    for (std::size_t c = 0; c < graph.corners.size(); c++) {
        const Corner& corner = graph.corners[c];
        for (Index r = corner.rings.first; r < corner.rings.last; r++) {
            line("corner", {static_cast<Index>(c), corner.vertex, corner.valid});
            const Range ring = graph.rings[r].halfedges;
            for (Index i = ring.first; i < ring.last; i++) line("", {graph.ring_halfedges[i]});
            out += '\n';
        }
    }
    return out;
}

void validate(const TriMesh& mesh, const Labeling& labels, const LabelingGraph& g) {
    const auto require = [](bool holds, const char* what, std::size_t i) {
        if (!holds) throw std::logic_error(std::string("LabelingGraph: ") + what + " at " + std::to_string(i));
    };
    Index facets = 0, invalid = 0, last = kNone, listed = 0;
    for (std::size_t c = 0; c < g.charts.size(); c++) {
        facets += g.charts[c].facets;
        require(g.charts[c].boundaries.first == listed, "list of a chart's boundaries", c);
        listed = g.charts[c].boundaries.last;
        invalid += !g.charts[c].valid;
        require(g.charts[c].smallest_facet > last, "order of charts", c);
        last = g.charts[c].smallest_facet;
        require(g.chart[last] == static_cast<Index>(c) && labels[last] == g.charts[c].label, "chart of its smallest facet", c);
        for (Index i = g.charts[c].boundaries.first; i < g.charts[c].boundaries.last; i++) {
            const Boundary& b = g.boundaries[g.chart_boundaries[i]];
            require(b.left == static_cast<Index>(c) || b.right == static_cast<Index>(c), "boundary of a chart", c);
            require(i == g.charts[c].boundaries.first || g.chart_boundaries[i - 1] < g.chart_boundaries[i], "order of boundaries",
                    c);
        }
    }
    require(facets == mesh.facets(), "number of facets", g.charts.size());
    for (Index f = 0; f < mesh.facets(); f++) require(f >= g.charts[g.chart[f]].smallest_facet, "smallest facet", f);
    require(listed == static_cast<Index>(g.chart_boundaries.size()), "lists of boundaries", listed);
    require(g.chart_boundaries.size() == 2 * g.boundaries.size(), "two charts per boundary", g.boundaries.size());
    Index borders = 0;
    for (Index h = 0; h < mesh.halfedges(); h++) {
        require((labels[facet(h)] == labels[mesh.right(h)]) == (g.chart[facet(h)] == g.chart[mesh.right(h)]),
                "equal labels, equal charts", h);
        require(g.is_border(h) == (labels[facet(h)] != labels[mesh.right(h)]), "borders", h);
        borders += g.is_border(h);
    }
    require(borders == 2 * static_cast<Index>(g.halfedges.size()), "each border in one boundary", borders);
    last = kNone;
    for (std::size_t b = 0; b < g.boundaries.size(); b++) {
        const Boundary& boundary = g.boundaries[b];
        invalid += !boundary.valid;
        const auto begin = g.halfedges.begin() + boundary.halfedges.first, end = g.halfedges.begin() + boundary.halfedges.last;
        require(begin != end, "empty boundary", b);
        Index smallest = *begin;
        bool runs = true, on_features = true;
        const Label l = labels[facet(*begin)], r = labels[mesh.right(*begin)];
        require(boundary.axis == (orthogonal(l, r) ? 3 - axis(l) - axis(r) : kNone), "axis of a boundary", b);
        for (auto h = begin; h != end; ++h) {
            require(g.boundary[*h] == static_cast<Index>(b) && g.boundary[mesh.opposite[*h]] == static_cast<Index>(b),
                    "boundary of its half-edges", b);
            require(g.chart[facet(*h)] == boundary.left && g.chart[mesh.right(*h)] == boundary.right, "sides of a boundary", b);
            on_features = on_features && mesh.feature[*h];
            require(h + 1 == end || mesh.to(*h) == mesh.from(h[1]), "chain", b);
            if (mesh.edge(*h) < smallest) smallest = mesh.edge(*h), runs = *h == smallest;
        }
        if (smallest == *begin) runs = mesh.edge(*begin) == *begin;
        require(runs, "direction of a boundary", b);
        require(boundary.on_features == on_features, "feature edges of a boundary", b);
        require(smallest == boundary.smallest && smallest > last, "order of boundaries", b);
        last = smallest;
        require(boundary.start == kNone
                    ? *begin == smallest && mesh.to(end[-1]) == mesh.from(*begin)
                    : g.corners[boundary.start].vertex == mesh.from(*begin) && g.corners[boundary.end].vertex == mesh.to(end[-1]),
                "ends of a boundary", b);
    }
    last = kNone;
    for (std::size_t c = 0; c < g.corners.size(); c++) {
        invalid += !g.corners[c].valid;
        require(g.corners[c].vertex > last, "order of corners", c);
        last = g.corners[c].vertex;
        require(g.corner[last] == static_cast<Index>(c) && g.corners[c].rings.size() > 0, "corner of its vertex", c);
        Index valence = 0;
        for (Index r = g.corners[c].rings.first; r < g.corners[c].rings.last; r++) {
            const Range ring = g.rings[r].halfedges;
            valence += ring.size();
            require(g.rings[r].corner == static_cast<Index>(c) && ring.size() >= 3, "ring of a corner", c);
            for (Index i = ring.first; i < ring.last; i++) {
                const Index h = g.ring_halfedges[i], following = g.ring_halfedges[i + 1 == ring.last ? ring.first : i + 1];
                require(mesh.from(h) == last && g.next_border_ccw(mesh, h) == following && h >= g.ring_halfedges[ring.first],
                        "ring order", c);
            }
        }
        require(g.corners[c].valence == valence, "valence of a corner", c);
    }
    const auto no_corner = std::count(g.corner.begin(), g.corner.end(), kNone);
    require(no_corner + g.corners.size() == g.corner.size(), "vertices that are no corners", g.corners.size());
    require(invalid == g.invalid(), "number of invalid elements", invalid);
}

}   // namespace polylab

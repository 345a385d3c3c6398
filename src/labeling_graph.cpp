#include "polylab/labeling_graph.h"

#include "polylab/text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace polylab {

namespace {

constexpr double kFlat = 1e-9;   // sine of the angle below which an edge counts as flat
constexpr Index kBorder = -2;    // boundary[h] of a border that is not traced yet

// Builds the graph phase by phase: charts and borders anew or from those that were, then the rest along the borders.
class Builder {
public:
    Builder(const TriMesh& mesh, const Labeling& labels, LabelingGraph& graph) : mesh_(mesh), labels_(labels), g_(graph) {}

    void build() {
        g_.charts.clear();
        g_.chart.assign(mesh_.facets(), kNone);
        g_.boundary.assign(mesh_.halfedges(), kNone);
        g_.corner.assign(mesh_.vertices(), kNone);
        g_.borders.clear();
        for (Index h = 0; h < mesh_.halfedges(); h++)
            if (is_border(h)) g_.borders.push_back(h);
        find_charts();
        build_along_borders();
    }

    void update(const std::vector<Index>& changed) {
        for (const Index h : g_.borders) {
            g_.boundary[h] = kNone;
            g_.corner[mesh_.from(h)] = kNone;
        }
        update_charts(changed);
        update_borders(changed);
        build_along_borders();
    }

private:
    bool is_border(Index h) const { return labels_[mesh_.left(h)] != labels_[mesh_.right(h)]; }

    void build_along_borders() {
        g_.boundaries.clear();
        g_.corners.clear();
        g_.rings.clear();
        g_.halfedges.clear();
        g_.chart_boundaries.clear();
        g_.ring_halfedges.clear();
        g_.invalid_charts = g_.invalid_boundaries = g_.invalid_corners = 0;
        for (const Index h : g_.borders) g_.boundary[h] = kBorder;
        find_rings();
        number_corners();
        trace_boundaries();
        list_chart_boundaries();
        judge();
    }

    // Charts are numbered by their smallest facet, since each is flooded from the smallest facet that has no chart yet.
    void find_charts() {
        for (Index f = 0; f < mesh_.facets(); f++)
            if (g_.chart[f] == kNone) flood(f, 0);
    }

    // A new chart. Its facets get its number plus `shift`.
    void flood(Index seed, Index shift) {
        const Index number = static_cast<Index>(g_.charts.size()) + shift;
        Chart chart;
        chart.label = labels_[seed];
        chart.smallest_facet = seed;
        g_.chart[seed] = number;
        stack_.assign(1, seed);
        while (!stack_.empty()) {
            const Index f = stack_.back();
            stack_.pop_back();
            chart.facets++;
            for (Index h = 3 * f; h < 3 * f + 3; h++) {
                const Index other = mesh_.right(h);
                if (labels_[other] != chart.label || g_.chart[other] == number) continue;
                g_.chart[other] = number;
                stack_.push_back(other);
            }
        }
        g_.charts.push_back(chart);
    }

    // Charts that lose or gain facets are flooded anew, the others get new numbers. While old and new numbers stand side by
    // side, the new ones of flooded charts are shifted beyond the old ones.
    void update_charts(const std::vector<Index>& changed) {
        const std::vector<Chart> old = std::move(g_.charts);
        g_.charts.clear();
        const Index shift = static_cast<Index>(old.size());
        std::vector<char> is_new(old.size(), 0);
        for (const Index f : changed) {
            is_new[g_.chart[f]] = 1;
            for (Index h = 3 * f; h < 3 * f + 3; h++)
                if (!is_border(h)) is_new[g_.chart[mesh_.right(h)]] = 1;
        }
        std::vector<Index> number(old.size(), kNone);
        for (Index f = 0; f < mesh_.facets(); f++) {
            Index& c = g_.chart[f];
            if (c < shift && is_new[c]) {
                flood(f, shift);
            } else if (c < shift && number[c] == kNone) {
                number[c] = static_cast<Index>(g_.charts.size());
                g_.charts.push_back(old[c]);
                g_.charts.back().boundaries = {};
            }
            c = c < shift ? number[c] : c - shift;
        }
    }

    void update_borders(const std::vector<Index>& changed) {
        std::vector<Index> near, kept;
        for (const Index f : changed)
            for (Index h = 3 * f; h < 3 * f + 3; h++) near.insert(near.end(), {h, mesh_.opposite[h]});
        std::sort(near.begin(), near.end());   // tie: equal numbers, of which one is kept
        near.erase(std::unique(near.begin(), near.end()), near.end());
        std::set_difference(g_.borders.begin(), g_.borders.end(), near.begin(), near.end(), std::back_inserter(kept));
        near.erase(std::remove_if(near.begin(), near.end(), [&](Index h) { return !is_border(h); }), near.end());
        g_.borders.clear();
        std::merge(kept.begin(), kept.end(), near.begin(), near.end(), std::back_inserter(g_.borders));
    }

    // Rings of the vertices with three and more border half-edges; g_.corner holds their number meanwhile. Most vertices
    // on a border have two, and need no look around. Two solids touching there may each have two: no corner either.
    void find_rings() {
        for (const Index h : g_.borders) g_.corner[mesh_.from(h)]++;   // from kNone = -1: two borders make 1
        for (const Index h : g_.borders) {
            if (g_.corner[mesh_.from(h)] + 1 < 3) continue;
            Ring ring;
            ring.halfedges.first = static_cast<Index>(g_.ring_halfedges.size());
            Index around = h;
            do {
                g_.ring_halfedges.push_back(around);
                around = g_.next_border_ccw(mesh_, around);
            } while (around > h);
            ring.halfedges.last = static_cast<Index>(g_.ring_halfedges.size());
            if (around == h && ring.halfedges.size() >= 3)   // else it is met from a smaller one, or no corner
                g_.rings.push_back(ring);
            else
                g_.ring_halfedges.resize(ring.halfedges.first);
        }
    }

    Index ring_vertex(const Ring& ring) const { return mesh_.from(g_.ring_halfedges[ring.halfedges.first]); }

    // Sorts the rings by vertex, and makes their vertices corners.
    void number_corners() {
        for (const Index h : g_.borders) g_.corner[mesh_.from(h)] = kNone;
        std::sort(g_.rings.begin(), g_.rings.end(),
                  [&](const Ring& a, const Ring& b) {   // tie: by smallest half-edge, all different
                      const Index v = ring_vertex(a), w = ring_vertex(b);
                      return v < w || (v == w && g_.ring_halfedges[a.halfedges.first] < g_.ring_halfedges[b.halfedges.first]);
                  });
        const std::vector<Index> found = std::move(g_.ring_halfedges);
        g_.ring_halfedges.clear();
        for (Index r = 0; r < static_cast<Index>(g_.rings.size()); r++) {
            Ring& ring = g_.rings[r];
            const Range old = ring.halfedges;
            ring.halfedges.first = static_cast<Index>(g_.ring_halfedges.size());
            g_.ring_halfedges.insert(g_.ring_halfedges.end(), found.begin() + old.first, found.begin() + old.last);
            ring.halfedges.last = static_cast<Index>(g_.ring_halfedges.size());
            const Index v = ring_vertex(ring);
            if (g_.corner[v] == kNone) {
                g_.corner[v] = static_cast<Index>(g_.corners.size());
                Corner corner;
                corner.vertex = v;
                corner.rings = {r, r};
                g_.corners.push_back(corner);
            }
            ring.corner = g_.corner[v];
            Corner& corner = g_.corners[ring.corner];
            corner.rings.last = r + 1;
            corner.valence += ring.halfedges.size();
        }
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

    // h is the smallest border half-edge of its boundary: walk back to the start, then forward.
    void trace_boundaries() {
        for (const Index h : g_.borders) {
            if (g_.boundary[h] != kBorder) continue;
            const Index b = static_cast<Index>(g_.boundaries.size());
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
            boundary.halfedges.first = static_cast<Index>(g_.halfedges.size());
            Index at = first;
            do {
                g_.halfedges.push_back(at);
                g_.boundary[at] = g_.boundary[mesh_.opposite[at]] = b;
                boundary.on_features = boundary.on_features && mesh_.feature[at];
                const Index back = mesh_.opposite[at];
                boundary.end = corner_at(back);
                if (boundary.end != kNone) break;
                at = g_.next_border_ccw(mesh_, back);
            } while (at != first);
            boundary.halfedges.last = static_cast<Index>(g_.halfedges.size());
            g_.boundaries.push_back(boundary);
        }
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

    void judge() {
        for (Chart& chart : g_.charts) {
            chart.valid = chart.boundaries.size() >= kLeastBoundaries;
            g_.invalid_charts += !chart.valid;
        }
        for (Boundary& b : g_.boundaries) {
            b.valid = b.axis != kNone || g_.allow_opposite;
            for (Index i = b.halfedges.first; i < b.halfedges.last && b.valid && b.axis == kNone; i++)
                b.valid = !is_convex(mesh_, g_.halfedges[i]);
            g_.invalid_boundaries += !b.valid;
        }
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
    std::vector<Index> stack_;
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

void update_graph(const TriMesh& mesh, const Labeling& labels, const std::vector<Index>& changed, LabelingGraph& graph) {
    Builder(mesh, labels, graph).update(changed);
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
    require(borders == static_cast<Index>(g.borders.size()), "number of borders", borders);
    for (std::size_t i = 0; i < g.borders.size(); i++)
        require(g.is_border(g.borders[i]) && (i == 0 || g.borders[i - 1] < g.borders[i]), "list of borders", i);
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

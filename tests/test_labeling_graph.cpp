// Charts, boundaries, corners: their numbering, and the paper's validity criteria on small shapes, figure by figure.
#include "polylab/labeling_graph.h"

#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;
using shapes::prism;
using shapes::pyramid;
using shapes::voxels;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

// Random multiples of `stride`, then `steps` facets that take over a random neighbour's label: patches with jagged borders.
Labeling patchy(const TriMesh& mesh, Index colours, Index stride, Index steps, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(stride * random.below(colours)));
    for (Index i = 0; i < steps; i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

// prism(): one label per side, -Z below, +Z above.
Labeling prism_labels(const Labeling& sides) {
    Labeling labels;
    for (const Label l : sides) labels.insert(labels.end(), 2, l);
    labels.insert(labels.end(), sides.size() - 2, kNegZ);
    labels.insert(labels.end(), sides.size() - 2, kZ);
    return labels;
}

// pyramid(): one label per side, -Z below.
Labeling pyramid_labels(Labeling sides) {
    sides.insert(sides.end(), sides.size() - 2, kNegZ);
    return sides;
}

// The paper's sentence as it stands: all of one axis only if they are two; else pairs, or pairs and one trio.
bool associable(const std::vector<int>& axes, bool allow_opposite) {
    const std::size_t n = axes.size();
    std::string left;
    for (std::size_t i = 0; i < n; i++) {
        if (axes[i] == kNone && !allow_opposite) return false;
        const bool beside_opposite = axes[(i + 1) % n] == kNone || axes[(i + n - 1) % n] == kNone;
        if (axes[i] != kNone && !beside_opposite) left += "XYZ"[axes[i]];
    }
    std::sort(left.begin(), left.end());
    if (!left.empty() && left.front() == left.back()) return left.size() == 2;
    for (auto twin = left.begin(); (twin = std::adjacent_find(left.begin(), left.end())) != left.end();)
        left.erase(twin, twin + 2);
    return left.empty() || left == "XYZ";
}

// graph_text() once more, from the definitions and without haste: numbers are handed on until none changes.
std::string reference_text(const TriMesh& mesh, const Labeling& labels, bool allow_opposite) {
    const auto border = [&](Index h) { return labels[facet(h)] != labels[mesh.right(h)]; };
    const auto fan = [&](Index h) {   // borders that leave from(h), counter-clockwise, h first if it is one
        std::vector<Index> found;
        Index around = h;
        do {
            if (border(around)) found.push_back(around);
            around = mesh.ccw(around);
        } while (around != h);
        return found;
    };
    const auto following = [&](Index h) {   // the border that goes on where h ends, kNone at a corner
        const std::vector<Index> leaving = fan(mesh.opposite[h]);
        return leaving.size() == 2 ? leaving[1] : kNone;
    };

    std::vector<Index> chart(mesh.facets()), boundary(mesh.halfedges(), kNone);   // its smallest facet or half-edge
    std::iota(chart.begin(), chart.end(), 0);
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (border(h)) boundary[h] = mesh.edge(h);
    for (bool changed = true; changed;) {
        changed = false;
        const auto agree = [&](Index& a, Index& b) {
            changed = changed || a != b;
            a = b = std::min(a, b);
        };
        for (Index h = 0; h < mesh.halfedges(); h++) {
            if (!border(h)) {
                agree(chart[facet(h)], chart[mesh.right(h)]);
                continue;
            }
            agree(boundary[h], boundary[mesh.opposite[h]]);
            if (following(h) != kNone) agree(boundary[h], boundary[following(h)]);
        }
    }
    std::map<Index, std::vector<std::vector<Index>>> rings;   // vertex -> rings, by smallest half-edge
    for (Index h = 0; h < mesh.halfedges(); h++) {
        const std::vector<Index> ring = fan(h);
        if (border(h) && ring.size() >= 3 && h == *std::min_element(ring.begin(), ring.end()))
            rings[mesh.from(h)].push_back(ring);
    }
    const std::set<Index> charts(chart.begin(), chart.end());
    std::set<Index> boundaries(boundary.begin(), boundary.end());
    boundaries.erase(kNone);
    const auto number = [](const auto& sorted, Index x) { return std::distance(sorted.begin(), sorted.find(x)); };
    const auto corner_at = [&](Index h) { return fan(h).size() < 3 ? kNone : number(rings, mesh.from(h)); };
    const auto boundary_axis = [&](Index h) {
        const Label l = labels[facet(h)], r = labels[mesh.right(h)];
        for (int a = 0; a < 3; a++)
            if (a != axis(l) && a != axis(r) && orthogonal(l, r)) return a;
        return int(kNone);
    };

    std::ostringstream text;
    for (const Index c : charts) {
        std::set<Index> around;
        for (Index h = 0; h < mesh.halfedges(); h++)
            if (chart[facet(h)] == c && border(h)) around.insert(boundary[h]);
        text << "chart " << number(charts, c) << ' ' << int(labels[c]) << ' ' << c << ' '
             << std::count(chart.begin(), chart.end(), c) << ' ' << (around.size() >= 4);
        for (const Index b : around) text << ' ' << number(boundaries, b);
        text << '\n';
    }
    for (const Index b : boundaries) {
        std::vector<Index> chain = {b};
        while (following(chain.back()) != kNone && following(chain.back()) != b) chain.push_back(following(chain.back()));
        if (following(chain.back()) != b)   // open, or through one corner: what precedes b is what follows its opposite
            for (Index o = mesh.opposite[b]; (o = following(o)) != kNone;) chain.insert(chain.begin(), mesh.opposite[o]);
        bool on_features = true, convex = false;
        for (const Index h : chain) {
            on_features = on_features && mesh.feature[h];
            convex = convex || dot(cross(mesh.area_vector(facet(h)), mesh.area_vector(mesh.right(h))), mesh.vector(h)) > 0;
        }
        text << "boundary " << number(boundaries, b) << ' ' << number(charts, chart[facet(b)]) << ' '
             << number(charts, chart[mesh.right(b)]) << ' ' << corner_at(chain[0]) << ' '
             << corner_at(mesh.opposite[chain.back()]) << ' ' << boundary_axis(b) << ' ' << on_features << ' '
             << (boundary_axis(b) != kNone || (allow_opposite && !convex));
        for (const Index h : chain) text << ' ' << h;
        text << '\n';
    }
    for (const auto& [vertex, fans] : rings) {
        bool valid = true;
        for (const auto& ring : fans) {
            std::vector<int> axes;
            for (const Index h : ring) axes.push_back(boundary_axis(h));
            valid = valid && associable(axes, allow_opposite);
        }
        for (const auto& ring : fans) {
            text << "corner " << number(rings, vertex) << ' ' << vertex << ' ' << valid;
            for (const Index h : ring) text << ' ' << h;
            text << '\n';
        }
    }
    return text.str();
}

struct Counts {
    std::size_t charts, boundaries, corners;
    Index invalid_charts, invalid_boundaries, invalid_corners;
};

// Builds, validates and counts.
LabelingGraph checked_graph(const TriMesh& mesh, const Labeling& labels, const Counts& expected, bool allow_opposite = true) {
    const LabelingGraph graph = build_graph(mesh, labels, allow_opposite);
    validate(mesh, labels, graph);
    CHECK(graph.allow_opposite == allow_opposite);
    CHECK(graph.charts.size() == expected.charts);
    CHECK(graph.boundaries.size() == expected.boundaries);
    CHECK(graph.corners.size() == expected.corners);
    CHECK(graph.invalid_charts == expected.invalid_charts);
    CHECK(graph.invalid_boundaries == expected.invalid_boundaries);
    CHECK(graph.invalid_corners == expected.invalid_corners);
    CHECK(graph.valid() == (expected.invalid_charts + expected.invalid_boundaries + expected.invalid_corners == 0));
    return graph;
}

Index vertex_at(const TriMesh& mesh, const Vec3& p) {
    return static_cast<Index>(std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin());
}

// One half-edge of each fan of facets around a vertex: its smallest.
std::vector<Index> fans_of(const TriMesh& mesh, Index vertex) {
    std::vector<Index> fans;
    std::set<Index> seen;
    for (Index h = 0; h < mesh.halfedges(); h++) {
        if (mesh.from(h) != vertex || seen.count(h)) continue;
        fans.push_back(h);
        for (Index around = h; seen.insert(around).second;) around = mesh.ccw(around);
    }
    return fans;
}

// Facets around h's origin get a, b, a, b …
void alternate(const TriMesh& mesh, Labeling& labels, Index h, Label a, Label b) {
    Index around = h;
    do {
        labels[facet(around)] = a;
        std::swap(a, b);
        around = mesh.ccw(around);
    } while (around != h);
}

std::vector<MeshData> all_shapes() {
    return {shapes::pillow(),
            shapes::tetrahedron(),
            shapes::octahedron(),
            shapes::tetrahedron_with_flat_facet(),
            cube(1),
            cube(3),
            shapes::l_shape(),
            shapes::creased(shapes::stair(3)),
            shapes::frame(),
            shapes::hollow_box(),
            pyramid(5),
            shapes::two_cubes_at_a_vertex(),
            shapes::pinched_ring(),
            shapes::creased(shapes::refined(shapes::two_cubes_at_a_vertex()))};
}

}   // namespace

// ---- numbers and directions ----

TEST_CASE("labeling graph: of a cube, by hand") {
    // cube(1), facet 2l and 2l + 1 for label l, by its vertices:
    //   +X 0 1 2, 0 2 3   -X 4 5 6, 4 6 7   +Y 7 6 2, 7 2 1   -Y 4 0 3, 4 3 5   +Z 5 3 2, 5 2 6   -Z 4 7 1, 4 1 0
    // Chart lines: number, label, smallest facet, facets, valid, boundaries. Boundary lines: number, left and right chart, start
    // and end corner, axis, on features, valid, half-edges. Corner lines: number, vertex, valid, half-edges.
    const TriMesh mesh = build_mesh(cube(1));
    const LabelingGraph graph = checked_graph(mesh, naive_labeling(mesh), {6, 12, 8, 0, 0, 0});
    CHECK(graph_text(graph) ==
          "chart 0 0 0 2 1 0 1 2 3\n"
          "chart 1 1 2 2 1 4 5 6 7\n"
          "chart 2 2 4 2 1 1 6 8 9\n"
          "chart 3 3 6 2 1 3 4 10 11\n"
          "chart 4 4 8 2 1 2 5 8 11\n"
          "chart 5 5 10 2 1 0 7 9 10\n"
          "boundary 0 0 5 0 1 1 0 1 0\n"
          "boundary 1 0 2 1 2 2 0 1 1\n"
          "boundary 2 0 4 2 3 1 0 1 4\n"
          "boundary 3 0 3 3 0 2 0 1 5\n"
          "boundary 4 1 3 4 5 2 0 1 6\n"
          "boundary 5 1 4 5 6 1 0 1 7\n"
          "boundary 6 1 2 6 7 2 0 1 10\n"
          "boundary 7 1 5 7 4 1 0 1 11\n"
          "boundary 8 2 4 6 2 0 0 1 13\n"
          "boundary 9 2 5 1 7 0 0 1 17\n"
          "boundary 10 3 5 4 0 0 0 1 18\n"
          "boundary 11 3 4 3 5 0 0 1 22\n"
          "corner 0 0 1 0 19 35\n"
          "corner 1 1 1 1 34 17\n"
          "corner 2 2 1 4 16 28\n"
          "corner 3 3 1 5 25 22\n"
          "corner 4 4 1 6 30 18\n"
          "corner 5 5 1 7 23 24\n"
          "corner 6 6 1 10 29 13\n"
          "corner 7 7 1 11 12 31\n");
    CHECK(graph.chart == std::vector<Index>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5});
    CHECK(graph.corner == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(graph.boundary[0] == 0);
    CHECK(graph.boundary[34] == 0);   // 1 -> 0 in the last facet, the opposite of half-edge 0
    CHECK(graph.boundary[2] == kNone);
    CHECK(graph.runs_with_boundary(0));
    CHECK_FALSE(graph.runs_with_boundary(34));
    CHECK(graph.neighbour(0, 0) == 5);
    CHECK(graph.neighbour(0, 5) == 0);
    CHECK(graph.next_border_ccw(mesh, 0) == 19);
    CHECK(graph.next_border_cw(mesh, 0) == 35);
}

TEST_CASE("labeling graph: one label, and a closed boundary without corner") {
    const TriMesh mesh = build_mesh(cube(1));
    CHECK(graph_text(checked_graph(mesh, Labeling(12, kY), {1, 0, 0, 1, 0, 0})) == "chart 0 2 0 12 0\n");
    // The upper face alone. Of the edges around it 2 -> 3 has the smallest half-edge, at the side: it goes on 3 -> 5 -> 6 -> 2.
    Labeling labels(12, kX);
    labels[8] = labels[9] = kZ;
    CHECK(graph_text(checked_graph(mesh, labels, {2, 1, 0, 2, 0, 0})) ==
          "chart 0 0 0 10 0 0\n"
          "chart 1 4 8 2 0 0\n"
          "boundary 0 0 1 -1 -1 1 0 1 4 22 7 13\n");
    // The sides of a tube: two closed boundaries, so that no chart has four.
    labels[10] = labels[11] = kNegZ;
    checked_graph(mesh, labels, {3, 2, 0, 3, 0, 0});
}

TEST_CASE("labeling graph: boundaries closed through one corner") {
    // Octahedron, facets 0 and 2 touch in vertex 4 only: four borders meet there, all along Z. The smallest half-edge around
    // facet 2 is 4, its neighbour's: that boundary has the neighbour at its left.
    const TriMesh mesh = build_mesh(shapes::octahedron());
    const LabelingGraph graph = checked_graph(mesh, {kY, kX, kY, kX, kX, kX, kX, kX}, {3, 2, 1, 3, 0, 1});
    CHECK(graph_text(graph) ==
          "chart 0 2 0 1 0 0\n"
          "chart 1 0 1 6 0 0 1\n"
          "chart 2 2 2 1 0 1\n"
          "boundary 0 0 1 0 0 2 0 1 2 0 1\n"
          "boundary 1 1 2 0 0 2 0 1 11 18 4\n"
          "corner 0 4 0 2 5 8 11\n");
    CHECK(graph.boundaries[0].closed());
    CHECK(graph.corners[0].valence == 4);
}

TEST_CASE("labeling graph: charts with holes") {
    // A patch in the middle of a face: the face has its four boundaries and one more, the patch has that one only.
    const TriMesh mesh = build_mesh(cube(3));
    Labeling labels = naive_labeling(mesh);
    labels[80] = labels[81] = kX;   // the middle square of the upper face, facets 72..89
    LabelingGraph graph = checked_graph(mesh, labels, {7, 13, 8, 1, 0, 0});
    CHECK(graph.charts[graph.chart[72]].boundaries.size() == 5);
    CHECK(graph.charts[graph.chart[80]].boundaries.size() == 1);
    CHECK_FALSE(graph.charts[graph.chart[80]].valid);
    // The upper and lower face of a frame: four boundaries outside, four inside. 4 + 4 faces between them.
    const TriMesh frame = build_mesh(shapes::frame());
    graph = checked_graph(frame, naive_labeling(frame), {10, 24, 16, 0, 0, 0});
    CHECK(std::count_if(graph.charts.begin(), graph.charts.end(), [](const Chart& c) { return c.boundaries.size() == 8; }) == 2);
}

TEST_CASE("labeling graph: boundaries on feature edges") {
    const MeshData creased = shapes::creased(cube(2));
    const TriMesh mesh = build_mesh(creased);
    for (const Boundary& b : build_graph(mesh, naive_labeling(mesh)).boundaries) CHECK(b.on_features);
    // Without one of the 24 edges, the boundary along it is no longer complete.
    MeshData less = creased;
    less.edges.resize(less.edges.size() - 2);
    const TriMesh mesh_less = build_mesh(less);
    Index complete = 0;
    for (const Boundary& b : build_graph(mesh_less, naive_labeling(mesh_less)).boundaries) complete += b.on_features;
    CHECK(complete == 11);
}

TEST_CASE("labeling graph: random labelings are as the definitions say, also in a used graph") {
    struct Kind {
        Index colours, stride, rounds;   // labels are multiples of the stride; steps per facet
    };
    const Kind kinds[] = {{6, 1, 0}, {6, 1, 4}, {6, 1, 30}, {2, 1, 4}, {2, 2, 4}, {3, 2, 10}, {3, 1, 10}, {4, 1, 2}};
    Lcg random(1);
    int labelings = 0, opposite = 0, many_fans = 0;
    for (const MeshData& shape : all_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        Labeling last(mesh.facets(), kX);
        LabelingGraph updated;
        for (const Kind& kind : kinds) {
            for (int again = 0; again < 4; again++) {
                const Labeling labels = patchy(mesh, kind.colours, kind.stride, kind.rounds * mesh.facets(), random);
                const bool allow_opposite = again % 2 == 0;
                labelings++;
                CAPTURE(labelings);
                const LabelingGraph graph = build_graph(mesh, labels, allow_opposite);
                CHECK_NOTHROW(validate(mesh, labels, graph));
                CHECK(graph_text(graph) == reference_text(mesh, labels, allow_opposite));
                updated = build_graph(mesh, last, allow_opposite);
                GraphChange change;
                for (Index f = 0; f < mesh.facets(); f++) {
                    if (labels[f] == last[f]) continue;
                    change.facets.push_back(f);
                    change.fans.insert(change.fans.end(), {3 * f, 3 * f + 1, 3 * f + 2});
                }
                for (const Index c : graph.chart) change.charts.push_back(2 * (static_cast<Index>(graph.charts.size()) - c));
                change.most_chart = 2 * static_cast<Index>(graph.charts.size());
                last = labels;
                update_graph(mesh, labels, change, updated);
                CHECK(graph_text(updated) == graph_text(graph));
                CHECK(updated.chart == graph.chart);
                CHECK(updated.boundary == graph.boundary);
                CHECK(updated.corner == graph.corner);
                CHECK(updated.invalid() == graph.invalid());
                for (const Boundary& b : graph.boundaries) opposite += b.axis == kNone;
                Index marked = 0;
                for (const Index c : graph.corner) marked += c != kNone;
                CHECK(marked == static_cast<Index>(graph.corners.size()));
                for (const Corner& c : graph.corners) {
                    many_fans += c.rings.size() > 1;
                    Index valence = 0;
                    for (Index r = c.rings.first; r < c.rings.last; r++) valence += graph.rings[r].halfedges.size();
                    CHECK(c.valence == valence);
                }
                for (Index h = 0; h < mesh.halfedges(); h++) {
                    if (!graph.is_border(h)) continue;
                    CHECK(graph.next_border_cw(mesh, graph.next_border_ccw(mesh, h)) == h);
                    const Range run = graph.boundaries[graph.boundary[h]].halfedges;
                    const auto first = graph.halfedges.begin();
                    CHECK(graph.runs_with_boundary(h) == (std::find(first + run.first, first + run.last, h) != first + run.last));
                }
            }
        }
    }
    CHECK(opposite > 100);   // that the interesting cases occur
    CHECK(many_fans > 10);
}

TEST_CASE("labeling graph: validate finds every changed number") {
    // A patch inside a face and one across an edge: boundaries with and without corners, open ones of several edges.
    const TriMesh mesh = build_mesh(cube(3));
    Labeling labels = naive_labeling(mesh);
    labels[80] = labels[81] = labels[77] = kX;
    labels[0] = labels[1] = kY;
    const LabelingGraph graph = build_graph(mesh, labels);
    CHECK_NOTHROW(validate(mesh, labels, graph));
    const auto refused = [&](const std::function<void(LabelingGraph&)>& change) {
        LabelingGraph changed = graph;
        change(changed);
        CHECK_THROWS_AS(validate(mesh, labels, changed), std::logic_error);
    };
    // Each entry of each array becomes the next number (-1 becomes 0).
    const auto each_entry = [&](std::vector<Index> LabelingGraph::*array, Index bound) {
        for (std::size_t i = 0; i < (graph.*array).size(); i++) {
            CAPTURE(i);
            refused([&](LabelingGraph& g) { (g.*array)[i] = ((g.*array)[i] + 1) % bound; });
        }
    };
    const auto size = [](const auto& list) { return static_cast<Index>(list.size()); };
    SUBCASE("chart of a facet") { each_entry(&LabelingGraph::chart, size(graph.charts)); }
    SUBCASE("boundary of a half-edge") { each_entry(&LabelingGraph::boundary, size(graph.boundaries)); }
    SUBCASE("corner of a vertex") { each_entry(&LabelingGraph::corner, size(graph.corners)); }
    SUBCASE("half-edges of boundaries") { each_entry(&LabelingGraph::halfedges, mesh.halfedges()); }
    SUBCASE("boundaries of charts") { each_entry(&LabelingGraph::chart_boundaries, size(graph.boundaries)); }
    SUBCASE("half-edges of rings") { each_entry(&LabelingGraph::ring_halfedges, mesh.halfedges()); }
    SUBCASE("charts") {
        for (std::size_t c = 0; c < graph.charts.size(); c++) {
            CAPTURE(c);
            refused([&](LabelingGraph& g) { g.charts[c].label = opposite(g.charts[c].label); });
            refused([&](LabelingGraph& g) { g.charts[c].smallest_facet++; });
            refused([&](LabelingGraph& g) { g.charts[c].facets++; });
            refused([&](LabelingGraph& g) { g.charts[c].boundaries.last--; });
            refused([&](LabelingGraph& g) { g.charts[c].valid = !g.charts[c].valid; });
        }
        refused([](LabelingGraph& g) { g.charts.pop_back(); });
        refused([](LabelingGraph& g) { g.invalid_charts++; });
    }
    SUBCASE("boundaries") {
        for (std::size_t b = 0; b < graph.boundaries.size(); b++) {
            CAPTURE(b);
            refused([&](LabelingGraph& g) { std::swap(g.boundaries[b].left, g.boundaries[b].right); });
            refused([&](LabelingGraph& g) { g.boundaries[b].start = (g.boundaries[b].start + 1) % size(g.corners); });
            refused([&](LabelingGraph& g) { g.boundaries[b].end = (g.boundaries[b].end + 1) % size(g.corners); });
            refused([&](LabelingGraph& g) { g.boundaries[b].axis = (g.boundaries[b].axis + 2) % 4 - 1; });
            refused([&](LabelingGraph& g) { g.boundaries[b].on_features = !g.boundaries[b].on_features; });
            refused([&](LabelingGraph& g) { g.boundaries[b].valid = !g.boundaries[b].valid; });
            refused([&](LabelingGraph& g) { g.boundaries[b].halfedges.last--; });
        }
        refused([](LabelingGraph& g) { g.invalid_boundaries++; });
    }
    SUBCASE("corners") {
        for (std::size_t c = 0; c < graph.corners.size(); c++) {
            CAPTURE(c);
            refused([&](LabelingGraph& g) { g.corners[c].vertex = (g.corners[c].vertex + 1) % mesh.vertices(); });
            refused([&](LabelingGraph& g) { g.corners[c].valence++; });
            refused([&](LabelingGraph& g) { g.corners[c].valid = !g.corners[c].valid; });
            refused([&](LabelingGraph& g) { g.corners[c].rings.last--; });
            refused([&](LabelingGraph& g) { g.rings[c].corner++; });
            refused([&](LabelingGraph& g) { g.rings[c].halfedges.last--; });
        }
        refused([](LabelingGraph& g) { g.invalid_corners++; });
    }
    SUBCASE("directions and starts") {
        for (const Boundary& b : graph.boundaries) {
            refused([&](LabelingGraph& g) {   // the other way
                const auto begin = g.halfedges.begin() + b.halfedges.first, end = g.halfedges.begin() + b.halfedges.last;
                std::reverse(begin, end);
                for (auto h = begin; h != end; ++h) *h = mesh.opposite[*h];
                Boundary& changed = g.boundaries[g.boundary[*begin]];
                std::swap(changed.left, changed.right);
                std::swap(changed.start, changed.end);
            });
            if (b.start != kNone || b.halfedges.size() < 2) continue;
            refused([&](LabelingGraph& g) {   // a closed one from its second half-edge
                const auto begin = g.halfedges.begin() + b.halfedges.first;
                std::rotate(begin, begin + 1, g.halfedges.begin() + b.halfedges.last);
            });
        }
        for (const Ring& ring : graph.rings)
            refused([&](LabelingGraph& g) {
                const auto begin = g.ring_halfedges.begin() + ring.halfedges.first;
                std::rotate(begin, begin + 1, g.ring_halfedges.begin() + ring.halfedges.last);
            });
        refused([](LabelingGraph& g) { std::swap(g.charts[0], g.charts[1]); });
        refused([](LabelingGraph& g) { std::swap(g.boundaries[0], g.boundaries[1]); });
        refused([](LabelingGraph& g) { std::swap(g.corners[0], g.corners[1]); });
    }
}

// ---- validity, figure by figure ----

TEST_CASE("labeling graph: Figure 4, an invalid chart") {
    // A patch across the edge of a cube between +X and +Z: two boundaries, and a trio of axes at each end of that edge's part.
    const TriMesh mesh = build_mesh(cube(3));
    Labeling labels = naive_labeling(mesh);
    labels[82] = labels[83] = kY;   // upper face, square (2,1); square (1,2) of the face +X is below it
    labels[14] = labels[15] = kY;
    const LabelingGraph graph = checked_graph(mesh, labels, {7, 15, 10, 1, 0, 0});
    CHECK(graph.charts[graph.chart[82]].boundaries.size() == 2);
    CHECK_FALSE(graph.charts[graph.chart[82]].valid);
    // The ends of a triangular prism have three boundaries. (Its slanted side, here +X, also meets -X.)
    const TriMesh wedge = build_mesh(shapes::triangular_prism(3, 1, 2));
    CHECK(checked_graph(wedge, prism_labels({kNegY, kX, kNegX}), {5, 9, 6, 2, 1, 0}).charts[3].boundaries.size() == 3);
}

TEST_CASE("labeling graph: Figures 4 and 6a, an invalid boundary at less than 180 degrees") {
    // M-shaped: two ridges between +X and -X, and a valley between them. The two sides at a ridge turn back into each other;
    // at the valley they don't.
    const std::vector<Vec3> m = {{2, 1, 0}, {1, 2, 0}, {0, 0, 0}, {4, 0, 0}, {3, 2, 0}};
    const TriMesh mesh = build_mesh(prism(m, 3));
    const Labeling labels = prism_labels({kX, kNegX, kNegY, kX, kNegX});
    const LabelingGraph graph = checked_graph(mesh, labels, {7, 15, 10, 0, 2, 0});
    for (const Boundary& b : graph.boundaries) {
        const Index h = graph.halfedges[b.halfedges.first];
        const bool opposite_labels = axis(graph.charts[b.left].label) == axis(graph.charts[b.right].label);
        CHECK((b.axis == kNone) == opposite_labels);
        CHECK(b.valid == (!opposite_labels || mesh.from(h) % 5 == 0));   // the valley is at vertices 0 and 5
    }
    // Not allowed at all: the valley as well, and the corners at the six ends.
    checked_graph(mesh, labels, {7, 15, 10, 0, 3, 6}, false);
}

TEST_CASE("labeling graph: Figure 6b, a boundary between opposite labels at more than 180 degrees is valid") {
    const std::vector<Vec3> notch = {{2, 1, 0}, {1, 3, 0}, {0, 3, 0}, {0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}};
    const TriMesh mesh = build_mesh(prism(notch, 2));
    const Labeling labels = prism_labels({kX, kY, kNegX, kNegY, kX, kY, kNegX});
    checked_graph(mesh, labels, {9, 21, 14, 0, 0, 0});
    checked_graph(mesh, labels, {9, 21, 14, 0, 1, 2}, false);
}

TEST_CASE("labeling graph: exactly 180 degrees is valid") {
    // Half of the upper face of a box is -Z: a flat boundary. Its two ends have no axis left that counts.
    const TriMesh mesh = build_mesh(shapes::box(2, 1, 1));
    Labeling labels = naive_labeling(mesh);
    std::replace(labels.begin() + 12, labels.begin() + 14, kZ, kNegZ);   // facets: 2 2 4 4, then 4 above
    CHECK(labels[12] == kNegZ);
    const LabelingGraph graph = checked_graph(mesh, labels, {7, 15, 10, 0, 0, 0});
    CHECK(graph.boundaries[graph.boundary[3 * 12 + 1]].axis == kNone);   // from (1,0,1) to (1,1,1)
    CHECK_FALSE(is_convex(mesh, 3 * 12 + 1));
}

TEST_CASE("labeling graph: convex, flat and concave edges") {
    const TriMesh mesh = build_mesh(shapes::l_shape());
    for (Index h = 0; h < mesh.halfedges(); h++) {
        const Vec3 p = mesh.points[mesh.from(h)], q = mesh.points[mesh.to(h)];
        const bool flat = mesh.normal[facet(h)] == mesh.normal[mesh.right(h)];
        const bool concave = p.x == 1 && p.y == 1 && q.x == 1 && q.y == 1;   // the one inner edge of the L
        CHECK(is_convex(mesh, h) == (!flat && !concave));
        CHECK(is_convex(mesh, mesh.opposite[h]) == is_convex(mesh, h));
    }
}

TEST_CASE("labeling graph: Figure 5, four cubes with a 4-connected corner") {
    // Two cubes along X below, two along Y above. Around (1,1,1) the vertical edges are inside of faces; two edges along X and
    // two along Y are left. 10 faces; the other corners have 3 boundaries, so 2 B = 3 C + 1, and Euler: C - B + 10 = 2.
    const TriMesh mesh = build_mesh(voxels({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}}));
    const LabelingGraph graph = checked_graph(mesh, naive_labeling(mesh), {10, 23, 15, 0, 0, 0});
    const Corner& corner = graph.corners[graph.corner[vertex_at(mesh, {1, 1, 1})]];
    CHECK(corner.valence == 4);
    CHECK(corner.rings.size() == 1);
    CHECK(corner.valid);
    // Three cubes on three sides of a fourth: two edges along each axis. 12 faces, 2 B = 3 C + 3.
    const TriMesh tripod = build_mesh(voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    const LabelingGraph six = checked_graph(tripod, naive_labeling(tripod), {12, 27, 17, 0, 0, 0});
    CHECK(six.corners[six.corner[vertex_at(tripod, {1, 1, 1})]].valence == 6);
}

TEST_CASE("labeling graph: Figures 4 and 9, corners of valence 4 and 6") {
    struct Cell {
        Labeling sides;   // labels around the apex of a pyramid
        bool valid;
    };
    const Cell cells[] = {
        {{kX, kY, kNegX, kNegY}, false},              // a cone: Z Z Z Z, four parallel lines can't meet
        {{kX, kY, kX, kNegY}, false},                 // the same axes on a saddle
        {{kX, kZ, kX, kY}, true},                     // Y Y Z Z
        {{kX, kY, kNegX, kZ}, true},                  // Z Z Y Y, opposite labels across
        {{kX, kY, kX, kY, kX, kY}, false},            // Z six times
        {{kX, kY, kNegX, kNegY, kX, kNegY}, false},   // the same axes by other labels
        {{kX, kY, kZ, kX, kY, kZ}, true},             // Z X Y Z X Y: pairs
        {{kX, kY, kNegX, kY, kX, kZ}, true},          // Z Z Z Z Y Y: pairs
    };
    for (const Cell& cell : cells) {
        const Index n = static_cast<Index>(cell.sides.size()), row = static_cast<Index>(&cell - cells);
        CAPTURE(row);
        const TriMesh mesh = build_mesh(pyramid(n));
        const Labeling labels = pyramid_labels(cell.sides);
        for (const bool allow_opposite : {true, false}) {   // no boundary between opposite labels: no difference
            const LabelingGraph graph = build_graph(mesh, labels, allow_opposite);
            validate(mesh, labels, graph);
            const Corner& apex = graph.corners[graph.corner[n]];
            CHECK(apex.valence == n);
            CHECK(apex.valid == cell.valid);
        }
    }
}

TEST_CASE("labeling graph: a corner with a trio and pairs, of any valence") {
    // Around labels X Y Z X Y: axes Z X Y Z Z, a trio and a pair.
    CHECK(valid_ring({2, 0, 1, 2, 2}, true));
    for (Index n = 3; n <= 9; n++) {
        const std::vector<int> same(n, 1);
        CHECK_FALSE(valid_ring(same, true));   // parallel lines, however many
        std::vector<int> axes = {0, 1, 2};
        for (Index i = 3; i + 1 < n; i += 2) axes.insert(axes.end(), 2, i % 3);
        CHECK(valid_ring(axes, true));
        axes.push_back(0);   // one more than trio and pairs
        CHECK_FALSE(valid_ring(axes, true));
    }
}

TEST_CASE("labeling graph: rings next to boundaries between opposite labels") {
    struct Row {
        std::vector<int> axes;
        bool valid;
    };
    const int o = kNone;
    const Row rows[] = {
        {{o, 2, 2}, true},             // both masked: nothing is left, the vertex is inside
        {{o, 2, 2, o}, true},          // again
        {{o, o, o}, true},             // again
        {{o, 2, 0, 1}, false},         // X alone is left
        {{o, 2, 0, 0, 1}, true},       // a pair X: the vertex lies on a boundary
        {{o, 2, 0, 1, 1}, false},      // X Y: neither pair nor trio
        {{o, 2, 0, 1, 2, 2}, true},    // X Y Z
        {{2, 0, 1, 2, o, 2}, true},    // the same ring from another start
        {{o, 2, 0, 0, 0, 2}, false},   // X three times
        {{0, 1, 2, o, 1, 1}, false},   // X and a pair Y
    };
    for (const Row& row : rows) {
        const auto number = &row - rows;
        CAPTURE(number);
        CHECK(valid_ring(row.axes, true) == row.valid);
        CHECK_FALSE(valid_ring(row.axes, false));
    }
}

TEST_CASE("labeling graph: every ring of up to seven axes is judged as the paper's sentence") {
    for (std::size_t n = 3; n <= 7; n++) {
        for (int code = 0; code < 1 << (2 * n); code++) {
            std::vector<int> axes;
            for (std::size_t i = 0; i < n; i++) axes.push_back((code >> (2 * i)) % 4 - 1);
            const bool right =
                valid_ring(axes, true) == associable(axes, true) && valid_ring(axes, false) == associable(axes, false);
            CAPTURE(n);
            CAPTURE(code);
            REQUIRE(right);
        }
    }
}

// ---- several fans ----

TEST_CASE("labeling graph: two solids that touch in a vertex have a ring each") {
    const TriMesh mesh = build_mesh(shapes::two_cubes_at_a_vertex());
    const Index vertex = vertex_at(mesh, {1, 1, 1});
    const std::vector<Index> fans = fans_of(mesh, vertex);
    REQUIRE(fans.size() == 2);
    // By normals: a trio in each fan.
    LabelingGraph graph = checked_graph(mesh, naive_labeling(mesh), {12, 24, 15, 0, 0, 0});
    CHECK(graph.corners[graph.corner[vertex]].rings.size() == 2);
    CHECK(graph.corners[graph.corner[vertex]].valence == 6);
    const auto rings = [&](const Labeling& labels) {
        graph = build_graph(mesh, labels);
        validate(mesh, labels, graph);
        std::vector<bool> valid;
        if (graph.corner[vertex] == kNone) return valid;
        const Corner& corner = graph.corners[graph.corner[vertex]];
        for (Index r = corner.rings.first; r < corner.rings.last; r++) valid.push_back(graph.rings[r].valid);
        CHECK(corner.valid == (std::count(valid.begin(), valid.end(), false) == 0));
        return valid;
    };
    // Six boundaries along Z in one fan, six along Y in the other: together they would be pairs.
    Labeling labels = naive_labeling(mesh);
    alternate(mesh, labels, fans[0], kX, kY);
    CHECK(rings(labels) == std::vector<bool>{false, true});
    alternate(mesh, labels, fans[1], kX, kZ);
    CHECK(rings(labels) == std::vector<bool>{false, false});
    CHECK(graph.corners[graph.corner[vertex]].valence == 12);
    CHECK(valid_ring({2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1}, true));
    // Two boundary edges in each fan pass by: no corner, although they are four.
    labels.assign(24, kX);
    labels[facet(fans[0])] = labels[facet(fans[1])] = kY;
    CHECK(rings(labels).empty());
    CHECK(graph.boundaries.size() == 2);
    CHECK(graph.boundaries[0].start == kNone);
    CHECK(graph.boundaries[1].start == kNone);
    // A corner in one fan only: the boundary in the other one passes by.
    alternate(mesh, labels, fans[0], kX, kY);
    CHECK(rings(labels) == std::vector<bool>{false});
    CHECK(graph.corners[graph.corner[vertex]].valence == 6);
    CHECK(graph.boundaries[graph.boundary[fans[1]]].start == kNone);
}

TEST_CASE("labeling graph: a solid that touches itself in a vertex") {
    const TriMesh mesh = build_mesh(shapes::pinched_ring());
    const Labeling labels = naive_labeling(mesh);
    const LabelingGraph graph = build_graph(mesh, labels);
    validate(mesh, labels, graph);
    CHECK(graph.valid());
    const Corner& corner = graph.corners[graph.corner[vertex_at(mesh, {1, 1, 2})]];
    CHECK(corner.rings.size() == 2);
    CHECK(corner.valence == 6);
}

// Validity operators on shapes made for them: what they propose, by hand, what it makes of the labeling, and what they refuse.
#include "polylab/validity_operators.h"

#include "polylab/initial_labeling.h"
#include "polylab/routines.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;
using shapes::refined;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

using Facets = std::set<Index>;

// ---- scenes

struct Shape {
    MeshData data;
    Labeling labels;
};

struct Scene {
    TriMesh mesh;
    State state;

    Scene(const MeshData& data, const Labeling& labels) : mesh(build_mesh(data)), state(Judge(mesh).state(labels)) {
        validate(mesh, state.labels, state.graph);
    }
    explicit Scene(const Shape& shape) : Scene(shape.data, shape.labels) {}

    State after(const Patch& patch) const {
        State result = state;
        Judge(mesh).apply(result, patch);
        validate(mesh, result.labels, result.graph);
        return result;
    }
    Vec3 middle(Index f) const {
        Vec3 sum;
        for (Index h = 3 * f; h < 3 * f + 3; h++) sum += mesh.points[mesh.from(h)];
        return sum * (1.0 / 3);
    }
    Facets where(const std::function<bool(Index)>& condition) const {
        Facets facets;
        for (Index f = 0; f < mesh.facets(); f++)
            if (condition(f)) facets.insert(f);
        return facets;
    }
    Facets of_chart(Index chart) const {
        return where([&](Index f) { return state.graph.chart[f] == chart; });
    }
    Index chart_labeled(Label label) const {   // the first
        return state.graph.chart[std::find(state.labels.begin(), state.labels.end(), label) - state.labels.begin()];
    }
    Index boundary_between(Label a, Label b) const {   // the first
        for (Index h = 0; h < mesh.halfedges(); h++)
            if (state.labels[mesh.left(h)] == a && state.labels[mesh.right(h)] == b) return state.graph.boundary[h];
        return kNone;
    }
    Index corner_at(const Vec3& p) const {
        return state.graph.corner[std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin()];
    }
    std::set<Label> neighbour_labels(Index chart) const {
        std::set<Label> labels;
        const Range r = state.graph.charts[chart].boundaries;
        for (Index i = r.first; i < r.last; i++)
            labels.insert(state.graph.charts[state.graph.neighbour(state.graph.chart_boundaries[i], chart)].label);
        return labels;
    }
};

Facets facets_of(const Patch& patch) {
    Facets facets;
    for (const Relabel& r : patch) CHECK(facets.insert(r.facet).second);   // none twice
    return facets;
}

std::set<Label> labels_of(const Patch& patch) {
    std::set<Label> labels;
    for (const Relabel& r : patch) labels.insert(r.label);
    return labels;
}

bool is_patch(const Patch& patch, const Facets& facets, Label label) {
    return facets_of(patch) == facets && labels_of(patch) == std::set<Label>{label};
}

bool same(const Proposals& a, const Proposals& b) {
    const auto equal = [](const Relabel& r, const Relabel& s) { return r.facet == s.facet && r.label == s.label; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Patch& p, const Patch& q) { return std::equal(p.begin(), p.end(), q.begin(), q.end(), equal); });
}

bool solved(const State& state) { return state.graph.valid() && state.turning.points.empty(); }

bool subset(const Facets& inner, const Facets& outer) {
    return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

// ---- shapes

Shape refined(const Shape& shape) {
    Shape fine{shapes::refined(shape.data), {}};
    for (const Label l : shape.labels) fine.labels.insert(fine.labels.end(), 4, l);
    return fine;
}

Shape by_normals(const MeshData& data) { return {data, naive_labeling(build_mesh(data))}; }

// A patch of one label, of squares [x,x+1] x [y,y+1] of the upper face of cube(n).
Shape cube_with(Index n, const std::vector<std::array<Index, 2>>& squares, Label label) {
    Shape shape = by_normals(cube(n));
    for (const auto& [x, y] : squares)
        for (const Index f : {8 * n * n + 2 * (n * y + x), 8 * n * n + 2 * (n * y + x) + 1}) shape.labels[f] = label;
    return shape;
}

// A plate of 3 x 3 cells with a cell of the given label on its middle, facets 0..9.
Shape button(Label label) {
    std::vector<shapes::Cell> cells = {{1, 1, 1}};
    for (int i = 0; i < 9; i++) cells.push_back({i % 3, i / 3, 0});
    Shape shape = by_normals(shapes::voxels(cells));
    std::fill(shape.labels.begin(), shape.labels.begin() + 10, label);
    return shape;
}

// Sides -Y, +X (slanted, normal (4,3,0) / 5), -X; 4 x 4 squares each; facets 32..63 are slanted.
Shape triangular_prism() {
    return refined(refined(Shape{shapes::creased(shapes::triangular_prism(3, 4, 4)), {3, 3, 0, 0, 1, 1, 5, 4}}));
}

// On the square [-2,2] x [-2,2], apex at (0,0,4); sides +X +Y -X -Y, base -Z. Before refinement facets 0..3 are the sides.
MeshData square_pyramid() {
    MeshData data;
    data.points = {{2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, -2, 0}, {0, 0, 4}};
    data.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
    return data;
}

// Refined twice: each side has rows of 1, 3, 5, 7 facets from the apex at (0,0,16) down.
Shape steep_pyramid() { return refined(refined(Shape{shapes::creased(square_pyramid()), {kX, kY, kNegX, kNegY, kNegZ, kNegZ}})); }

// Two steep slopes, +X and -X, that meet at a ridge of 4 edges; 4 columns of 4 squares each.
Shape gable() {
    return refined(
        refined(Shape{shapes::creased(shapes::prism({{0, 0, 0}, {2, 0, 0}, {1, 3, 0}}, 2)), {3, 3, 0, 0, 1, 1, 5, 4}}));
}

// Facets with labels, by their corners.
class Surface {
public:
    void add(Label label, const std::vector<Vec3>& polygon) {
        for (std::size_t i = 1; i + 1 < polygon.size(); i++) {
            for (const Vec3& p : {polygon[0], polygon[i], polygon[i + 1]}) shape.data.triangles.push_back(vertex(p));
            shape.labels.push_back(label);
        }
    }

    Shape shape;

private:
    Index vertex(const Vec3& p) {
        std::vector<Vec3>& points = shape.data.points;
        const auto found = std::find(points.begin(), points.end(), p);
        if (found != points.end()) return static_cast<Index>(found - points.begin());
        points.push_back(p);
        return static_cast<Index>(points.size()) - 1;
    }
};

//   z  5          +    a ramp with 45 degrees on a plate of 8 x 6, from y = 2 to y = 4. The plate and the
//               / |    slope are one chart, +Z: its boundary with a side of the ramp turns at the toe (2,y,1),
//             /   |    and has the ramp's back, +X, for its only other neighbour.
//      1 ---+-----+---
//      0 --------------   x
//           2     6   8
Shape ramp_on_plate(double length = 4) {
    Surface s;
    const double end = 2 + length, width = end + 2;
    for (double x = 0; x < width; x++) {
        for (double y = 0; y < 6; y++) {
            s.add(kNegZ, {{x, y, 0}, {x, y + 1, 0}, {x + 1, y + 1, 0}, {x + 1, y, 0}});
            const bool ramp = x >= 2 && x < end && y >= 2 && y < 4;
            const double z = ramp ? x - 1 : 1, rise = ramp;
            s.add(kZ, {{x, y, z}, {x + 1, y, z + rise}, {x + 1, y + 1, z + rise}, {x, y + 1, z}});
        }
        s.add(kNegY, {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 0, 1}, {x, 0, 1}});
        s.add(kY, {{x, 6, 1}, {x + 1, 6, 1}, {x + 1, 6, 0}, {x, 6, 0}});
    }
    for (double y = 0; y < 6; y++) {
        s.add(kNegX, {{0, y, 1}, {0, y + 1, 1}, {0, y + 1, 0}, {0, y, 0}});
        s.add(kX, {{width, y, 0}, {width, y + 1, 0}, {width, y + 1, 1}, {width, y, 1}});
    }
    for (double x = 2; x < end; x++) {
        for (double z = 1; z < x - 1; z++) {
            s.add(kNegY, {{x, 2, z}, {x + 1, 2, z}, {x + 1, 2, z + 1}, {x, 2, z + 1}});
            s.add(kY, {{x, 4, z + 1}, {x + 1, 4, z + 1}, {x + 1, 4, z}, {x, 4, z}});
        }
        s.add(kNegY, {{x, 2, x - 1}, {x + 1, 2, x - 1}, {x + 1, 2, x}});
        s.add(kY, {{x + 1, 4, x}, {x + 1, 4, x - 1}, {x, 4, x - 1}});
    }
    for (double y = 2; y < 4; y++)
        for (double z = 1; z < 1 + length; z++) s.add(kX, {{end, y, z}, {end, y + 1, z}, {end, y + 1, z + 1}, {end, y, z + 1}});
    s.shape.data = shapes::creased(s.shape.data);
    return s.shape;
}

// Eight sides in pairs +X +Y -X -Y: in the middle of each pair a ridge is lost.
Shape eight_sided_pyramid(bool features) {
    const MeshData data = shapes::pyramid(8);
    return refined(Shape{features ? shapes::creased(data) : data, {0, 2, 2, 1, 1, 3, 3, 0, 5, 5, 5, 5, 5, 5}});
}

// Two domes on each other, each one chart.
Shape lens() { return refined(Shape{shapes::octahedron(), {kZ, kZ, kZ, kZ, kNegZ, kNegZ, kNegZ, kNegZ}}); }

Labeling patchy(const TriMesh& mesh, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    for (Index i = 0; i < 3 * mesh.facets(); i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

std::vector<Scene> patchy_scenes(Index each) {
    Lcg random(77);
    std::vector<Scene> scenes;
    for (const MeshData& data :
         {cube(3), shapes::creased(shapes::frame()), shapes::refined(shapes::creased(shapes::triangular_prism(3, 4, 5))),
          shapes::two_cubes_at_a_vertex(), shapes::pinched_ring(), shapes::creased(shapes::pyramid(8))})
        for (Index i = 0; i < each; i++) scenes.emplace_back(data, patchy(build_mesh(data), random));
    return scenes;
}

bool edge_connected(const TriMesh& mesh, const Facets& facets) {
    std::vector<Index> reached = {*facets.begin()};
    Facets left = facets;
    left.erase(reached[0]);
    for (std::size_t i = 0; i < reached.size(); i++)
        for (Index h = 3 * reached[i]; h < 3 * reached[i] + 3; h++)
            if (left.erase(mesh.right(h)) > 0) reached.push_back(mesh.right(h));
    return left.empty();
}

}   // namespace

// ---- surrounded by one label

TEST_CASE("validity operators: a chart inside a face takes the label of the face") {
    const Scene scene(cube_with(3, {{1, 1}}, kX));
    const Index patch_chart = scene.state.graph.chart[80];   // square (1,1): 8 * 9 + 2 * 4
    const Proposals found = remove_surrounded_chart(scene.mesh, scene.state, patch_chart);
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], {80, 81}, kZ));
    CHECK(scene.after(found[0]).labels == naive_labeling(scene.mesh));
}

TEST_CASE("validity operators: a chart between two labels is not a surrounded one") {
    const Scene scene(cube_with(3, {{1, 2}}, kX));   // at the edge to +Y
    CHECK(remove_surrounded_chart(scene.mesh, scene.state, scene.state.graph.chart[86]).empty());
    const Scene plain(by_normals(cube(2)));
    for (Index c = 0; c < 6; c++) CHECK(remove_surrounded_chart(plain.mesh, plain.state, c).empty());
    const Scene single(cube(1), Labeling(12, kZ));   // no neighbour at all
    CHECK(remove_surrounded_chart(single.mesh, single.state, 0).empty());
}

TEST_CASE("validity operators: a chart surrounded by two charts of one label is a surrounded one") {
    // A band of +X around a bar along Z that is +Z elsewhere.
    const TriMesh mesh = build_mesh(shapes::box(1, 1, 3));
    Labeling labels(mesh.facets(), kZ);
    Facets ring;
    for (Index f = 0; f < 24; f++) {   // four sides of three squares, from below upward
        if (f % 6 != 2 && f % 6 != 3) continue;
        labels[f] = kX;
        ring.insert(f);
    }
    const Scene scene(shapes::box(1, 1, 3), labels);
    REQUIRE(scene.state.graph.charts.size() == 3);
    const Proposals found = remove_surrounded_chart(scene.mesh, scene.state, scene.chart_labeled(kX));
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], ring, kZ));
}

TEST_CASE("validity operators: a surrounded chart is spared where a boundary lies on feature edges") {
    Shape shape = button(kX);
    const Facets cell = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const Scene plain(shape);
    const Proposals found = remove_surrounded_chart(plain.mesh, plain.state, plain.chart_labeled(kX));
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], cell, kZ));
    shape.data = shapes::creased(shape.data);
    const Scene creased(shape);
    CHECK(remove_surrounded_chart(creased.mesh, creased.state, creased.chart_labeled(kX)).empty());
    // One edge less, and the boundary does not lie on feature edges.
    std::vector<Index>& edges = shape.data.edges;
    for (std::size_t e = 0; e < edges.size(); e += 2) {
        const Vec3 middle = (shape.data.points[edges[e]] + shape.data.points[edges[e + 1]]) * 0.5;
        if (!(middle == Vec3{1.5, 1, 1})) continue;
        edges.erase(edges.begin() + e, edges.begin() + e + 2);
        break;
    }
    const Scene open(shape);
    REQUIRE(open.mesh.features_kept == creased.mesh.features_kept - 1);
    CHECK(remove_surrounded_chart(open.mesh, open.state, open.chart_labeled(kX)).size() == 1);
}

TEST_CASE("validity operators: two charts that surround each other are not exchanged for ever") {
    const Scene scene(lens());
    for (const Label l : {kZ, kNegZ}) {
        const Index chart = scene.chart_labeled(l);
        const Proposals found = remove_surrounded_chart(scene.mesh, scene.state, chart);
        REQUIRE(found.size() == 1);
        CHECK(is_patch(found[0], scene.of_chart(chart), opposite(l)));
        CHECK(scene.after(found[0]).graph.charts.size() == 1);   // one at a time: the other chart stays
    }
    const State result = run_routines(scene.mesh, scene.state.labels);   // ends
    CHECK_FALSE(scene.state.score < result.score);
}

// ---- valence

TEST_CASE("validity operators: the caps of a triangular prism get a fourth boundary") {
    // The sides +X (slanted) and -X meet at the edge x = 0: both follow Y around a cap. X is inserted on the slanted side,
    // where an edge makes 53 degrees with X and 37 with Y: two edges from the corner, 2 x 53 against 2 x 37; with three it
    // would be 3 x 53 against 37. Along -X there is nothing to gain. Between the corner and there the side becomes +Y.
    const Scene scene(triangular_prism());
    CHECK(scene.state.graph.invalid() == 3);   // caps, and the edge between +X and -X
    const Facets half = scene.where([&](Index f) { return f >= 32 && f < 64 && scene.middle(f).x < 6; });
    CHECK(half.size() == 16);
    for (const Label cap : {kZ, kNegZ}) {
        const Proposals found = increase_chart_valence(scene.mesh, scene.state, scene.chart_labeled(cap));
        REQUIRE(found.size() == 1);
        CHECK(is_patch(found[0], half, kY));
        const State after = scene.after(found[0]);
        CHECK(solved(after));
        CHECK(after.graph.charts.size() == 6);
    }
}

TEST_CASE("validity operators: a wedge is a prism on another side") {
    const Shape prism = triangular_prism();
    const Scene upright(prism);
    const Patch expected = increase_chart_valence(upright.mesh, upright.state, upright.chart_labeled(kZ)).at(0);
    for (int i = 0; i < 24; i++) {
        const shapes::Mapped m = shapes::rotated_axes(prism.data, i);
        const Scene scene(m.data, m.labels(prism.labels));
        const Proposals found = increase_chart_valence(scene.mesh, scene.state, scene.chart_labeled(m.image[kZ]));
        REQUIRE(found.size() == 1);
        CHECK(is_patch(found[0], facets_of(expected), m.image[kY]));
        CHECK(solved(scene.after(found[0])));
    }
}

TEST_CASE("validity operators: a turning-point where a ramp meets its plate becomes a corner") {
    // The slope makes 45 degrees with X and Z: of its four edges two go over. The plate's edges follow X exactly.
    const Scene scene(ramp_on_plate());
    CHECK(scene.state.graph.invalid() == 2);   // the ramp's two sides
    CHECK(scene.state.turning.points.size() == 2);
    const Facets lower_half = scene.where([&](Index f) {
        const Vec3 p = scene.middle(f);
        return scene.mesh.normal[f].x < -0.5 && p.x > 2 && p.x < 4 && p.z > 1;
    });
    REQUIRE(lower_half.size() == 8);
    for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
        if (scene.state.graph.charts[c].valid) continue;
        const Proposals found = increase_chart_valence(scene.mesh, scene.state, c);
        REQUIRE(found.size() == 1);
        CHECK(is_patch(found[0], lower_half, kNegX));
        const State after = scene.after(found[0]);
        CHECK(solved(after));                                                      // one new chart for both sides
        CHECK(after.graph.charts.size() == scene.state.graph.charts.size() + 2);   // and the upper half of the slope
    }
    CHECK(solved(run_routines(scene.mesh, scene.state.labels)));
    CHECK(solved(run_routines(scene.mesh, graphcut_labeling(scene.mesh))));
}

TEST_CASE("validity operators: an edge that may follow either axis goes over to the new one") {
    // At 45 degrees, of three edges: with one, 1 against 3 that stay; with two, 2 against 2, which is not more; with three, 3
    // against 1. So two go over.
    const Scene scene(ramp_on_plate(3));
    for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
        if (scene.state.graph.charts[c].valid) continue;
        const Proposals found = increase_chart_valence(scene.mesh, scene.state, c);
        REQUIRE(found.size() == 1);
        CHECK(found[0].size() == 8);
        CHECK(solved(scene.after(found[0])));
    }
}

TEST_CASE("validity operators: a side of a pyramid gets a fourth boundary at the apex") {
    // Both ridges follow Z and meet at the apex. A ridge (1,1,2) makes 35 degrees with Z and 66 with X or Y: one of its four
    // edges goes over, 66 against 3 x 35; two would be 2 x 66 against 2 x 35. So the tip of one or other side becomes +Z.
    const Scene scene(steep_pyramid());
    const Facets tip = scene.where([&](Index f) { return scene.middle(f).z > 12; });
    REQUIRE(tip.size() == 4);
    const Index side = scene.chart_labeled(kX);
    const Proposals found = increase_chart_valence(scene.mesh, scene.state, side);
    REQUIRE(found.size() == 2);
    std::set<Label> given_way;
    for (const Patch& patch : found) {
        REQUIRE(patch.size() == 1);
        CHECK(patch[0].label == kZ);
        CHECK(tip.count(patch[0].facet) == 1);
        given_way.insert(scene.state.labels[patch[0].facet]);
        const State after = scene.after(patch);
        CHECK(after.graph.charts[after.graph.chart[*scene.of_chart(side).begin()]].boundaries.size() == 4);
    }
    CHECK(given_way == std::set<Label>{kY, kNegY});
}

TEST_CASE("validity operators: short segments are proposed too on fine meshes") {
    // 16 edges: 53 (i + 1) > 37 (16 - i) from i = 6 on, so six of them go over; half of that is still three.
    const Scene scene(refined(refined(triangular_prism())));
    const Proposals found = increase_chart_valence(scene.mesh, scene.state, scene.chart_labeled(kZ));
    REQUIRE(found.size() == 2);
    CHECK(found[0].size() == 6 * 16 * 2);
    CHECK(found[1].size() == 3 * 16 * 2);
    for (const Patch& patch : found) CHECK(solved(scene.after(patch)));
}

TEST_CASE("validity operators: no valence to increase where neighbouring boundaries differ in axis") {
    // Around a face of a cube axes alternate and nothing turns back. A closed boundary has no spot; nor has no boundary.
    const Scene plain(by_normals(cube(2)));
    for (Index c = 0; c < 6; c++) CHECK(increase_chart_valence(plain.mesh, plain.state, c).empty());
    const Scene patch(cube_with(3, {{1, 1}}, kX));
    for (Index c = 0; c < 7; c++) CHECK(increase_chart_valence(patch.mesh, patch.state, c).empty());
    const Scene single(cube(1), Labeling(12, kZ));
    CHECK(increase_chart_valence(single.mesh, single.state, 0).empty());
}

TEST_CASE("validity operators: proposals do not depend on the scale") {
    for (const Shape& shape : {triangular_prism(), steep_pyramid(), gable(), ramp_on_plate(), eight_sided_pyramid(true)}) {
        const Scene scene(shape);
        for (const double by : {1024.0, 1.0 / 1024}) {
            const Scene other(shapes::scaled(shape.data, by), shape.labels);
            CHECK(scene.state.score == other.state.score);
            for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
                CHECK(
                    same(increase_chart_valence(scene.mesh, scene.state, c), increase_chart_valence(other.mesh, other.state, c)));
                CHECK(same(remove_chart(scene.mesh, scene.state, c), remove_chart(other.mesh, other.state, c)));
                CHECK(same(grow_chart(scene.mesh, scene.state, c), grow_chart(other.mesh, other.state, c)));
            }
            for (Index b = 0; b < static_cast<Index>(scene.state.graph.boundaries.size()); b++)
                CHECK(same(opposite_boundary(scene.mesh, scene.state, b), opposite_boundary(other.mesh, other.state, b)));
            for (Index c = 0; c < static_cast<Index>(scene.state.graph.corners.size()); c++)
                CHECK(same(high_valence_corner(scene.mesh, scene.state, c), high_valence_corner(other.mesh, other.state, c)));
        }
    }
}

// ---- boundaries between opposite labels

TEST_CASE("validity operators: a ridge between opposite labels gets a chart along it") {
    const Scene scene(gable());
    CHECK(scene.state.graph.invalid() == 3);   // the ridge, and the two caps with three neighbours
    const Index ridge = scene.boundary_between(kX, kNegX);
    const Boundary& b = scene.state.graph.boundaries[ridge];
    CHECK_FALSE(b.valid);
    const Proposals found = opposite_boundary(scene.mesh, scene.state, ridge);
    REQUIRE(found.size() >= 12);   // four labels, three choices of sides

    // Best is +Y: beside the ridge at the left, at the right, on both sides.
    const auto beside = [&](Index chart, double columns) {   // a column is 1 wide in x: the ridge is at x = 4
        return scene.where(
            [&](Index f) { return scene.state.graph.chart[f] == chart && std::abs(scene.middle(f).x - 4) < columns; });
    };
    Facets last;
    for (std::size_t i = 0; i < 3; i++) {
        CHECK(labels_of(found[i]) == std::set<Label>{kY});
        CHECK(solved(scene.after(found[i])));   // the caps have their fourth neighbour
    }
    CHECK(subset(facets_of(found[0]), scene.of_chart(b.left)));
    CHECK(subset(facets_of(found[1]), scene.of_chart(b.right)));
    last = facets_of(found[0]);
    for (const Index f : facets_of(found[1])) last.insert(f);
    CHECK(facets_of(found[2]) == last);

    // Whole columns along the ridge, two of them among others, and all four.
    std::set<std::size_t> columns;
    for (const Patch& patch : found) {
        const Facets facets = facets_of(patch);
        bool whole = false;
        for (const double k : {1, 2, 3, 4}) {
            const Facets left = beside(b.left, k), right = beside(b.right, k);
            Facets both = left;
            both.insert(right.begin(), right.end());
            if (facets != left && facets != right && facets != both) continue;
            whole = true;
            columns.insert(static_cast<std::size_t>(k));
        }
        CHECK(whole);
    }
    CHECK(columns.count(2) == 1);
    CHECK(columns.count(4) == 1);   // five rings are more than there are
}

TEST_CASE("validity operators: labels along a boundary come best first, orthogonal to both sides") {
    // Normals beside the ridge add up to +Y, so that +Z and -Z fit equally.
    const Scene scene(gable());
    const Proposals found = opposite_boundary(scene.mesh, scene.state, scene.boundary_between(kX, kNegX));
    std::vector<Label> order;
    std::map<Label, int> times;
    for (const Patch& patch : found) {
        REQUIRE(labels_of(patch).size() == 1);
        const Label l = patch[0].label;
        if (times[l]++ == 0) order.push_back(l);
    }
    CHECK(order == std::vector<Label>{kY, kZ, kNegZ, kNegY});
    for (const auto& [label, n] : times) CHECK(n == times[kY]);

    // Around the lens they cancel: from the smallest label on.
    const Scene both(lens());
    CHECK(labels_of(opposite_boundary(both.mesh, both.state, 0).at(0)) == std::set<Label>{kX});
}

TEST_CASE("validity operators: a rim that turns gets charts around it") {
    // A cube whose upper half is one chart, and its lower half another: a rim runs round, at z = 2.
    Shape shape = by_normals(cube(4));
    const Labeling sides = shape.labels;
    const Scene upright(shape);
    for (std::size_t f = 0; f < shape.labels.size(); f++)
        shape.labels[f] = upright.middle(static_cast<Index>(f)).z > 2 ? kZ : kNegZ;
    const Scene scene(shape);
    const Index rim = scene.boundary_between(kZ, kNegZ);
    int whole = 0;
    for (const Patch& patch : opposite_boundary(scene.mesh, scene.state, rim)) {
        if (labels_of(patch).size() == 1) continue;
        CHECK(labels_of(patch) == std::set<Label>{kX, kNegX, kY, kNegY});
        const Facets facets = facets_of(patch);
        if (facets != scene.where([&](Index f) { return std::abs(scene.middle(f).z - 2) < 1; })) continue;
        whole++;   // one row of squares on both sides
        for (const Relabel& r : patch) CHECK(r.label == sides[r.facet]);
        CHECK(solved(scene.after(patch)));
    }
    CHECK(whole == 1);
}

// ---- corners

TEST_CASE("validity operators: a chart around the apex of a pyramid") {
    // Four boundaries along Z meet there. The four facets around the apex become +Z, with one side of the pyramid at each.
    const Scene scene(steep_pyramid());
    CHECK(scene.state.graph.invalid() == 5);   // the apex, and the sides with three neighbours
    const Index apex = scene.corner_at({0, 0, 16});
    REQUIRE(apex != kNone);
    CHECK(scene.state.graph.corners[apex].valence == 4);
    const Proposals found = high_valence_corner(scene.mesh, scene.state, apex);
    REQUIRE_FALSE(found.empty());
    const Facets tip = scene.where([&](Index f) { return scene.middle(f).z > 12; });
    CHECK(is_patch(found[0], tip, kZ));
    const State after = scene.after(found[0]);
    CHECK(solved(after));
    CHECK(after.graph.charts.size() == 6);

    // Wider ones follow, all around the apex.
    const Facets two_rows = scene.where([&](Index f) { return scene.middle(f).z > 8; });
    REQUIRE(two_rows.size() == 16);
    CHECK(std::any_of(found.begin(), found.end(), [&](const Patch& patch) { return is_patch(patch, two_rows, kZ); }));
}

TEST_CASE("validity operators: around a corner labels come best first") {
    const Scene scene(steep_pyramid());
    const Proposals found = high_valence_corner(scene.mesh, scene.state, scene.corner_at({0, 0, 16}));
    REQUIRE(found.size() > 6);
    std::vector<Label> order;
    for (std::size_t i = 0; i < 6; i++) order.push_back(found[i].at(0).label);
    CHECK(order == std::vector<Label>{kZ, kX, kNegX, kY, kNegY, kNegZ});   // the mean is +Z: four labels at 90 degrees
}

TEST_CASE("validity operators: a chart along each lost feature edge that leaves a corner") {
    // What the ridges that are lost add to the proposals: charts within one side of the pyramid, along its ridge, with a
    // label orthogonal to the side's. Four ridges, two sides of each, four labels.
    const Scene creased(eight_sided_pyramid(true)), plain(eight_sided_pyramid(false));
    const Vec3 top = {0, 0, 2000};
    const auto all = [&](const Scene& scene) { return high_valence_corner(scene.mesh, scene.state, scene.corner_at(top)); };
    const auto key = [](const Patch& patch) { return std::pair(facets_of(patch), labels_of(patch)); };
    std::set<std::pair<Facets, std::set<Label>>> known;
    for (const Patch& patch : all(plain)) known.insert(key(patch));
    std::set<Index> sides;
    std::size_t added = 0, connected = 0, at_one_side = 0;
    for (const Patch& patch : all(creased)) {
        if (known.count(key(patch)) > 0) continue;
        added++;
        const Facets facets = facets_of(patch);
        const Index old_chart = creased.state.graph.chart[patch[0].facet];
        CHECK(orthogonal(patch[0].label, creased.state.graph.charts[old_chart].label));
        CHECK(subset(facets, creased.of_chart(old_chart)));
        connected += edge_connected(creased.mesh, facets);
        at_one_side += *facets.rbegin() / 4 == *facets.begin() / 4;   // facets that were one before refinement
        sides.insert(*facets.begin() / 4);
    }
    CHECK(added == 4 * 2 * 4);
    CHECK(connected == added);
    CHECK(at_one_side == added);
    CHECK(sides.size() == 8);
}

TEST_CASE("validity operators: at a corner a chart may give way along its boundary") {
    // Along the ridge between +X and +Y the side +Y can become +X, and the other way round.
    const Scene scene(steep_pyramid());
    const Proposals found = high_valence_corner(scene.mesh, scene.state, scene.corner_at({0, 0, 16}));
    for (const auto& [from, to] : {std::pair{kX, kY}, std::pair{kY, kX}, std::pair{kNegX, kNegY}}) {
        const Facets all_of_it = scene.of_chart(scene.chart_labeled(from));
        CHECK(std::any_of(found.begin(), found.end(), [&, label = to](const Patch& patch) {
            return labels_of(patch) == std::set<Label>{label} && subset(facets_of(patch), all_of_it);
        }));
    }
}

// ---- removal

TEST_CASE("validity operators: a stray chart is removed and nothing else changes") {
    const Scene scene(cube_with(4, {{1, 1}, {1, 2}, {2, 1}, {2, 2}}, kX));
    const Index stray = scene.state.graph.chart[8 * 16 + 2 * 5];
    const Proposals found = remove_chart(scene.mesh, scene.state, stray);
    REQUIRE(found.size() == 1);   // +Z whatever the compactness
    CHECK(is_patch(found[0], scene.of_chart(stray), kZ));
    CHECK(solved(scene.after(found[0])));
}

TEST_CASE("validity operators: a removed chart goes to the neighbours that fit") {
    // Two squares that meet at the edge between +Z and +Y: each takes the label of its side.
    Shape shape = by_normals(cube(4));
    const Facets beside = {2 * 32 + 14, 2 * 32 + 15}, above = {4 * 32 + 26, 4 * 32 + 27};   // at x = 1, z = 3 and y = 3
    for (const Index f : {78, 79, 154, 155}) shape.labels[f] = kNegX;
    const Scene scene(shape);
    const Index stray = scene.state.graph.chart[78];
    REQUIRE(scene.of_chart(stray).size() == 4);
    const Proposals found = remove_chart(scene.mesh, scene.state, stray);
    REQUIRE(found.size() == 1);
    for (const Relabel& r : found[0]) CHECK(r.label == (beside.count(r.facet) > 0 ? kY : kZ));
    for (const Index f : above) CHECK(facets_of(found[0]).count(f) == 1);
    CHECK(solved(scene.after(found[0])));
}

TEST_CASE("validity operators: a removed chart takes labels of its neighbours only, however badly they fit") {
    const Scene scene(button(kX));   // its sides face four directions, around it there is +Z alone
    const Index cell = scene.state.graph.chart[0];
    const Proposals found = remove_chart(scene.mesh, scene.state, cell);
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], scene.of_chart(cell), kZ));
}

TEST_CASE("validity operators: a removed chart follows its surroundings where that costs less than fidelity") {
    // The upper face of cube(6) is +X from x = 3 on, and the stray square (3,2) has +X at three sides, +Z at one. As +Z it fits,
    // but for three borders of 100; as +X it costs 99 per facet and one border; as one facet of each 99 and two borders.
    std::vector<std::array<Index, 2>> squares;
    for (Index x = 3; x < 6; x++)
        for (Index y = 0; y < 6; y++) squares.push_back({x, y});
    Shape shape = cube_with(6, squares, kX);
    const Index stray = 8 * 36 + 2 * 15;
    shape.labels[stray] = shape.labels[stray + 1] = kNegY;
    const Scene scene(shape);
    const Proposals found = remove_chart(scene.mesh, scene.state, scene.state.graph.chart[stray]);
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], {stray, stray + 1}, kX));
}

TEST_CASE("validity operators: charts removed together do not lend each other their labels") {
    Shape shape = cube_with(4, {{1, 1}}, kX);
    for (const Relabel& r : relabel({140, 141}, kY)) shape.labels[r.facet] = r.label;   // the square (2,1) beside it
    const Scene scene(shape);
    const Index one = scene.state.graph.chart[138], other = scene.state.graph.chart[140];
    REQUIRE(one != other);
    const Proposals both = remove_charts(scene.mesh, scene.state, {one, other});
    REQUIRE(both.size() == 1);
    CHECK(is_patch(both[0], {138, 139, 140, 141}, kZ));
}

TEST_CASE("validity operators: without neighbours there is nothing to remove") {
    const Scene single(cube(1), Labeling(12, kZ));
    CHECK(remove_chart(single.mesh, single.state, 0).empty());
    const Scene both(lens());
    CHECK(remove_charts(both.mesh, both.state, {0, 1}).empty());
    CHECK(remove_charts(both.mesh, both.state, {}).empty());
}

TEST_CASE("validity operators: removal relabels the chart alone, with labels of its neighbours, each variant once") {
    for (const Scene& scene : patchy_scenes(3)) {
        for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
            const Facets chart = scene.of_chart(c);
            const std::set<Label> allowed = scene.neighbour_labels(c);
            const Proposals found = remove_chart(scene.mesh, scene.state, c);
            CHECK(found.size() >= 1);
            CHECK(found.size() <= 3);
            const Judge judge(scene.mesh);
            for (const Patch& patch : found) {
                CHECK(scene.after(patch).score.loss - scene.state.score.loss >=
                      least_loss_of_removing_chart(judge, scene.state, c));
                CHECK(facets_of(patch) == chart);
                for (const Label l : labels_of(patch)) CHECK(allowed.count(l) == 1);
                CHECK_FALSE(scene.after(patch).labels == scene.state.labels);
            }
            for (std::size_t i = 1; i < found.size(); i++) CHECK_FALSE(same({found[i]}, {found[i - 1]}));
        }
    }
}

TEST_CASE("validity operators: no removal costs less than it is said to cost at least") {
    for (const Scene& scene : patchy_scenes(3)) {
        const Judge judge(scene.mesh);
        for (Index b = 0; b < static_cast<Index>(scene.state.graph.boundaries.size()); b++) {
            const std::int64_t least = least_loss_of_removing_around(judge, scene.state, b);
            for (const Patch& patch : remove_charts_around_boundary(scene.mesh, scene.state, b))
                CHECK(scene.after(patch).score.loss - scene.state.score.loss >= least);
        }
        // Locked facets stay, and cost nothing.
        Labeling locks = scene.state.labels;
        for (std::size_t f = 0; f < locks.size(); f++)
            if (f % 3 != 0) locks[f] = kNoLabel;
        Judge locking(scene.mesh, true, locks);
        for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++)
            for (const Patch& patch : remove_chart(scene.mesh, scene.state, c))
                CHECK(locking.score(scene.state, patch).loss - scene.state.score.loss >=
                      least_loss_of_removing_chart(locking, scene.state, c));
    }
    // By hand: a facet of a cube with the opposite label, fidelity 0 and pointing away, may take its own again, fidelity 1.
    const TriMesh mesh = build_mesh(cube(1));
    Labeling labels = naive_labeling(mesh);
    labels[0] ^= 1;
    const State state = Judge(mesh).state(labels);
    CHECK(least_loss_of_removing_chart(Judge(mesh), state, state.graph.chart[0]) == -11000000);
}

TEST_CASE("validity operators: charts at an invalid boundary are removed left, right and both") {
    const Scene scene(gable());
    const Boundary& ridge = scene.state.graph.boundaries[scene.boundary_between(kX, kNegX)];
    const Facets left = scene.of_chart(ridge.left), right = scene.of_chart(ridge.right);
    Facets both = left;
    both.insert(right.begin(), right.end());
    std::vector<Facets> order;
    for (const Patch& patch : remove_charts_around_boundary(scene.mesh, scene.state, scene.boundary_between(kX, kNegX))) {
        const Facets facets = facets_of(patch);
        if (order.empty() || order.back() != facets) order.push_back(facets);
        for (const Relabel& r : patch) {
            CHECK(r.label != scene.state.labels[r.facet]);
            if (facets == both) CHECK((axis(r.label) == 2 || r.label == kNegY));   // no longer +X or -X
        }
    }
    CHECK(order == std::vector<Facets>{left, right, both});
}

TEST_CASE("validity operators: charts whose boundaries all lie on feature edges are the part's own") {
    const Scene creased(shapes::creased(cube(2)), naive_labeling(build_mesh(cube(2)))), plain(by_normals(cube(2)));
    for (Index c = 0; c < 6; c++) {
        CHECK(surrounded_by_features(creased.state, c));
        CHECK_FALSE(surrounded_by_features(plain.state, c));
    }
    // A patch in a face is not, and the face has a second boundary that is not.
    const Scene patch(shapes::creased(cube(3)), cube_with(3, {{1, 1}}, kX).labels);
    CHECK_FALSE(surrounded_by_features(patch.state, patch.state.graph.chart[80]));
    CHECK_FALSE(surrounded_by_features(patch.state, patch.state.graph.chart[72]));
    CHECK(surrounded_by_features(patch.state, patch.state.graph.chart[0]));
    const Scene single(shapes::creased(cube(1)), Labeling(12, kZ));
    CHECK_FALSE(surrounded_by_features(single.state, 0));   // no boundary at all
}

// ---- growth

TEST_CASE("validity operators: a chart grows by rings of facets") {
    // The eight squares around a square: those across its edges whole (8 facets), two across its corners whole (4), where a
    // diagonal ends, and one facet of each of the other two.
    const Scene scene(cube_with(6, {{2, 2}}, kX));
    const Index chart = scene.state.graph.chart[8 * 36 + 2 * 14];
    const Facets square = scene.of_chart(chart);
    REQUIRE(square.size() == 2);
    std::set<std::size_t> gains;
    for (const Patch& patch : grow_chart(scene.mesh, scene.state, chart)) {
        CHECK(labels_of(patch) == std::set<Label>{kX});
        const State after = scene.after(patch);
        Facets grown;
        for (Index f = 0; f < scene.mesh.facets(); f++)
            if (after.graph.chart[f] == after.graph.chart[*square.begin()]) grown.insert(f);
        CHECK(subset(square, grown));
        gains.insert(grown.size() - square.size());
    }
    REQUIRE_FALSE(gains.empty());
    CHECK(*gains.begin() == 14);
}

TEST_CASE("validity operators: a chart grows all around or into one neighbour") {
    // A square at the edge between +Z and +Y: upward only, sideward only, or both.
    const Scene scene(cube_with(6, {{2, 5}}, kX));
    const Index chart = scene.state.graph.chart[8 * 36 + 2 * 32];
    std::set<std::set<Label>> into;
    for (const Patch& patch : grow_chart(scene.mesh, scene.state, chart)) {
        std::set<Label> old;
        for (const Relabel& r : patch)
            if (scene.state.labels[r.facet] != kX) old.insert(scene.state.labels[r.facet]);
        if (patch.size() < 40) into.insert(old);   // wider ones reach the other sides of the cube
    }
    CHECK(into == std::set<std::set<Label>>{{kY}, {kZ}, {kY, kZ}});
    const Scene single(cube(1), Labeling(12, kZ));
    CHECK(grow_chart(single.mesh, single.state, 0).empty());
}

// ---- all of them

TEST_CASE("validity operators: on random labelings all proposals can be applied") {
    const auto check = [](const Scene& scene, const Proposals& proposals) {
        for (const Patch& patch : proposals) {
            CHECK_FALSE(patch.empty());
            for (const Relabel& r : patch)
                CHECK((r.facet >= 0 && r.facet < scene.mesh.facets() && r.label >= 0 && r.label < kLabels));
            facets_of(patch);     // none twice
            scene.after(patch);   // gives a graph that is right
        }
    };
    for (const Scene& scene : patchy_scenes(2)) {
        const LabelingGraph& graph = scene.state.graph;
        for (Index c = 0; c < static_cast<Index>(graph.charts.size()); c++)
            for (const auto& propose : {remove_surrounded_chart, increase_chart_valence, remove_chart, grow_chart})
                check(scene, propose(scene.mesh, scene.state, c));
        for (Index b = 0; b < static_cast<Index>(graph.boundaries.size()); b++)
            for (const auto& propose : {opposite_boundary, remove_charts_around_boundary})
                check(scene, propose(scene.mesh, scene.state, b));
        for (Index c = 0; c < static_cast<Index>(graph.corners.size()); c++)
            check(scene, high_valence_corner(scene.mesh, scene.state, c));
    }
}

// Quality operators: each removes its turning-points on a shape made for it, and refuses where it has no say.
#include "polylab/quality_operators.h"

#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

using Facets = std::set<Index>;
using Square = std::array<Index, 2>;

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
    Facets of_chart(Index chart) const {
        Facets facets;
        for (Index f = 0; f < mesh.facets(); f++)
            if (state.graph.chart[f] == chart) facets.insert(f);
        return facets;
    }
    Index boundary_between(Label a, Label b) const {   // the first
        for (Index h = 0; h < mesh.halfedges(); h++)
            if (state.labels[mesh.left(h)] == a && state.labels[mesh.right(h)] == b) return state.graph.boundary[h];
        return kNone;
    }
    TurningPoint turning_point_at(const Vec3& p) const {
        for (const TurningPoint& t : state.turning.points)
            if (mesh.points[t.vertex] == p) return t;
        REQUIRE_MESSAGE(false, "no turning-point there");
        return {};
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

bool has_patch(const Proposals& proposals, const Facets& facets, Label label) {
    return std::any_of(proposals.begin(), proposals.end(), [&](const Patch& patch) { return is_patch(patch, facets, label); });
}

bool solved(const State& state) { return state.graph.valid() && state.turning.points.empty(); }

bool same(const Proposals& a, const Proposals& b) {
    const auto equal = [](const Relabel& r, const Relabel& s) { return r.facet == s.facet && r.label == s.label; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Patch& p, const Patch& q) { return std::equal(p.begin(), p.end(), q.begin(), q.end(), equal); });
}

// ---- shapes

Shape refined(const Shape& shape) {
    Shape fine{shapes::refined(shape.data), {}};
    for (const Label l : shape.labels) fine.labels.insert(fine.labels.end(), 4, l);
    return fine;
}

Shape creased(Shape shape) {
    shape.data = shapes::creased(shape.data);
    return shape;
}

Shape with_features(Shape shape, const std::function<bool(const Vec3& middle)>& keep) {
    std::vector<Index> kept;
    const std::vector<Index>& edges = shape.data.edges;
    for (std::size_t e = 0; e < edges.size(); e += 2)
        if (keep((shape.data.points[edges[e]] + shape.data.points[edges[e + 1]]) * 0.5))
            kept.insert(kept.end(), {edges[e], edges[e + 1]});
    shape.data.edges = kept;
    return shape;
}

Labeling prism_labels(const Labeling& sides) {
    Labeling labels;
    for (const Label l : sides) labels.insert(labels.end(), 2, l);
    labels.insert(labels.end(), sides.size() - 2, kNegZ);
    labels.insert(labels.end(), sides.size() - 2, kZ);
    return labels;
}

//   12 +------+        Its right side is +X from below to above: around the caps it goes up to (8,8), back to (7,6),
//      |      |        and up again, with 0.89 against the axis on the way back: 38, where two turns cost 16 each.
//    8 |      | +      Facets 4 and 5 are the part in between. As +Y it would be a shelf between two walls.
//    6 |      +'|
//    0 +--------+
//      0      7 8
const Facets kUndercut = {4, 5};
Shape undercut() {
    return {shapes::prism({{5, 0, 0}, {8, 0, 0}, {8, 8, 0}, {7, 6, 0}, {7, 12, 0}, {0, 12, 0}, {0, 0, 0}}, 4),
            prism_labels({kNegY, kX, kX, kX, kY, kNegX, kNegY})};
}

//    8          +      The horn's inner side, facets 4 and 5, is +X: the corner between +X, +Y and a cap sits at its
//              /|      foot (6,4), the turning-point at its tip (8,8), where the corner belongs.
//    4 +------+ |
//    0 +--------+
//      0      6 8
const Facets kInnerSide = {4, 5};
Shape horn() {
    return {shapes::prism({{5, 0, 0}, {8, 0, 0}, {8, 8, 0}, {6, 4, 0}, {0, 4, 0}, {0, 0, 0}}, 4),
            prism_labels({kNegY, kX, kX, kY, kNegX, kNegY})};
}

// cube(n) by its normals, but squares [x,x+1] x [y,y+1] of its upper face.
Shape cube_with(Index n, const std::vector<Square>& squares, Label label) {
    Shape shape{cube(n), naive_labeling(build_mesh(cube(n)))};
    for (const auto& [x, y] : squares)
        for (const Index f : {8 * n * n + 2 * (n * y + x), 8 * n * n + 2 * (n * y + x) + 1}) shape.labels[f] = label;
    return shape;
}

// The boundary between +X and +Z of cube(6) leaves its edge at y = 4, goes back to y = 1, and on from there: three edges back
// cost 138, two turns 120.
//
//    y  5 +---+---+  +X
//       4 +   +---+
//         +   |   :  +Z
//       1 +---+   :
//         4   5   6 x
Shape hook() { return cube_with(6, {{5, 4}, {4, 4}, {4, 3}, {4, 2}, {4, 1}}, kX); }

// +X inside +Z, closed: two arms of five squares and what joins them. Down and up between the arms: four turning-points.
Shape horseshoe() {
    return cube_with(7, {{2, 1}, {2, 2}, {2, 3}, {2, 4}, {2, 5}, {3, 1}, {4, 1}, {4, 2}, {4, 3}, {4, 4}, {4, 5}}, kX);
}

// The upper face of cube(6) is +X from x = 3 on, with teeth and a dent.
Shape ragged() {
    std::vector<Square> squares = {{2, 1}, {2, 3}, {2, 4}};
    for (Index x = 3; x < 6; x++)
        for (Index y = 0; y < 6; y++)
            if (x > 3 || y != 2) squares.push_back({x, y});
    return cube_with(6, squares, kX);
}

Labeling straight_labels() {
    std::vector<Square> squares;
    for (Index x = 3; x < 6; x++)
        for (Index y = 0; y < 6; y++) squares.push_back({x, y});
    return cube_with(6, squares, kX).labels;
}

Labeling patchy(const TriMesh& mesh, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    for (Index i = 0; i < 6 * mesh.facets(); i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

std::vector<Scene> patchy_scenes(Index each) {
    Lcg random(31);
    std::vector<Scene> scenes;
    for (const MeshData& data :
         {cube(4), shapes::refined(shapes::creased(shapes::frame())),
          shapes::refined(shapes::creased(shapes::triangular_prism(3, 4, 5))), shapes::refined(shapes::two_cubes_at_a_vertex()),
          shapes::refined(shapes::pinched_ring()), shapes::refined(shapes::creased(shapes::pyramid(8)))})
        for (Index i = 0; i < each; i++) scenes.emplace_back(data, patchy(build_mesh(data), random));
    return scenes;
}

// Sum of the angles that the facets of a chart have at a vertex.
double angle_at(const Scene& scene, Index vertex, Index chart) {
    double sum = 0;
    for (Index h = 0; h < scene.mesh.halfedges(); h++) {
        if (scene.mesh.from(h) != vertex || scene.state.graph.chart[facet(h)] != chart) continue;
        const Vec3 a = scene.mesh.vector(h), b = -scene.mesh.vector(prev(h));
        sum += std::acos(dot(a, b) / (norm(a) * norm(b)));
    }
    return sum;
}

Facets touching(const Scene& scene, Index vertex, Index chart) {
    Facets facets;
    for (Index h = 0; h < scene.mesh.halfedges(); h++)
        if (scene.mesh.from(h) == vertex && scene.state.graph.chart[facet(h)] == chart) facets.insert(facet(h));
    return facets;
}

// The facets with two neighbours of one other label that may take it: none of the edges to it is a feature edge.
Facets to_smooth(const TriMesh& mesh, const Labeling& labels) {
    Facets facets;
    for (Index f = 0; f < mesh.facets(); f++) {
        for (Label l = 0; l < kLabels; l++) {
            int beside = 0, features = 0;
            for (Index h = 3 * f; h < 3 * f + 3; h++) {
                if (labels[mesh.right(h)] != l) continue;
                beside++;
                features += mesh.feature[h];
            }
            if (l != labels[f] && beside >= 2 && features == 0) facets.insert(f);
        }
    }
    return facets;
}

}   // namespace

// ---- what is there to repair

TEST_CASE("quality operators: the shapes are valid and have the turning-points that they are made for") {
    const auto check = [](const Shape& shape, Index invalid, std::size_t turning_points) {
        const Scene scene(shape);
        CHECK(scene.state.graph.invalid() == invalid);
        CHECK(scene.state.turning.points.size() == turning_points);
    };
    check(undercut(), 0, 4);   // two at each cap
    check(horn(), 0, 2);
    check(hook(), 0, 2);
    check(horseshoe(), 1, 4);   // the chart has one boundary
    check(ragged(), 0, 0);
}

// ---- join turning-points (Figure 15)

TEST_CASE("quality operators: a chart along lost feature edges joins two turning-points") {
    // The ridges at (8,8) and (7,6) are lost in +X. Beside either of them lies the undercut, which becomes +Y.
    const Scene scene(creased(undercut()));
    for (const TurningPoint& t : scene.state.turning.points) {
        const Proposals found = join_turning_points(scene.mesh, scene.state, t);
        CHECK(has_patch(found, kUndercut, kY));
        for (const Patch& patch : found) {
            const Label l = patch.at(0).label;
            CHECK(labels_of(patch).size() == 1);
            CHECK(l != kX);   // not the labels at the sides of its boundary
            CHECK(l != (scene.mesh.points[t.vertex].z > 0 ? kZ : kNegZ));
            if (is_patch(patch, kUndercut, kY)) CHECK(solved(scene.after(patch)));
        }
    }
}

TEST_CASE("quality operators: the chart that joins turning-points lies at one side of the lost feature edges") {
    // Refined twice: facets 64..95 are the undercut, 32..63 and 96..127 the walls below and above.
    const Scene scene(refined(refined(creased(undercut()))));
    const Proposals found = join_turning_points(scene.mesh, scene.state, scene.turning_point_at({32, 32, 16}));
    REQUIRE_FALSE(found.empty());
    std::set<bool> walls;
    for (const Patch& patch : found) {
        const Facets facets = facets_of(patch);
        const bool below = *facets.rbegin() < 64;
        walls.insert(below);
        if (!below) CHECK(*facets.begin() >= 64);
    }
    CHECK(walls.size() == 2);   // either side is tried
}

TEST_CASE("quality operators: without lost feature edges there are no turning-points to join") {
    const Scene plain(undercut());
    for (const TurningPoint& t : plain.state.turning.points) CHECK(join_turning_points(plain.mesh, plain.state, t).empty());
    const Scene rim(
        with_features(creased(undercut()), [](const Vec3& middle) { return middle.z != 2; }));   // only around the caps
    for (const TurningPoint& t : rim.state.turning.points) CHECK(join_turning_points(rim.mesh, rim.state, t).empty());
}

TEST_CASE("quality operators: lost feature edges that end inside the chart join nothing") {
    // The ridges are feature edges from the upper cap (z = 8) to the middle only.
    const Scene scene(with_features(refined(creased(undercut())), [](const Vec3& middle) { return middle.z == 6; }));
    REQUIRE(scene.mesh.features_kept > 0);
    CHECK(join_turning_points(scene.mesh, scene.state, scene.turning_point_at({16, 16, 8})).empty());
    CHECK(join_turning_points(scene.mesh, scene.state, scene.turning_point_at({16, 16, 0})).empty());
}

// ---- pull the closest corner (Figure 16)

TEST_CASE("quality operators: the closest corner is pulled onto the turning-point") {
    // From the tip the boundary between +X and +Y is traced anew, along the ridge; in between all becomes +Y. Along the lost
    // feature edge or along a greedy path: it is the same edge here.
    for (const Shape& shape : {horn(), creased(horn())}) {
        const Scene scene(shape);
        for (const double z : {0, 4}) {
            const Proposals found = pull_closest_corner(scene.mesh, scene.state, scene.turning_point_at({8, 8, z}));
            REQUIRE_FALSE(found.empty());
            CHECK(is_patch(found[0], kInnerSide, kY));   // of all variants the first
            CHECK(solved(scene.after(found[0])));
        }
    }
}

TEST_CASE("quality operators: a corner may be pulled by a thin chart") {
    // Refined twice: facets 64..95 are the inner side. The strip beside the ridge is part of it.
    for (const Shape& shape : {refined(refined(horn())), refined(refined(creased(horn())))}) {
        const Scene scene(shape);
        Facets side;
        for (Index f = 64; f < 96; f++) side.insert(f);
        const TurningPoint tip = scene.turning_point_at({32, 32, 16});
        const Proposals found = pull_closest_corner(scene.mesh, scene.state, tip);
        REQUIRE(found.size() >= 2);
        CHECK(is_patch(found[0], side, kY));
        CHECK(solved(scene.after(found[0])));
        const Facets strip = facets_of(found[1]);
        CHECK(labels_of(found[1]) == std::set<Label>{kY});
        CHECK(strip.size() < side.size());
        CHECK(std::includes(side.begin(), side.end(), strip.begin(), strip.end()));
        for (const Index f : side)
            for (Index h = 3 * f; h < 3 * f + 3; h++)
                if (scene.mesh.points[scene.mesh.from(h)].y == 32) CHECK(strip.count(f) == 1);
    }
}

TEST_CASE("quality operators: a boundary without corner has none to pull") {
    const Scene scene(horseshoe());
    REQUIRE(scene.state.turning.points.size() == 4);
    for (const TurningPoint& t : scene.state.turning.points) CHECK(pull_closest_corner(scene.mesh, scene.state, t).empty());
}

// ---- move the boundary (Figure 17)

TEST_CASE("quality operators: facets around a turning-point take the label with the larger angle") {
    for (const Shape& shape : {hook(), undercut(), horseshoe()}) {
        const Scene scene(shape);
        for (const TurningPoint& t : scene.state.turning.points) {
            const Boundary& b = scene.state.graph.boundaries[t.boundary];
            const bool left = angle_at(scene, t.vertex, b.left) > angle_at(scene, t.vertex, b.right);
            const Index wide = left ? b.left : b.right, narrow = left ? b.right : b.left;
            const Proposals found = move_boundary_near(scene.mesh, scene.state, t);
            REQUIRE(found.size() >= 2);
            CHECK(is_patch(found[0], touching(scene, t.vertex, narrow), scene.state.graph.charts[wide].label));
            CHECK(has_patch(found, touching(scene, t.vertex, wide),
                            scene.state.graph.charts[narrow].label));   // the other way comes later
        }
    }
}

TEST_CASE("quality operators: a hook is shortened until going back costs less than turning") {
    const Scene scene(hook());
    for (const TurningPoint& t : scene.state.turning.points) {
        const Proposals found = move_boundary_near(scene.mesh, scene.state, t);
        CHECK(std::any_of(found.begin(), found.end(), [&](const Patch& patch) { return solved(scene.after(patch)); }));
        for (const Patch& patch : found) {   // one chart gives way to the other
            const Label l = patch.at(0).label;
            CHECK((l == kX || l == kZ));
            for (const Relabel& r : patch) {
                CHECK(r.label == l);
                CHECK(scene.state.labels[r.facet] == (l == kX ? kZ : kX));
            }
        }
    }
}

// ---- straighten

TEST_CASE("quality operators: a ragged boundary becomes straight between its corners") {
    const Scene scene(ragged());
    const Index b = scene.boundary_between(kZ, kX);
    REQUIRE(scene.state.graph.boundaries[b].halfedges.size() > 6);
    const Proposals found = straighten_boundary(scene.mesh, scene.state, b);
    REQUIRE(found.size() == 1);   // one run
    CHECK(scene.after(found[0]).labels == straight_labels());
    const Scene straight(cube(6), straight_labels());
    CHECK(straighten_boundary(straight.mesh, straight.state, straight.boundary_between(kZ, kX)).empty());
}

TEST_CASE("quality operators: a tooth at an edge of the part goes, unless the edge is kept by features") {
    // Without feature edges the whole boundary is one run of eight edges. With them, two runs on the edge stay, and between
    // them are three edges: out, along and in. Three are too few.
    const Shape tooth = cube_with(6, {{5, 2}}, kX);
    const Scene plain(tooth), kept(shapes::creased(tooth.data), tooth.labels);
    const Proposals found = straighten_boundary(plain.mesh, plain.state, plain.boundary_between(kZ, kX));
    REQUIRE(found.size() == 1);
    CHECK(plain.after(found[0]).labels == naive_labeling(plain.mesh));
    CHECK(straighten_boundary(kept.mesh, kept.state, kept.boundary_between(kZ, kX)).empty());
}

TEST_CASE("quality operators: runs between feature edges are straightened each on its own") {
    // Along the edge between +Z and +X of cube(8) there are feature edges from y = 3 to y = 5, and a tooth at either side.
    Shape shape = with_features(creased(cube_with(8, {{7, 1}, {7, 6}}, kX)), [](const Vec3& middle) {
        return middle.x == 8 && middle.z == 8 && middle.y > 3 && middle.y < 5;
    });
    const Scene scene(shape);
    REQUIRE(scene.mesh.features_kept == 2);
    const Proposals found = straighten_boundary(scene.mesh, scene.state, scene.boundary_between(kZ, kX));
    REQUIRE(found.size() == 3);   // both, one, the other
    CHECK(scene.after(found[0]).labels == naive_labeling(scene.mesh));
    const Index one = 8 * 64 + 2 * 15, other = 8 * 64 + 2 * 55;
    CHECK((is_patch(found[1], {one, one + 1}, kZ) || is_patch(found[2], {one, one + 1}, kZ)));
    CHECK((is_patch(found[1], {other, other + 1}, kZ) || is_patch(found[2], {other, other + 1}, kZ)));
}

TEST_CASE("quality operators: a boundary on feature edges stays, straight or not") {
    // The inner walls of the L are one chart, +X: its boundary with the upper face goes around a right angle.
    Shape shape = refined(Shape{shapes::l_shape(), naive_labeling(build_mesh(shapes::l_shape()))});
    const TriMesh mesh = build_mesh(shape.data);
    for (Index f = 0; f < mesh.facets(); f++)
        if (mesh.normal[f] == Vec3{0, 1, 0} && mesh.points[mesh.origin[3 * f]].y == 2) shape.labels[f] = kX;   // the one at y = 2
    const Scene plain(shape), kept(shapes::creased(shape.data), shape.labels);
    const Index b = plain.boundary_between(kZ, kX);
    CHECK(straighten_boundary(kept.mesh, kept.state, b).empty());
    CHECK_FALSE(straighten_boundary(plain.mesh, plain.state, b).empty());
}

TEST_CASE("quality operators: what has no ends or three edges at most is not straightened") {
    const Scene closed(horseshoe());
    CHECK(straighten_boundary(closed.mesh, closed.state, closed.state.turning.points.at(0).boundary).empty());
    const Scene small(cube(3), naive_labeling(build_mesh(cube(3))));
    for (Index b = 0; b < 12; b++) CHECK(straighten_boundary(small.mesh, small.state, b).empty());
}

TEST_CASE("quality operators: a boundary without corner is not straightened, even if feature edges divide it") {
    // A cube on a plate is +X, and with it three squares of the plate at one side. Around the foot of the cube run three feature
    // edges, and around the squares seven edges that are none.
    std::vector<shapes::Cell> cells = {{2, 2, 1}};
    for (int i = 0; i < 25; i++) cells.push_back({i % 5, i / 5, 0});
    const MeshData data = shapes::creased(shapes::voxels(cells));
    const TriMesh mesh = build_mesh(data);
    Labeling labels = naive_labeling(mesh);
    std::fill(labels.begin(), labels.begin() + 10, kX);   // the cube comes first: five free sides
    for (Index f = 10; f < mesh.facets(); f++) {
        Vec3 middle;
        for (Index h = 3 * f; h < 3 * f + 3; h++) middle += mesh.points[mesh.from(h)] * (1.0 / 3);
        if (middle.z == 1 && middle.x > 3 && middle.x < 4 && middle.y > 1 && middle.y < 4) labels[f] = kX;
    }
    const Scene scene(data, labels);
    const Index chart = scene.state.graph.chart[0];
    REQUIRE(scene.state.graph.charts[chart].boundaries.size() == 1);
    const Index b = scene.state.graph.chart_boundaries[scene.state.graph.charts[chart].boundaries.first];
    REQUIRE(scene.state.graph.boundaries[b].start == kNone);
    REQUIRE(scene.state.graph.boundaries[b].halfedges.size() == 10);
    CHECK(straighten_boundary(scene.mesh, scene.state, b).empty());
}

TEST_CASE("quality operators: straightening moves facets between the boundary's two charts only") {
    Index found = 0;
    for (const Scene& scene : patchy_scenes(4)) {
        for (Index b = 0; b < static_cast<Index>(scene.state.graph.boundaries.size()); b++) {
            const Boundary& boundary = scene.state.graph.boundaries[b];
            const Label left = scene.state.graph.charts[boundary.left].label,
                        right = scene.state.graph.charts[boundary.right].label;
            for (const Patch& patch : straighten_boundary(scene.mesh, scene.state, b)) {
                found++;
                facets_of(patch);
                for (const Relabel& r : patch) {
                    const Index chart = scene.state.graph.chart[r.facet];
                    CHECK((chart == boundary.left || chart == boundary.right));
                    CHECK(r.label == (chart == boundary.left ? right : left));
                }
            }
        }
    }
    CHECK(found > 10);
}

// ---- smooth

TEST_CASE("quality operators: a tooth of one facet disappears") {
    // Beside the straight line x = 3 one facet of the square (2,2) is +X: that at x = 3, between two facets that are +Z.
    Labeling labels = straight_labels();
    const Index tooth = 8 * 36 + 2 * 14;
    labels[tooth] = kX;
    const Scene scene(cube(6), labels);
    const Proposals found = smooth_boundaries(scene.mesh, scene.state);
    REQUIRE(found.size() == 1);
    CHECK(is_patch(found[0], {tooth}, kZ));
    // A row of them goes down together. (At y = 0 the third neighbour is -Y.)
    for (Index y = 1; y < 6; y++) labels[8 * 36 + 2 * (6 * y + 2)] = kX;
    const Scene row(cube(6), labels);
    CHECK(row.after(smooth_boundaries(row.mesh, row.state).at(0)).labels == straight_labels());
}

TEST_CASE("quality operators: where no facet has two neighbours of one other label nothing is smoothed") {
    const Scene straight(cube(6), straight_labels()), plain(cube(2), naive_labeling(build_mesh(cube(2))));
    CHECK(smooth_boundaries(straight.mesh, straight.state).empty());
    CHECK(smooth_boundaries(plain.mesh, plain.state).empty());
    const Scene single(cube(1), Labeling(12, kZ));
    CHECK(smooth_boundaries(single.mesh, single.state).empty());
}

TEST_CASE("quality operators: smoothing keeps the boundaries that lie on feature edges") {
    // A cap is one facet, with two neighbours of its three that are +X.
    const MeshData data = shapes::triangular_prism(1, 1, 1);
    const Labeling labels = {kX, kX, kX, kX, kNegX, kNegX, kNegZ, kZ};
    const Scene plain(data, labels), kept(shapes::creased(data), labels);
    const Facets flipped = facets_of(smooth_boundaries(plain.mesh, plain.state).at(0));
    CHECK(flipped.count(6) == 1);
    CHECK(flipped.count(7) == 1);
    CHECK(smooth_boundaries(kept.mesh, kept.state).empty());
}

TEST_CASE("quality operators: after smoothing there is no tooth left") {
    Index smoothed = 0;
    for (const Scene& scene : patchy_scenes(6)) {
        const Proposals found = smooth_boundaries(scene.mesh, scene.state);
        CHECK(found.empty() == to_smooth(scene.mesh, scene.state.labels).empty());
        if (found.empty()) continue;
        REQUIRE(found.size() == 1);
        const State after = scene.after(found[0]);
        CHECK(to_smooth(scene.mesh, after.labels).empty());
        for (Index h = 0; h < scene.mesh.halfedges(); h++)   // feature edges with different labels at their sides still have
            if (scene.mesh.feature[h] && scene.state.graph.is_border(h)) CHECK(after.graph.is_border(h));
        smoothed++;
    }
    CHECK(smoothed > 10);
}

TEST_CASE("quality operators: a long spike is smoothed away to its foot") {
    // A row of 27 squares of the upper face is +X, up to the side +X: a strip of 54 facets, each with one neighbour outside,
    // the tip with two. It goes from the tip on, whatever the order of the facets; its foot, at the side, may be rounded.
    const TriMesh mesh = build_mesh(shapes::box(28, 3, 1));
    const Labeling plain = naive_labeling(mesh);
    const Index top = static_cast<Index>(std::find(plain.begin(), plain.end(), kZ) - plain.begin());
    const auto square = [&](Index x) { return top + 2 * (28 + x); };   // of the middle row
    Labeling labels = plain;
    for (Index x = 1; x < 28; x++) labels[square(x)] = labels[square(x) + 1] = kX;
    const Scene scene(shapes::box(28, 3, 1), labels);
    const Proposals found = smooth_boundaries(scene.mesh, scene.state);
    REQUIRE(found.size() == 1);
    const State after = scene.after(found[0]);
    CHECK(to_smooth(mesh, after.labels).empty());
    for (Index x = 1; x < 26; x++) {
        CHECK(after.labels[square(x)] == kZ);
        CHECK(after.labels[square(x) + 1] == kZ);
    }
}

// ---- directional path

TEST_CASE("quality operators: a directional path needs no feature edges") {
    // Along Z from cap to cap: the way of the ridges, with the undercut at one side.
    const Scene scene(undercut());
    for (const TurningPoint& t : scene.state.turning.points) {
        const Proposals found = directional_path(scene.mesh, scene.state, t);
        CHECK(has_patch(found, kUndercut, kY));
        for (const Patch& patch : found) {
            CHECK(labels_of(patch).size() == 1);
            CHECK(patch.at(0).label != kX);
            CHECK(patch.at(0).label != (scene.mesh.points[t.vertex].z > 0 ? kZ : kNegZ));
        }
    }
}

TEST_CASE("quality operators: a directional path stays in one of the two charts") {
    for (const Shape& shape : {refined(undercut()), hook(), horseshoe()}) {
        const Scene scene(shape);
        for (const TurningPoint& t : scene.state.turning.points) {
            const Boundary& b = scene.state.graph.boundaries[t.boundary];
            const Facets left = scene.of_chart(b.left), right = scene.of_chart(b.right);
            for (const Patch& patch : directional_path(scene.mesh, scene.state, t)) {
                const Facets facets = facets_of(patch);
                const Facets& chart = left.count(*facets.begin()) > 0 ? left : right;
                CHECK(std::includes(chart.begin(), chart.end(), facets.begin(), facets.end()));
            }
        }
    }
}

// ---- all of them

TEST_CASE("quality operators: proposals do not depend on the scale") {
    for (const Shape& shape :
         {undercut(), refined(creased(undercut())), refined(horn()), creased(horn()), hook(), horseshoe(), ragged()}) {
        const Scene scene(shape);
        for (const double by : {1024.0, 1.0 / 1024}) {
            const Scene other(shapes::scaled(shape.data, by), shape.labels);
            CHECK(scene.state.score == other.state.score);
            REQUIRE(scene.state.turning.points.size() == other.state.turning.points.size());
            for (const TurningPoint& t : scene.state.turning.points)
                for (const auto& propose : {join_turning_points, pull_closest_corner, move_boundary_near, directional_path})
                    CHECK(same(propose(scene.mesh, scene.state, t), propose(other.mesh, other.state, t)));
            for (Index b = 0; b < static_cast<Index>(scene.state.graph.boundaries.size()); b++)
                CHECK(same(straighten_boundary(scene.mesh, scene.state, b), straighten_boundary(other.mesh, other.state, b)));
            CHECK(same(smooth_boundaries(scene.mesh, scene.state), smooth_boundaries(other.mesh, other.state)));
        }
    }
}

TEST_CASE("quality operators: on random labelings all proposals can be applied") {
    const auto check = [](const Scene& scene, const Proposals& proposals) {
        for (const Patch& patch : proposals) {
            CHECK_FALSE(patch.empty());
            for (const Relabel& r : patch)
                CHECK((r.facet >= 0 && r.facet < scene.mesh.facets() && r.label >= 0 && r.label < kLabels));
            facets_of(patch);     // none twice
            scene.after(patch);   // gives a graph that is right
        }
    };
    Index turning_points = 0;
    for (const Scene& scene : patchy_scenes(4)) {
        for (const TurningPoint& t : scene.state.turning.points)
            for (const auto& propose : {join_turning_points, pull_closest_corner, move_boundary_near, directional_path})
                check(scene, propose(scene.mesh, scene.state, t));
        turning_points += static_cast<Index>(scene.state.turning.points.size());
    }
    CHECK(turning_points > 20);
}

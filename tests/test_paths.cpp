// Paths, regions and bands on grids and roofs where they can be drawn by hand; and on random labelings, what must always hold.
#include "polylab/paths.h"

#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kY = 2, kZ = 4, kNegZ = 5;

using Points = std::vector<Vec3>;

struct Scene {
    TriMesh mesh;
    State state;

    Scene(const MeshData& data, const Labeling& labels) : mesh(build_mesh(data)), state(Judge(mesh).state(labels)) {}
    explicit Scene(const MeshData& data) : Scene(data, naive_labeling(build_mesh(data))) {}

    Index vertex(const Vec3& p) const {
        return static_cast<Index>(std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin());
    }
    Index halfedge(const Vec3& p, const Vec3& q) const {
        for (Index h = 0; h < mesh.halfedges(); h++)
            if (mesh.points[mesh.from(h)] == p && mesh.points[mesh.to(h)] == q) return h;
        return kNone;
    }
    Halfedges path(const Points& points) const {
        Halfedges result;
        for (std::size_t i = 1; i < points.size(); i++) result.push_back(halfedge(points[i - 1], points[i]));
        return result;
    }
    Points points(const Halfedges& path) const {
        Points result;
        for (const Index h : path) {
            if (result.empty()) result.push_back(mesh.points[mesh.from(h)]);
            result.push_back(mesh.points[mesh.to(h)]);
        }
        return result;
    }
    Points greedy(const Vec3& from, Index chart, const Vec3& direction) const {
        return points(greedy_path(mesh, state, vertex(from), chart, direction));
    }
};

// Facets of the square [x,x+1] x [y,y+1] of the upper face of cube(n): r = (x+1, y+1) and p = (x, y) are in both.
//
//    s---r      second facet: p r s
//    | / |
//    p---q      first facet: p q r
Index first_facet(Index n, Index x, Index y) { return 8 * n * n + 2 * (n * y + x); }

// The first chart that is +Z.
Index upper_chart(const Scene& scene) {
    return scene.state.graph
        .chart[std::find(scene.state.labels.begin(), scene.state.labels.end(), kZ) - scene.state.labels.begin()];
}

Labeling with_square(Index n, Index x, Index y, Label label) {
    Labeling labels = naive_labeling(build_mesh(cube(n)));
    labels[first_facet(n, x, y)] = labels[first_facet(n, x, y) + 1] = label;
    return labels;
}

// Labels of the facets of refined(data).
Labeling refined_labels(const Labeling& labels) {
    Labeling fine;
    for (const Label l : labels) fine.insert(fine.end(), 4, l);
    return fine;
}

// A house with a flat roof of two slopes, +Y, from z = 0 to z = 40: ridge at (20,28,z), slopes of two columns of cells that
// are 20 long, 10 wide and 4 high, with diagonals from the ridge's upper end down to z = 20.
MeshData roof(bool features) {
    const MeshData data = shapes::prism({{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {10, 14, 0}, {0, 10, 0}}, 20);
    return shapes::refined(features ? shapes::creased(data) : data);
}

Labeling roof_labels() { return refined_labels({3, 3, 0, 0, 2, 2, 2, 2, 1, 1, 5, 5, 5, 4, 4, 4}); }

// Over the square [-2,2] x [-2,2], the sides facing +X, +Y, -X, -Y; edges cut in two.
MeshData square_pyramid(int height) {
    MeshData data;
    data.points = {{2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, -2, 0}, {0, 0, double(height)}};
    data.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
    return data;
}

// The sides are one chart, the base another.
Labeling tent_labels(Label sides) { return refined_labels({sides, sides, sides, sides, kNegZ, kNegZ}); }

// The same shape with only those feature edges for whose middle the condition holds.
MeshData with_features(MeshData data, const std::function<bool(const Vec3&)>& keep) {
    std::vector<Index> kept;
    for (std::size_t e = 0; e < data.edges.size(); e += 2)
        if (keep((data.points[data.edges[e]] + data.points[data.edges[e + 1]]) * 0.5))
            kept.insert(kept.end(), {data.edges[e], data.edges[e + 1]});
    data.edges = kept;
    return data;
}

Vec3 in_xz(double degrees) {   // from -Z toward +X
    const double angle = degrees * std::acos(-1.0) / 180;
    return {std::sin(angle), 0, -std::cos(angle)};
}

// Random labels, then facets that take over a neighbour's: patches with jagged borders.
Labeling patchy(const TriMesh& mesh, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    for (Index i = 0; i < 4 * mesh.facets(); i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

std::vector<Scene> patchy_scenes(Index each) {
    Lcg random(5);
    std::vector<Scene> scenes;
    for (const MeshData& data : {cube(3), shapes::creased(shapes::frame()), shapes::refined(shapes::octahedron()),
                                 shapes::two_cubes_at_a_vertex(), shapes::pinched_ring(), shapes::creased(square_pyramid(3))})
        for (Index i = 0; i < each; i++) scenes.emplace_back(data, patchy(build_mesh(data), random));
    return scenes;
}

bool touches_border(const Scene& scene, Index vertex) {
    for (Index h = 0; h < scene.mesh.halfedges(); h++)
        if (scene.mesh.from(h) == vertex && scene.state.graph.is_border(h)) return true;
    return false;
}

bool inside(const Scene& scene, Index h, Index chart) {
    return scene.state.graph.chart[scene.mesh.left(h)] == chart && scene.state.graph.chart[scene.mesh.right(h)] == chart;
}

bool is_chain(const TriMesh& mesh, const Halfedges& path) {
    for (std::size_t i = 1; i < path.size(); i++)
        if (mesh.from(path[i]) != mesh.to(path[i - 1])) return false;
    return true;
}

bool all_different(std::vector<Index> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end();
}

std::set<Index> as_set(const std::vector<Index>& list) { return {list.begin(), list.end()}; }

}   // namespace

// ---- small things

TEST_CASE("paths: the way back has the opposite half-edges in reverse order") {
    const Scene scene(cube(2));
    const Points there = {{0, 1, 2}, {1, 1, 2}, {1, 2, 2}}, back = {{1, 2, 2}, {1, 1, 2}, {0, 1, 2}};
    CHECK(reversed(scene.mesh, scene.path(there)) == scene.path(back));
    CHECK(reversed(scene.mesh, {}).empty());
}

TEST_CASE("paths: vertices along a path") {
    const Scene scene(cube(2));
    CHECK(vertices_of(scene.mesh, scene.path({{0, 1, 2}, {1, 1, 2}, {1, 2, 2}})) ==
          std::vector<Index>{scene.vertex({0, 1, 2}), scene.vertex({1, 1, 2}), scene.vertex({1, 2, 2})});
    CHECK(vertices_of(scene.mesh, {}).empty());
}

TEST_CASE("paths: the label closest to a vector, off two axes") {
    CHECK(best_label({3, 2, 1}, 1, 2) == 0);
    CHECK(best_label({3, 2, 1}, 0, 2) == 2);
    CHECK(best_label({3, 2, -1}, 0, 1) == 5);
    CHECK(best_label({3, 2, -1}, 0, 0) == 2);   // one axis, named twice
    CHECK(best_label({-1, 2, 1}, kNone, kNone) == 2);
    CHECK(best_label({-3, 0, 0}, kNone, kNone) == 1);
}

TEST_CASE("paths: of labels equally close the smallest is taken") {
    CHECK(best_label({1, 1, 1}, kNone, kNone) == 0);
    CHECK(best_label({1, 1, 1}, 0, kNone) == 2);
    CHECK(best_label({-1, -1, -1}, 1, kNone) == 1);
    CHECK(best_label({5, 5, 0}, 0, 1) == 4);   // +Z and -Z are both at 90 degrees
    CHECK(best_label({0, 0, 0}, 0, 2) == 2);
}

TEST_CASE("paths: the sum of normals counts facets, not areas") {
    const Scene scene(shapes::box(2, 1, 5));   // 10 facets face +X, 10 -X, 20 +Y, 20 -Y, 4 +Z, 4 -Z, in this order
    std::vector<Index> all;
    for (Index f = 0; f < scene.mesh.facets(); f++) all.push_back(f);
    CHECK(mean_normal(scene.mesh, all) == Vec3{0, 0, 0});
    CHECK(mean_normal(scene.mesh, {0, 9, 10, 20, 60, 61, 62}) == Vec3{1, 1, 3});
    CHECK(mean_normal(scene.mesh, {}) == Vec3{0, 0, 0});
}

TEST_CASE("paths: a patch of one label, in the order of the facets") {
    const Patch patch = relabel({7, 3, 5}, kY);
    REQUIRE(patch.size() == 3);
    for (std::size_t i = 0; i < 3; i++) {
        CHECK(patch[i].facet == std::vector<Index>{7, 3, 5}[i]);
        CHECK(patch[i].label == kY);
    }
    CHECK(relabel({}, kX).empty());
}

// ---- greedy paths

TEST_CASE("paths: a greedy path goes straight across a face and ends at its border") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    CHECK(scene.greedy({0, 3, 6}, top, {1, 0, 0}) ==
          Points{{0, 3, 6}, {1, 3, 6}, {2, 3, 6}, {3, 3, 6}, {4, 3, 6}, {5, 3, 6}, {6, 3, 6}});
    CHECK(scene.greedy({2, 6, 6}, top, {0, -7, 0}) ==
          Points{{2, 6, 6}, {2, 5, 6}, {2, 4, 6}, {2, 3, 6}, {2, 2, 6}, {2, 1, 6}, {2, 0, 6}});
    CHECK(scene.greedy({0, 2, 6}, top, {1, 1, 0}) ==
          Points{{0, 2, 6}, {1, 3, 6}, {2, 4, 6}, {3, 5, 6}, {4, 6, 6}});   // along diagonals
    CHECK(scene.greedy({0, 0, 6}, top, {1, 1, 0}).size() == 7);             // from corner to corner
}

TEST_CASE("paths: a greedy path stays near its line") {
    // Two squares along X for one along Y: no edge leads there, but the walk comes back to its line.
    const Scene scene(shapes::box(12, 6, 1));
    const Points path = scene.greedy({0, 0, 1}, upper_chart(scene), {2, 1, 0});
    REQUIRE_FALSE(path.empty());
    for (const Vec3& p : path) CHECK(std::abs(p.x - 2 * p.y) / std::sqrt(5.0) < 1);
    CHECK((path.back().x == 12 || path.back().y == 6));   // at the far end
}

TEST_CASE("paths: a greedy path never runs along the border") {
    // From (0,3) toward +Y: along the border is out, the diagonal (1,1) is the only edge inside that leads there; from then
    // on the line is one square away and 11 squares (ten mean edges) ahead, so straight edges fit best.
    const Scene scene(cube(6));
    CHECK(scene.greedy({0, 3, 6}, upper_chart(scene), {0, 1, 0}) == Points{{0, 3, 6}, {1, 4, 6}, {1, 5, 6}, {1, 6, 6}});
}

TEST_CASE("paths: a greedy path stops at the border of a hole") {
    const Scene scene(cube(5), with_square(5, 2, 2, kX));
    CHECK(scene.greedy({0, 2, 5}, upper_chart(scene), {1, 0, 0}) == Points{{0, 2, 5}, {1, 2, 5}, {2, 2, 5}});
}

TEST_CASE("paths: a greedy path that would turn back is refused") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    CHECK(scene.greedy({0, 3, 6}, top, {-1, 0, 0}).empty());   // out of the chart
    CHECK(scene.greedy({0, 3, 6}, top, {0, -1, 0}).empty());   // inside there is only (1,0) and (1,1)
    CHECK(scene.greedy({3, 3, 0}, top, {1, 0, 0}).empty());    // a vertex far from the chart
    CHECK(scene.greedy({0, 3, 6}, top, {0, 0, 0}).empty());    // no direction
    // Up a pyramid to its apex, from where all edges lead down.
    const Scene tent(shapes::refined(square_pyramid(4)), tent_labels(kX));
    CHECK(tent.greedy({4, -4, 0}, tent.state.graph.chart[0], {0, 0, 1}).empty());
}

TEST_CASE("paths: a greedy path crosses an apex that lies in its direction") {
    const Scene tent(shapes::refined(square_pyramid(2)), tent_labels(kZ));
    CHECK(tent.greedy({4, -4, 0}, tent.state.graph.chart[0], {-1, 1, 0}) ==
          Points{{4, -4, 0}, {2, -2, 2}, {0, 0, 4}, {-2, 2, 2}, {-4, 4, 0}});
}

TEST_CASE("paths: a greedy path prefers feature edges within 25 degrees") {
    // From the ridge's end, 20 degrees off the ridge toward the diagonal (10,-4,-20): cosines 0.94 and 0.98. The line is ten
    // mean edges (more than 100) ahead, so after one edge of 20 the ridge is still less than 25 degrees off.
    const Points along_ridge = {{20, 28, 40}, {20, 28, 20}, {20, 28, 0}};
    const Scene plain(roof(false), roof_labels()), creased(roof(true), roof_labels());
    REQUIRE(plain.mesh.mean_edge > 10);
    const Index plain_roof = plain.state.graph.chart[16], creased_roof = creased.state.graph.chart[16];
    CHECK(plain.greedy({20, 28, 40}, plain_roof, in_xz(20)).at(1) == Vec3{30, 24, 20});
    CHECK(creased.greedy({20, 28, 40}, creased_roof, in_xz(20)) == along_ridge);
    CHECK(creased.greedy({20, 28, 40}, creased_roof, in_xz(30)).at(1) == Vec3{30, 24, 20});
    CHECK(plain.greedy({20, 28, 40}, plain_roof, in_xz(0)) == along_ridge);   // both agree where the ridge is best
    CHECK(creased.greedy({20, 28, 40}, creased_roof, in_xz(0)) == along_ridge);
}

TEST_CASE("paths: greedy paths are the same at any scale and for any length of the direction") {
    for (const double by : {1024.0, 1.0 / 1024}) {
        for (const bool features : {false, true}) {
            const Scene one(roof(features), roof_labels()), other(shapes::scaled(roof(features), by), roof_labels());
            for (Index v = 0; v < one.mesh.vertices(); v++)
                for (const Vec3& d : {Vec3{3, 1, 2}, Vec3{-1, 0, -5}, Vec3{0, -2, 1}}) {
                    const Halfedges path = greedy_path(one.mesh, one.state, v, one.state.graph.chart[16], d);
                    CHECK(path == greedy_path(other.mesh, other.state, v, other.state.graph.chart[16], d));
                    CHECK(path == greedy_path(one.mesh, one.state, v, one.state.graph.chart[16], d * by));
                }
        }
    }
}

TEST_CASE("paths: greedy paths run inside the chart from border to border and meet no vertex twice") {
    Index found = 0;
    for (const Scene& scene : patchy_scenes(4)) {
        for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
            for (const Halfedges& contour : contours(scene.mesh, scene.state, c)) {
                for (const Index start : contour) {
                    for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{-1, 2, -3}}) {
                        const Halfedges path = greedy_path(scene.mesh, scene.state, scene.mesh.from(start), c, d);
                        if (path.empty()) continue;
                        found++;
                        CHECK(scene.mesh.from(path[0]) == scene.mesh.from(start));
                        CHECK(is_chain(scene.mesh, path));
                        CHECK(all_different(vertices_of(scene.mesh, path)));
                        CHECK(std::all_of(path.begin(), path.end(), [&](Index h) { return inside(scene, h, c); }));
                        CHECK(touches_border(scene, scene.mesh.to(path.back())));
                    }
                }
            }
        }
    }
    CHECK(found > 100);
}

// ---- lost feature edges

TEST_CASE("paths: lost feature edges that leave a vertex, in the order of the fan") {
    // Four ridges leave the apex, all lost in one chart; turning clockwise from one of them the others follow.
    const Scene tent(shapes::refined(shapes::creased(square_pyramid(2))), tent_labels(kZ));
    const Vec3 apex = {0, 0, 4};
    const Points clockwise = {{2, -2, 2}, {-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}};
    const Halfedges found = lost_features_at(tent.mesh, tent.state, tent.halfedge(apex, clockwise[0]));
    REQUIRE(found.size() == 4);
    for (std::size_t i = 0; i < 4; i++) CHECK(found[i] == tent.halfedge(apex, clockwise[i]));
    // The edges of the base are feature edges, but not lost; from a corner of it one ridge leaves.
    const Index along_base = tent.halfedge({4, -4, 0}, {4, 0, 0});
    CHECK(lost_features_at(tent.mesh, tent.state, along_base) == tent.path({{4, -4, 0}, {2, -2, 2}}));
    const Scene plain(shapes::refined(square_pyramid(2)), tent_labels(kZ));
    CHECK(lost_features_at(plain.mesh, plain.state, plain.halfedge(apex, clockwise[0])).empty());
}

TEST_CASE("paths: lost feature edges are followed to the border, straight on at a junction") {
    // At the apex the opposite ridge has the cosine 1/3 with the one that came, the two others -1/3.
    const Scene tent(shapes::refined(shapes::creased(square_pyramid(2))), tent_labels(kZ));
    const Points over = {{4, -4, 0}, {2, -2, 2}, {0, 0, 4}, {-2, 2, 2}, {-4, 4, 0}};
    CHECK(tent.points(lost_feature_path(tent.mesh, tent.state, tent.halfedge(over[0], over[1]))) == over);
    const Scene house(roof(true), roof_labels());
    CHECK(house.points(lost_feature_path(house.mesh, house.state, house.halfedge({20, 28, 40}, {20, 28, 20}))) ==
          Points{{20, 28, 40}, {20, 28, 20}, {20, 28, 0}});
}

TEST_CASE("paths: lost feature edges are followed to a dead end") {
    const MeshData half = with_features(roof(true), [](const Vec3& middle) { return middle.z > 20; });
    const Scene house(half, roof_labels());
    CHECK(house.points(lost_feature_path(house.mesh, house.state, house.halfedge({20, 28, 40}, {20, 28, 20}))) ==
          Points{{20, 28, 40}, {20, 28, 20}});
}

TEST_CASE("paths: lost feature edges in a ring end before a vertex met before") {
    // A cube on a plate, all of them +Z: of its edges the four around its foot are feature edges.
    std::vector<shapes::Cell> cells = {{1, 1, 1}};
    for (int i = 0; i < 9; i++) cells.push_back({i % 3, i / 3, 0});
    const MeshData data = with_features(shapes::creased(shapes::voxels(cells)), [](const Vec3& middle) {
        return middle.z == 1 && middle.x >= 1 && middle.x <= 2 && middle.y >= 1 && middle.y <= 2;
    });
    REQUIRE(data.edges.size() == 8);
    Labeling labels = naive_labeling(build_mesh(data));
    std::fill(labels.begin(), labels.begin() + 10, kZ);   // the cube comes first: five free sides
    const Scene scene(data, labels);
    const Halfedges path = lost_feature_path(scene.mesh, scene.state, scene.halfedge({1, 1, 1}, {2, 1, 1}));
    CHECK(scene.points(path) == Points{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}});
}

TEST_CASE("paths: lost feature paths consist of lost feature edges of one chart and meet no vertex twice") {
    Index found = 0;
    for (const Scene& scene : patchy_scenes(4)) {
        for (Index h = 0; h < scene.mesh.halfedges(); h++) {
            if (!scene.mesh.feature[h] || scene.state.graph.is_border(h)) continue;
            const Halfedges path = lost_feature_path(scene.mesh, scene.state, h);
            found++;
            REQUIRE_FALSE(path.empty());
            CHECK(path[0] == h);
            CHECK(is_chain(scene.mesh, path));
            CHECK(all_different(vertices_of(scene.mesh, path)));
            for (const Index edge : path)
                CHECK((scene.mesh.feature[edge] && inside(scene, edge, scene.state.graph.chart[facet(h)])));
        }
    }
    CHECK(found > 100);
}

// ---- regions and bands

TEST_CASE("paths: a region ends at walls and at the chart's border") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    const Halfedges wall = greedy_path(scene.mesh, scene.state, scene.vertex({2, 0, 6}), top, {0, 1, 0});
    REQUIRE(wall.size() == 6);   // x = 2, from side to side
    std::set<Index> left;
    for (Index y = 0; y < 6; y++)
        for (Index x = 0; x < 2; x++) left.insert({first_facet(6, x, y), first_facet(6, x, y) + 1});
    const std::vector<Index> seed = {first_facet(6, 0, 0)};
    CHECK(as_set(region_between(scene.mesh, scene.state, top, seed, wall)) == left);
    CHECK(as_set(region_between(scene.mesh, scene.state, top, seed, reversed(scene.mesh, wall))) == left);   // either way
    CHECK(region_between(scene.mesh, scene.state, top, {first_facet(6, 4, 3)}, wall).size() == 72 - 24);
    CHECK(region_between(scene.mesh, scene.state, top, seed, {}).size() == 72);
}

TEST_CASE("paths: walls with a gap enclose nothing") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    Halfedges wall = greedy_path(scene.mesh, scene.state, scene.vertex({2, 0, 6}), top, {0, 1, 0});
    wall.erase(wall.begin() + 3);
    CHECK(region_between(scene.mesh, scene.state, top, {first_facet(6, 0, 0)}, wall).empty());
}

TEST_CASE("paths: seeds of a region lie in its chart, at one side of the walls") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    const Halfedges wall = greedy_path(scene.mesh, scene.state, scene.vertex({2, 0, 6}), top, {0, 1, 0});
    const Index left = first_facet(6, 0, 0), right = first_facet(6, 5, 5), elsewhere = 0;
    CHECK(region_between(scene.mesh, scene.state, top, {elsewhere, left}, wall).size() == 24);
    CHECK(region_between(scene.mesh, scene.state, top, {left, left}, wall).size() == 24);
    CHECK(region_between(scene.mesh, scene.state, top, {left, right}, wall).empty());
    CHECK(region_between(scene.mesh, scene.state, top, {elsewhere}, wall).empty());
    CHECK(region_between(scene.mesh, scene.state, top, {}, wall).empty());
}

TEST_CASE("paths: rings around a vertex of a grid") {
    // Triangles in a plane, six at each vertex: 6 k k of them within k rings.
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    std::vector<Index> inner;
    for (const int rings : {1, 2, 3}) {
        const std::vector<Index> facets = band(scene.mesh, scene.state, {scene.vertex({3, 3, 6})}, top, rings);
        CHECK(facets.size() == std::size_t(6 * rings * rings));
        CHECK(all_different(facets));
        CHECK(std::equal(inner.begin(), inner.end(), facets.begin()));   // ring after ring
        inner = facets;
    }
    CHECK(band(scene.mesh, scene.state, {scene.vertex({3, 3, 6})}, top, 0).empty());
    CHECK(band(scene.mesh, scene.state, {}, top, 3).empty());
}

TEST_CASE("paths: the band along a line of a grid is one row of squares per ring and side") {
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    const std::vector<Index> line =
        vertices_of(scene.mesh, greedy_path(scene.mesh, scene.state, scene.vertex({3, 0, 6}), top, {0, 1, 0}));
    CHECK(band(scene.mesh, scene.state, line, top, 1).size() == 2 * 12);
    CHECK(band(scene.mesh, scene.state, line, top, 2).size() == 4 * 12);
    CHECK(band(scene.mesh, scene.state, line, top, 9).size() == 72);   // no further than the chart
}

TEST_CASE("paths: the strip at the left of a path is one row of squares per ring") {
    // Up along x = 3 the left is toward x = 0. Two rings from the path are two rows; three all that there is.
    const Scene scene(cube(6));
    const Index top = upper_chart(scene);
    const Halfedges up = greedy_path(scene.mesh, scene.state, scene.vertex({3, 0, 6}), top, {0, 1, 0});
    REQUIRE(up.size() == 6);
    std::set<Index> left, right;
    for (const Index width : {1, 2, 3}) {
        for (Index y = 0; y < 6; y++)
            for (const Index k : {0, 1}) {
                left.insert(first_facet(6, 3 - width, y) + k);
                right.insert(first_facet(6, 2 + width, y) + k);
            }
        CHECK(as_set(strip_beside(scene.mesh, scene.state, up, width)) == left);
        CHECK(as_set(strip_beside(scene.mesh, scene.state, reversed(scene.mesh, up), width)) == right);
    }
    CHECK(as_set(strip_beside(scene.mesh, scene.state, up, 9)) == left);
}

TEST_CASE("paths: vertices that a boundary passes") {
    const Scene scene(cube(2), with_square(2, 0, 0, kX));
    CHECK(on_border(scene.mesh, scene.state, scene.halfedge({1, 1, 2}, {1, 2, 2})));   // a corner of the square
    CHECK(on_border(scene.mesh, scene.state, scene.halfedge({0, 0, 2}, {1, 1, 2})));   // whichever edge it is
    CHECK_FALSE(on_border(scene.mesh, scene.state, scene.halfedge({1, 1, 0}, {1, 2, 0})));
}

TEST_CASE("paths: a band stays in its chart, or in none") {
    // Above, (6,3,6) is r of the square (5,2), in both of its facets, and q of (5,3), in one. In the plane of the side the
    // same: (3,6) is r of (2,5) and s of (3,5).
    const Scene scene(cube(6));
    const std::vector<Index> rim = {scene.vertex({6, 3, 6})};
    CHECK(as_set(band(scene.mesh, scene.state, rim, upper_chart(scene), 1)) ==
          std::set<Index>{first_facet(6, 5, 2), first_facet(6, 5, 2) + 1, first_facet(6, 5, 3)});
    CHECK(band(scene.mesh, scene.state, rim, scene.state.graph.chart[0], 1).size() == 3);
    CHECK(band(scene.mesh, scene.state, rim, kNone, 1).size() == 6);
    CHECK(band(scene.mesh, scene.state, rim, scene.state.graph.chart[72], 3).empty());   // -X does not reach there
}

// ---- contours

TEST_CASE("paths: the contour of a face has the face at its left") {
    const Scene scene(cube(3));
    const Index top = upper_chart(scene);
    const std::vector<Halfedges> found = contours(scene.mesh, scene.state, top);
    REQUIRE(found.size() == 1);
    CHECK(found[0].size() == 12);
    CHECK(is_chain(scene.mesh, found[0]));
    CHECK(scene.mesh.to(found[0].back()) == scene.mesh.from(found[0][0]));
    for (const Index h : found[0]) CHECK(scene.state.graph.chart[facet(h)] == top);
    // Counter-clockwise from above: the area it encloses is positive.
    double area = 0;
    for (const Index h : found[0])
        area += cross(scene.mesh.points[scene.mesh.from(h)], scene.mesh.points[scene.mesh.to(h)]).z / 2;
    CHECK(area == 9);
}

TEST_CASE("paths: a chart with a hole has two contours, that of its first boundary first") {
    const Scene scene(cube(5), with_square(5, 2, 2, kX));
    const Index top = upper_chart(scene);
    const std::vector<Halfedges> found = contours(scene.mesh, scene.state, top);
    REQUIRE(found.size() == 2);
    CHECK(found[0].size() + found[1].size() == 20 + 4);
    CHECK(std::min(found[0].size(), found[1].size()) == 4);
    const LabelingGraph& graph = scene.state.graph;
    const Index first = graph.chart_boundaries[graph.charts[top].boundaries.first];
    CHECK(graph.boundary[found[0][0]] == first);
    CHECK(contours(scene.mesh, scene.state, graph.chart[first_facet(5, 2, 2)]).size() == 1);   // the hole's chart
}

TEST_CASE("paths: a ring-shaped face has two contours") {
    const Scene scene(shapes::frame());
    for (Index c = 0; c < static_cast<Index>(scene.state.graph.charts.size()); c++) {
        std::vector<Halfedges> found = contours(scene.mesh, scene.state, c);
        const bool ring = axis(scene.state.graph.charts[c].label) == 2;
        REQUIRE(found.size() == (ring ? 2 : 1));
        if (!ring) continue;
        if (found[0].size() < found[1].size()) std::swap(found[0], found[1]);
        CHECK(found[0].size() == 12);
        CHECK(found[1].size() == 4);
    }
}

TEST_CASE("paths: contours hold every border of the chart once, whole boundaries one after the other") {
    for (const Scene& scene : patchy_scenes(6)) {
        const LabelingGraph& graph = scene.state.graph;
        for (Index c = 0; c < static_cast<Index>(graph.charts.size()); c++) {
            std::vector<Index> expected, found;
            for (Index h = 0; h < scene.mesh.halfedges(); h++)
                if (graph.is_border(h) && graph.chart[facet(h)] == c) expected.push_back(h);
            Index last_first = kNone;
            for (const Halfedges& contour : contours(scene.mesh, scene.state, c)) {
                CHECK(is_chain(scene.mesh, contour));
                CHECK(scene.mesh.to(contour.back()) == scene.mesh.from(contour[0]));
                CHECK(graph.boundary[contour[0]] > last_first);   // by the smallest boundary of each
                last_first = graph.boundary[contour[0]];
                for (const Index h : contour) CHECK(graph.boundary[h] >= last_first);
                std::set<Index> met;
                for (std::size_t i = 0; i < contour.size(); i++)
                    if (i == 0 || graph.boundary[contour[i]] != graph.boundary[contour[i - 1]])
                        CHECK(met.insert(graph.boundary[contour[i]]).second);
                found.insert(found.end(), contour.begin(), contour.end());
            }
            std::sort(found.begin(), found.end());
            CHECK(found == expected);
        }
    }
}

TEST_CASE("paths: a chart that is all of the surface has no contour") {
    const Scene scene(cube(1), Labeling(12, kX));
    CHECK(contours(scene.mesh, scene.state, 0).empty());
}

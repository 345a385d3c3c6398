#include "polylab/mesh.h"

#include "polylab/labels.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace polylab;
using shapes::Lcg;

namespace {

struct Named {
    std::string name;
    MeshData data;
};

std::vector<Named> all_shapes() {
    return {{"tetrahedron", shapes::tetrahedron()},
            {"octahedron", shapes::octahedron()},
            {"cube(3)", shapes::cube(3)},
            {"box(1,2,3)", shapes::box(1, 2, 3)},
            {"l_shape", shapes::l_shape()},
            {"stair(3)", shapes::stair(3)},
            {"frame", shapes::frame()},
            {"hollow_box", shapes::hollow_box()},
            {"two_cubes_at_a_vertex", shapes::two_cubes_at_a_vertex()},
            {"pinched_ring", shapes::pinched_ring()},
            {"triangular_prism", shapes::triangular_prism(2, 3, 1)},
            {"pyramid(7)", shapes::pyramid(7)},
            {"pillow", shapes::pillow()},
            {"tetrahedron_with_flat_facet", shapes::tetrahedron_with_flat_facet()},
            {"refined l_shape", shapes::refined(shapes::l_shape())},
            {"cube beside frame", shapes::joined(shapes::cube(1), shapes::moved(shapes::frame(), {5, 0, 0}))}};
}

// vertices - edges + facets: 2 for a sphere, 0 for a torus; each pinch (two points made one) takes 1
Index euler(const TriMesh& mesh) { return mesh.vertices() - mesh.halfedges() / 2 + mesh.facets(); }

// Turning around a half-edge's origin visits one fan.
Index count_fans(const TriMesh& mesh) {
    std::vector<char> seen(mesh.halfedges(), 0);
    Index fans = 0;
    for (Index h = 0; h < mesh.halfedges(); h++) {
        if (seen[h]) continue;
        fans++;
        for (Index i = h; !seen[i]; i = mesh.ccw(i)) seen[i] = 1;
    }
    return fans;
}

double volume6(const TriMesh& mesh) {
    double sum = 0;
    for (Index f = 0; f < mesh.facets(); f++) sum += dot(mesh.points[mesh.origin[3 * f]], mesh.area_vector(f));
    return sum;
}

// The message with which the mesh is refused, or "accepted".
std::string refusal(const MeshData& data) {
    try {
        build_mesh(data);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool names_edge(const std::string& message, Index a, Index b) {
    return contains(message, "edge " + std::to_string(a) + "-" + std::to_string(b) + ":") ||
           contains(message, "edge " + std::to_string(b) + "-" + std::to_string(a) + ":");
}

void check_same(const TriMesh& a, const TriMesh& b) {
    CHECK(a.points == b.points);
    CHECK(a.origin == b.origin);
    CHECK(a.opposite == b.opposite);
    CHECK(a.normal == b.normal);
    CHECK(a.feature == b.feature);
    CHECK(a.features_kept == b.features_kept);
}

Index find_halfedge(const TriMesh& mesh, Index from, Index to) {
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.from(h) == from && mesh.to(h) == to) return h;
    return kNone;
}

bool is_feature(const TriMesh& mesh, Index from, Index to) {
    const Index h = find_halfedge(mesh, from, to);
    REQUIRE(h != kNone);
    return mesh.feature[h];
}

}   // namespace

TEST_CASE("mesh: half-edge steps are inverse to each other") {
    for (const Named& shape : all_shapes()) {
        CAPTURE(shape.name);
        const TriMesh mesh = build_mesh(shape.data);
        validate(mesh);
        for (Index h = 0; h < mesh.halfedges(); h++) {
            const Index o = mesh.opposite[h];
            REQUIRE(next(next(next(h))) == h);
            REQUIRE(prev(next(h)) == h);
            REQUIRE(facet(next(h)) == facet(h));
            REQUIRE(mesh.to(h) == mesh.from(next(h)));
            REQUIRE(mesh.opposite[o] == h);
            REQUIRE(mesh.from(o) == mesh.to(h));
            REQUIRE(mesh.to(o) == mesh.from(h));
            REQUIRE(mesh.edge(o) == mesh.edge(h));
            REQUIRE(mesh.left(o) == mesh.right(h));
            REQUIRE(mesh.vector(o) == -mesh.vector(h));
            REQUIRE(mesh.ccw(mesh.cw(h)) == h);
            REQUIRE(mesh.cw(mesh.ccw(h)) == h);
            REQUIRE(mesh.from(mesh.ccw(h)) == mesh.from(h));
            REQUIRE(mesh.right(mesh.ccw(h)) == mesh.left(h));
            REQUIRE(mesh.left(mesh.cw(h)) == mesh.right(h));
        }
    }
}

TEST_CASE("mesh: turning around a vertex is counter-clockwise seen from outside, and returns") {
    const TriMesh mesh = build_mesh(shapes::cube(2));
    Index middle = kNone;
    for (Index v = 0; v < mesh.vertices(); v++)
        if (mesh.points[v] == Vec3{1, 1, 2}) middle = v;
    REQUIRE(middle != kNone);
    Index start = 0;
    while (mesh.from(start) != middle) start++;
    // Four squares meet there, two of them cut by a diagonal through it: 6 facets.
    Index h = start, steps = 0;
    do {
        CHECK(cross(mesh.vector(h), mesh.vector(mesh.ccw(h))).z > 0);
        h = mesh.ccw(h);
        steps++;
    } while (h != start && steps < 100);
    CHECK(steps == 6);
}

TEST_CASE("mesh: shapes have the counts, Euler characteristic, fans and volume of a drawing") {
    struct Expected {
        std::string name;
        MeshData data;
        Index vertices, facets, components, cavities, euler, fans_more_than_vertices;
        double volume6;
    };
    // cube(n): 12 n^2 facets on 6 n^2 + 2 vertices. Cells: 12 facets each, less 4 per common side.
    // pinched_ring: a sphere of 10 cells with 10 * 4 + 4 vertices, 2 of them made one.
    const std::vector<Expected> table = {
        {"tetrahedron", shapes::tetrahedron(), 4, 4, 1, 0, 2, 0, 1},
        {"octahedron", shapes::octahedron(), 6, 8, 1, 0, 2, 0, 8},
        {"cube(1)", shapes::cube(1), 8, 12, 1, 0, 2, 0, 6},
        {"cube(4)", shapes::cube(4), 98, 192, 1, 0, 2, 0, 6 * 64},
        {"box(2,3,4)", shapes::box(2, 3, 4), 54, 104, 1, 0, 2, 0, 6 * 24},
        {"l_shape", shapes::l_shape(), 16, 28, 1, 0, 2, 0, 6 * 3},
        {"stair(3)", shapes::stair(3), 26, 48, 1, 0, 2, 0, 6 * 6},
        {"frame", shapes::frame(), 32, 64, 1, 0, 0, 0, 6 * 8},
        {"hollow_box", shapes::hollow_box(), 56 + 8, 108 + 12, 2, 1, 4, 0, 6 * 26},
        {"two cubes", shapes::two_cubes_at_a_vertex(), 15, 24, 2, 0, 3, 1, 6 * 2},
        {"pinched_ring", shapes::pinched_ring(), 43, 84, 1, 0, 1, 1, 6 * 10},
        {"prism", shapes::triangular_prism(2, 3, 5), 6, 8, 1, 0, 2, 0, 6 * 15},
        {"pillow", shapes::pillow(), 3, 2, 1, 0, 2, 0, 0},
        {"refined tetrahedron", shapes::refined(shapes::tetrahedron()), 10, 16, 1, 0, 2, 0, 8},
    };
    for (const Expected& e : table) {
        CAPTURE(e.name);
        const TriMesh mesh = build_mesh(e.data);
        CHECK(mesh.vertices() == e.vertices);
        CHECK(mesh.facets() == e.facets);
        CHECK(mesh.halfedges() == 3 * e.facets);
        CHECK(mesh.components == e.components);
        CHECK(mesh.cavities == e.cavities);
        CHECK(euler(mesh) == e.euler);
        CHECK(count_fans(mesh) == e.vertices + e.fans_more_than_vertices);
        CHECK(volume6(mesh) == e.volume6);
        CHECK(mesh.turned_facets == 0);
        CHECK(mesh.turned_components == 0);
        CHECK(mesh.isolated_vertices == 0);
        CHECK(mesh.flat_facets == 0);
        CHECK(notes(mesh).empty());
    }
}

TEST_CASE("mesh: normals of a cube are the exact directions of the labels") {
    const TriMesh mesh = build_mesh(shapes::cube(2));
    for (Index f = 0; f < mesh.facets(); f++) CHECK(mesh.normal[f] == direction(static_cast<Label>(f / 8)));
    const TriMesh huge = build_mesh(shapes::scaled(shapes::cube(1), 1e75));   // the largest coordinate allowed
    for (Index f = 0; f < huge.facets(); f++) {
        const Vec3 difference = huge.normal[f] - direction(static_cast<Label>(f / 2));
        CHECK(norm(difference) < 1e-15);
    }
}

TEST_CASE("mesh: the mean edge counts every edge once") {
    // 12 edges of length 1 and 6 diagonals.
    CHECK(build_mesh(shapes::cube(1)).mean_edge == doctest::Approx((12 + 6 * std::sqrt(2.0)) / 18).epsilon(1e-14));
    const TriMesh mesh = build_mesh(shapes::scaled(shapes::tetrahedron(), 4));   // three edges of 4, three diagonals
    CHECK(mesh.mean_edge == doctest::Approx(2 * (1 + std::sqrt(2.0))).epsilon(1e-14));
}

TEST_CASE("mesh: a surface that is not closed is refused, naming an open edge") {
    MeshData data = shapes::tetrahedron();
    data.triangles.erase(data.triangles.begin(), data.triangles.begin() + 3);   // 1 2 3
    const std::string message = refusal(data);
    CAPTURE(message);
    CHECK((names_edge(message, 1, 2) || names_edge(message, 2, 3) || names_edge(message, 1, 3)));
    CHECK(contains(message, "expected two facets"));
    CHECK(contains(message, "found 1"));
    CHECK(contains(refusal(shapes::mobius_strip(5)), "expected two facets"));
}

TEST_CASE("mesh: an edge of more than two facets is refused, naming it and its facets") {
    // Two unit cells that share only the vertical edge at (1,1).
    const MeshData data = shapes::voxels({{0, 0, 0}, {1, 1, 0}});
    Index ends[2] = {kNone, kNone};
    for (std::size_t v = 0; v < data.points.size(); v++)
        for (int z = 0; z < 2; z++)
            if (data.points[v] == Vec3{1, 1, double(z)}) ends[z] = static_cast<Index>(v);
    const std::string message = refusal(data);
    CAPTURE(message);
    CHECK(names_edge(message, ends[0], ends[1]));
    CHECK(contains(message, "found 4"));
    for (Index h = 0; h < static_cast<Index>(data.triangles.size()); h++) {
        const Index a = data.triangles[h], b = data.triangles[next(h)];
        const bool on_edge = (a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]);
        if (on_edge) CHECK(contains(message, std::to_string(facet(h))));
    }
}

TEST_CASE("mesh: a facet given twice is refused, naming both") {
    const std::vector<std::vector<Index>> copies = {{0, 3, 2}, {3, 2, 0}, {2, 3, 0}};   // of facet 1: as it is, rotated, turned
    for (const std::vector<Index>& copy : copies) {
        MeshData data = shapes::tetrahedron();
        data.triangles.insert(data.triangles.end(), copy.begin(), copy.end());
        const std::string message = refusal(data);
        CAPTURE(message);
        CHECK(contains(message, "facet 4"));
        CHECK(contains(message, "facet 1"));
        CHECK(contains(message, "each facet once"));
    }
    // Alone they would pair up; only facing opposite ways (a pillow) is a surface.
    MeshData twice = shapes::pillow();
    twice.triangles = {0, 1, 2, 1, 2, 0};
    CHECK(contains(refusal(twice), "each facet once"));
}

TEST_CASE("mesh: a facet that repeats a vertex is refused, naming both") {
    for (int k = 0; k < 3; k++) {
        MeshData data = shapes::tetrahedron();
        data.triangles[3 * 2 + k] = data.triangles[3 * 2 + (k + 1) % 3];
        const std::string message = refusal(data);
        CAPTURE(message);
        CHECK(contains(message, "facet 2:"));
        CHECK(contains(message, "vertex " + std::to_string(data.triangles[3 * 2 + k])));
    }
}

TEST_CASE("mesh: an index out of range is refused, naming facet or feature edge") {
    for (const Index bad : {-1, 4, std::numeric_limits<Index>::max(), std::numeric_limits<Index>::min()}) {
        MeshData data = shapes::tetrahedron();
        data.triangles[3 * 3 + 1] = bad;
        const std::string message = refusal(data);
        CAPTURE(message);
        CHECK(contains(message, "facet 3:"));
        CHECK(contains(message, "0..3"));
        CHECK(contains(message, std::to_string(bad)));
        data = shapes::tetrahedron();
        data.edges = {0, 1, 2, bad};
        CHECK(contains(refusal(data), "feature edge 1:"));
        CHECK(contains(refusal(data), std::to_string(bad)));
    }
    MeshData pointless;
    pointless.triangles = {0, 1, 2};
    CHECK(contains(refusal(pointless), "facet 0:"));
}

TEST_CASE("mesh: a coordinate that is not finite or beyond 1e75 is refused, naming the vertex") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), 1e80, -1e80, 1.0000001e75})
        for (int axis = 0; axis < 3; axis++) {
            MeshData data = shapes::tetrahedron();
            data.points[2][axis] = bad;
            const std::string message = refusal(data);
            CAPTURE(message);
            CHECK(contains(message, "vertex 2:"));
            CHECK(contains(message, "1e75"));
        }
}

TEST_CASE("mesh: no facet at all is refused") {
    CHECK(contains(refusal({}), "found no triangle"));
    MeshData points = shapes::tetrahedron();
    points.triangles.clear();
    CHECK(contains(refusal(points), "found no triangle"));
}

TEST_CASE("mesh: a closed surface with one side is refused") {
    const std::string message = refusal(shapes::projective_plane());
    CAPTURE(message);
    CHECK(contains(message, "facets "));
    CHECK(contains(message, "can't be oriented"));
}

TEST_CASE("mesh: facets that disagree are turned back, by exchanging their vertices 1 and 2") {
    Lcg random(1);
    for (const Named& shape : all_shapes()) {
        CAPTURE(shape.name);
        if (shape.name == "pillow") continue;   // no volume: which of its two facets to turn is open
        MeshData data = shapes::creased(shape.data);
        data.edges.resize(data.edges.size() / 4 * 2);   // half of the sharp edges, so that the flags have to follow
        const TriMesh mesh = build_mesh(data);
        for (int round = 0; round < 10; round++) {
            std::vector<char> turn(mesh.facets());
            Index count = 0;
            for (char& t : turn) count += t = static_cast<char>(random.below(round + 2) == 0);
            const TriMesh repaired = build_mesh(shapes::turned(data, turn));
            check_same(repaired, mesh);
            validate(repaired);
            CHECK(repaired.turned_facets == count);
        }
    }
}

TEST_CASE("mesh: facets without area are accepted and have no normal") {
    MeshData data = shapes::tetrahedron_with_flat_facet();
    const TriMesh mesh = build_mesh(data);
    validate(mesh);
    CHECK(mesh.flat_facets == 1);
    CHECK(mesh.normal[4] == Vec3{});
    CHECK(mesh.normal[5] == Vec3{0, -1, 0});
    // The edges of the flat facet have no angle; 1-3 is an edge of the tetrahedron.
    data.edges = {0, 1, 4, 0, 1, 4, 1, 3};
    for (const bool detect : {false, true}) {
        const TriMesh marked = build_mesh(data, {detect, kFeatureCos});
        CHECK_FALSE(is_feature(marked, 0, 1));
        CHECK_FALSE(is_feature(marked, 0, 4));
        CHECK_FALSE(is_feature(marked, 1, 4));
        CHECK(is_feature(marked, 1, 3));
        CHECK(marked.features_off == 0);
        CHECK(marked.features_kept == (detect ? 5 : 1));   // of the tetrahedron's 6 edges 0-1 is hidden by the flat facet
    }
}

TEST_CASE("mesh: vertices without facet keep their numbers") {
    MeshData data;
    data.points = {{7, 7, 7}};
    shapes::append(data, shapes::cube(2));
    data.points.push_back({8, 8, 8});
    const TriMesh mesh = build_mesh(data);
    validate(mesh);
    CHECK(mesh.isolated_vertices == 2);
    CHECK(mesh.points == data.points);
    CHECK(mesh.origin == data.triangles);
    CHECK(mesh.components == 1);
}

TEST_CASE("mesh: a named edge is a feature edge from an angle of 0.5 rad") {
    CHECK(std::abs(kFeatureCos - std::cos(0.5)) < 1e-15);
    // The vertical edge 1-5 of the prism; sides 0 and 1 meet there at atan(y/100). tan 0.5 = 0.5463: 0.495 rad, 0.503 rad.
    for (const int y : {54, 55}) {
        MeshData data = shapes::prism({{0, 0, 0}, {100, 0, 0}, {200, double(y), 0}, {0, 300, 0}}, 10);
        CHECK(build_mesh(data, {true, kFeatureCos}).features_kept == 3 * 4 - (y == 54));
        CHECK(build_mesh(data).features_kept == 0);
        data.edges = {1, 5};
        const TriMesh mesh = build_mesh(data);
        CHECK(is_feature(mesh, 1, 5) == (y == 55));
        CHECK(is_feature(mesh, 5, 1) == (y == 55));
        CHECK(mesh.features_kept == (y == 55));
        CHECK(mesh.features_given == 1);
        CHECK(mesh.features_off == 0);
    }
}

TEST_CASE("mesh: an angle of exactly the threshold is a feature edge") {
    const MeshData data = shapes::creased(shapes::cube(2));
    CHECK(build_mesh(data, {false, 0.0}).features_kept == 24);   // right angles: the cosine is exactly 0
    CHECK(build_mesh(data, {false, -1e-9}).features_kept == 0);
}

TEST_CASE("mesh: concave edges are feature edges like convex ones") {
    // The contour of the L has 8 unit edges, below and above, and 6 corners with a vertical edge each.
    const MeshData data = shapes::creased(shapes::l_shape());
    CHECK(data.edges.size() / 2 == 8 + 8 + 6);
    const TriMesh mesh = build_mesh(data);
    CHECK(mesh.features_kept == 22);
    bool concave = false;   // at (1,1)
    for (Index h = 0; h < mesh.halfedges(); h++)
        concave |= mesh.feature[h] && mesh.points[mesh.from(h)] == Vec3{1, 1, 0} && mesh.points[mesh.to(h)] == Vec3{1, 1, 1};
    CHECK(concave);
    check_same(build_mesh(shapes::l_shape(), {true, kFeatureCos}), mesh);
}

TEST_CASE("mesh: feature edges given twice count once, those off the surface are counted") {
    MeshData data = shapes::box(1, 1, 1);
    const TriMesh plain = build_mesh(data);
    Index sharp = 0;
    while (plain.normal[plain.left(sharp)] == plain.normal[plain.right(sharp)]) sharp++;
    Index flat = 0;
    while (!(plain.normal[plain.left(flat)] == plain.normal[plain.right(flat)])) flat++;
    const Index a = plain.from(sharp), b = plain.to(sharp), far = plain.vertices();
    data.points.push_back({9, 9, 9});
    // Sharp: three times in two directions; between coplanar facets; off the surface: to a vertex without facet, twice, and
    // from a vertex to itself.
    data.edges = {a, b, b, a, plain.from(flat), plain.to(flat), a, b, far, a, a, far, a, a};
    const TriMesh mesh = build_mesh(data);
    validate(mesh);
    CHECK(mesh.features_given == 7);
    CHECK(mesh.features_kept == 1);
    CHECK(mesh.features_off == 3);
    for (Index h = 0; h < mesh.halfedges(); h++) CHECK(mesh.feature[h] == (mesh.edge(h) == mesh.edge(sharp)));
}

TEST_CASE("mesh: detection finds all sharp edges, whatever the file names") {
    MeshData data = shapes::cube(2);
    CHECK(build_mesh(data, {true, kFeatureCos}).features_kept == 24);   // 12 edges of 2
    const TriMesh plain = build_mesh(data);
    Index flat = 0;
    while (!(plain.normal[plain.left(flat)] == plain.normal[plain.right(flat)])) flat++;
    data.edges = {plain.from(flat), plain.to(flat)};
    const TriMesh mesh = build_mesh(data, {true, kFeatureCos});
    validate(mesh);
    CHECK(mesh.features_kept == 24);
    CHECK(mesh.features_given == 0);   // the list is not asked
    CHECK_FALSE(mesh.feature[flat]);
}

TEST_CASE("mesh: one line tells each repair") {
    MeshData data = shapes::tetrahedron_with_flat_facet();   // 1 flat facet
    data.points.push_back({5, 5, 5});                        // 1 isolated vertex
    data.edges = {0, 5};                                     // 1 edge off the surface
    std::vector<char> turn(6, 0);
    turn[3] = 1;
    const std::vector<std::string> lines = notes(build_mesh(shapes::turned(data, turn)));
    REQUIRE(lines.size() == 4);
    CHECK(contains(lines[0], "1 facet was turned"));
    CHECK(contains(lines[0], "0 of 1 component"));
    CHECK(contains(lines[1], "1 vertex has no facet"));
    CHECK(contains(lines[2], "1 facet has no area"));
    CHECK(contains(lines[3], "1 feature edge is not on the surface"));
    for (const std::string& line : lines) CHECK_FALSE(contains(line, "\n"));

    const std::vector<std::string> two = notes(build_mesh(shapes::joined(shapes::turned(data), shapes::moved(data, {9, 0, 0}))));
    REQUIRE(two.size() == 4);
    CHECK(contains(two[0], "6 facets were turned"));
    CHECK(contains(two[0], "1 of 2 components"));
    CHECK(contains(two[1], "2 vertices have no facet"));
    CHECK(contains(two[2], "2 facets have no area"));
    CHECK(contains(two[3], "2 feature edges are not on the surface"));
}

TEST_CASE("mesh: validation sees broken arrays") {
    const TriMesh good = build_mesh(shapes::creased(shapes::cube(2)));
    CHECK_NOTHROW(validate(good));
    const Index last = good.halfedges() - 1;
    Index sharp = 0;
    while (!good.feature[sharp]) sharp++;
    const std::vector<std::function<void(TriMesh&)>> breakers = {
        [](TriMesh& m) { m.opposite[5] = kNone; },
        [&](TriMesh& m) { m.opposite[5] = last + 1; },
        [](TriMesh& m) { m.opposite[5] = 5; },
        [](TriMesh& m) { m.opposite[5] = m.opposite[6]; },
        [](TriMesh& m) { std::swap(m.opposite[0], m.opposite[1]); },
        [](TriMesh& m) { std::swap(m.origin[0], m.origin[1]); },
        [&](TriMesh& m) { m.origin[last] = m.origin[last - 1]; },
        [&](TriMesh& m) { m.feature[sharp] = 0; },
        [](TriMesh& m) { m.features_kept++; },
        [](TriMesh& m) { m.normal.pop_back(); },
        [](TriMesh& m) { m.opposite.pop_back(); },
        [](TriMesh& m) { m.feature.push_back(0); },
        [](TriMesh& m) { m.origin.resize(m.origin.size() - 3); },
    };
    for (std::size_t i = 0; i < breakers.size(); i++) {
        CAPTURE(i);
        TriMesh broken = good;
        breakers[i](broken);
        CHECK_THROWS_AS(validate(broken), std::logic_error);
    }
}

TEST_CASE("mesh: any numbering of a shape gives the same mesh, renumbered") {
    Lcg random(2);
    for (const Named& shape : all_shapes()) {
        CAPTURE(shape.name);
        const MeshData data = shapes::creased(shape.data);
        const TriMesh mesh = build_mesh(data);
        const shapes::Renumbered r = shapes::renumbered(data, random);
        const TriMesh other = build_mesh(r.data);
        CHECK(other.turned_facets == 0);
        CHECK(other.components == mesh.components);
        CHECK(other.cavities == mesh.cavities);
        CHECK(other.features_kept == mesh.features_kept);
        for (Index f = 0; f < mesh.facets(); f++) CHECK(other.normal[r.facet[f]] == mesh.normal[f]);
        for (Index h = 0; h < mesh.halfedges(); h++) {
            const Index image = find_halfedge(other, r.vertex[mesh.from(h)], r.vertex[mesh.to(h)]);
            REQUIRE(image != kNone);
            CHECK(facet(image) == r.facet[facet(h)]);
            CHECK(other.right(image) == r.facet[mesh.right(h)]);
            CHECK(other.feature[image] == mesh.feature[h]);
        }
    }
}

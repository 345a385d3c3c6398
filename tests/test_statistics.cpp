// Statistics: fidelity and feature edges by hand, classes, and what symmetries of the part must not change.
#include "polylab/statistics.h"

#include "polylab/explain.h"
#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace polylab;
using doctest::Approx;
using shapes::creased;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

Statistics statistics_of(const TriMesh& mesh, const Labeling& labels, bool allow_opposite = true) {
    return statistics(mesh, labels, build_graph(mesh, labels, allow_opposite));
}

// Random labels, then `steps` facets that take over the label of a random neighbour: patches with jagged borders.
Labeling patchy(const TriMesh& mesh, Index steps, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    for (Index i = 0; i < steps; i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

// cube(6) by its normals, but in the upper face the chart +X has a hook that runs back for three edges: two turning-points.
Labeling hooked_cube() {
    Labeling labels = naive_labeling(build_mesh(cube(6)));
    const Index squares[][2] = {{5, 4}, {4, 4}, {4, 3}, {4, 2}, {4, 1}};
    for (const auto& [x, y] : squares) labels[288 + 2 * (6 * y + x)] = labels[289 + 2 * (6 * y + x)] = kX;
    return labels;
}

// Everything that doesn't depend on numbers and axes: all but the published turning-points.
void check_same(const Statistics& a, const Statistics& b) {
    const auto counts = [](const Statistics& s) {
        return std::array{s.facets,
                          s.charts,
                          s.boundaries,
                          s.corners,
                          s.invalid_charts,
                          s.invalid_boundaries,
                          s.invalid_corners,
                          s.own_turning_points,
                          s.features_preserved,
                          s.features_lost,
                          s.features_ignored};
    };
    CHECK(counts(a) == counts(b));
    const auto close = [](double x, double y) { return std::abs(x - y) < 1e-12; };
    CHECK(close(a.fidelity_min, b.fidelity_min));
    CHECK(close(a.fidelity_avg, b.fidelity_avg));
    CHECK(close(a.fidelity_max, b.fidelity_max));
    CHECK(close(a.fidelity_sd, b.fidelity_sd));
    CHECK(close(a.fidelity_area_avg, b.fidelity_area_avg));
}

std::vector<MeshData> symmetric_test_shapes() {
    return {creased(cube(4)),
            creased(shapes::refined(shapes::l_shape())),
            creased(shapes::stair(3)),
            creased(shapes::refined(shapes::triangular_prism(4, 2, 2))),
            creased(shapes::refined(shapes::two_cubes_at_a_vertex())),
            shapes::pinched_ring(),
            shapes::refined(shapes::refined(shapes::octahedron()))};
}

}   // namespace

// ---- fidelity ----

TEST_CASE("statistics: fidelity of one facet") {
    const double half = std::sqrt(0.5);   // of the normal along an axis 45 degrees away
    CHECK(fidelity({1, 0, 0}, kX) == 1);
    CHECK(fidelity({1, 0, 0}, kNegX) == 0);
    CHECK(fidelity({1, 0, 0}, kZ) == 0.5);
    CHECK(fidelity({half, half, 0}, kX) == Approx(0.853553).epsilon(1e-6));
    CHECK(fidelity({half, half, 0}, kNegY) == Approx(0.146447).epsilon(1e-5));
    CHECK(fidelity({0, 0.5, -0.6 * std::sqrt(3.0)}, kY) == Approx(0.75));   // 60 degrees: the cosine is all that counts
    CHECK(fidelity({0, 0, 0}, kX) == 0.5);                                  // no normal
}

TEST_CASE("statistics: fidelity over facets") {
    const TriMesh mesh = build_mesh(cube(2));
    Statistics s = statistics_of(mesh, naive_labeling(mesh));
    CHECK(s.facets == 48);
    CHECK(s.fidelity_min == 1);
    CHECK(s.fidelity_avg == 1);
    CHECK(s.fidelity_max == 1);
    CHECK(s.fidelity_sd == 0);
    CHECK(s.fidelity_area_avg == 1);
    // All +X: a sixth 1, a sixth 0, the others 1/2; the deviation is 1/2 for a third of them.
    s = statistics_of(mesh, Labeling(48, kX));
    CHECK(s.fidelity_min == 0);
    CHECK(s.fidelity_avg == 0.5);
    CHECK(s.fidelity_max == 1);
    CHECK(s.fidelity_sd == Approx(std::sqrt(0.25 / 3)));
    CHECK(s.fidelity_area_avg == 0.5);
}

TEST_CASE("statistics: the average over the area weights facets, the published one does not") {
    // 4 x 1 x 2: sides of area 8, 2, 8, 2, ends of area 4, two facets each. -Y is right, +Z above as well, -Z is turned
    // over, three sides are 90 degrees off.
    const TriMesh mesh = build_mesh(shapes::prism({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}, 2));
    const Statistics s = statistics_of(mesh, {kNegY, kNegY, kZ, kZ, kZ, kZ, kZ, kZ, kZ, kZ, kZ, kZ});
    CHECK(s.fidelity_avg == Approx((2 * 1 + 6 * 0.5 + 2 * 0 + 2 * 1) / 12));
    CHECK(s.fidelity_area_avg == Approx((8 * 1 + 12 * 0.5 + 4 * 0 + 4 * 1) / 28));
    CHECK(s.fidelity_min == 0);
    CHECK(s.fidelity_max == 1);
}

TEST_CASE("statistics: fidelity at 45 degrees and without area") {
    // Of the octahedron every normal has 1/sqrt(3) along three axes.
    const TriMesh octahedron = build_mesh(shapes::octahedron());
    Statistics s = statistics_of(octahedron, naive_labeling(octahedron));
    CHECK(s.fidelity_avg == Approx((1 + std::sqrt(1.0 / 3)) / 2));
    CHECK(s.fidelity_sd == Approx(0));
    // Slanted at 45 degrees: facets 2 and 3 of 8.
    const TriMesh wedge = build_mesh(shapes::triangular_prism(1, 1, 1));
    s = statistics_of(wedge, {kNegY, kNegY, kX, kX, kNegX, kNegX, kNegZ, kZ});
    CHECK(s.fidelity_min == Approx((1 + std::sqrt(0.5)) / 2));
    CHECK(s.fidelity_avg == Approx((6 + 1 + std::sqrt(0.5)) / 8));
    // The facet without area counts as 1/2 among the facets, and for nothing in the area. -Z and -X are right.
    const TriMesh flat = build_mesh(shapes::tetrahedron_with_flat_facet());
    REQUIRE(flat.flat_facets == 1);
    Labeling labels = naive_labeling(flat);
    s = statistics_of(flat, labels);
    CHECK(s.fidelity_min == 0.5);
    labels[4] = opposite(labels[4]);
    CHECK(statistics_of(flat, labels).fidelity_avg == s.fidelity_avg);
    CHECK(statistics_of(flat, labels).fidelity_area_avg == s.fidelity_area_avg);
    CHECK(s.fidelity_area_avg > s.fidelity_avg);
}

// ---- feature edges ----

TEST_CASE("statistics: feature edges are preserved, lost or ignored") {
    const MeshData data = creased(cube(2));   // 12 edges of two parts
    TriMesh mesh = build_mesh(data);
    const Labeling naive = naive_labeling(mesh);
    const auto counts = [&](const Labeling& labels) {
        const Statistics s = statistics_of(mesh, labels);
        return std::array{s.features_preserved, s.features_lost, s.features_ignored};
    };
    CHECK(counts(naive) == std::array{24, 0, 0});
    CHECK(counts(Labeling(48, kX)) == std::array{0, 24, 0});
    Labeling labels = naive;
    std::replace(labels.begin(), labels.end(), kX, kZ);   // the edge between them is lost
    CHECK(counts(labels) == std::array{22, 2, 0});
    // In the file also: an edge once more, the diagonal of a flat square, and a line through the cube.
    MeshData more = data;
    more.edges.insert(more.edges.end(), {data.edges[1], data.edges[0]});
    more.edges.insert(more.edges.end(), {data.triangles[0], data.triangles[2]});
    more.edges.insert(more.edges.end(), {data.triangles[0], data.triangles[24]});
    mesh = build_mesh(more);
    REQUIRE(mesh.features_off == 1);
    CHECK(counts(naive) == std::array{24, 0, 3});
    // Detected edges are not the file's.
    FeatureOptions detect;
    detect.detect = true;
    mesh = build_mesh(cube(2), detect);
    CHECK(counts(naive) == std::array{24, 0, 0});
    mesh = build_mesh(cube(2));
    CHECK(counts(naive) == std::array{0, 0, 0});
}

// ---- counts and classes ----

TEST_CASE("statistics: counts are the graph's") {
    const TriMesh mesh = build_mesh(cube(3));
    Labeling labels = naive_labeling(mesh);
    labels[80] = labels[81] = kNegZ;   // one square in the middle of the upper face
    for (const bool allow_opposite : {true, false}) {
        const Statistics s = statistics_of(mesh, labels, allow_opposite);
        CHECK(s.allow_opposite == allow_opposite);
        CHECK(s.charts == 7);
        CHECK(s.invalid_charts == 1);
        CHECK(s.boundaries == 13);
        CHECK(s.invalid_boundaries == (allow_opposite ? 0 : 1));   // flat: 180 degrees
        CHECK(s.corners == 8);
        CHECK(s.invalid_corners == 0);
        CHECK(s.invalid() == (allow_opposite ? 1 : 2));
    }
}

TEST_CASE("statistics: the class of a result") {
    TriMesh mesh = build_mesh(cube(6));
    Statistics s = statistics_of(mesh, naive_labeling(mesh));
    CHECK(s.result_class() == Class::valid_monotone);
    s = statistics_of(mesh, hooked_cube());
    CHECK(s.invalid() == 0);
    CHECK(s.turning_points == 2);
    CHECK(s.own_turning_points == 2);
    CHECK(s.non_monotone_boundaries == 1);
    CHECK(s.result_class() == Class::valid_turning_points);
    s = statistics_of(mesh, Labeling(432, kX));
    CHECK(s.invalid_charts == 1);
    CHECK(s.result_class() == Class::invalid);
    // Invalid is worse than turning-points; the published count decides, not ours.
    Statistics made;
    made.turning_points = 1;
    made.invalid_corners = 1;
    CHECK(made.result_class() == Class::invalid);
    made.invalid_corners = 0;
    CHECK(made.result_class() == Class::valid_turning_points);
    made.turning_points = 0;
    made.own_turning_points = 1;
    CHECK(made.result_class() == Class::valid_monotone);
}

TEST_CASE("statistics: the summary has two lines") {
    const TriMesh mesh = build_mesh(creased(cube(6)));
    CHECK(summary(statistics_of(mesh, naive_labeling(mesh))) ==
          "valid, all monotone: 6 charts (0 invalid), 12 boundaries (0 invalid), 8 corners (0 invalid), 0 turning-points\n"
          "fidelity 1.0000 on average, 1.0000 at least; feature edges: 72 preserved, 0 lost, 0 ignored");
    // Ten of 432 facets are +X instead of +Z (1/2): the average is 1 - 5/432. The square (5,4) takes one edge away from the
    // border.
    CHECK(summary(statistics_of(mesh, hooked_cube())) ==
          "valid, with turning-points: 6 charts (0 invalid), 12 boundaries (0 invalid), 8 corners (0 invalid), 2 turning-points\n"
          "fidelity 0.9884 on average, 0.5000 at least; feature edges: 71 preserved, 1 lost, 0 ignored");
    CHECK(summary(statistics_of(mesh, Labeling(432, kX))) ==
          "not valid: 1 charts (1 invalid), 0 boundaries (0 invalid), 0 corners (0 invalid), 0 turning-points\n"
          "fidelity 0.5000 on average, 0.0000 at least; feature edges: 0 preserved, 72 lost, 0 ignored");
}

// ---- JSON ----

TEST_CASE("statistics: JSON with the published keys in the published layout") {
    const TriMesh mesh = build_mesh(creased(cube(6)));
    const Statistics s = statistics_of(mesh, naive_labeling(mesh));
    CHECK(statistics_json(s, {}) == R"({
    "boundaries": {
        "invalid": 0,
        "nb": 12,
        "non-monotone": 0
    },
    "charts": {
        "invalid": 0,
        "nb": 6
    },
    "corners": {
        "invalid": 0,
        "nb": 8
    },
    "feature-edges": {
        "lost": 0,
        "preserved": 72,
        "removed": 0
    },
    "fidelity": {
        "avg": 1.0,
        "max": 1.0,
        "min": 1.0,
        "sd": 0.0
    },
    "is_allowing_boundaries_between_opposite_labels": true,
    "polylab": {
        "class": "valid_monotone",
        "facets": 432,
        "fidelity_area_avg": 1.0,
        "turning_points": 0
    },
    "problems": [],
    "turning-points": {
        "nb": 0
    }
}
)");
}

TEST_CASE("statistics: JSON has each number in its place") {
    Statistics s;
    s.facets = 11;
    s.charts = 12, s.invalid_charts = 13;
    s.boundaries = 14, s.invalid_boundaries = 15, s.non_monotone_boundaries = 16;
    s.corners = 17, s.invalid_corners = 18;
    s.turning_points = 19, s.own_turning_points = 20;
    s.fidelity_min = 0.125, s.fidelity_avg = 0.25, s.fidelity_max = 0.5, s.fidelity_sd = 0.0625, s.fidelity_area_avg = 0.75;
    s.features_preserved = 21, s.features_lost = 22, s.features_ignored = 23;
    s.allow_opposite = false;
    std::string text = statistics_json(s, {});
    text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n'; }), text.end());
    CHECK(text ==
          R"({"boundaries":{"invalid":15,"nb":14,"non-monotone":16},"charts":{"invalid":13,"nb":12},)"
          R"("corners":{"invalid":18,"nb":17},"feature-edges":{"lost":22,"preserved":21,"removed":23},)"
          R"("fidelity":{"avg":0.25,"max":0.5,"min":0.125,"sd":0.0625},"is_allowing_boundaries_between_opposite_labels":false,)"
          R"("polylab":{"class":"invalid","facets":11,"fidelity_area_avg":0.75,"turning_points":20},"problems":[],)"
          R"("turning-points":{"nb":19}})");
}

// ---- symmetries ----

TEST_CASE("statistics: do not depend on which axis is which") {
    Lcg random(24);
    for (const MeshData& shape : symmetric_test_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        const Labeling labels = patchy(mesh, 12 * mesh.facets(), random);
        const Statistics s = statistics_of(mesh, labels);
        for (int i = 0; i < 24; i++) {
            CAPTURE(i);
            const shapes::Mapped rotated = shapes::rotated_axes(shape, i);
            check_same(statistics_of(build_mesh(rotated.data), rotated.labels(labels)), s);
        }
        for (int axis = 0; axis < 3; axis++) {
            CAPTURE(axis);
            const shapes::Mapped image = shapes::mirrored(shape, axis);
            check_same(statistics_of(build_mesh(image.data), image.labels(labels)), s);
        }
    }
}

TEST_CASE("statistics: do not depend on the numbers of facets and vertices") {
    Lcg random(25);
    Index turning_points = 0, invalid = 0;
    for (const MeshData& shape : symmetric_test_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        for (int i = 0; i < 12; i++) {
            CAPTURE(i);
            const Labeling labels = patchy(mesh, 3 * i * mesh.facets(), random);
            const Statistics s = statistics_of(mesh, labels);
            turning_points += s.own_turning_points;
            invalid += s.invalid();
            const shapes::Renumbered r = shapes::renumbered(shape, random);
            check_same(statistics_of(build_mesh(r.data), r.labels(labels)), s);
        }
    }
    CHECK(turning_points > 50);   // that there is something to keep
    CHECK(invalid > 500);
}

TEST_CASE("statistics: our turning-points do not depend on numbers where two boundaries share a vertex") {
    // Two patches of three by three squares in the upper face of cube(8) touch in (4,4). Each is closed through that corner and
    // turns at one end of both of its sides along X: four turning-points. The sides at y = 4 go from (1,4) to (4,4) and on to
    // (7,4); each takes its end with the smaller number, so that numbers decide whether both take (4,4).
    const MeshData shape = cube(8);
    Labeling labels = naive_labeling(build_mesh(shape));
    for (const Index low : {1, 4})
        for (Index i = 0; i < 9; i++)
            for (Index k = 0; k < 2; k++) labels[512 + 2 * (8 * (low + i / 3) + low + i % 3) + k] = kX;
    for (const Vec3& first : {Vec3{1, 4, 8}, Vec3{4, 4, 8}, Vec3{7, 4, 8}}) {   // this vertex becomes vertex 0
        const auto found = std::find(shape.points.begin(), shape.points.end(), first);
        const Index v = static_cast<Index>(found - shape.points.begin());
        MeshData swapped = shape;
        std::swap(swapped.points[0], swapped.points[v]);
        for (Index& w : swapped.triangles) w = w == v ? 0 : w == 0 ? v : w;
        CAPTURE(v);
        CHECK(statistics_of(build_mesh(swapped), labels).own_turning_points == 4);
    }
}

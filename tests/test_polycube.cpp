// The polycube of a labeling: shapes that are their own polycube, a width by hand, least squares as a property; distortion by
// hand; what symmetries and unusual parts must not change.
#include "polylab/polycube.h"

#include "polylab/initial_labeling.h"
#include "polylab/labeling_graph.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace polylab;
using doctest::Approx;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double largest = 0;
    for (std::size_t v = 0; v < a.size(); v++) largest = std::max(largest, norm(a[v] - b[v]));
    return largest;
}

// A trapezoid with its slanted side at +X, height 1: vertices 0..3 below, 4..7 above.
MeshData trapezoid() { return shapes::prism({{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 1); }
const Labeling kTrapezoid = {kNegY, kNegY, kX, kX, kY, kY, kNegX, kNegX, kNegZ, kNegZ, kZ, kZ};

std::vector<MeshData> rough_shapes() {
    return {shapes::refined(shapes::refined(shapes::octahedron())), shapes::refined(shapes::pyramid(7)),
            shapes::refined(shapes::triangular_prism(4, 3, 2)), trapezoid()};
}

Labeling random_labels(const TriMesh& mesh, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    return labels;
}

// What the positions are to minimise: for each facet, twice its area times the squared changes of its edges along the two axes
// that its label leaves free.
double energy(const TriMesh& mesh, const Labeling& labels, const std::vector<Vec3>& points) {
    double sum = 0;
    for (Index h = 0; h < mesh.halfedges(); h++)
        for (int a = 0; a < 3; a++) {
            if (a == axis(labels[facet(h)])) continue;
            const double change = points[mesh.to(h)][a] - points[mesh.from(h)][a] - mesh.vector(h)[a];
            sum += norm(mesh.area_vector(facet(h))) * change * change;
        }
    return sum;
}

void check_all_one(const Distortion& d) {
    CHECK(d.stretch == Approx(1));
    CHECK(d.area == Approx(1));
    CHECK(d.angle == Approx(1));
    CHECK(d.isometric == Approx(1));
    CHECK(d.collapsed == 0);
    CHECK(d.turned == 0);
}

}   // namespace

// ---- positions ----

TEST_CASE("polycube: shapes that are polycubes stay as they are, to the last bit") {
    for (const MeshData& shape : {cube(3), shapes::box(1, 2, 5), shapes::l_shape(), shapes::stair(4), shapes::frame(),
                                  shapes::hollow_box(), shapes::two_cubes_at_a_vertex(), shapes::pinched_ring()}) {
        const TriMesh mesh = build_mesh(shape);
        const std::vector<Vec3> polycube = surface_polycube(mesh, naive_labeling(mesh));
        CHECK(polycube == mesh.points);
        check_all_one(distortion(mesh, polycube));
    }
}

TEST_CASE("polycube: the width of a trapezoid, by hand") {
    // Along X the slanted side has one coordinate, the side at x = 0 another; what lies between wants lengths 4 and 2. Weights
    // are twice the areas. The lower side (4 x 1, two facets of weight 4) holds two edges of length 4 per facet; the upper one
    // (2 x 1, weight 2) two of length 2; below and above: one facet of weight 8 with edges of 4 and 2, one of weight 4 with 2 and
    // 2. Mean: (2*2*4*4 + 2*2*2*2 + 2*(8*(4+2) + 4*(2+2))) / (2*2*4 + 2*2*2 + 2*(8*2 + 4*2)) = 208 / 72.
    const TriMesh mesh = build_mesh(trapezoid());
    const std::vector<Vec3> polycube = surface_polycube(mesh, kTrapezoid);
    for (const Index v : {0, 3, 4, 7}) CHECK(polycube[v].x == Approx(1.5 - 208.0 / 144));   // 1.5: mean of all x
    for (const Index v : {1, 2, 5, 6}) CHECK(polycube[v].x == Approx(1.5 + 208.0 / 144));
    for (Index v = 0; v < 8; v++) {
        CHECK(polycube[v].y == Approx(mesh.points[v].y));
        CHECK(polycube[v].z == Approx(mesh.points[v].z));
    }
}

TEST_CASE("polycube: each chart lies in a plane across its axis") {
    Lcg random(7);
    for (const MeshData& shape : rough_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        for (const Labeling& labels : {naive_labeling(mesh), random_labels(mesh, random)}) {
            const std::vector<Vec3> polycube = surface_polycube(mesh, labels);
            for (Index h = 0; h < mesh.halfedges(); h++) {
                const int a = axis(labels[facet(h)]);
                CHECK(polycube[mesh.from(h)][a] == polycube[mesh.to(h)][a]);
            }
        }
    }
}

TEST_CASE("polycube: no move of a plane makes it better") {
    Lcg random(8);
    for (const MeshData& shape : rough_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        for (const Labeling& labels : {naive_labeling(mesh), random_labels(mesh, random)}) {
            const std::vector<Vec3> best = surface_polycube(mesh, labels);
            const double least = energy(mesh, labels, best);
            for (Index v = 0; v < mesh.vertices(); v++)
                for (int a = 0; a < 3; a++)
                    for (const double by : {-0.01 * mesh.mean_edge, 0.01 * mesh.mean_edge}) {
                        std::vector<Vec3> moved = best;   // all vertices that share this coordinate: others never have it twice
                        for (Index w = 0; w < mesh.vertices(); w++)
                            if (best[w][a] == best[v][a]) moved[w][a] += by;
                        CHECK(energy(mesh, labels, moved) >= least * (1 - 1e-9));
                    }
        }
    }
}

TEST_CASE("polycube: follows translations, scales, symmetries and numbers of the part") {
    Lcg random(9);
    for (const MeshData& shape : rough_shapes()) {
        const TriMesh mesh = build_mesh(shape);
        const Labeling labels = naive_labeling(mesh);
        const std::vector<Vec3> polycube = surface_polycube(mesh, labels);
        const double near = 1e-6 * mesh.mean_edge;

        const Vec3 far = {64, -32, 1024};
        std::vector<Vec3> expected = polycube;
        for (Vec3& p : expected) p += far;
        CHECK(distance(surface_polycube(build_mesh(shapes::moved(shape, far)), labels), expected) < near);

        expected = polycube;
        for (Vec3& p : expected) p = p * 4;
        CHECK(surface_polycube(build_mesh(shapes::scaled(shape, 4)), labels) == expected);   // powers of two round nothing

        for (int i = 0; i < 24; i++) {
            MeshData image = shape;
            image.points = polycube;
            const shapes::Mapped mapped = shapes::rotated_axes(shape, i);
            CHECK(distance(surface_polycube(build_mesh(mapped.data), mapped.labels(labels)),
                           shapes::rotated_axes(image, i).data.points) < near);
        }

        const shapes::Renumbered other = shapes::renumbered(shape, random);
        const std::vector<Vec3> there = surface_polycube(build_mesh(other.data), other.labels(labels));
        for (Index v = 0; v < mesh.vertices(); v++) CHECK(norm(there[other.vertex[v]] - polycube[v]) < near);
    }
}

TEST_CASE("polycube: opposite labels in one plane, all labels equal, facets without area, parts without size") {
    TriMesh mesh = build_mesh(cube(2));
    for (Label l = 0; l < kLabels; l++) {   // everything in one plane: the facets across it stay, the others collapse
        const Distortion d = distortion(mesh, surface_polycube(mesh, Labeling(mesh.facets(), l)));
        CHECK(d.collapsed == 32);
        CHECK(d.turned == 0);
        CHECK(std::isfinite(d.stretch + d.area + d.angle + d.isometric));
    }
    for (const MeshData& shape : {shapes::pillow(), shapes::tetrahedron_with_flat_facet(), shapes::octahedron()}) {
        mesh = build_mesh(shape);
        const std::vector<Vec3> polycube = surface_polycube(mesh, naive_labeling(mesh));
        for (const Vec3& p : polycube) CHECK(std::isfinite(p.x + p.y + p.z));
        const Distortion d = distortion(mesh, polycube);
        CHECK(std::isfinite(d.stretch + d.area + d.angle + d.isometric));
    }
    MeshData point = cube(1);
    for (Vec3& p : point.points) p = {1, 2, 3};
    mesh = build_mesh(point);
    CHECK(surface_polycube(mesh, Labeling(12, kX)) == mesh.points);
    const Distortion none = distortion(mesh, mesh.points);
    CHECK(none.stretch == 0);
    CHECK(none.area == 0);
    CHECK(none.collapsed == 0);
    for (const double size : {1e-12, 1e70}) {
        mesh = build_mesh(shapes::scaled(trapezoid(), size));
        CHECK(surface_polycube(mesh, kTrapezoid)[1].x / size == Approx(1.5 + 208.0 / 144));
    }
}

TEST_CASE("polycube: vertices without facet stay, and parts of a whole keep their places") {
    MeshData two = shapes::joined(trapezoid(), shapes::moved(trapezoid(), {10, 20, 30}));
    two.points.push_back({-5, -6, -7});
    const TriMesh mesh = build_mesh(two), one = build_mesh(trapezoid());
    Labeling labels = kTrapezoid;
    labels.insert(labels.end(), kTrapezoid.begin(), kTrapezoid.end());
    const std::vector<Vec3> polycube = surface_polycube(mesh, labels), single = surface_polycube(one, kTrapezoid);
    CHECK(polycube.back() == Vec3{-5, -6, -7});
    for (Index v = 0; v < 8; v++) {
        CHECK(norm(polycube[v] - single[v]) < 1e-9);
        CHECK(norm(polycube[v + 8] - single[v] - Vec3{10, 20, 30}) < 1e-9);
    }
}

// ---- distortion ----

TEST_CASE("distortion: a stretched cube, by hand") {
    // Twice as long along X: areas of 2 * 1 + 4 * 2 = 10 for 6, so lengths are scaled by k = sqrt(0.6). Two sides have
    // s = (k, k), four have (2k, k).
    const TriMesh mesh = build_mesh(cube(1));
    std::vector<Vec3> stretched = mesh.points;
    for (Vec3& p : stretched) p.x *= 2;
    const double k = std::sqrt(0.6);
    const Distortion d = distortion(mesh, stretched);
    CHECK(d.stretch == Approx(std::pow((2 * 0.6 + 4 * 0.6 * 2.5) / 6, -2)));
    CHECK(d.area == Approx((2 * (0.6 + 1 / 0.6) + 4 * (1.2 + 1 / 1.2)) / 12));
    CHECK(d.angle == Approx((2 * 1 + 4 * 1.25) / 6));
    CHECK(d.isometric == Approx((2 / k + 4 * 2 * k) / 6));
    CHECK(d.collapsed == 0);
    CHECK(d.turned == 0);
}

TEST_CASE("distortion: is independent of place and size, and of a rotation of the polycube but for the turned facets") {
    const TriMesh mesh = build_mesh(trapezoid());
    std::vector<Vec3> polycube = surface_polycube(mesh, kTrapezoid);
    const Distortion d = distortion(mesh, polycube);
    CHECK(d.angle > 1.001);
    for (Vec3& p : polycube) p = Vec3{-p.y, p.x, p.z} * 3 + Vec3{1, 2, 3};   // a quarter turn around Z
    const Distortion e = distortion(mesh, polycube);
    CHECK(e.stretch == Approx(d.stretch));
    CHECK(e.area == Approx(d.area));
    CHECK(e.angle == Approx(d.angle));
    CHECK(e.isometric == Approx(d.isometric));
}

TEST_CASE("distortion: counts what collapses and what turns over") {
    const TriMesh mesh = build_mesh(cube(1));
    std::vector<Vec3> points = mesh.points;
    for (Vec3& p : points) p.x = -p.x;             // a mirror: its image of a facet faces the mirror image's other side
    CHECK(distortion(mesh, points).turned == 8);   // so all but those across X, which the mirror turns back
    points = mesh.points;
    for (Vec3& p : points) p.z = 0;
    const Distortion flat = distortion(mesh, points);   // two sides are left, at three times their area
    CHECK(flat.collapsed == 8);
    CHECK(flat.area == Approx((3 + 1.0 / 3) / 2));
    CHECK(flat.angle == Approx(1));
    points.assign(points.size(), Vec3{1, 1, 1});
    const Distortion nothing = distortion(mesh, points);
    CHECK(nothing.collapsed == 12);
    CHECK(nothing.stretch == 0);
    CHECK(nothing.angle == 0);
}

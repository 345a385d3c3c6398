#include "polylab/initial_labeling.h"

#include "polylab/io.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace polylab;

namespace {

// A mesh of single normals, as far as labels of facets are concerned.
TriMesh facets_with_normals(const std::vector<Vec3>& normals) {
    TriMesh mesh;
    mesh.normal = normals;
    return mesh;
}

Label naive_label(const Vec3& normal) { return naive_labeling(facets_with_normals({normal}))[0]; }

// Two facets per side, as box() makes them: label f / (facets / 6).
Labeling cube_labels(int n) {
    Labeling labels(12 * n * n);
    for (std::size_t f = 0; f < labels.size(); f++) labels[f] = static_cast<Label>(f / (2 * n * n));
    return labels;
}

const double kHalf = std::sqrt(0.5);

// A box with one edge cut off at 45 degrees: sides 0..4 face -Y, +X, (1,1,0), +Y, -X.
MeshData chamfered() { return shapes::prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 2); }

}   // namespace

TEST_CASE("initial labeling: naive labels are the closest directions") {
    CHECK(naive_labeling(build_mesh(shapes::cube(3))) == cube_labels(3));
    CHECK(naive_label({0.6, 0, 0.8}) == 4);
    CHECK(naive_label({-0.8, 0.6, 0}) == 1);
    CHECK(naive_label({0.48, -0.64, 0.6}) == 3);
    CHECK(naive_label({0, 0.6, -0.8}) == 5);
}

TEST_CASE("initial labeling: naive ties go to X before Y before Z") {
    const double s = kHalf, t = std::sqrt(1.0 / 3);
    CHECK(naive_label({s, s, 0}) == 0);
    CHECK(naive_label({-s, s, 0}) == 1);
    CHECK(naive_label({s, 0, -s}) == 0);
    CHECK(naive_label({-s, 0, s}) == 1);
    CHECK(naive_label({0, s, s}) == 2);
    CHECK(naive_label({0, -s, s}) == 3);
    CHECK(naive_label({0, s, -s}) == 2);
    for (int i = 0; i < 8; i++)   // all eight corners of a cube
        CHECK(naive_label({i & 1 ? -t : t, i & 2 ? -t : t, i & 4 ? -t : t}) == (i & 1));
    CHECK(naive_label({0, 0, 0}) == 0);
    CHECK(naive_label({-0.0, -0.0, -0.0}) == 0);
}

TEST_CASE("initial labeling: naive labels are not tilted") {
    // Slanted at 45 degrees exactly: a tilt would give +Y.
    const MeshData data = shapes::triangular_prism(1, 1, 1);
    CHECK(naive_labeling(build_mesh(data)) == Labeling{3, 3, 0, 0, 1, 1, 5, 4});
}

TEST_CASE("initial labeling: naive labels follow the facets through symmetries of the axes") {
    shapes::Lcg random(14);
    for (const MeshData& data : {shapes::cube(2), shapes::l_shape(), shapes::stair(3), shapes::frame(), shapes::hollow_box(),
                                 shapes::triangular_prism(2, 3, 1), shapes::two_cubes_at_a_vertex()}) {
        const Labeling labels = naive_labeling(build_mesh(data));
        for (int i = 0; i < 24; i++) {
            const shapes::Mapped m = shapes::rotated_axes(data, i);
            const TriMesh mesh = build_mesh(m.data);
            CHECK(mesh.turned_facets == 0);
            CHECK(naive_labeling(mesh) == m.labels(labels));
        }
        for (int axis = 0; axis < 3; axis++) {
            const shapes::Mapped m = shapes::mirrored(data, axis);
            const TriMesh mesh = build_mesh(m.data);
            CHECK(mesh.turned_facets == 0);
            CHECK(naive_labeling(mesh) == m.labels(labels));
        }
        const shapes::Renumbered r = shapes::renumbered(data, random);
        CHECK(naive_labeling(build_mesh(r.data)) == r.labels(labels));
    }
}

TEST_CASE("initial labeling: facets at 45 degrees are tilted") {
    const std::vector<char> tilt = facets_to_tilt(build_mesh(shapes::triangular_prism(3, 3, 1)), 1e-9);
    CHECK(tilt == std::vector<char>{0, 0, 1, 1, 0, 0, 0, 0});
    const double t = std::sqrt(1.0 / 3);
    const TriMesh mesh = facets_with_normals(
        {{kHalf, kHalf, 0}, {-kHalf, 0, kHalf}, {0, -kHalf, -kHalf}, {t, -t, t}, {1, 0, 0}, {0.6, 0, 0.8}, {-0.8, 0.6, 0}});
    CHECK(facets_to_tilt(mesh, 1e-9) == std::vector<char>{1, 1, 1, 1, 0, 0, 0});
    // The third largest component has no say.
    CHECK(facets_to_tilt(facets_with_normals({{0.2, 0.2, std::sqrt(0.92)}}), 1e-9) == std::vector<char>{0});
}

TEST_CASE("initial labeling: the sensitivity is the least difference of the two best weights that is safe") {
    // Legs 1000 and 1001: the slanted normal is (1001, 1000, 0) / 1414.92, its components differ by 0.00070675.
    const TriMesh mesh = build_mesh(shapes::triangular_prism(1000, 1001, 1));
    CHECK(facets_to_tilt(mesh, 0.0007067)[2] == 0);
    CHECK(facets_to_tilt(mesh, 0.0007068)[2] == 1);
    // Strictly: with 0 not even equal weights are tilted.
    CHECK(facets_to_tilt(build_mesh(shapes::triangular_prism(1, 1, 1)), 0) == std::vector<char>(8, 0));
}

TEST_CASE("initial labeling: the tilt is a rotation around X, then Y, then Z") {
    for (const double angle : {0.0, 0.05, -0.3, 1.0}) {
        CAPTURE(angle);
        const double c = std::cos(angle), s = std::sin(angle);
        for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{kHalf, -kHalf, 0}, Vec3{0.48, -0.64, 0.6}}) {
            const Vec3 x = {n.x, c * n.y - s * n.z, s * n.y + c * n.z};
            const Vec3 y = {c * x.x + s * x.z, x.y, c * x.z - s * x.x};
            const Vec3 z = {c * y.x - s * y.y, s * y.x + c * y.y, y.z};
            CHECK(norm(tilted(n, sin_cos(angle)) - z) < 2e-15);
        }
    }
    // c = 0.998750, s = 0.049979. x: 0.70711 (c^2 + s c (s - 1)) = 0.67182; y: 0.70711 (s c + s^3 + c^2) = 0.74073
    const Vec3 t = tilted({kHalf, kHalf, 0}, sin_cos(0.05));
    CHECK(std::abs(t.x - 0.672) < 0.0005);
    CHECK(std::abs(t.y - 0.741) < 0.0005);
    CHECK(std::abs(t.z) < 0.0005);
}

TEST_CASE("initial labeling: costs of a label and of a border") {
    // 300 (1 - exp(-((n.d - 1) / 0.2)^2 / 2)): for n.d = 0.6 300 (1 - exp(-2)) = 259.4, for 0.8 300 (1 - exp(-0.5)) = 118.04
    const Vec3 n = {0.6, 0, -0.8};
    CHECK(data_cost(n, 0, 3) == 259);
    CHECK(data_cost(n, 2, 3) == 299);   // 300 (1 - exp(-12.5)) = 299.999
    CHECK(data_cost(n, 3, 3) == 299);
    CHECK(data_cost(n, 5, 3) == 118);
    CHECK(data_cost({0, 1, 0}, 2, 3) == 0);
    CHECK(data_cost({0, 1, 0}, 3, 3) == 300);
    CHECK(data_cost({0, 1, 0}, 0, 3) == 299);
    CHECK(data_cost(n, 5, 1) == 39);         // 39.35
    CHECK(data_cost(n, 5, 1000) == 39346);   // 39346.93
    CHECK(data_cost(n, 5, 0) == 0);
    // 100 exp(-((n.m - 1) / 0.25)^2 / 2): n.m = 0.75: 60.65; n.m = 0.5: 100 exp(-2) = 13.53; n.m = 0: 0.03
    const Vec3 x = {1, 0, 0};
    CHECK(pairwise_cost(x, x, 1) == 100);
    CHECK(pairwise_cost(x, {0.75, 0.6, 0.2}, 1) == 60);
    CHECK(pairwise_cost({0.5, 0.8, 0.3}, x, 1) == 13);
    CHECK(pairwise_cost(x, {0, 1, 0}, 1) == 0);
    CHECK(pairwise_cost(x, {-1, 0, 0}, 1) == 0);
    CHECK(pairwise_cost({0.5, 0.8, 0.3}, x, 10) == 135);
    CHECK(pairwise_cost(x, {0, 1, 0}, 1000) == 33);   // 100000 exp(-8) = 33.5
    CHECK(pairwise_cost(x, x, 0) == 0);
}

TEST_CASE("initial labeling: the energy has one site per facet and one edge per mesh edge") {
    for (const MeshData& data : {shapes::cube(2), shapes::pyramid(5), shapes::frame(), shapes::tetrahedron_with_flat_facet()}) {
        const TriMesh mesh = build_mesh(data);
        const PottsEnergy energy = labeling_energy(mesh);
        REQUIRE(energy.sites() == mesh.facets());
        REQUIRE(energy.arcs.size() == energy.data.size());
        for (Index h = 0; h < mesh.halfedges(); h++) {
            const auto [site, weight] = energy.arcs[mesh.left(h)][h % 3];
            CHECK(site == mesh.right(h));
            CHECK(weight == pairwise_cost(mesh.normal[mesh.left(h)], mesh.normal[site], 1));
        }
    }
}

TEST_CASE("initial labeling: free feature edges cost nothing, all else is the same") {
    const TriMesh mesh = build_mesh(read_mesh(std::string(POLYLAB_SOURCE_DIR) + "/golden/cases/countersunk/in.obj"));
    InitialOptions options;
    options.free_features = true;
    const PottsEnergy energy = labeling_energy(mesh), free = labeling_energy(mesh, options);
    CHECK(free.data == energy.data);
    Index cheaper = 0;
    for (Index h = 0; h < mesh.halfedges(); h++) {
        const Index weight = energy.arcs[facet(h)][h % 3].weight;
        CHECK(free.arcs[facet(h)][h % 3].weight == (mesh.feature[h] ? 0 : weight));
        cheaper += mesh.feature[h] && weight > 0;
    }
    CHECK(cheaper > 0);
}

TEST_CASE("initial labeling: energies of a cube counted by hand") {
    const TriMesh mesh = build_mesh(shapes::cube(1));
    const PottsEnergy energy = labeling_energy(mesh);
    Labeling labels = cube_labels(1);
    CHECK(energy(labels) == 0);   // every border is a right angle
    CHECK(energy(Labeling(12, 0)) == 2 * 0 + 2 * 300 + 8 * 299);
    labels[8] = 0;   // one of two facets on top: its data, one flat border
    CHECK(energy(labels) == 299 + 100);
    labels[9] = 5;
    CHECK(energy(labels) == 299 + 300 + 100);

    InitialOptions options;
    options.fidelity = 10;
    options.compactness = 2;
    labels = cube_labels(1);
    labels[8] = 0;
    CHECK(labeling_energy(mesh, options)(labels) == 999 + 200);   // 1000 (1 - exp(-12.5)) = 999.996
}

TEST_CASE("initial labeling: a facet without area has neither preference nor border") {
    const TriMesh mesh = build_mesh(shapes::tetrahedron_with_flat_facet());
    const PottsEnergy energy = labeling_energy(mesh);
    for (Label l = 0; l < kLabels; l++) CHECK(energy.data[4][l] == 299);   // n.d = 0, tilted or not
    for (Index f = 0; f < mesh.facets(); f++)
        for (const auto& [other, weight] : energy.arcs[f])
            if (f == 4 || other == 4) CHECK(weight == 0);
}

TEST_CASE("initial labeling: tilted normals count in the data cost only") {
    const TriMesh mesh = build_mesh(chamfered());
    const PottsEnergy energy = labeling_energy(mesh);
    for (Index f = 4; f < 6; f++) {   // normal (0.672, 0.741, 0) after the tilt
        CHECK(energy.data[f][0] == 221);
        CHECK(energy.data[f][2] == 170);
    }
    for (Index f = 0; f < mesh.facets(); f++)
        for (const auto& [other, weight] : energy.arcs[f]) {
            const Index a = f / 2, b = other / 2;   // sides
            if ((a == 2) == (b == 2) || a > 4 || b > 4) continue;
            CHECK(weight == 50);   // at 45 degrees; with the tilted normal it would be 42 to +X, 58 to +Y
        }
    InitialOptions untilted;
    untilted.sensitivity = 0;
    CHECK(labeling_energy(mesh, untilted).data[4][0] == 197);
    CHECK(labeling_energy(mesh, untilted).data[4][2] == 197);
}

TEST_CASE("initial labeling: graph-cut of shapes with right angles is the naive labeling") {
    // Its energy is 0, and no other labeling's is.
    for (const MeshData& data : {shapes::cube(1), shapes::cube(5), shapes::l_shape(), shapes::stair(4), shapes::frame(),
                                 shapes::hollow_box(), shapes::two_cubes_at_a_vertex(), shapes::pinched_ring()}) {
        const TriMesh mesh = build_mesh(data);
        const Labeling labels = graphcut_labeling(mesh);
        CHECK(labels == naive_labeling(mesh));
        CHECK(labeling_energy(mesh)(labels) == 0);
    }
}

TEST_CASE("initial labeling: a side at 45 degrees gets one label everywhere") {
    // Its borders are free (135 and 90 degrees), so the tilt decides: +Y, 170 against 221. As many facets as it has.
    MeshData data = shapes::triangular_prism(1, 1, 1);
    for (int i = 0; i < 3; i++) data = shapes::refined(data);
    const TriMesh mesh = build_mesh(data);
    const Labeling labels = graphcut_labeling(mesh);
    const Label side[] = {3, 3, 2, 2, 1, 1, 5, 4};   // of the coarse facets; each has become 64
    for (Index f = 0; f < mesh.facets(); f++) CHECK(labels[f] == side[f / 64]);
    CHECK(labeling_energy(mesh)(labels) == 2 * 64 * 170);
}

TEST_CASE("initial labeling: a chamfer goes where its borders and the tilt send it") {
    // +Y: 2 * 170 for its facets, 50 for the edge to the +X side.   +X: 2 * 221 + 50.   All other borders are free.
    const TriMesh mesh = build_mesh(chamfered());
    const Labeling labels = graphcut_labeling(mesh);
    CHECK(labels == Labeling{3, 3, 0, 0, 2, 2, 2, 2, 1, 1, 5, 5, 5, 4, 4, 4});
    CHECK(labeling_energy(mesh)(labels) == 390);
    // Without compactness each facet takes its best label; without fidelity nothing gains by leaving +X.
    InitialOptions options;
    options.compactness = 0;
    CHECK(graphcut_labeling(mesh, options) == labels);
    CHECK(labeling_energy(mesh, options)(labels) == 340);
    options = {};
    options.fidelity = 0;
    CHECK(graphcut_labeling(mesh, options) == Labeling(mesh.facets(), 0));
}

TEST_CASE("initial labeling: a ridge has labels of its own until compactness outweighs them") {
    //  8 +--------+        Sides 2 and 3 face (1,-2) and (1,2): n.Y = 0.894, 39 each of their two facets as -Y and +Y;
    //    |        |        n.X = 0.447, 293 as +X. One edge each to the +X sides 1 and 4, 8.67 times the compactness.
    //  5 |        +.       Own labels: 2 * 39 + 8.67 c.   +X: 2 * 293. Equal at c = 58.6.
    //  4 |          '>+
    //  3 |        +'       8
    //  0 +--------+       10
    const std::vector<Vec3> contour = {{0, 0, 0}, {8, 0, 0}, {8, 3, 0}, {10, 4, 0}, {8, 5, 0}, {8, 8, 0}, {0, 8, 0}};
    const TriMesh mesh = build_mesh(shapes::prism(contour, 1));
    Labeling expected = {3, 3, 0, 0, 3, 3, 2, 2, 0, 0, 2, 2, 1, 1, 5, 5, 5, 5, 5, 4, 4, 4, 4, 4};
    InitialOptions options;
    CHECK(graphcut_labeling(mesh, options) == expected);
    options.compactness = 55;
    CHECK(graphcut_labeling(mesh, options) == expected);
    options.compactness = 62;
    for (Index f = 4; f < 8; f++) expected[f] = 0;
    CHECK(graphcut_labeling(mesh, options) == expected);
}

TEST_CASE("initial labeling: graph-cut is two cycles of expansion, from +X everywhere") {
    std::vector<Vec3> decagon = shapes::pyramid(10).points;
    decagon.pop_back();   // the apex
    InitialOptions options;
    options.compactness = 3;
    options.fidelity = 1;
    const TriMesh column = build_mesh(shapes::prism(decagon, 100));
    PottsEnergy energy = labeling_energy(column, options);
    const Labeling start(column.facets(), 0);
    REQUIRE(alpha_expansion(energy, start, 1) != alpha_expansion(energy, start, 2));   // it needs the second cycle
    CHECK(graphcut_labeling(column, options) == alpha_expansion(energy, start, 2));

    options.fidelity = 3;
    const TriMesh tent = build_mesh(shapes::pyramid(5));
    energy = labeling_energy(tent, options);
    const Labeling from_x = alpha_expansion(energy, Labeling(tent.facets(), 0), 2);
    REQUIRE(from_x != alpha_expansion(energy, naive_labeling(tent), 2));   // the start matters
    CHECK(graphcut_labeling(tent, options) == from_x);
}

TEST_CASE("initial labeling: graph-cut labels do not depend on the numbering") {
    shapes::Lcg random(15);
    MeshData round_one = shapes::octahedron();   // normals at equal distance to three labels: ties everywhere
    for (int i = 0; i < 2; i++) round_one = shapes::refined(round_one);
    const MeshData fine_tetrahedron = shapes::refined(shapes::tetrahedron());
    for (const MeshData& data : {round_one, fine_tetrahedron, shapes::pyramid(9), shapes::pyramid(30), chamfered()}) {
        const Labeling labels = graphcut_labeling(build_mesh(data));
        for (int round = 0; round < 5; round++) {
            const shapes::Renumbered r = shapes::renumbered(data, random);
            CHECK(graphcut_labeling(build_mesh(r.data)) == r.labels(labels));
        }
    }
}

TEST_CASE("initial labeling: graph-cut is never worse than its start and any single label") {
    for (const MeshData& data : {shapes::pyramid(9), shapes::pyramid(40), shapes::octahedron(), chamfered()}) {
        const TriMesh mesh = build_mesh(data);
        const PottsEnergy energy = labeling_energy(mesh);
        const std::int64_t reached = energy(graphcut_labeling(mesh));
        for (Label l = 0; l < kLabels; l++) CHECK(reached <= energy(Labeling(mesh.facets(), l)));
    }
}

TEST_CASE("initial labeling: a graph-cut that is stopped gives no more energy than the naive labels") {
    const TriMesh mesh = build_mesh(shapes::refined(shapes::l_shape()));
    const PottsEnergy energy = labeling_energy(mesh);
    Labeling locks(mesh.facets(), kNoLabel);
    locks[3] = 5;
    for (int most = 0; most < 14; most++) {
        int asked = 0;
        const Labeling labels = graphcut_labeling(mesh, {}, {}, [&] { return asked++ >= most; });
        CHECK(energy(labels) <= energy(naive_labeling(mesh)));
        asked = 0;
        CHECK(graphcut_labeling(mesh, {}, locks, [&] { return asked++ >= most; })[3] == 5);
    }
    int asked = 0;
    graphcut_labeling(mesh, {}, {}, [&] { return asked++ < 0; });
    CHECK(asked > 6);   // before each move
    CHECK(graphcut_labeling(mesh, {}, {}, [] { return false; }) == graphcut_labeling(mesh));
}

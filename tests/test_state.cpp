// State: scores by hand, their order, and patches, with and without locks, against states made from scratch.
#include "polylab/state.h"

#include "polylab/initial_labeling.h"
#include "polylab/statistics.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

// The two facets of the square [x,x+1] x [y,y+1] of the upper face of cube(n), relabeled.
Patch square(Index n, Index x, Index y, Label label) {
    const Index f = 8 * n * n + 2 * (n * y + x);
    return {{f, label}, {f + 1, label}};
}

Labeling with(Labeling labels, const Patch& patch) {
    for (const Relabel& r : patch) labels[r.facet] = r.label;
    return labels;
}

// By its normals, but for the patch.
State state_of(const TriMesh& mesh, const Patch& patch, bool allow_opposite = true) {
    return Judge(mesh, allow_opposite).state(with(naive_labeling(mesh), patch));
}

Patch upper_face(Index n, Label label) {
    Patch patch;
    for (Index f = 8 * n * n; f < 10 * n * n; f++) patch.push_back({f, label});
    return patch;
}

Patch relabel_all(const TriMesh& mesh, Label label) {
    Patch patch;
    for (Index f = 0; f < mesh.facets(); f++) patch.push_back({f, label});
    return patch;
}

Patch random_patch(Index facets, Lcg& random) {
    Patch patch;
    for (Index i = random.below(facets); i >= 0; i--)
        patch.push_back({random.below(facets), static_cast<Label>(random.below(kLabels))});
    return patch;
}

void check_score(const Score& score, Index invalid, Index turning_points, std::int64_t loss) {
    CHECK(score.invalid == invalid);
    CHECK(score.turning_points == turning_points);
    CHECK(score.loss == loss);
}

// Two ways to the same labeling give the same state.
void check_equal(const State& a, const State& b) {
    CHECK(a.labels == b.labels);
    CHECK(graph_text(a.graph) == graph_text(b.graph));
    CHECK(a.graph.allow_opposite == b.graph.allow_opposite);
    CHECK(a.score == b.score);
    CHECK(a.turning.vertices == b.turning.vertices);
    REQUIRE(a.turning.points.size() == b.turning.points.size());
    for (std::size_t i = 0; i < a.turning.points.size(); i++) {
        CHECK(a.turning.points[i].boundary == b.turning.points[i].boundary);
        CHECK(a.turning.points[i].position == b.turning.points[i].position);
    }
}

}   // namespace

TEST_CASE("state: the score of a cube with a patch, by hand") {
    const TriMesh mesh = build_mesh(cube(3));
    check_score(state_of(mesh, {}).score, 0, 0, 0);
    // One closed boundary around the patch: it has too few. Two facets at 90 degrees lose half of their fidelity each.
    // Turning back once around a square would cost 2 x 60, the one edge that goes back costs 46.
    check_score(state_of(mesh, square(3, 1, 1, kX)).score, 1, 0, 1000000);
    // The opposite label loses all, and ten times as much for pointing away; its boundary is flat, and invalid only where
    // opposite labels never may meet.
    check_score(state_of(mesh, square(3, 1, 1, kNegZ)).score, 1, 0, 22000000);
    check_score(state_of(mesh, square(3, 1, 1, kNegZ), false).score, 2, 0, 22000000);
}

TEST_CASE("state: a bay has a turning-point") {
    // A bay of +Y in the upper face, two squares deep, open to +X: it has two neighbours only, and its boundary with +Z goes
    // along -X, across and along +X. Going back costs 2 x 46, one turn next to the edge across 60.
    const TriMesh mesh = build_mesh(cube(5));
    Patch bay = square(5, 4, 2, kY);
    for (const Relabel& r : square(5, 3, 2, kY)) bay.push_back(r);
    const State state = state_of(mesh, bay);
    check_score(state.score, 1, 1, 4 * 500000);
    CHECK(state.turning.points.size() == 1);
}

TEST_CASE("state: fidelity enters as a whole number of millionths") {
    // Slanted facets 2 and 3 have the normal (4, 3, 0) / 5, fidelity 0.9 for +X and 0.8 for +Y; at 45 degrees
    // (1 - 0.70710678) / 2 = 0.1464466, rounded.
    const TriMesh slanted = build_mesh(shapes::triangular_prism(3, 4, 1)),
                  diagonal = build_mesh(shapes::triangular_prism(1, 1, 1));
    CHECK(Judge(slanted).state({3, 3, kX, kX, 1, 1, kNegZ, kZ}).score.loss == 2 * 100000);
    CHECK(Judge(slanted).state({3, 3, kX, kY, 1, 1, kNegZ, kZ}).score.loss == 100000 + 200000);
    CHECK(Judge(diagonal).state({3, 3, kX, kX, 1, 1, kNegZ, kZ}).score.loss == 2 * 146447);
}

TEST_CASE("state: a facet without area loses half") {
    const TriMesh mesh = build_mesh(shapes::tetrahedron_with_flat_facet());
    const State right = Judge(mesh).state(naive_labeling(mesh));
    CHECK(Judge(mesh).state(with(right.labels, {{4, kZ}})).score.loss == right.score.loss);   // whatever its label
    // Facets 1, 2, 3, 5 face an axis; facet 0 has fidelity (1 + 0.57735) / 2.
    CHECK(right.score.loss == 211325 + 500000);
}

TEST_CASE("state: lost feature edges weigh half of what all fidelity weighs") {
    // 12 facets, 12 feature edges: each is worth half a facet. One label everywhere: 8 facets lose half of their fidelity, 2
    // all of it and point away; all edges are lost.
    const TriMesh mesh = build_mesh(shapes::creased(cube(1)));
    CHECK(Judge(mesh).state(Labeling(12, kZ)).score.loss == 8 * 500000 + 2 * 11000000 + 12 * 500000);
    CHECK(Judge(build_mesh(cube(1))).state(Labeling(12, kZ)).score.loss == 26000000);
}

TEST_CASE("state: a facet points away from its label below a fidelity of 0.3") {
    // The slanted facets of the prism have normals (4, 3, 0) / 5 and (3, 4, 0) / 5: fidelity 0.2 and 0.1 for -Y; with
    // (8, 3, 0) / sqrt(73) it is 0.3244.
    const auto loss = [](int a, int b) { return Judge(build_mesh(shapes::triangular_prism(a, b, 1))).loss(2, kNegY); };
    CHECK(loss(3, 4) == 800000 + 10000000);
    CHECK(loss(4, 3) == 900000 + 10000000);
    CHECK(loss(3, 8) == 675562);
}

TEST_CASE("state: each chart that a component lacks of six counts three times") {
    // One chart, without any boundary: it is invalid and five are missing. Of two cubes both lack five.
    CHECK(Judge(build_mesh(cube(1))).state(Labeling(12, kZ)).score.invalid == 1 + 3 * 5);
    CHECK(Judge(build_mesh(shapes::two_cubes_at_a_vertex())).state(Labeling(24, kZ)).score.invalid == 2 + 3 * 10);
    // More than six make up for nothing.
    CHECK(state_of(build_mesh(cube(3)), square(3, 1, 1, kX)).score.invalid == 1);
}

TEST_CASE("state: a face that joins its neighbour loses the edges between them") {
    // 108 facets and 36 feature edges: an edge is worth 1.5 facets. The upper face as +X: 18 facets at 90 degrees, 3 edges.
    // +Y and -Y keep three neighbours, +X and -X meet at a convex edge; at its ends, next to opposite labels, axes count for
    // nothing.
    const TriMesh mesh = build_mesh(shapes::creased(cube(3)));
    check_score(state_of(mesh, upper_face(3, kX)).score, 3 + 3, 0, 18 * 500000 + 3 * 1500000);
    check_score(state_of(build_mesh(cube(3)), upper_face(3, kX)).score, 3 + 3, 0, 18 * 500000);
}

TEST_CASE("state: the loss is what the statistics say") {
    // (mean of (1 - fidelity) + half of the share of lost edges) times facets + 10 for each that points away, up to rounding by
    // one per facet and edge
    Lcg random(11);
    for (const MeshData& data :
         {shapes::creased(shapes::triangular_prism(2, 5, 3)), shapes::creased(shapes::pyramid(5)), shapes::creased(cube(2))}) {
        const TriMesh mesh = build_mesh(data);
        const State state = Judge(mesh).state(with(naive_labeling(mesh), random_patch(mesh.facets(), random)));
        const Statistics s = statistics(mesh, state.labels, state.graph);
        const double lost = double(s.features_lost) / (s.features_lost + s.features_preserved);
        Index away = 0;
        for (Index f = 0; f < mesh.facets(); f++) away += (1 + along(mesh.normal[f], state.labels[f])) / 2 < 0.3;
        const double expected = ((1 - s.fidelity_avg + 0.5 * lost) * s.facets + 10 * away) * 1e6;
        CHECK(std::abs(static_cast<double>(state.score.loss) - expected) <= s.facets + mesh.features_kept);
        CHECK(state.score.invalid == s.invalid() + 3 * std::max(0, 6 - s.charts));
        CHECK(state.score.turning_points == s.own_turning_points);
    }
}

TEST_CASE("state: scores compare validity, then turning-points, then loss") {
    const Score best = {0, 0, 5}, turning = {0, 1, 0}, invalid = {1, 0, 0}, more_invalid = {2, 0, 0};
    CHECK(best < turning);   // a better loss makes up for nothing
    CHECK(turning < invalid);
    CHECK(invalid < more_invalid);
    CHECK_FALSE(turning < best);
    CHECK_FALSE(invalid < turning);
    CHECK(Score{0, 1, 4} < Score{0, 1, 5});
    CHECK_FALSE(Score{0, 1, 5} < Score{0, 1, 5});
    CHECK(Score{0, 1, 5} == Score{0, 1, 5});
    CHECK_FALSE(Score{0, 1, 5} == Score{0, 1, 4});
    CHECK_FALSE(Score{0, 1, 5} == Score{0, 2, 5});
    CHECK_FALSE(Score{0, 1, 5} == Score{1, 1, 5});
    CHECK(Score{0, 0, 3000000000} < Score{0, 0, 5000000000});   // beyond 32 bits
}

TEST_CASE("state: a patch gives the state of the patched labeling") {
    Lcg random(23);
    for (const MeshData& data :
         {cube(2), shapes::creased(shapes::stair(3)), shapes::two_cubes_at_a_vertex(), shapes::refined(shapes::octahedron())}) {
        const TriMesh mesh = build_mesh(data);
        for (const bool allow_opposite : {true, false}) {
            Judge judge(mesh, allow_opposite);
            State state = judge.state(naive_labeling(mesh));
            for (int i = 0; i < 12; i++) {
                const Patch patch = random_patch(mesh.facets(), random);
                const State expected = judge.state(with(state.labels, patch));
                judge.apply(state, patch);
                check_equal(state, expected);
                validate(mesh, state.labels, state.graph);
                CHECK(state.graph.allow_opposite == allow_opposite);
            }
        }
    }
}

TEST_CASE("state: an empty patch changes nothing, and of two labels for a facet the last counts") {
    const TriMesh mesh = build_mesh(cube(2));
    Judge judge(mesh);
    const State state = judge.state(naive_labeling(mesh));
    State result = state;
    judge.apply(result, {});
    check_equal(result, state);
    judge.apply(result, {{3, kY}, {3, kZ}});
    CHECK(result.labels[3] == kZ);
}

TEST_CASE("state: locked facets keep their labels whatever a patch says") {
    const TriMesh mesh = build_mesh(cube(2));
    const Labeling labels = naive_labeling(mesh);
    Labeling locks(mesh.facets(), kNoLabel);
    locks[0] = labels[0];
    locks[40] = labels[40];
    Judge locked(mesh, true, locks);
    const Judge free(mesh);
    State result = free.state(labels);
    locked.apply(result, relabel_all(mesh, kY));
    for (Index f = 0; f < mesh.facets(); f++) CHECK(result.labels[f] == (locks[f] == kNoLabel ? kY : labels[f]));
    check_equal(result, free.state(result.labels));   // locks cost nothing
}

TEST_CASE("state: a list of locks without any lock leaves all free") {
    const TriMesh mesh = build_mesh(cube(1));
    Judge judge(mesh, true, Labeling(12, kNoLabel));
    State result = judge.state(naive_labeling(mesh));
    judge.apply(result, relabel_all(mesh, kX));
    CHECK(result.labels == Labeling(12, kX));
}

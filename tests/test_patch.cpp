// Patch: effects against graphs built from scratch, on everything that can lie around a patch.
#include "polylab/patch.h"

#include "polylab/initial_labeling.h"
#include "polylab/state.h"
#include "shapes.h"

#include <doctest/doctest.h>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;

namespace {

// Some facets around a random one get a random label, most often one.
Patch random_patch(const TriMesh& mesh, Lcg& random) {
    Patch patch;
    Index f = random.below(mesh.facets());
    Label label = static_cast<Label>(random.below(kLabels));
    for (Index i = random.below(25); i >= 0; i--) {
        patch.push_back({f, label});
        f = random.below(30) == 0 ? random.below(mesh.facets()) : mesh.right(3 * f + random.below(3));
        if (random.below(20) == 0) label = static_cast<Label>(random.below(kLabels));
    }
    return patch;
}

Labeling patched(Labeling labels, const Patch& patch) {
    for (const Relabel& r : patch) labels[r.facet] = r.label;
    return labels;
}

Index lost_features(const TriMesh& mesh, const LabelingGraph& graph) {
    Index lost = 0;
    for (Index h = 0; h < mesh.halfedges(); h++) lost += h < mesh.opposite[h] && mesh.feature[h] && !graph.is_border(h);
    return lost;
}

struct Numbers {
    Index charts, invalid, turning_points, lost_features;
};

Numbers numbers(const TriMesh& mesh, const State& s) {
    return {static_cast<Index>(s.graph.charts.size()), s.graph.invalid(), static_cast<Index>(s.turning.points.size()),
            lost_features(mesh, s.graph)};
}

// Random patches, two of three on top of each other, so that labelings become patchy and jagged.
void check_random_patches(const TriMesh& mesh, bool allow_opposite, Lcg& random, int patches) {
    Judge judge(mesh, allow_opposite);
    EffectFinder finder(mesh);
    State state = judge.state(naive_labeling(mesh));
    for (int i = 0; i < patches; i++) {
        const Patch patch = random_patch(mesh, random);
        const State after = judge.state(patched(state.labels, patch));
        const Effect effect = finder.effect(state.labels, state.graph, state.turning, patch);
        const Numbers a = numbers(mesh, state), b = numbers(mesh, after);
        CHECK(effect.charts == b.charts - a.charts);
        CHECK(effect.invalid == b.invalid - a.invalid);
        CHECK(effect.turning_points == b.turning_points - a.turning_points);
        CHECK(effect.lost_features == b.lost_features - a.lost_features);
        CHECK(judge.score(state, patch) == after.score);
        // With bounds: the same within them, beyond them worse than any.
        const std::int64_t most_loss = after.score.loss + random.below(3) - 1;
        const Index most_invalid = std::max(0, after.score.invalid + random.below(3) - 1);
        const Score bounded = judge.score(state, patch, most_loss, most_invalid);
        CHECK(bounded.loss == after.score.loss);
        if (after.score.loss > most_loss || after.graph.invalid() > most_invalid)
            CHECK(bounded.invalid == kUnknown);
        else
            CHECK(bounded == after.score);
        State applied = state;
        judge.apply(applied, patch);
        CHECK_NOTHROW(validate(mesh, applied.labels, applied.graph));
        CHECK(graph_text(applied.graph) == graph_text(after.graph));
        CHECK(applied.graph.chart == after.graph.chart);
        CHECK(applied.graph.boundary == after.graph.boundary);
        CHECK(applied.graph.corner == after.graph.corner);
        CHECK(applied.graph.invalid() == after.graph.invalid());
        CHECK(applied.score == after.score);
        if (random.below(3) > 0) std::swap(state, applied);
    }
}

}   // namespace

TEST_CASE("patch: effects are the differences of graphs built from scratch") {
    Lcg random(5);
    for (const bool allow_opposite : {true, false}) {
        check_random_patches(build_mesh(cube(1)), allow_opposite, random, 100);
        check_random_patches(build_mesh(cube(4)), allow_opposite, random, 300);
        check_random_patches(build_mesh(shapes::creased(shapes::stair(3))), allow_opposite, random, 200);
        check_random_patches(build_mesh(shapes::refined(shapes::creased(shapes::frame()))), allow_opposite, random, 300);
        check_random_patches(build_mesh(shapes::refined(shapes::refined(shapes::octahedron()))), allow_opposite, random, 200);
        check_random_patches(build_mesh(shapes::creased(shapes::hollow_box())), allow_opposite, random, 200);
    }
}

TEST_CASE("patch: effects at vertices with several fans, and with several components") {
    Lcg random(7);
    for (const bool allow_opposite : {true, false}) {
        check_random_patches(build_mesh(shapes::two_cubes_at_a_vertex()), allow_opposite, random, 300);
        check_random_patches(build_mesh(shapes::refined(shapes::two_cubes_at_a_vertex())), allow_opposite, random, 300);
        check_random_patches(build_mesh(shapes::creased(shapes::pinched_ring())), allow_opposite, random, 300);
        check_random_patches(build_mesh(shapes::refined(shapes::pinched_ring())), allow_opposite, random, 300);
    }
}

TEST_CASE("patch: effects on labelings that are noise") {
    Lcg random(9);
    for (const MeshData& data : {cube(4), shapes::refined(shapes::pinched_ring()), shapes::creased(shapes::frame())}) {
        const TriMesh mesh = build_mesh(data);
        Judge judge(mesh);
        for (int i = 0; i < 100; i++) {
            Labeling labels;
            for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(2 * random.below(2) + random.below(2)));
            const State state = judge.state(labels);
            const Patch patch = random_patch(mesh, random);
            CHECK(judge.score(state, patch) == judge.state(patched(labels, patch)).score);
        }
    }
}

TEST_CASE("patch: changes hold each facet once, with its last label, and only where it differs") {
    const TriMesh mesh = build_mesh(cube(1));
    const Labeling labels = naive_labeling(mesh);
    const LabelingGraph graph = build_graph(mesh, labels);
    const TurningPoints turning = find_turning_points(mesh, graph);
    EffectFinder finder(mesh);
    CHECK(finder.effect(labels, graph, turning, {}).charts == 0);
    CHECK(finder.changes().empty());
    finder.effect(labels, graph, turning, {{0, 2}, {5, 4}, {0, 3}, {7, labels[7]}, {5, labels[5]}});
    REQUIRE(finder.changes().size() == 1);
    CHECK(finder.changes()[0].facet == 0);
    CHECK(finder.changes()[0].label == 3);
    // Taken back: nothing stays behind from one patch to the next.
    const Effect same = finder.effect(labels, graph, turning, {{0, 3}, {0, labels[0]}});
    CHECK(finder.changes().empty());
    CHECK(same.invalid == 0);
}

TEST_CASE("patch: a chart that is cut falls apart only where nothing leads around") {
    const TriMesh mesh = build_mesh(cube(5));
    Judge judge(mesh);
    const State state = judge.state(naive_labeling(mesh));
    EffectFinder finder(mesh);
    const auto row = [&](Index from, Index to) {   // of squares in the middle of the upper face
        Patch patch;
        for (Index x = from; x < to; x++)
            for (Index k = 0; k < 2; k++) patch.push_back({8 * 25 + 2 * (5 * 2 + x) + k, 2});
        return patch;
    };
    CHECK(finder.effect(state.labels, state.graph, state.turning, row(1, 4)).charts == 1);   // an island
    CHECK(finder.effect(state.labels, state.graph, state.turning, row(0, 4)).charts == 1);   // a peninsula
    CHECK(finder.effect(state.labels, state.graph, state.turning, row(0, 5)).charts == 2);   // from side to side
}

TEST_CASE("patch: scores with locks are those of the patch without locked facets") {
    Lcg random(3);
    const TriMesh mesh = build_mesh(shapes::creased(cube(3)));
    Labeling locks(mesh.facets(), kNoLabel);
    for (Index f = 0; f < mesh.facets(); f += 5) locks[f] = static_cast<Label>(random.below(kLabels));
    Judge judge(mesh, true, locks);
    State state = judge.state(naive_labeling(mesh));
    for (int i = 0; i < 100; i++) {
        const Patch patch = random_patch(mesh, random);
        State after = judge.state(patched(state.labels, patch));
        CHECK(judge.score(state, patch) == after.score);
        std::swap(state, after);
    }
}

// Polish and search: what is done beyond the paper's routines.
#include "fuzz_targets.h"

#include "polylab/initial_labeling.h"
#include "polylab/polylab.h"
#include "polylab/search.h"
#include "shapes.h"

#include <doctest/doctest.h>

using namespace polylab;
using shapes::cube;

namespace {

TriMesh golden_part(const std::string& name) {
    return read_surface(std::string(POLYLAB_SOURCE_DIR) + "/golden/cases/" + name + "/in.obj");
}

// A cube's labels with the facets of +X whose centre is above z = `from` labeled +Z: valid and monotone, but not close.
Labeling with_low_border(const TriMesh& mesh, double from) {
    Labeling labels = naive_labeling(mesh);
    for (Index f = 0; f < mesh.facets(); f++) {
        double z = 0;
        for (int k = 0; k < 3; k++) z += mesh.points[mesh.origin[3 * f + k]].z / 3;
        if (labels[f] == 0 && z > from) labels[f] = 4;
    }
    return labels;
}

Index differing(const Labeling& a, const Labeling& b) {
    Index n = 0;
    for (std::size_t i = 0; i < a.size(); i++) n += a[i] != b[i];
    return n;
}

}   // namespace

TEST_CASE("polish: redraw gives a facet back to the chart that it belongs to, and leaves what lies outside") {
    const TriMesh mesh = build_mesh(cube(4));
    const Labeling naive = naive_labeling(mesh);
    Labeling labels = naive;
    labels[3] = 4;
    labels[20] = 4;
    const State state = Judge(mesh).state(labels);
    const Proposals all = Redraw(mesh)(state, {2, 3, 20}, 1);
    REQUIRE(all.size() == 3);   // the whole, and its two parts
    CHECK(all[0].size() == 2);
    CHECK(all[1][0].facet == 3);
    CHECK(all[2][0].facet == 20);
    for (const Relabel& r : all[0]) CHECK(r.label == naive[r.facet]);
    const Proposals one = Redraw(mesh)(state, {3}, 1);
    REQUIRE(one.size() == 1);
    CHECK(one[0].size() == 1);
    CHECK(Redraw(mesh)(Judge(mesh).state(naive), {1, 2, 3}, 1).empty());
}

TEST_CASE("polish: the face beside a lost feature edge takes another label, also where nothing was repaired") {
    const TriMesh mesh = golden_part("v_groove_blind");
    const Labeling start = graphcut_labeling(mesh);
    const State before = run_routines(mesh, start), after = polish(mesh, before.labels, before);
    CHECK(statistics(mesh, before.labels, before.graph).features_lost > 0);
    CHECK(statistics(mesh, after.labels, after.graph).features_lost == 0);
    CHECK(after.score < before.score);
    CHECK(after.graph.charts.size() <= before.graph.charts.size());
}

TEST_CASE("polish: a border that left its edge comes back") {
    const TriMesh mesh = build_mesh(cube(4));
    const Labeling naive = naive_labeling(mesh), low = with_low_border(mesh, 2.9);
    REQUIRE(differing(naive, low) > 0);
    const State state = Judge(mesh).state(low);
    REQUIRE(state.score.invalid == 0);
    CHECK(polish(mesh, naive, state).labels == naive);
    CHECK(polish(mesh, low, state).labels == low);   // nothing was repaired, so nothing is touched
}

TEST_CASE("polish: locked facets keep their labels") {
    const TriMesh mesh = build_mesh(cube(4));
    const Labeling naive = naive_labeling(mesh), low = with_low_border(mesh, 2.9);
    RoutineOptions options;
    options.locks.assign(mesh.facets(), kNoLabel);
    for (Index f = 0; f < mesh.facets(); f++)
        if (low[f] != naive[f]) options.locks[f] = low[f];
    const State state = Judge(mesh, true, options.locks).state(low);
    CHECK(polish(mesh, naive, state, options).labels == low);
}

TEST_CASE("polish: never worse, no new chart, and the steps lead from the first score to the last") {
    for (const char* name : {"wedge_hole", "gusset", "boss_on_ramp", "oblique_hole"}) {
        CAPTURE(name);
        const TriMesh mesh = golden_part(name);
        const Labeling start = graphcut_labeling(mesh);
        const State before = run_routines(mesh, start);
        RoutineOptions options;
        Score last = before.score;
        options.trace = [&](const Step& step) {
            CHECK(step.before == last);
            CHECK((step.kept ? step.after < step.before : step.after == step.before));
            last = step.after;
        };
        const State after = polish(mesh, start, before, options);
        CHECK(!(before.score < after.score));
        CHECK(after.graph.charts.size() <= before.graph.charts.size());
        CHECK(after.score == last);
        CHECK(after.score == Judge(mesh).state(after.labels).score);
    }
}

TEST_CASE("search: effort 0 is the routines alone, and a part that needs no repair costs nothing more") {
    const TriMesh mesh = golden_part("gusset");
    const Labeling start = graphcut_labeling(mesh);
    CHECK(search(mesh, start, {}, 0).labels == run_routines(mesh, start).labels);

    const TriMesh plain = build_mesh(shapes::stair(3));
    RoutineOptions options;
    options.trace = [](const Step& step) { FAIL("a step: ", step.operation); };
    CHECK(search(plain, naive_labeling(plain), options).labels == naive_labeling(plain));
}

TEST_CASE("search: the start follows obtuse feature edges, but at effort 0") {
    const TriMesh mesh = golden_part("countersunk");
    const Labeling plain = graphcut_labeling(mesh), start = search_start(mesh);
    CHECK(search_start(mesh, 0) == plain);
    CHECK(statistics(mesh, start, build_graph(mesh, start)).features_lost <
          statistics(mesh, plain, build_graph(mesh, plain)).features_lost);
}

TEST_CASE("search: best-first search mends what the routines leave, before any other start") {
    const TriMesh mesh = golden_part("blob");
    InitialOptions smooth;
    smooth.compactness = 20;
    const Labeling start = search_start(mesh, kDefaultEffort, smooth);
    const State left = search(mesh, start, {}, 1);
    CHECK(left.score.invalid + left.score.turning_points > 0);
    RoutineOptions options;
    Index expanded = 0, explored = 0;
    options.trace = [&](const Step& step) {
        CHECK(step.operation != "start-again");
        expanded += step.operation == "expand" ? step.proposals : 0;
        if (step.operation != "explore") return;
        CHECK(step.kept);
        CHECK(step.before == left.score);
        CHECK(step.after < step.before);
        explored = step.proposals;
    };
    const State found = search(mesh, start, options);
    CHECK(found.score.invalid == 0);
    CHECK(found.score.turning_points == 0);
    CHECK(explored == expanded);
    CHECK(explored > 0);
    CHECK(search(mesh, start, options).labels == found.labels);
    options.locks = left.labels;
    options.trace = {};
    CHECK(search(mesh, start, options).labels == left.labels);   // locked facets keep their labels
}

TEST_CASE("search: another start where the first one leaves something invalid") {
    const TriMesh mesh = golden_part("torus");
    const Labeling start(mesh.facets(), 0);   // no boundary, where operators could begin
    CHECK(search(mesh, start, {}, 1).score.invalid > 0);
    RoutineOptions options;
    Index starts = 0;
    options.trace = [&](const Step& step) { starts += step.operation == "start-again"; };
    const State found = search(mesh, start, options);
    CHECK(found.score.invalid == 0);
    CHECK(found.score.turning_points == 0);
    CHECK(starts >= 1);
    starts = 0;
    CHECK(!(found.score < search(mesh, start, options, 3).score));
    CHECK(starts == 5);
}

TEST_CASE("search: stopped at once, it gives the start") {
    const TriMesh mesh = golden_part("blob_turning_point");
    const Labeling start = graphcut_labeling(mesh);
    RoutineOptions options;
    options.stop = [] { return true; };
    CHECK(search(mesh, start, options).labels == start);
}

TEST_CASE("search: a small surface that crosses itself does not take all starts") {
    // 50 facets: with six starts to the end it took more than a second, and stayed invalid.
    const TriMesh mesh = build_mesh(fuzz::soup(fuzz::choices_of_seed(194)));
    RoutineOptions options;
    Index starts = 0;
    options.trace = [&](const Step& step) { starts += step.operation == "start-again"; };
    CHECK(search(mesh, graphcut_labeling(mesh), options).score.invalid == 0);
    CHECK(starts < 5);
}

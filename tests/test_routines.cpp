// The routines: never worse than their start, the same every time, and good enough for small shapes and one CAD part.
#include "polylab/polylab.h"
#include "polylab/routines.h"

#include "polylab/initial_labeling.h"
#include "polylab/io.h"
#include "polylab/statistics.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

using namespace polylab;
using shapes::creased;
using shapes::cube;
using shapes::Lcg;
using shapes::refined;

namespace {

constexpr Label kX = 0, kZ = 4, kNegZ = 5;

using Shapes = std::vector<MeshData>;

// ---- runs with their trace

struct Run {
    State start, result;
    std::vector<Step> steps;
    std::string trace;
};

Run run(const TriMesh& mesh, const Labeling& start, RoutineOptions options = {}) {
    Run r;
    r.start = Judge(mesh, options.allow_opposite).state(start);
    options.trace = [&r](const Step& step) {
        r.steps.push_back(step);
        r.trace += trace_line(step);
    };
    r.result = run_routines(mesh, start, options);
    return r;
}

Class class_of(const TriMesh& mesh, const State& state) { return statistics(mesh, state.labels, state.graph).result_class(); }

// Whether the graph-cut becomes a labeling without any fault: of the paper's best class, and with the charts of a polycube.
bool solved(const TriMesh& mesh) {
    const State result = run_routines(mesh, graphcut_labeling(mesh));
    return class_of(mesh, result) == Class::valid_monotone && result.score.invalid == 0 && result.score.turning_points == 0;
}

std::set<std::string> operations(const std::vector<Step>& steps) {
    const std::string sequence = "sequence-of-";
    std::set<std::string> names;
    for (const Step& s : steps)
        names.insert(s.operation.rfind(sequence, 0) == 0 ? s.operation.substr(sequence.size()) : s.operation);
    return names;
}

const std::set<std::string> kQualityOperations = {"join-turning-points", "pull-closest-corner", "move-boundary-near",
                                                  "straighten-boundary", "directional-path"};

// What always holds: the result is no worse, is what it says, and each kept step leads from one score to a better one.
void check_run(const TriMesh& mesh, const Run& r) {
    CHECK_FALSE(r.start.score < r.result.score);
    CHECK(r.result.score == Judge(mesh, r.result.graph.allow_opposite).state(r.result.labels).score);
    validate(mesh, r.result.labels, r.result.graph);
    Score now = r.start.score;
    for (const Step& s : r.steps) {
        if (s.kept) CHECK(s.after < s.before);
        if (s.kept) CHECK(s.facets > 0);
        CHECK(s.proposals > 0);
        if (s.in_sequence) continue;
        CHECK(s.before == now);
        if (s.kept) now = s.after;
    }
    CHECK(r.result.score == now);
}

// ---- starts

Labeling noise(Index facets, Lcg& random) {
    Labeling labels(facets);
    for (Label& l : labels) l = static_cast<Label>(random.below(kLabels));
    return labels;
}

// The labels closest to the normals, but for a few patches.
Labeling patched(const TriMesh& mesh, Lcg& random) {
    Labeling labels = naive_labeling(mesh);
    for (Index i = 1 + random.below(4); i > 0; i--) {
        Index f = random.below(mesh.facets());
        const Label l = static_cast<Label>(random.below(kLabels));
        for (Index k = random.below(10); k >= 0; k--) {
            labels[f] = l;
            f = mesh.right(3 * f + random.below(3));
        }
    }
    return labels;
}

// The same, but for one facet in eight.
Labeling sprinkled(const TriMesh& mesh, Lcg& random) {
    Labeling labels = naive_labeling(mesh);
    for (Label& l : labels)
        if (random.below(8) == 0) l = static_cast<Label>(random.below(kLabels));
    return labels;
}

Labeling any_start(const TriMesh& mesh, Index i, Lcg& random) {
    switch (i % 8) {
        case 0: return noise(mesh.facets(), random);
        case 1: return Labeling(mesh.facets(), static_cast<Label>(random.below(kLabels)));
        case 2:
        case 3:
        case 4: return sprinkled(mesh, random);
        default: return patched(mesh, random);
    }
}

// ---- shapes

MeshData refined_times(MeshData data, int times) {
    for (int i = 0; i < times; i++) data = refined(data);
    return data;
}

// On the square [-2,2] x [-2,2], apex at (0,0,4).
MeshData square_pyramid() {
    MeshData data;
    data.points = {{2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {-2, -2, 0}, {0, 0, 4}};
    data.triangles = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2};
    return data;
}

//   8        +---+
//          /     |     a plate with a ramp of 45 degrees that ends in a wall
//   2 +---+      |
//   0 +----------+
//     0   2  8  12
MeshData ramp() { return shapes::prism({{12, 0, 0}, {12, 8, 0}, {8, 8, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}}, 6); }

MeshData lens() { return refined(shapes::octahedron()); }

// A corner and a turning-point that belong together: see test_quality_operators.cpp. Valid, two turning-points.
MeshData horn() { return shapes::prism({{5, 0, 0}, {8, 0, 0}, {8, 8, 0}, {6, 4, 0}, {0, 4, 0}, {0, 0, 0}}, 4); }
Labeling horn_labels() { return {3, 3, 0, 0, 0, 0, 2, 2, 1, 1, 3, 3, 5, 5, 5, 5, 4, 4, 4, 4}; }

// The facets of the square [x,x+1] x [y,y+1] of the upper face of cube(n) get a label.
Labeling with_square(Index n, Index x, Index y, Label label) {
    Labeling labels = naive_labeling(build_mesh(cube(n)));
    labels[8 * n * n + 2 * (n * y + x)] = labels[8 * n * n + 2 * (n * y + x) + 1] = label;
    return labels;
}

}   // namespace

// ---- what always holds

TEST_CASE("routines: from any start they end, the result is never worse and the trace says why") {
    struct Set {
        MeshData data;
        Index starts;
    };
    const std::vector<Set> sets = {{shapes::pillow(), 200},
                                   {shapes::tetrahedron(), 150},
                                   {shapes::tetrahedron_with_flat_facet(), 60},
                                   {creased(shapes::octahedron()), 150},
                                   {cube(1), 400},
                                   {cube(2), 500},
                                   {cube(4), 180},
                                   {refined(shapes::tetrahedron()), 30},
                                   {lens(), 50},
                                   {creased(shapes::triangular_prism(3, 4, 4)), 80},
                                   {refined(creased(shapes::triangular_prism(3, 4, 4))), 60},
                                   {creased(shapes::l_shape()), 60},
                                   {shapes::two_cubes_at_a_vertex(), 40},
                                   {creased(shapes::stair(3)), 30},
                                   {shapes::frame(), 24},
                                   {shapes::hollow_box(), 16},
                                   {shapes::pinched_ring(), 10}};
    Lcg random(2024);
    Index runs = 0;
    for (const auto& [data, starts] : sets) {
        const TriMesh mesh = build_mesh(data);
        for (Index i = 0; i < starts; i++) {
            const Labeling start = any_start(mesh, i, random);
            check_run(mesh, run(mesh, start));
            runs++;
        }
    }
    CHECK(runs >= 2000);
}

TEST_CASE("routines: the same start gives the same labels and the same trace") {
    Lcg random(7);
    for (const MeshData& data :
         {cube(3), refined(creased(shapes::triangular_prism(3, 4, 4))), creased(shapes::frame()), refined(shapes::pyramid(5))}) {
        const TriMesh mesh = build_mesh(data), again = build_mesh(data);
        for (Index i = 0; i < 8; i++) {
            const Labeling start = any_start(mesh, i, random);
            const Run first = run(mesh, start), second = run(again, start);
            CHECK(first.result.labels == second.result.labels);
            CHECK(first.trace == second.trace);
            CHECK(run_routines(mesh, start).labels == first.result.labels);   // traced or not
        }
    }
}

TEST_CASE("routines: what is valid and monotone is left alone") {
    for (const MeshData& data :
         {cube(1), creased(cube(3)), creased(shapes::l_shape()), shapes::stair(4), shapes::frame(), shapes::hollow_box(),
          shapes::two_cubes_at_a_vertex(), shapes::pinched_ring(), shapes::box(2, 3, 4)}) {
        const TriMesh mesh = build_mesh(data);
        const Labeling labels = naive_labeling(mesh);
        const Run r = run(mesh, labels);
        REQUIRE(r.start.graph.valid());
        REQUIRE(r.start.turning.points.empty());
        CHECK(r.result.labels == labels);
        for (const Step& s : r.steps) CHECK_FALSE(s.kept);
    }
}

TEST_CASE("routines: charts of two domes on each other are not exchanged for ever") {
    const TriMesh mesh = build_mesh(lens());
    Labeling labels(mesh.facets(), kNegZ);
    std::fill(labels.begin(), labels.begin() + 16, kZ);
    check_run(mesh, run(mesh, labels));
}

// ---- traces

TEST_CASE("routines: a line of the trace") {
    Step step;
    step.operation = "remove-chart";
    step.element = 3;
    step.kept = true;
    step.proposals = 2;
    step.facets = 17;
    step.before = {4, 1, 500};
    step.after = {3, 0, 6000000000};
    CHECK(trace_line(step) == "remove-chart 3 kept 2 17 4 1 500 3 0 6000000000\n");
    step.kept = false;
    step.in_sequence = true;
    step.element = kNone;
    CHECK(trace_line(step) == "| remove-chart -1 refused 2 17 4 1 500 3 0 6000000000\n");
}

TEST_CASE("routines: a stray chart is removed in one step") {
    // The six facets around a vertex, each with two neighbours inside: there is nothing to smooth. From fidelity 0.5 back to 1;
    // all that is invalid is that the chart has one neighbour.
    const TriMesh mesh = build_mesh(cube(4));
    Labeling start = naive_labeling(mesh);
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.points[mesh.from(h)] == Vec3{2, 2, 4}) start[facet(h)] = kX;
    const Run r = run(mesh, start);
    CHECK(r.result.labels == naive_labeling(mesh));
    std::vector<Step> kept;
    std::copy_if(r.steps.begin(), r.steps.end(), std::back_inserter(kept), [](const Step& s) { return s.kept; });
    REQUIRE(kept.size() == 1);
    CHECK(kept[0].operation == "remove-surrounded-chart");
    CHECK(kept[0].proposals == 1);
    CHECK(kept[0].facets == 6);
    CHECK(kept[0].before == Score{1, 0, 3000000});
    CHECK(kept[0].after == Score{0, 0, 0});
}

// ---- options

TEST_CASE("routines: each of the two can run alone") {
    Lcg random(99);
    for (const MeshData& data : {cube(4), refined(creased(shapes::triangular_prism(3, 4, 4))), creased(shapes::stair(3))}) {
        const TriMesh mesh = build_mesh(data);
        for (Index i = 0; i < 16; i++) {
            const Labeling start = any_start(mesh, i, random);
            RoutineOptions options;
            options.monotonicity = false;
            const Run validity = run(mesh, start, options);
            check_run(mesh, validity);
            for (const std::string& name : operations(validity.steps)) CHECK(kQualityOperations.count(name) == 0);
            options = {};
            options.validity = false;
            const Run quality = run(mesh, start, options);
            check_run(mesh, quality);
            for (const std::string& name : operations(quality.steps)) CHECK(kQualityOperations.count(name) == 1);
            // One after the other is both.
            CHECK(run(mesh, validity.result.labels, options).result.labels == run(mesh, start).result.labels);
            options.monotonicity = false;
            const Run none = run(mesh, start, options);
            CHECK(none.result.labels == start);
            CHECK(none.steps.empty());
        }
    }
}

TEST_CASE("routines: turning-points go without the validity routine, and stay without the other") {
    const TriMesh mesh = build_mesh(horn());
    RoutineOptions options;
    options.validity = false;
    const Run quality = run(mesh, horn_labels(), options);
    CHECK(quality.start.turning.points.size() == 2);
    CHECK(quality.result.turning.points.empty());
    CHECK(quality.result.graph.valid());
    options.validity = true;
    options.monotonicity = false;
    CHECK(run(mesh, horn_labels(), options).result.labels == horn_labels());   // it was valid
}

TEST_CASE("routines: locked facets keep their labels whatever it costs") {
    // The stray square would go, but it is locked.
    const TriMesh mesh = build_mesh(cube(3));
    const Labeling start = with_square(3, 1, 1, kX);
    RoutineOptions options;
    options.locks.assign(mesh.facets(), kNoLabel);
    options.locks[80] = options.locks[81] = kX;
    const Run r = run(mesh, start, options);
    CHECK(r.result.labels[80] == kX);
    CHECK(r.result.labels[81] == kX);
    check_run(mesh, r);
}

TEST_CASE("routines: random locks hold from random starts") {
    Lcg random(4);
    for (const MeshData& data : {cube(2), refined(creased(shapes::triangular_prism(3, 4, 4))), shapes::two_cubes_at_a_vertex()}) {
        const TriMesh mesh = build_mesh(data);
        for (Index i = 0; i < 8; i++) {
            const Labeling start = any_start(mesh, i, random);
            RoutineOptions options;
            options.locks.assign(mesh.facets(), kNoLabel);
            for (Index f = 0; f < mesh.facets(); f++)
                if (random.below(4) == 0) options.locks[f] = start[f];
            const Run r = run(mesh, start, options);
            check_run(mesh, r);
            for (Index f = 0; f < mesh.facets(); f++)
                if (options.locks[f] != kNoLabel) CHECK(r.result.labels[f] == start[f]);
        }
    }
}

TEST_CASE("routines: all locked is left as it is, and no lock is as good as no list") {
    const TriMesh mesh = build_mesh(cube(2));
    Lcg random(15);
    const Labeling start = noise(mesh.facets(), random);
    RoutineOptions options;
    options.locks = start;
    CHECK(run(mesh, start, options).result.labels == start);
    options.locks.assign(mesh.facets(), kNoLabel);
    const Run r = run(mesh, start, options), plain = run(mesh, start);
    CHECK(r.trace == plain.trace);
    CHECK(r.result.labels == plain.result.labels);
    CHECK_FALSE(plain.result.labels == start);
}

TEST_CASE("routines: opposite labels may be kept apart") {
    // +Z against -Z in a flat face: with a chart around it the patch could stay, were it not for its one neighbour.
    const TriMesh mesh = build_mesh(cube(3));
    RoutineOptions options;
    options.allow_opposite = false;
    const Run r = run(mesh, with_square(3, 1, 1, kNegZ), options);
    CHECK_FALSE(r.result.graph.allow_opposite);
    CHECK(r.start.graph.invalid() == 2);
    CHECK(r.result.labels == naive_labeling(mesh));
    check_run(mesh, r);
}

// ---- results

TEST_CASE("routines: small shapes get valid and monotone labelings from their graph-cut") {
    CHECK(solved(build_mesh(refined(creased(shapes::triangular_prism(3, 4, 4))))));
    CHECK(solved(build_mesh(refined_times(creased(shapes::triangular_prism(4, 1, 2)), 2))));   // a flat wedge
    CHECK(solved(build_mesh(refined(creased(square_pyramid())))));
    CHECK(solved(build_mesh(refined_times(creased(square_pyramid()), 2))));
    for (const int n : {4, 5, 6, 8}) CHECK(solved(build_mesh(refined_times(creased(shapes::pyramid(n)), n == 8 ? 2 : 1))));
    CHECK(solved(build_mesh(refined(creased(shapes::octahedron())))));
    CHECK(solved(build_mesh(refined_times(shapes::octahedron(), 2))));
    CHECK(solved(build_mesh(refined_times(creased(shapes::tetrahedron()), 2))));
    CHECK(solved(build_mesh(refined(creased(shapes::l_shape())))));
    CHECK(solved(build_mesh(creased(ramp()))));
    CHECK(solved(build_mesh(refined(creased(ramp())))));
    CHECK(solved(build_mesh(refined(creased(shapes::frame())))));
    CHECK(solved(build_mesh(shapes::hollow_box())));
}

TEST_CASE("routines: these shapes do need repair") {
    for (const MeshData& data : {refined(creased(shapes::triangular_prism(3, 4, 4))), refined(creased(square_pyramid())),
                                 refined(creased(shapes::octahedron())), refined_times(creased(shapes::tetrahedron()), 2)}) {
        const TriMesh mesh = build_mesh(data);
        CHECK(Judge(mesh).state(graphcut_labeling(mesh)).score.invalid > 0);
    }
}

TEST_CASE("routines: results do not depend on the scale") {
    for (const MeshData& data : {refined(creased(shapes::triangular_prism(3, 4, 4))), refined(creased(square_pyramid())),
                                 refined(creased(ramp())), refined(shapes::octahedron()), horn()}) {
        const TriMesh mesh = build_mesh(data);
        const Run one = run(mesh, graphcut_labeling(mesh));
        for (const double by : {1024.0, 1.0 / 1024}) {
            const TriMesh other = build_mesh(shapes::scaled(data, by));
            const Run scaled = run(other, graphcut_labeling(other));
            CHECK(scaled.result.labels == one.result.labels);
            CHECK(scaled.trace == one.trace);
        }
    }
}

TEST_CASE("routines: shapes without ties get the same class in every position") {
    for (const MeshData& data : {refined(creased(shapes::triangular_prism(3, 4, 4))), refined(creased(square_pyramid())),
                                 refined(creased(shapes::pyramid(5))), creased(shapes::l_shape()), creased(shapes::stair(3))}) {
        for (int i = 0; i < 24; i++) CHECK(solved(build_mesh(shapes::rotated_axes(data, i).data)));
        for (int axis = 0; axis < 3; axis++) CHECK(solved(build_mesh(shapes::mirrored(data, axis).data)));
    }
}

TEST_CASE("routines: a CAD part gets a valid labeling, no worse than its graph-cut") {
    const TriMesh mesh = build_mesh(read_mesh(std::string(POLYLAB_SOURCE_DIR) + "/golden/cases/bracket/bracket.mesh"));
    const Run r = run(mesh, graphcut_labeling(mesh));
    check_run(mesh, r);
    CHECK(r.result.graph.valid());
}

TEST_CASE("routines: the library's one call is the graph-cut and both routines") {
    const TriMesh mesh = build_mesh(shapes::l_shape());
    CHECK(label_polycube(mesh) == run_routines(mesh, graphcut_labeling(mesh)).labels);
}

TEST_CASE("routines: a run that is stopped ends with the best labeling so far") {
    const TriMesh mesh = build_mesh(refined(shapes::l_shape()));
    Lcg random(7);
    Labeling noise(mesh.facets());
    for (Label& l : noise) l = static_cast<Label>(random.below(kLabels));
    const State start = Judge(mesh).state(noise);
    Score last = start.score;
    for (const int most : {0, 1, 2, 5, 10, 100, 1000}) {
        int asked = 0;
        RoutineOptions options;
        options.stop = [&] { return asked++ >= most; };
        const State result = run_routines(mesh, noise, options);
        CHECK_FALSE(last < result.score);   // more work, no worse
        CHECK(result.score == Judge(mesh).state(result.labels).score);
        if (most == 0) CHECK(result.labels == noise);
        if (most == 100) CHECK(result.score < start.score);
        last = result.score;
    }
}

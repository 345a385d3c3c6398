#include "polylab/search.h"

#include <algorithm>
#include <tuple>

namespace polylab {

namespace {

constexpr int kStartCompactness[] = {2, 3, 4, 6, 10};   // of other starts: ever smoother

// How many proposals are tried before no further start is made at effort 2. Surfaces that have no valid labeling, such as
// those that cross themselves, take all that they are given: a small one has to end within a second.
Index most_before_start(const TriMesh& mesh) { return std::max(20000, 20 * std::min(mesh.facets(), 100000000)); }

State from_start(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options, int effort) {
    State state = run_routines(mesh, start, options);
    return effort == 0 ? state : polish(mesh, start, std::move(state), options);
}

// The score, with turning-points by the published count too, which depends on directions and decides a result's class.
std::tuple<Index, Index, Index, std::int64_t> standing(const TriMesh& mesh, const State& s) {
    return {s.score.invalid, s.score.turning_points, published_turning_points(mesh, s.graph).vertices, s.score.loss};
}

bool is_good(const TriMesh& mesh, const State& s) {
    const auto [invalid, turning_points, published, loss] = standing(mesh, s);
    return invalid == 0 && turning_points == 0 && published == 0;
}

}   // namespace

Labeling search_start(const TriMesh& mesh, int effort, InitialOptions initial, const Labeling& locks, const Stop& stop) {
    initial.free_features = effort > 0;
    return graphcut_labeling(mesh, initial, locks, stop);
}

State search(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options, int effort) {
    Index tried = 0;
    RoutineOptions first = options, inner = options;
    first.trace = [&](const Step& step) {
        tried += step.proposals;
        if (options.trace) options.trace(step);
    };
    inner.trace = [&](Step step) {
        tried += step.proposals;
        step.in_sequence = true;
        if (options.trace) options.trace(step);
    };
    State best = from_start(mesh, start, first, effort);
    for (const int compactness : kStartCompactness) {
        if (effort < 2 || (options.stop && options.stop())) break;
        if (effort == 2 && (tried >= most_before_start(mesh) || is_good(mesh, best))) break;
        InitialOptions initial;
        initial.compactness = compactness;
        State other = from_start(mesh, search_start(mesh, effort, initial, options.locks, options.stop), inner, effort);
        Step step{"start-again", compactness, false, standing(mesh, other) < standing(mesh, best), 1, 0, best.score, other.score};
        for (Index f = 0; f < mesh.facets(); f++) step.facets += other.labels[f] != best.labels[f];
        if (options.trace) options.trace(step);
        if (step.kept) best = std::move(other);
    }
    return best;
}

}   // namespace polylab

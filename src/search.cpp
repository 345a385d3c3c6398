#include "polylab/search.h"

#include "polylab/initial_labeling.h"

namespace polylab {

namespace {

constexpr int kStartCompactness[] = {2, 3, 4, 6, 10};   // of other starts: ever smoother

State from_start(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options, int effort) {
    State state = run_routines(mesh, start, options);
    return effort == 0 ? state : polish(mesh, start, std::move(state), options);
}

}   // namespace

State search(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options, int effort) {
    State best = from_start(mesh, start, options, effort);
    RoutineOptions inner = options;
    inner.trace = [&](Step step) {
        step.in_sequence = true;
        if (options.trace) options.trace(step);
    };
    for (const int compactness : kStartCompactness) {
        const bool done = best.score.invalid == 0 && best.score.turning_points == 0;
        if (effort < 2 || (effort == 2 && done) || (options.stop && options.stop())) break;
        InitialOptions initial;
        initial.compactness = compactness;
        State other = from_start(mesh, graphcut_labeling(mesh, initial, options.locks, options.stop), inner, effort);
        Step step{"start-again", compactness, false, other.score < best.score, 1, 0, best.score, other.score};
        for (Index f = 0; f < mesh.facets(); f++) step.facets += other.labels[f] != best.labels[f];
        if (options.trace) options.trace(step);
        if (step.kept) best = std::move(other);
    }
    return best;
}

}   // namespace polylab

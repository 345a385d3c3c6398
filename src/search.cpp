#include "polylab/search.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace polylab {

namespace {

constexpr int kStartCompactness[] = {2, 3, 4, 6, 10};   // of other starts: ever smoother

// How many proposals are tried before no further start is made at effort 2. Surfaces that have no valid labeling, such as
// those that cross themselves, take all that they are given: a small one has to end within a second.
Index most_before_start(const TriMesh& mesh) { return std::max(20000, 20 * std::min(mesh.facets(), 100000000)); }

// The score, with turning-points by the published count too, which depends on directions and decides a result's class.
std::tuple<Index, Index, Index, std::int64_t> standing(const TriMesh& mesh, const State& s) {
    return {s.score.invalid, s.score.turning_points, published_turning_points(mesh, s.graph).vertices, s.score.loss};
}

// Its turning-points; if it has none, those of the published count.
std::vector<TurningPoint> points_of(const TriMesh& mesh, const State& s) {
    return s.turning.points.empty() ? published_turning_points(mesh, s.graph).points : s.turning.points;
}

bool is_good(const TriMesh& mesh, const State& s) {
    const auto [invalid, turning_points, published, loss] = standing(mesh, s);
    return invalid == 0 && turning_points == 0 && published == 0;
}

// ---- best-first search

constexpr Index kMostExplored = 1000;   // proposals; of what it solved, one needed 216, and one over 500
constexpr Index kMostWrong = 20;        // invalid elements and turning-points; more is not mended by so few
constexpr std::size_t kMostOpen = 50;   // labelings that wait to be expanded

std::uint64_t fingerprint(const Labeling& labels) {
    Fingerprint print;
    for (const Label l : labels) print.mix(l);
    return print.value();
}

// The routines take no step that makes things worse. Here all proposals for the labeling of the best score so far lead to further
// labelings, whatever they cost, and each of these is met once.   tie: the one found first
State explore(const TriMesh& mesh, const State& start, const RoutineOptions& options) {
    Judge judge(mesh, options.allow_opposite, options.locks);
    State best = start;
    std::map<std::pair<Score, Index>, Labeling> open;   // by score, then number
    open[{start.score, 0}] = start.labels;
    std::set<std::uint64_t> met = {fingerprint(start.labels)};
    Step all{"explore", kNone, false, false, 0, 0, start.score, start.score};
    const auto stopped = [&] { return options.stop && options.stop(); };
    for (Index numbers = 0; !open.empty() && all.proposals < kMostExplored && !stopped();) {
        const Index number = open.begin()->first.second;
        const State state = judge.state(std::move(open.begin()->second));
        open.erase(open.begin());
        if (standing(mesh, state) < standing(mesh, best)) best = state;
        if (is_good(mesh, best)) break;
        Step step{"expand", number, true, false, 0, 0, state.score, state.score};
        for (const Patch& patch : all_proposals(mesh, state, points_of(mesh, state))) {
            if (stopped()) break;
            Labeling labels = state.labels;
            for (const Relabel& r : patch)
                if (options.locks.empty() || options.locks[r.facet] == kNoLabel) labels[r.facet] = r.label;
            if (!met.insert(fingerprint(labels)).second) continue;
            step.proposals++;
            open[{judge.score(state, patch), ++numbers}] = std::move(labels);
            if (open.size() > kMostOpen) open.erase(std::prev(open.end()));
        }
        all.proposals += step.proposals;
        if (options.trace && step.proposals > 0) options.trace(step);
    }
    all.kept = standing(mesh, best) < standing(mesh, start);
    all.after = best.score;
    for (Index f = 0; f < mesh.facets(); f++) all.facets += best.labels[f] != start.labels[f];
    if (options.trace && all.proposals > 0) options.trace(all);
    return best;
}

State from_start(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options, int effort) {
    State state = run_routines(mesh, start, options);
    if (effort > 0) state = polish(mesh, start, std::move(state), options);
    if (effort < 2 || is_good(mesh, state) || state.score.invalid + state.score.turning_points > kMostWrong) return state;
    State found = explore(mesh, state, options);
    return found.labels == state.labels ? found : polish(mesh, state.labels, std::move(found), options);
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
        tried += step.operation == "explore" ? 0 : step.proposals;   // counted when they were tried
        if (options.trace) options.trace(step);
    };
    inner.trace = [&](Step step) {
        tried += step.operation == "explore" ? 0 : step.proposals;
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

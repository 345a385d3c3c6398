#include "polylab/routines.h"

#include "polylab/text.h"

#include <algorithm>
#include <set>
#include <utility>

namespace polylab {

namespace {

constexpr int kPasses = 6;           // of Algorithm 1 (published code: max_loops + 1)
constexpr int kSequenceStarts = 4;   // proposals of an operator that may be followed by others
constexpr int kSequenceLength = 4;   // operators that may follow

enum class Kind { chart, boundary, corner };

class Routines {
public:
    Routines(const TriMesh& mesh, Labeling start, const RoutineOptions& options)
        : mesh_(mesh), options_(options), judge_(mesh, options.allow_opposite, options.locks), state_(judge_.state(std::move(start))) {}

    State run() {
        if (options_.validity) fix_validity();
        if (options_.monotonicity) fix_monotonicity();
        return std::move(state_);
    }

private:
    // Algorithm 1.
    void fix_validity() {
        for (int pass = 0; pass < kPasses && !state_.graph.valid(); pass++) {
            const Score before = state_.score;
            repeat("smooth-boundaries", [&] { return once("smooth-boundaries", kNone, smooth_boundaries(mesh_, state_)); });
            for_each_invalid(Kind::chart, "remove-surrounded-chart", [&](const State& s, Index c) { return remove_surrounded_chart(mesh_, s, c); });
            for_each_invalid(Kind::chart, "increase-chart-valence", [&](const State& s, Index c) { return valence(s, c); });
            for_each_invalid(Kind::boundary, "opposite-boundary", [&](const State& s, Index b) { return opposite_boundary(mesh_, s, b); });
            for_each_invalid(Kind::corner, "high-valence-corner", [&](const State& s, Index c) { return high_valence_corner(mesh_, s, c); });
            if (state_.graph.valid()) return;
            remove_invalid_charts();
            if (state_.score == before) {
                remove_charts_around_invalid_boundaries();
                if (state_.score == before) return;
            }
        }
    }

    // Algorithm 2.
    void fix_monotonicity() {
        for_each_turning_point("join-turning-points", [&](const State& s, const TurningPoint& t) { return join_turning_points(mesh_, s, t); });
        for_each_turning_point("pull-closest-corner", [&](const State& s, const TurningPoint& t) {
            return beside_feature(mesh_, s, t) ? pull_closest_corner(mesh_, s, t) : Proposals{};
        });
        for_each_turning_point("move-boundary-near", [&](const State& s, const TurningPoint& t) {
            return beside_feature(mesh_, s, t) ? Proposals{} : move_boundary_near(mesh_, s, t);
        });
        straighten_boundaries();
        for_each_turning_point("pull-closest-corner", [&](const State& s, const TurningPoint& t) { return pull_closest_corner(mesh_, s, t); });
        for_each_turning_point("move-boundary-near", [&](const State& s, const TurningPoint& t) { return move_boundary_near(mesh_, s, t); });
        for_each_turning_point("directional-path", [&](const State& s, const TurningPoint& t) { return directional_path(mesh_, s, t); });
    }

    Proposals valence(const State& s, Index c) const { return increase_chart_valence(mesh_, s, c); }

    // ---- the one step

    // Tries all proposals and keeps the best if the score improves.   tie: the first
    bool once(const char* operation, Index element, const Proposals& proposals) {
        if (proposals.empty()) return false;
        Step step{operation, element, false, static_cast<Index>(proposals.size()), 0, state_.score, {}};
        bool any = false;
        for (const Patch& patch : proposals) {
            judge_.apply(state_, patch, trial_);
            if (any && !(trial_.score < best_.score)) continue;
            any = true;
            std::swap(trial_, best_);
            step.facets = static_cast<Index>(patch.size());
        }
        step.after = best_.score;
        step.kept = best_.score < state_.score;
        if (step.kept) std::swap(best_, state_);
        if (options_.trace) options_.trace(step);
        return step.kept;
    }

    template <class Try>
    void repeat(const char*, const Try& attempt) {
        while (attempt()) {}
    }

    static Index count(const State& s, Kind kind) {
        return static_cast<Index>(kind == Kind::chart ? s.graph.charts.size() : kind == Kind::boundary ? s.graph.boundaries.size() : s.graph.corners.size());
    }
    static bool invalid(const State& s, Kind kind, Index i) {
        return kind == Kind::chart ? !s.graph.charts[i].valid : kind == Kind::boundary ? !s.graph.boundaries[i].valid : !s.graph.corners[i].valid;
    }

    // An element by something that outlives a relabeling elsewhere.
    Index name(const State& s, Kind kind, Index i) const {
        return kind == Kind::chart      ? s.graph.charts[i].smallest_facet
               : kind == Kind::boundary ? s.graph.halfedges[s.graph.boundaries[i].halfedges.first]
                                        : s.graph.corners[i].vertex;
    }

    // The operator on the first invalid element, until none of them gives a better state.
    template <class Operator>
    void for_each_invalid(Kind kind, const char* operation, const Operator& apply) {
        std::set<Index> tried;
        for (Index i = 0; i < count(state_, kind);) {
            if (invalid(state_, kind, i) && tried.insert(name(state_, kind, i)).second && once(operation, i, apply(state_, i))) {
                i = 0;
                tried.clear();
            } else {
                i++;
            }
        }
    }

    template <class Operator>
    void for_each_turning_point(const char* operation, const Operator& apply) {
        for (std::size_t i = 0; i < state_.turning.points.size();) {
            const TurningPoint t = state_.turning.points[i];
            i = once(operation, t.vertex, apply(state_, t)) ? 0 : i + 1;
        }
    }

    void remove_invalid_charts() {
        while (!state_.graph.valid()) {
            std::vector<Index> charts;
            for (Index c = 0; c < count(state_, Kind::chart); c++)
                if (!state_.graph.charts[c].valid && !surrounded_by_features(state_, c)) charts.push_back(c);
            if (!once("remove-charts", kNone, remove_charts(mesh_, state_, charts))) break;
        }
        for_each_invalid(Kind::chart, "remove-chart", [&](const State& s, Index c) { return remove_charts(mesh_, s, {c}); });
    }

    void remove_charts_around_invalid_boundaries() {
        for_each_invalid(Kind::boundary, "remove-charts-around-boundary", [&](const State& s, Index b) {
            Proposals proposals;
            for (const std::vector<Index>& charts : {std::vector<Index>{s.graph.boundaries[b].left}, {s.graph.boundaries[b].right}, {s.graph.boundaries[b].left, s.graph.boundaries[b].right}})
                for (Patch& patch : remove_charts(mesh_, s, charts)) proposals.push_back(std::move(patch));
            return proposals;
        });
    }

    void straighten_boundaries() {
        for (Index b = 0; b < count(state_, Kind::boundary) && state_.turning.vertices > 0;) b = once("straighten-boundary", b, straighten_boundary(mesh_, state_, b)) ? 0 : b + 1;
    }

    const TriMesh& mesh_;
    const RoutineOptions& options_;
    Judge judge_;
    State state_;
    State trial_, best_;   // memory of once()
};

}  // namespace

State run_routines(const TriMesh& mesh, Labeling start, const RoutineOptions& options) { return Routines(mesh, std::move(start), options).run(); }

std::string trace_line(const Step& step) {
    std::string line = step.operation;
    const auto number = [&](Index i) {
        line += ' ';
        append(line, i);
    };
    number(step.element);
    line += step.kept ? " kept" : " refused";
    number(step.proposals);
    number(step.facets);
    for (const Score& s : {step.before, step.after}) {
        number(s.invalid);
        number(s.turning_points);
        line += ' ' + std::to_string(s.loss);
    }
    return line + "\n";
}

}  // namespace polylab

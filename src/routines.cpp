#include "polylab/routines.h"

#include "polylab/text.h"

#include <algorithm>
#include <set>
#include <utility>

namespace polylab {

namespace {

// What a pass of Algorithm 1 may do: cheap repairs first, and all of them before any costly one.
struct Pass {
    double loss_limit;   // mean fidelity that one step may cost
    bool sequences;      // whether steps may be combined
};
constexpr Pass kPasses[] = {{0.001, false}, {0.004, false}, {0.016, false}, {0.004, true}, {0.016, true}, {1, true}};

enum class Kind { chart, boundary, corner };

struct Operator {
    const char* name;
    Kind kind;
    Proposals (*propose)(const TriMesh&, const State&, Index element);
};

// In the order of Algorithm 1: valence first, since what it repairs shows invalid boundaries and corners too; boundaries
// before corners, since the ends of an invalid boundary are often invalid; removal last, since it destroys most.
const Operator kValidityOperators[] = {
    {"remove-surrounded-chart", Kind::chart, remove_surrounded_chart},
    {"increase-chart-valence", Kind::chart, increase_chart_valence},
    {"opposite-boundary", Kind::boundary, opposite_boundary},
    {"high-valence-corner", Kind::corner, high_valence_corner},
    {"grow-chart", Kind::chart, grow_chart},
    {"remove-chart", Kind::chart, remove_chart},
    {"remove-charts-around-boundary", Kind::boundary, remove_charts_around_boundary},
};

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
        for (const Pass& pass : kPasses) {
            loss_limit_ = static_cast<std::int64_t>(pass.loss_limit * 1e6 * mesh_.facets());
            for (Score before; !state_.graph.valid() && !(state_.score == before);) {
                before = state_.score;
                once("smooth-boundaries", kNone, smooth_boundaries(mesh_, state_));
                for (const Operator& o : kValidityOperators) for_each_invalid(o, {});
                remove_invalid_charts();
                if (pass.sequences && state_.score == before)
                    for (const Operator& o : kValidityOperators) for_each_in_sequence(o);
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

    // ---- the one step

    bool improves(const State& s, const State& before) const { return s.score < before.score && s.score.loss - before.score.loss <= loss_limit_; }

    // Tries all proposals. Of those that improve the score it keeps the one with the least loss, so that a small repair is
    // preferred to a sweeping one that repairs more.   tie: the first
    bool once(const char* operation, Index element, const Proposals& proposals) {
        if (proposals.empty()) return false;
        Step step{operation, element, false, static_cast<Index>(proposals.size()), 0, state_.score, {}};
        for (const Patch& patch : proposals) {
            judge_.apply(state_, patch, trial_);
            const bool better = improves(trial_, state_);
            if (step.facets > 0 && (better != step.kept ? step.kept : better ? trial_.score.loss >= best_.score.loss : !(trial_.score < best_.score))) continue;
            std::swap(trial_, best_);
            step.kept = better;
            step.facets = static_cast<Index>(patch.size());
        }
        step.after = best_.score;
        if (step.kept) std::swap(best_, state_);
        if (options_.trace) options_.trace(step);
        return step.kept;
    }

    static Index count(const State& s, Kind kind) {
        return static_cast<Index>(kind == Kind::chart ? s.graph.charts.size() : kind == Kind::boundary ? s.graph.boundaries.size() : s.graph.corners.size());
    }
    static bool invalid(const State& s, Kind kind, Index i) {
        return kind == Kind::chart ? !s.graph.charts[i].valid : kind == Kind::boundary ? !s.graph.boundaries[i].valid : !s.graph.corners[i].valid;
    }
    // An element by something that outlives a relabeling elsewhere.
    static Index name(const State& s, Kind kind, Index i) {
        return kind == Kind::chart      ? s.graph.charts[i].smallest_facet
               : kind == Kind::boundary ? s.graph.halfedges[s.graph.boundaries[i].halfedges.first]
                                        : s.graph.corners[i].vertex;
    }
    std::set<Index> invalid_names(Kind kind) const {
        std::set<Index> names;
        for (Index i = 0; i < count(state_, kind); i++)
            if (invalid(state_, kind, i)) names.insert(name(state_, kind, i));
        return names;
    }

    // The operator on the first invalid element that is not in `skip`, until none of them gives a better state.
    void for_each_invalid(const Operator& o, const std::set<Index>& skip) {
        for (Index i = 0; i < count(state_, o.kind);) {
            const bool kept = invalid(state_, o.kind, i) && skip.count(name(state_, o.kind, i)) == 0 && once(o.name, i, o.propose(mesh_, state_, i));
            i = kept ? 0 : i + 1;
        }
    }

    // Some repairs make things worse before they get better: each proposal is taken as it is, the operators mend what it
    // broke, and the whole is kept if it improves the score.
    void for_each_in_sequence(const Operator& o) {
        for (Index i = 0; i < count(state_, o.kind);) i = invalid(state_, o.kind, i) && sequence(o.propose(mesh_, state_, i)) ? 0 : i + 1;
    }

    bool sequence(const Proposals& proposals) {
        const State before = state_;
        const std::set<Index> skip[] = {invalid_names(Kind::chart), invalid_names(Kind::boundary), invalid_names(Kind::corner)};
        State best;
        for (const Patch& patch : proposals) {
            judge_.apply(before, patch, state_);
            for (const Operator& o : kValidityOperators) for_each_invalid(o, skip[static_cast<int>(o.kind)]);
            if (improves(state_, before) && (best.labels.empty() || state_.score.loss < best.score.loss)) std::swap(state_, best);
        }
        const bool kept = !best.labels.empty();
        state_ = kept ? std::move(best) : before;
        return kept;
    }

    template <class Operator>
    void for_each_turning_point(const char* operation, const Operator& apply) {
        for (std::size_t i = 0; i < state_.turning.points.size();) {
            const TurningPoint t = state_.turning.points[i];
            i = once(operation, t.vertex, apply(state_, t)) ? 0 : i + 1;
        }
    }

    // All of them in one cut, as long as that helps; those that are the part's own shape are spared.
    void remove_invalid_charts() {
        while (!state_.graph.valid()) {
            std::vector<Index> charts;
            for (Index c = 0; c < count(state_, Kind::chart); c++)
                if (!state_.graph.charts[c].valid && !surrounded_by_features(state_, c)) charts.push_back(c);
            if (!once("remove-charts", kNone, remove_charts(mesh_, state_, charts))) break;
        }
    }

    void straighten_boundaries() {
        for (Index b = 0; b < count(state_, Kind::boundary) && state_.turning.vertices > 0;) b = once("straighten-boundary", b, straighten_boundary(mesh_, state_, b)) ? 0 : b + 1;
    }

    const TriMesh& mesh_;
    const RoutineOptions& options_;
    Judge judge_;
    State state_;
    std::int64_t loss_limit_ = std::numeric_limits<std::int64_t>::max();
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

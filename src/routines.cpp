#include "polylab/routines.h"

#include "polylab/text.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace polylab {

namespace {

enum class Kind { chart, boundary, corner };

struct ValidityOperator {
    const char* name;
    Kind kind;
    Proposals (*propose)(const TriMesh&, const State&, Index element);
    // What each of the proposals costs, or more than that; quicker to find than they are. Null: unknown.
    std::int64_t (*least_loss)(const Judge&, const State&, Index element) = nullptr;
};

// In the order of Algorithm 1: valence first, since what it repairs shows invalid boundaries and corners too; boundaries
// before corners, since the ends of an invalid boundary are often invalid; removal last, since it destroys most.
constexpr ValidityOperator kValidityOperators[] = {
    {"remove-surrounded-chart", Kind::chart, remove_surrounded_chart},
    {"increase-chart-valence", Kind::chart, increase_chart_valence},
    {"opposite-boundary", Kind::boundary, opposite_boundary},
    {"high-valence-corner", Kind::corner, high_valence_corner},
    {"grow-chart", Kind::chart, grow_chart},
    {"remove-chart", Kind::chart, remove_chart, least_loss_of_removing_chart},
    {"remove-charts-around-boundary", Kind::boundary, remove_charts_around_boundary, least_loss_of_removing_around},
};

struct QualityOperator {
    const char* name;
    Proposals (*propose)(const TriMesh&, const State&, const TurningPoint&);
};

// In the order of Algorithm 2; straightening, which goes by boundary, comes behind the third.
constexpr QualityOperator kJoin = {"join-turning-points", join_turning_points};
constexpr QualityOperator kPull = {"pull-closest-corner", pull_closest_corner};
constexpr QualityOperator kMove = {"move-boundary-near", move_boundary_near};
constexpr QualityOperator kDirectional = {"directional-path", directional_path};

// What a pass of a routine may do: cheap repairs first, and all of them before any costly one.
struct Pass {
    double loss_limit;   // mean fidelity that one step may cost
    bool sequences;      // whether steps may be combined
};
constexpr Pass kPasses[] = {{0.001, false}, {0.004, false}, {0.016, false}, {0.004, true}, {0.016, true}, {1, true}};

// A bound in units of work, not of time, so that results don't depend on the machine: proposals that a run may try. CAD
// parts need up to 6000; labelings that are mostly noise would go on for long.
constexpr Index kMostProposals = 20000;

// How many elements of a kind there are, and whether one is invalid.
Index count(const State& s, Kind kind) {
    return static_cast<Index>(kind == Kind::chart      ? s.graph.charts.size()
                              : kind == Kind::boundary ? s.graph.boundaries.size()
                                                       : s.graph.corners.size());
}
bool invalid(const State& s, Kind kind, Index i) {
    return kind == Kind::chart      ? !s.graph.charts[i].valid
           : kind == Kind::boundary ? !s.graph.boundaries[i].valid
                                    : !s.graph.corners[i].valid;
}

class Routines {
public:
    Routines(const TriMesh& mesh, Labeling start, const RoutineOptions& options)
        : mesh_(mesh), options_(options), judge_(mesh, options.allow_opposite, options.locks),
          state_(judge_.state(std::move(start))) {}

    State run() {
        for (const Pass& pass : kPasses)
            if (options_.validity) fix_validity(pass);
        for (const Pass& pass : kPasses)
            if (options_.monotonicity && !pass.sequences) fix_monotonicity(pass);
        return std::move(state_);
    }

private:
    // Algorithm 1.
    void fix_validity(const Pass& pass) {
        set_limit(pass.loss_limit);
        for (Score before; !state_.graph.valid() && !(state_.score == before);) {
            before = state_.score;
            once("smooth-boundaries", kNone, smooth_boundaries(mesh_, state_));
            for (const ValidityOperator& o : kValidityOperators) for_each_invalid(o);
            remove_invalid_charts();
            if (pass.sequences && state_.score == before)
                for (const ValidityOperator& o : kValidityOperators) for_each_in_sequence(o);
        }
    }

    // Algorithm 2.
    void fix_monotonicity(const Pass& pass) {
        set_limit(pass.loss_limit);
        for (Score before; !state_.turning.points.empty() && !(state_.score == before);) {
            before = state_.score;
            for_each_turning_point(kJoin);
            for_each_turning_point(kPull);
            for_each_turning_point(kMove);
            straighten_boundaries();
            for_each_turning_point(kDirectional);
        }
    }

    // Whether the run has tried its share, or was told to end.
    bool over() { return proposals_tried_ >= kMostProposals || stopped(); }
    bool stopped() { return options_.stop && options_.stop(); }

    // ---- one step

    void set_limit(double mean_fidelity) { loss_limit_ = static_cast<std::int64_t>(mean_fidelity * kLossUnit * mesh_.facets()); }

    bool improves(const Score& s, const Score& before) const { return s < before && s.loss - before.loss <= loss_limit_; }

    // Tries all proposals. Of those that improve the score it keeps the one with the least loss, so that a small repair is
    // preferred to a sweeping one that repairs more.   tie: the first
    // What is too costly is not judged. Puts what the cheapest of these costs into `least_loss`, or what is beyond the limit.
    bool once(const char* operation, Index element, const Proposals& proposals, std::int64_t* least_loss = nullptr) {
        proposals_tried_ += static_cast<Index>(proposals.size());
        Step step{operation, element, in_sequence_, false, static_cast<Index>(proposals.size()), 0, state_.score, state_.score};
        std::int64_t most_loss = state_.score.loss + loss_limit_, too_much = kAnyLoss;
        const Patch* best = nullptr;
        for (const Patch& patch : proposals) {
            if (stopped()) break;
            const Score score = judge_.score(state_, patch, most_loss, state_.score.invalid);
            if (score.loss > most_loss) {
                too_much = std::min(too_much, score.loss - state_.score.loss);
            } else if (score < state_.score) {
                best = &patch;
                step.kept = true;
                step.facets = static_cast<Index>(patch.size());
                step.after = score;
                most_loss = score.loss - 1;
            }
        }
        if (least_loss) *least_loss = step.kept ? loss_limit_ + 1 : too_much;
        if (step.kept) judge_.apply(state_, *best);
        if (options_.trace && step.proposals > 0) options_.trace(step);
        return step.kept;
    }

    // ---- elements

    // An element by something that outlives a relabeling elsewhere.
    static Index name(const State& s, Kind kind, Index i) {
        return kind == Kind::chart      ? s.graph.charts[i].smallest_facet
               : kind == Kind::boundary ? s.graph.halfedges[s.graph.boundaries[i].halfedges.first]
                                        : s.graph.corners[i].vertex;
    }

    // A number for all that lies around an element: the charts that meet there, with their contours. While it stays the
    // same, an operator that was refused there need not be tried again.
    std::uint64_t surroundings(const std::vector<Index>& charts) const {
        Fingerprint print;
        const LabelingGraph& graph = state_.graph;
        for (const Index c : charts) {
            print.mix(graph.charts[c].smallest_facet);
            print.mix(graph.charts[c].label);
            print.mix(graph.charts[c].facets);
            for (Index i = graph.charts[c].boundaries.first; i < graph.charts[c].boundaries.last; i++) {
                const Boundary& b = graph.boundaries[graph.chart_boundaries[i]];
                print.mix(graph.charts[graph.neighbour(graph.chart_boundaries[i], c)].label);
                for (Index k = b.halfedges.first; k < b.halfedges.last; k++) print.mix(graph.halfedges[k]);
            }
        }
        return print.value();
    }

    std::vector<Index> charts_at(Kind kind, Index i) const {
        const LabelingGraph& graph = state_.graph;
        std::vector<Index> charts;
        if (kind == Kind::boundary) charts = {graph.boundaries[i].left, graph.boundaries[i].right};
        if (kind == Kind::chart) {
            charts = {i};
            for (Index k = graph.charts[i].boundaries.first; k < graph.charts[i].boundaries.last; k++)
                charts.push_back(graph.neighbour(graph.chart_boundaries[k], i));
        }
        if (kind == Kind::corner)
            for (Index r = graph.corners[i].rings.first; r < graph.corners[i].rings.last; r++)
                for (Index k = graph.rings[r].halfedges.first; k < graph.rings[r].halfedges.last; k++)
                    charts.push_back(graph.chart[facet(graph.ring_halfedges[k])]);
        return charts;
    }

    // Where the operator was tried before at this place, in the same surroundings: what its proposals cost at least. Null if
    // that is beyond the limit, or the run over.
    std::int64_t* worth_trying(const char* operation, Index place, const std::vector<Index>& charts) {
        if (over()) return nullptr;
        std::int64_t& least_loss = least_loss_[{std::string(operation) + (in_sequence_ ? "/" : ""), place, surroundings(charts)}];
        return least_loss <= loss_limit_ ? &least_loss : nullptr;
    }

    // The operator on one invalid element after the other, until a round keeps nothing. In a sequence only on elements
    // that were valid before it.
    void for_each_invalid(const ValidityOperator& o) {
        for (bool kept = true; kept;) {
            kept = false;
            for (Index i = 0; i < count(state_, o.kind); i++) {
                if (!invalid(state_, o.kind, i)) continue;
                const Index place = name(state_, o.kind, i);
                if (invalid_before_[static_cast<int>(o.kind)].count(place) > 0) continue;
                std::int64_t* least_loss = worth_trying(o.name, place, charts_at(o.kind, i));
                if (least_loss && o.least_loss) *least_loss = o.least_loss(judge_, state_, i);
                if (least_loss && *least_loss <= loss_limit_)
                    kept = once(o.name, i, o.propose(mesh_, state_, i), least_loss) || kept;
            }
        }
    }

    template <class Propose>
    void for_each_turning_point(const Propose& o) {
        for (bool kept = true; kept;) {
            kept = false;
            for (std::size_t i = 0; i < state_.turning.points.size(); i++) {
                const TurningPoint t = state_.turning.points[i];
                if (std::int64_t* least_loss = worth_trying(o.name, t.vertex, charts_at(Kind::boundary, t.boundary)))
                    kept = once(o.name, t.vertex, o.propose(mesh_, state_, t), least_loss) || kept;
            }
        }
    }

    void straighten_boundaries() {
        for (bool kept = true; kept;) {
            kept = false;
            for (Index b = 0; b < count(state_, Kind::boundary); b++)
                if (std::int64_t* least_loss =
                        worth_trying("straighten-boundary", name(state_, Kind::boundary, b), charts_at(Kind::boundary, b)))
                    kept = once("straighten-boundary", b, straighten_boundary(mesh_, state_, b), least_loss) || kept;
        }
    }

    // All of them in one cut, as long as that helps; those that are the part's own shape are spared.
    void remove_invalid_charts() {
        while (!state_.graph.valid()) {
            std::vector<Index> charts;
            for (Index c = 0; c < count(state_, Kind::chart); c++)
                if (!state_.graph.charts[c].valid && !surrounded_by_features(state_, c)) charts.push_back(c);
            std::int64_t* least_loss = worth_trying("remove-charts", kNone, charts);
            if (least_loss) *least_loss = least_loss_of_removal(judge_, state_, charts);
            if (!least_loss || *least_loss > loss_limit_ ||
                !once("remove-charts", kNone, remove_charts(mesh_, state_, charts), least_loss))
                break;
        }
    }

    // ---- sequences

    // Some repairs make things worse before they get better: each proposal is taken as it is, the operators mend what it
    // broke, and the best of these ends is kept if it improves the score.
    void for_each_in_sequence(const ValidityOperator& o) {
        for (Index i = 0; i < count(state_, o.kind); i++) {
            if (!invalid(state_, o.kind, i) || over()) continue;
            const Step step = sequence(o.propose(mesh_, state_, i));
            if (options_.trace && step.proposals > 0)
                options_.trace({std::string("sequence-of-") + o.name, i, false, step.kept, step.proposals, step.facets,
                                step.before, step.after});
        }
    }

    Step sequence(const Proposals& proposals) {
        const State before = state_;
        State best = before;
        Step step{"", kNone, false, false, static_cast<Index>(proposals.size()), 0, before.score, before.score};
        for (const Kind kind : {Kind::chart, Kind::boundary, Kind::corner})
            for (Index i = 0; i < count(state_, kind); i++)
                if (invalid(state_, kind, i)) invalid_before_[static_cast<int>(kind)].insert(name(state_, kind, i));
        in_sequence_ = true;
        for (const Patch& patch : proposals) {
            if (stopped()) break;
            proposals_tried_++;
            state_ = before;
            judge_.apply(state_, patch);
            for (const ValidityOperator& o : kValidityOperators) for_each_invalid(o);
            if (!improves(state_.score, before.score) || (step.kept && state_.score.loss >= best.score.loss)) continue;
            step.kept = true;
            std::swap(state_, best);
        }
        in_sequence_ = false;
        for (std::set<Index>& names : invalid_before_) names.clear();
        state_ = std::move(best);
        step.after = state_.score;
        for (Index f = 0; f < mesh_.facets(); f++) step.facets += state_.labels[f] != before.labels[f];
        return step;
    }

    const TriMesh& mesh_;
    const RoutineOptions& options_;
    Judge judge_;
    State state_;
    Index proposals_tried_ = 0;
    std::int64_t loss_limit_ = 0;
    bool in_sequence_ = false;
    std::set<Index> invalid_before_[3];   // by kind, in a sequence: names of what was invalid at its start
    // By operator, place and surroundings: see worth_trying().
    std::map<std::tuple<std::string, Index, std::uint64_t>, std::int64_t> least_loss_;
};

}   // namespace

State run_routines(const TriMesh& mesh, Labeling start, const RoutineOptions& options) {
    return Routines(mesh, std::move(start), options).run();
}

Proposals all_proposals(const TriMesh& mesh, const State& state, const std::vector<TurningPoint>& points) {
    Proposals all;
    const auto add = [&](Proposals more) {
        for (Patch& patch : more) all.push_back(std::move(patch));
    };
    for (const Kind kind : {Kind::chart, Kind::boundary, Kind::corner})
        for (Index i = 0; i < count(state, kind); i++)
            for (const ValidityOperator& o : kValidityOperators)
                if (o.kind == kind && invalid(state, kind, i)) add(o.propose(mesh, state, i));
    if (!state.graph.valid()) return all;
    for (const TurningPoint& t : points) {
        for (const QualityOperator& o : {kJoin, kPull, kMove, kDirectional}) add(o.propose(mesh, state, t));
        add(straighten_boundary(mesh, state, t.boundary));
    }
    return all;
}

std::string trace_line(const Step& step) {
    std::string line = (step.in_sequence ? "| " : "") + step.operation;
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

}   // namespace polylab

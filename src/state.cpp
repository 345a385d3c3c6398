#include "polylab/state.h"

#include <algorithm>

namespace polylab {

namespace {

constexpr Index kLeastCharts = 6;   // of a component: a polycube faces all six directions
constexpr Index kMissing = 3;       // a missing chart counts like an invalid chart, boundary and corner

}   // namespace

Judge::Judge(const TriMesh& mesh, bool allow_opposite, Labeling locks)
    : mesh_(mesh), allow_opposite_(allow_opposite), locks_(std::move(locks)), effects_(mesh) {
    if (mesh.features_kept > 0)
        loss_per_feature_ =
            static_cast<std::int64_t>(kLostWeight * kLossUnit * mesh.facets() / static_cast<double>(mesh.features_kept));
}

std::int64_t Judge::loss(Index f, Label l) const {
    const double cosine = along(mesh_.normal[f], l);
    return static_cast<std::int32_t>(kLossUnit * ((1 - cosine) / 2 + (cosine < kAway ? kAwayLoss : 0)) + 0.5);
}

// Of a labeling with so many invalid elements and so many charts.
Index Judge::invalid(Index elements, Index charts) const {
    return elements + kMissing * std::max(0, kLeastCharts * mesh_.components - charts);
}

State Judge::state(Labeling labels) const {
    State state;
    state.labels = std::move(labels);
    for (std::size_t f = 0; f < locks_.size(); f++)
        if (locks_[f] != kNoLabel) state.labels[f] = locks_[f];
    state.graph = build_graph(mesh_, state.labels, allow_opposite_);
    state.turning = find_turning_points(mesh_, state.graph);
    state.score = {invalid(state.graph.invalid(), static_cast<Index>(state.graph.charts.size())),
                   static_cast<Index>(state.turning.points.size()), 0};
    for (Index f = 0; f < mesh_.facets(); f++) state.score.loss += loss(f, state.labels[f]);
    for (Index h = 0; h < mesh_.halfedges(); h++)
        if (mesh_.feature[h] && h < mesh_.opposite[h] && !state.graph.is_border(h)) state.score.loss += loss_per_feature_;
    return state;
}

Score Judge::score(const State& state, const Patch& patch, std::int64_t most_loss, Index most_invalid) {
    if (!locks_.empty()) {
        allowed_.clear();
        for (const Relabel& r : patch)
            if (!locked(r.facet)) allowed_.push_back(r);
    }
    const Index lost = effects_.begin(state.labels, state.graph, state.turning, locks_.empty() ? patch : allowed_);
    Score score = {kUnknown, kUnknown, state.score.loss + loss_per_feature_ * lost};
    for (const Relabel& r : effects_.changes()) score.loss += loss(r.facet, r.label) - loss(r.facet, state.labels[r.facet]);
    if (score.loss > most_loss) return score;
    effect_ = effects_.finish(most_invalid == kUnknown ? kUnknown : most_invalid - state.graph.invalid());
    if (state.graph.invalid() + effect_.invalid > most_invalid) return score;
    score.invalid =
        invalid(state.graph.invalid() + effect_.invalid, static_cast<Index>(state.graph.charts.size()) + effect_.charts);
    score.turning_points = state.score.turning_points + effect_.turning_points;
    return score;
}

void Judge::apply(State& state, const Patch& patch) {
    state.score = score(state, patch);
    if (effects_.changes().empty()) return;
    effects_.describe(change_);
    for (const Relabel& r : effects_.changes()) state.labels[r.facet] = r.label;
    const std::vector<Boundary> boundaries = state.graph.boundaries;
    const std::vector<Index> halfedges = state.graph.halfedges;
    update_graph(mesh_, state.labels, change_, state.graph);
    state.turning = find_turning_points(mesh_, state.graph, boundaries, halfedges, state.turning);
}

}   // namespace polylab

#include "polylab/state.h"

#include <algorithm>

namespace polylab {

namespace {

constexpr Index kLeastCharts = 6;   // of a component: a polycube faces all six directions
constexpr Index kMissing = 3;       // a missing chart counts like an invalid chart, boundary and corner

}   // namespace

Judge::Judge(const TriMesh& mesh, bool allow_opposite, Labeling locks)
    : mesh_(mesh), allow_opposite_(allow_opposite), locks_(std::move(locks)) {
    loss_.resize(mesh.facets());
    for (Index f = 0; f < mesh.facets(); f++)
        for (Label l = 0; l < kLabels; l++)
            loss_[f][l] = static_cast<std::int32_t>(kLossUnit * (1 - along(mesh.normal[f], l)) / 2 + 0.5);
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && h < mesh.opposite[h]) features_.push_back(h);
    if (!features_.empty())
        loss_per_feature_ =
            static_cast<std::int64_t>(kLostWeight * kLossUnit * mesh.facets() / static_cast<double>(features_.size()));
}

State Judge::state(Labeling labels) const {
    State state;
    state.labels = std::move(labels);
    for (std::size_t f = 0; f < locks_.size(); f++)
        if (locks_[f] != kNoLabel) state.labels[f] = locks_[f];
    state.graph.allow_opposite = allow_opposite_;
    derive(state);
    return state;
}

void Judge::apply(const State& state, const Patch& patch, State& result) const {
    result.labels = state.labels;
    result.graph.allow_opposite = allow_opposite_;
    for (const Relabel& r : patch)
        if (free(r.facet)) result.labels[r.facet] = r.label;
    derive(result);
}

void Judge::derive(State& state) const {
    build_graph(mesh_, state.labels, state.graph);
    state.turning = find_turning_points(mesh_, state.graph);
    const Index missing = std::max(0, kLeastCharts * mesh_.components - static_cast<Index>(state.graph.charts.size()));
    state.score = {state.graph.invalid() + kMissing * missing, static_cast<Index>(state.turning.points.size()), 0};
    for (Index f = 0; f < mesh_.facets(); f++) state.score.loss += loss_[f][state.labels[f]];
    for (const Index h : features_)
        if (!state.graph.is_border(h)) state.score.loss += loss_per_feature_;
}

}   // namespace polylab

// polish.h: borders that a repair has left uneven are drawn again, without giving up what it has won. Not in the paper.
//
// The routines repair with whole strips, and end when a labeling is valid and monotone. Here the places that they changed are
// cut once more. What is cut is judged like any other step, so that invalid elements and turning-points don't come back.
#pragma once

#include "polylab/routines.h"

#include <array>
#include <map>
#include <vector>

namespace polylab {

class Redraw {
public:
    explicit Redraw(const TriMesh& mesh) : mesh_(mesh), expansion_(energy_) {}
    Redraw(const Redraw&) = delete;
    Redraw& operator=(const Redraw&) = delete;

    // The given facets (all different), all others being fixed, take the labels that occur on and next to them, by a graph-cut.
    // Its data cost is the loss of fidelity, linear in the normal, so that it also tells labels apart that all point away from a
    // facet; the cost of Section 5 doesn't. Borders on kept feature edges cost nothing. The first proposal is the whole change;
    // if it falls into several edge-connected parts, these follow. O(n) in the facets given, but for the max-flow
    Proposals operator()(const State& state, const std::vector<Index>& facets, int compactness);

private:
    using Occurs = std::array<bool, kLabels>;

    Index data_cost(Index f, Label l) const;
    void cut(const State& state, const std::vector<Index>& facets, const Occurs& occurs, int compactness);
    void cut_without_edges(const std::vector<Index>& facets, const Occurs& occurs);
    Proposals changes(const State& state, const std::vector<Index>& facets) const;

    const TriMesh& mesh_;
    std::map<int, std::vector<std::int16_t>> pairwise_;   // compactness -> half-edge -> cost, kNone where not asked for yet

    // Memory of a call.
    Marks sites_;
    PottsEnergy energy_;
    Labeling labels_;   // of the facets
    std::vector<Index> costs_;
    Expansion expansion_;
};

// `state` with better labels for faces beside lost feature edges, the borders near the facets that differ from `start` redrawn,
// and facets turned that point away from their label, as long as that improves the score and makes no new chart.
// Bounded as run_routines() is. Never worse than `state`.
State polish(const TriMesh& mesh, const Labeling& start, State state, const RoutineOptions& options = {});

}   // namespace polylab

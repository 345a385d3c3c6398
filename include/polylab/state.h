// state.h: a labeling together with all that is derived from it, and the score by which two are compared.
//
// differs: the published routines apply operators unconditionally. Here each one proposes a Patch, and the routine keeps
// it only if the score improves, so that a result is never worse than its start.
#pragma once

#include "polylab/patch.h"

#include <cstdint>
#include <tuple>
#include <vector>

namespace polylab {

// Compared from left to right, less is better; integers only.
struct Score {
    Index invalid = 0;          // charts, boundaries and corners; three for each chart that a component lacks of six
    Index turning_points = 0;   // the count that depends on no direction
    std::int64_t loss = 0;      // fidelity and feature edges, see Judge

    bool operator<(const Score& b) const {
        return std::tie(invalid, turning_points, loss) < std::tie(b.invalid, b.turning_points, b.loss);
    }
    bool operator==(const Score& b) const { return !(*this < b) && !(b < *this); }
};

struct State {
    Labeling labels;
    LabelingGraph graph;
    TurningPoints turning;
    Score score;
};

// A facet points away from its label where the cosine of normal and label is below this (fidelity 0.3): no mesher can use it.
inline constexpr double kAway = -0.4;
inline constexpr double kAwayLoss = 10;   // of such a facet, beyond its fidelity

// Derives states from labelings. The loss is the mean of (1 - fidelity) plus kLostWeight times the share of the kept
// feature edges that are lost, in integers: a labeling may lose 1 % of the feature edges for 0.005 of mean fidelity.
// Neither extreme is right: a part can keep every edge by labels that fit badly. Facets that point away cost extra.
inline constexpr double kLostWeight = 0.5;
inline constexpr double kLossUnit = 1e6;   // the loss of a facet whose fidelity is 0

inline constexpr std::int64_t kAnyLoss = std::numeric_limits<std::int64_t>::max();
inline constexpr Index kUnknown = std::numeric_limits<Index>::max();

class Judge {
public:
    // Locked facets have the labels of `locks` whatever a labeling or a patch says; an empty list locks none, kNoLabel leaves
    // free.
    explicit Judge(const TriMesh& mesh, bool allow_opposite = true, Labeling locks = {});

    const TriMesh& mesh() const { return mesh_; }
    State state(Labeling labels) const;
    // The score that `state` would have with the patch applied, at the price of what the patch changes.
    Score score(const State& state, const Patch& patch) { return score(state, patch, kAnyLoss, kUnknown); }
    // The same where it is of interest only if neither the loss nor the number of invalid elements becomes more than this, which
    // is quicker to see: if not, only the loss is right, and the rest is kUnknown, worse than any.
    Score score(const State& state, const Patch& patch, std::int64_t most_loss, Index most_invalid);
    // How many charts the patch scored last would add.
    Index added_charts() const { return effect_.charts; }
    // Makes `state` that of its labels with the patch applied. At the price of update_graph()
    void apply(State& state, const Patch& patch);
    std::int64_t loss(Index f, Label l) const;   // kLossUnit (1 - fidelity), and kAwayLoss more
    bool locked(Index f) const { return !locks_.empty() && locks_[f] != kNoLabel; }
    std::int64_t loss_per_feature() const { return loss_per_feature_; }   // of each that is lost

private:
    Index invalid(Index elements, Index charts) const;

    const TriMesh& mesh_;
    bool allow_opposite_;
    Labeling locks_;
    std::int64_t loss_per_feature_ = 0;
    EffectFinder effects_;
    Effect effect_;        // of the patch scored last
    Patch allowed_;        // memory of score(): the patch without locked facets
    GraphChange change_;   // of apply()
};

}   // namespace polylab

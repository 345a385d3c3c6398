// alpha_expansion.h: approximate minimum of a Potts energy with more than two labels.
//
//   E(L) = sum over sites of data[site][L_site]  +  sum over edges of weight * [L_first != L_second]
//
// Y. Boykov, O. Veksler, R. Zabih. Fast Approximate Energy Minimization via Graph Cuts. PAMI 2001. A move lets every site
// keep its label or take alpha, at the least energy: one minimum cut. Costs are integers, so the result depends only on
// them, the order of the labels, the number of cycles and the start.
#pragma once

#include "polylab/labels.h"
#include "polylab/maxflow.h"

#include <array>
#include <vector>

namespace polylab {

struct PottsEnergy {
    std::vector<std::array<Index, kLabels>> data;   // site -> cost of each label, 0 .. 2^24
    std::vector<Index> ends;                        // 2 sites per edge, different ones
    std::vector<Index> weight;                      // edge -> cost of different labels, 0 .. 2^24

    std::int64_t operator()(const Labeling& labels) const;
};

// The best move towards alpha from `labels`: applied, and true returned, if its energy is lower than before.
// tie: among the moves of least energy, the one in which most sites take alpha. Cost: one max-flow.
// Alpha is the source side. A site that has alpha stays; the edges to its neighbours cost them for keeping. port: any exact
// construction gives the same move, since the minimum cut with the largest source side is unique.
bool expand(const PottsEnergy& energy, MaxFlow& network, Label alpha, Labeling& labels);

// Cycles over the labels 0..5 in this order, at most `cycles`, ending early after a cycle without change, or before the
// next move once `stop` says so.
Labeling alpha_expansion(const PottsEnergy& energy, Labeling start, int cycles = 2, const Stop& stop = {});

}   // namespace polylab

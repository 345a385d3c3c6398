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

// The moves of one energy. A site on the source side of the cut takes alpha, one on the sink side
// keeps its label. Most sites are decided before the max-flow: one whose own gain outweighs all of its edges takes alpha
// whatever its neighbours do, and one whose loss does keeps its label; that settles its edges, and may decide its neighbours.
// Of the rest, connected sites of which none would lose by alpha take it, and of which none would gain keep. What is left is
// cut out of the network and solved by max-flow. All of this is exact.
// port: any exact construction gives the same moves, since the minimum cut with the largest source side is unique.
class Expansion {
public:
    explicit Expansion(PottsEnergy energy);   // O(sites + edges)

    // The best move towards alpha from `labels`: applied, and true returned, if its energy is lower than before.
    // tie: among the moves of least energy, the one in which most sites take alpha. O(sites + edges), and one max-flow.
    bool move(Label alpha, Labeling& labels);

private:
    enum class Choice : char { open, takes, keeps, in_core };
    struct Arc {
        Index site, weight;
    };

    Index arc_begin(Index i) const { return first_[i]; }
    Index arc_end(Index i) const { return first_[i + 1]; }
    void decide(Index i);
    void settle_edges(const Labeling& labels);
    void collect_core(const Labeling& labels);
    void solve_core(const Labeling& labels);
    std::int64_t gain(Label alpha, const Labeling& labels) const;

    std::vector<std::array<Index, kLabels>> data_;   // as in the energy
    std::vector<Index> first_;                       // the arcs of site i are first_[i] .. first_[i+1] - 1
    std::vector<Arc> arcs_;                          // edges with a weight, from both ends

    // Of the current move, all costs doubled:
    std::vector<Choice> choice_;
    std::vector<Index> excess_;                      // site -> what it gains by alpha, with the edges to decided sites
    std::vector<Index> around_;                      // site -> capacity of its edges to open sites
    std::vector<Index> queue_;                       // decided sites, whose neighbours have to be told
    std::vector<Index> core_;                        // the sites that max-flow decides
    std::vector<Index> node_;                        // site -> its number in core_
    std::vector<Index> core_ends_, core_capacity_;   // its edges
    MaxFlow network_;
};

// Cycles over the labels 0..5 in this order, at most `cycles`, ending early after a cycle without change, or before the
// next move once `stop` says so.
Labeling alpha_expansion(PottsEnergy energy, Labeling start, int cycles = 2, const Stop& stop = {});

}   // namespace polylab

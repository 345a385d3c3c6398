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

// Sites are facets, so each has three edges at most, and a fixed place for each: nothing has to be sorted or looked up.
struct PottsEnergy {
    struct Arc {
        Index site, weight;   // the site at the other end; cost of different labels, 0 .. 2^24
    };
    std::vector<std::array<Index, kLabels>> data;   // site -> cost of each label, 0 .. 2^24
    std::vector<std::array<Arc, 3>> arcs;           // site -> its edges; where it has fewer, arcs of weight 0 to itself

    PottsEnergy() = default;
    explicit PottsEnergy(Index sites);   // without edges, all labels for nothing

    Index sites() const { return static_cast<Index>(data.size()); }
    // Adds an edge between two sites, each of which has at most two so far.
    void connect(Index a, Index b, Index weight);
    std::int64_t operator()(const Labeling& labels) const;
};

// The moves of an energy, which stays the caller's. A site on the source side of the cut takes alpha, one on the sink side keeps
// its label. Work goes only where something can change, and all of it is exact:
// - Sites that take alpha together can only gain if one of them is ready: if it would not lose even where none of the edges
//   that it separates cost anything. From the ready sites a region grows, by neighbours that lose no more than the capacity
//   of their edges to it. All others keep their labels.
// - In the region, a site whose own gain outweighs all of its edges takes alpha whatever its neighbours do, and one whose loss
//   does keeps its label; that settles its edges, and may decide its neighbours.
// - Of the rest, connected sites of which none would lose by alpha take it, and of which none would gain keep.
// - What is left is cut out of the network and solved by max-flow.
// port: any exact construction gives the same moves, since the minimum cut with the largest source side is unique.
class Expansion {
public:
    explicit Expansion(const PottsEnergy& energy) : energy_(energy) {}

    // Before the first move, and after the energy has changed. O(sites)
    void begin(Labeling start);
    const Labeling& labels() const { return labels_; }

    // The best move towards alpha: made, and true returned, if its energy is lower than before.
    // tie: among the moves of least energy, the one in which most sites take alpha. O(region), one max-flow, and a glance at
    // every site.
    bool move(Label alpha);

private:
    enum class Choice : char { outside, beside, open, takes, keeps, in_core };   // outside the region and beside it they keep
    // All costs doubled.
    struct Site {
        Index excess = 0;   // what it gains by alpha, with the edges to decided sites
        Index around = 0;   // capacity of its edges to open sites, or to the region from beside it; in the core, its number there
        Choice choice = Choice::outside;
    };

    static constexpr unsigned char kChanged = 1u << kLabels;

    template <class Visit>
    void for_each_with(unsigned char bit, const Visit& visit) const;
    void find_ready(Index i);
    Index excess(Index i, Label alpha) const;
    void grow_region(Label alpha);
    void decide(Index i);
    void settle_edges();
    void collect_core();
    void solve_core();
    std::int64_t gain(Label alpha) const;
    void take(Label alpha);

    const PottsEnergy& energy_;
    Labeling labels_;
    // site -> a bit for each label that it is ready for; kChanged: to be found again. Filled up with zeros to a multiple of
    // eight.
    std::vector<unsigned char> ready_;

    // Of the current move:
    std::vector<Site> sites_;
    std::vector<Index> region_, beside_;   // the sites that may take alpha, and their neighbours
    std::vector<Index> queue_;             // decided sites, whose neighbours have to be told
    std::vector<Index> core_;              // the sites that max-flow decides
    MaxFlow network_;
};

// Cycles over the labels 0..5 in this order, at most `cycles`, ending early after a cycle without change, or before the
// next move once `stop` says so.
Labeling alpha_expansion(const PottsEnergy& energy, Labeling start, int cycles = 2, const Stop& stop = {});

}   // namespace polylab

// maxflow.h: maximum flow and minimum cut on graphs with integer capacities.
//
// The algorithm of Y. Boykov, V. Kolmogorov. An Experimental Comparison of Min-Cut/Max-Flow Algorithms for Energy
// Minimization in Vision. PAMI 2004, written from that paper.
//
// Why the cut does not depend on which maximum flow was found: the minimum cuts of a graph are closed under union and
// intersection, so there is one with the largest source side, and it is unique. A node is outside of it exactly when it
// can still reach the sink in the residual graph of a maximum flow, of any maximum flow. Capacities are integers, so no
// rounding blurs "can still". Any port with any max-flow algorithm that answers on_source_side() by this rule (search
// backwards from the sink) gives the same labels.
#pragma once

#include "polylab/base.h"

#include <vector>

namespace polylab {

class MaxFlow {
public:
    // A graph of n nodes and undirected edges (ends[2e], ends[2e+1]), all without capacity. O(nodes + edges)
    MaxFlow(Index nodes, const std::vector<Index>& ends);

    Index nodes() const { return static_cast<Index>(first_.size()) - 1; }
    Index edges() const { return static_cast<Index>(arc_of_edge_.size()) / 2; }

    // All capacities and the flow back to zero; the graph stays.
    void clear();

    // Adds capacity to edge e: `there` from its first end to its second, `back` the other way. Not negative.
    void add_edge_capacity(Index e, Index there, Index back);

    // Adds the arcs source -> node and node -> sink. Not negative.
    void add_terminals(Index node, Index from_source, Index to_sink);

    // Pushes a maximum flow and returns its value. Call once after the capacities are set.
    std::int64_t solve();

    // Whether the node belongs to the largest source side of a minimum cut. After solve().
    // tie: a node that fits both sides is on the source side
    bool on_source_side(Index node) const { return tree_[node] != Tree::sink; }

private:
    enum class Tree : char { none, source, sink };

    bool join_or_meet(Index node, Index arc);
    void augment(Index arc);
    Index& toward_root(Index arc, Tree tree);
    Index& from_root(Index arc, Tree tree);
    void adopt(Index node);
    Index distance_to_root(Index node);
    void activate(Index node);
    void make_orphan(Index node);

    std::vector<Index> first_;         // the arcs of node i are first_[i] .. first_[i+1] - 1
    std::vector<Index> head_;          // arc -> the node it points to
    std::vector<Index> sister_;        // arc -> the reverse arc
    std::vector<Index> residual_;      // arc -> residual capacity
    std::vector<Index> arc_of_edge_;   // edge -> its two arcs, there and back

    std::vector<Index> terminal_;   // node -> residual capacity from the source (> 0) or to the sink (< 0)
    std::vector<Tree> tree_;        // node -> search tree it belongs to
    std::vector<Index> parent_;     // node -> arc to its parent, or kRoot, kOrphan, kNone
    std::vector<Index> stamp_;      // node -> augmentation after which its distance was found
    std::vector<Index> distance_;   // node -> number of arcs to its terminal, at that time

    std::vector<Index> active_;   // ring buffer of nodes whose arcs may lead out of their tree
    std::vector<char> queued_;    // node -> 1 while in active_
    std::size_t active_begin_ = 0, active_count_ = 0;
    std::vector<Index> orphans_;   // nodes that lost their parent
    Index augmentations_ = 0;
    std::int64_t flow_ = 0;
};

}   // namespace polylab

// maxflow.h: maximum flow and minimum cut on graphs with integer capacities.
//
// The algorithm of Y. Boykov, V. Kolmogorov. An Experimental Comparison of Min-Cut/Max-Flow Algorithms for Energy
// Minimization in Vision. PAMI 2004, written from that paper. What lies between far ends is moved there before, in bulk, by
// sweeps over all nodes: augmenting paths one by one would walk the same long way thousands of times.
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

// Nodes are facets, so each has three edges at most: they have fixed places, and nothing is sorted or looked up.
class MaxFlow {
public:
    // A graph of n nodes without edges. O(n)
    explicit MaxFlow(Index nodes = 0) { reset(nodes); }
    // The same in the memory of this one.
    void reset(Index nodes);

    Index nodes() const { return static_cast<Index>(terminal_.size()); }

    // Adds an edge with capacity `there` from a to b, and `back` from b to a, not negative. Each has two edges at most so far.
    void connect(Index a, Index b, Index there, Index back);

    // Adds the arcs source -> node and node -> sink. Not negative.
    void add_terminals(Index node, Index from_source, Index to_sink);

    // Pushes a maximum flow and returns its value. Call once after the capacities are set.
    std::int64_t solve();

    // Whether the node belongs to the largest source side of a minimum cut. After solve().
    // tie: a node that fits both sides is on the source side
    bool on_source_side(Index node) const { return place_[node] < 0; }

private:
    enum class Tree : char { none, source, sink, apart };   // apart: no path from a source to a sink goes through the node

    template <int Sign>
    std::int64_t sweep();
    template <int Sign>
    bool find_places(bool all);
    void set_apart();
    void grow_trees();
    bool join_or_meet(Index node, Index arc);
    void augment(Index arc);
    void push(Index arc, Index amount);
    Index toward_root(Index arc, Tree tree) const;
    Index from_root(Index arc, Tree tree) const;
    void adopt(Index node);
    Index distance_to_root(Index node);
    void activate(Index node);
    void make_orphan(Index node);

    struct Arc {
        Index sister;     // the reverse arc; the arc itself where a node has fewer edges
        Index residual;   // capacity left
        Index back;       // that of the sister, kept here too: searches go both ways, and need not look there

        Index head() const { return static_cast<Index>(static_cast<std::uint32_t>(sister) / 3); }   // the node it points to
    };
    struct Node {
        Index parent = kNone;     // arc to its parent, or kRoot, kOrphan, kNone
        Index stamp = 0;          // augmentation after which its distance was found
        Index distance = 0;       // number of arcs to its terminal, at that time
        Tree tree = Tree::none;   // search tree it belongs to
        bool queued = false;      // in active_
    };
    static constexpr Index kWaiting = -2, kApart = -3;   // places of a node that waits to be met, or is apart

    std::vector<Arc> arcs_;                // those of node i are 3i, 3i + 1, 3i + 2
    std::vector<Node> nodes_;              // while the trees grow
    std::vector<std::int64_t> terminal_;   // node -> residual capacity from the source (> 0) or to the sink (< 0)

    std::vector<Index> place_;    // node -> its place in active_ by the last search; kNone or kWaiting: not met; kApart
    std::vector<Index> within_;   // the nodes that are not apart
    // Ring buffer of nodes whose arcs may lead out of their tree. In a sweep: the nodes met, nearest first, and room for one
    // more, which a search writes before it knows whether it counts.
    std::vector<Index> active_;
    std::size_t active_begin_ = 0, active_count_ = 0;
    std::vector<Index> orphans_;   // nodes that lost their parent
    Index augmentations_ = 0;
    std::int64_t flow_ = 0;
};

}   // namespace polylab

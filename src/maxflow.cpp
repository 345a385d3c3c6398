#include "polylab/maxflow.h"

#include <algorithm>
#include <cassert>

namespace polylab {

namespace {

constexpr Index kRoot = -2;     // parent of a node that hangs on its terminal
constexpr Index kOrphan = -3;   // parent of a node that has lost its own
constexpr Index kFar = std::numeric_limits<Index>::max();

}   // namespace

MaxFlow::MaxFlow(Index nodes, const std::vector<Index>& ends) : first_(nodes + 1, 0) {
    const Index arcs = static_cast<Index>(ends.size());
    for (const Index node : ends) first_[node + 1]++;
    for (Index i = 0; i < nodes; i++) first_[i + 1] += first_[i];
    std::vector<Index> place(first_.begin(), first_.end() - 1);
    head_.resize(arcs);
    sister_.resize(arcs);
    arc_of_edge_.resize(arcs);
    for (Index e = 0; e < arcs; e += 2) {
        assert(ends[e] != ends[e + 1]);
        const Index there = place[ends[e]]++, back = place[ends[e + 1]]++;
        head_[there] = ends[e + 1];
        head_[back] = ends[e];
        sister_[there] = back;
        sister_[back] = there;
        arc_of_edge_[e] = there;
        arc_of_edge_[e + 1] = back;
    }
    residual_.resize(arcs);
    terminal_.resize(nodes);
    tree_.resize(nodes);
    parent_.resize(nodes);
    stamp_.resize(nodes);
    distance_.resize(nodes);
    active_.resize(nodes);
    queued_.resize(nodes);
    clear();
}

void MaxFlow::clear() {
    std::fill(residual_.begin(), residual_.end(), 0);
    std::fill(terminal_.begin(), terminal_.end(), 0);
    std::fill(tree_.begin(), tree_.end(), Tree::none);
    std::fill(parent_.begin(), parent_.end(), kNone);
    std::fill(stamp_.begin(), stamp_.end(), 0);
    std::fill(queued_.begin(), queued_.end(), char{0});
    active_begin_ = active_count_ = 0;
    orphans_.clear();
    augmentations_ = 0;
    flow_ = 0;
}

void MaxFlow::add_edge_capacity(Index e, Index there, Index back) {
    assert(there >= 0 && back >= 0);
    residual_[arc_of_edge_[2 * e]] += there;
    residual_[arc_of_edge_[2 * e + 1]] += back;
}

void MaxFlow::add_terminals(Index node, Index from_source, Index to_sink) {
    assert(from_source >= 0 && to_sink >= 0);
    // What goes straight through the node is flow already; terminal_ holds what is left at one of its sides.
    const Index source = from_source + std::max(terminal_[node], 0), sink = to_sink + std::max(-terminal_[node], 0);
    flow_ += std::min(source, sink);
    terminal_[node] = source - sink;
}

// Grows the two trees from the terminals until they meet, augments the path, repairs the trees, and goes on from there:
// when no active node is left, no residual path joins source and sink.
std::int64_t MaxFlow::solve() {
    for (Index i = 0; i < nodes(); i++) {
        if (terminal_[i] == 0) continue;
        tree_[i] = terminal_[i] > 0 ? Tree::source : Tree::sink;
        parent_[i] = kRoot;
        distance_[i] = 1;
        activate(i);
    }
    while (active_count_ > 0) {
        const Index node = active_[active_begin_];
        active_begin_ = active_begin_ + 1 == active_.size() ? 0 : active_begin_ + 1;
        active_count_--;
        queued_[node] = 0;
        for (Index arc = first_[node]; arc < first_[node + 1] && tree_[node] != Tree::none;) {
            if (!join_or_meet(node, arc)) {
                arc++;
                continue;
            }
            augment(tree_[node] == Tree::source ? arc : sister_[arc]);
            for (std::size_t i = 0; i < orphans_.size(); i++) adopt(orphans_[i]);
            orphans_.clear();
            // The same arc again: it may have capacity left, or its other end may have become free.
        }
    }
    return flow_;
}

// Residual capacity along the direction in which flow runs through the tree, for an arc that points to the parent:
// from the parent in the source tree, to the parent in the sink tree.
Index& MaxFlow::toward_root(Index arc, Tree tree) { return residual_[tree == Tree::source ? sister_[arc] : arc]; }

// The same for an arc that points away from the root.
Index& MaxFlow::from_root(Index arc, Tree tree) { return residual_[tree == Tree::source ? arc : sister_[arc]]; }

// Growth of `node` along one arc. True if the other end belongs to the other tree: an augmenting path.
bool MaxFlow::join_or_meet(Index node, Index arc) {
    const Tree tree = tree_[node];
    if (from_root(arc, tree) == 0) return false;
    const Index other = head_[arc];
    if (tree_[other] == Tree::none) {
        tree_[other] = tree;
        parent_[other] = sister_[arc];
        stamp_[other] = stamp_[node];
        distance_[other] = distance_[node] + 1;
        activate(other);
    } else if (tree_[other] != tree) {
        return true;
    } else if (stamp_[other] <= stamp_[node] && distance_[other] > distance_[node] + 1) {
        // A shorter way to the root: keeps the trees shallow, and the paths short.
        parent_[other] = sister_[arc];
        stamp_[other] = stamp_[node];
        distance_[other] = distance_[node] + 1;
    }
    return false;
}

// Pushes as much as possible along the path root - tail(arc) - head(arc) - root; `arc` leads from the source tree to the
// sink tree. Nodes whose link to the parent is saturated become orphans.
void MaxFlow::augment(Index arc) {
    const Index ends[2] = {head_[sister_[arc]], head_[arc]};
    Index amount = residual_[arc];
    for (const Index end : ends) {
        Index i = end;
        for (; parent_[i] != kRoot; i = head_[parent_[i]]) amount = std::min(amount, toward_root(parent_[i], tree_[i]));
        amount = std::min(amount, std::abs(terminal_[i]));
    }
    augmentations_++;
    flow_ += amount;
    residual_[arc] -= amount;
    residual_[sister_[arc]] += amount;
    for (const Index end : ends) {
        Index i = end;
        while (parent_[i] != kRoot) {
            const Index up = parent_[i];
            toward_root(up, tree_[i]) -= amount;
            from_root(up, tree_[i]) += amount;
            if (toward_root(up, tree_[i]) == 0) make_orphan(i);
            i = head_[up];
        }
        terminal_[i] -= terminal_[i] > 0 ? amount : -amount;
        if (terminal_[i] == 0) make_orphan(i);
    }
}

// Finds a new parent for an orphan, in its own tree and with a way to the root; or sets it free and orphans its children.
void MaxFlow::adopt(Index node) {
    const Tree tree = tree_[node];
    Index best = kNone, best_distance = kFar;
    for (Index arc = first_[node]; arc < first_[node + 1]; arc++) {
        const Index other = head_[arc];
        if (tree_[other] != tree || toward_root(arc, tree) == 0) continue;
        const Index distance = distance_to_root(other);
        if (distance < best_distance) {
            best = arc;
            best_distance = distance;
        }
    }
    parent_[node] = best;
    if (best != kNone) {
        stamp_[node] = augmentations_;
        distance_[node] = best_distance + 1;
        return;
    }
    for (Index arc = first_[node]; arc < first_[node + 1]; arc++) {
        const Index other = head_[arc];
        if (tree_[other] != tree) continue;
        if (toward_root(arc, tree) > 0) activate(other);   // it could have had this node as a child
        if (parent_[other] >= 0 && head_[parent_[other]] == node) make_orphan(other);
    }
    tree_[node] = Tree::none;
}

// Number of arcs from the node to its terminal, or kFar if the way ends at an orphan. The nodes on the way remember it.
Index MaxFlow::distance_to_root(Index node) {
    Index distance = 0, i = node;
    while (true) {
        if (stamp_[i] == augmentations_) {
            distance += distance_[i];
            break;
        }
        distance++;
        if (parent_[i] == kRoot) {
            stamp_[i] = augmentations_;
            distance_[i] = 1;
            break;
        }
        if (parent_[i] < 0) return kFar;
        i = head_[parent_[i]];
    }
    Index left = distance;
    for (i = node; stamp_[i] != augmentations_; i = head_[parent_[i]]) {
        stamp_[i] = augmentations_;
        distance_[i] = left--;
    }
    return distance;
}

void MaxFlow::activate(Index node) {
    if (queued_[node]) return;
    queued_[node] = 1;
    const std::size_t end = active_begin_ + active_count_++;
    active_[end < active_.size() ? end : end - active_.size()] = node;
}

void MaxFlow::make_orphan(Index node) {
    parent_[node] = kOrphan;
    orphans_.push_back(node);
}

}   // namespace polylab

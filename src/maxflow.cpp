#include "polylab/maxflow.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace polylab {

namespace {

constexpr Index kRoot = -2;     // parent of a node that hangs on its terminal
constexpr Index kOrphan = -3;   // parent of a node that has lost its own
constexpr Index kFar = std::numeric_limits<Index>::max();

}   // namespace

void MaxFlow::reset(Index nodes) {
    arcs_.resize(3 * static_cast<std::size_t>(nodes));
    for (Index arc = 0; arc < 3 * nodes; arc++) arcs_[arc] = {arc, 0, 0};
    terminal_.assign(nodes, 0);
    active_.resize(nodes + 1);
    place_.resize(nodes);
    active_begin_ = active_count_ = 0;
    orphans_.clear();
    augmentations_ = 0;
    flow_ = 0;
}

void MaxFlow::connect(Index a, Index b, Index there, Index back) {
    assert(a != b && there >= 0 && back >= 0);
    const auto free_arc = [&](Index node) {
        Index arc = 3 * node;
        while (arcs_[arc].sister != arc) arc++;
        assert(arc < 3 * node + 3);
        return arc;
    };
    const Index arc = free_arc(a), sister = free_arc(b);
    arcs_[arc] = {sister, there, back};
    arcs_[sister] = {arc, back, there};
}

void MaxFlow::add_terminals(Index node, Index from_source, Index to_sink) {
    assert(from_source >= 0 && to_sink >= 0);
    // What goes straight through the node is flow already; terminal_ holds what is left at one of its sides.
    const std::int64_t terminal = terminal_[node];
    const std::int64_t source = from_source + std::max<std::int64_t>(terminal, 0),
                       sink = to_sink + std::max<std::int64_t>(-terminal, 0);
    flow_ += std::min(source, sink);
    terminal_[node] = source - sink;
}

// Moves what the sources have (Sign 1) towards the sinks, or what the sinks lack (-1) towards the sources: all of it at
// once, from the farthest nodes to the nearest, each node passing on what it has to those met before it. Where it can't go
// on it stays, as capacity between the terminal and that node. The value of every cut stays the same, but for the flow that
// has arrived, so the minimum cuts are those of the graph as it was. Returns what moved over all arcs. O(nodes that are not
// apart, and their edges)
template <int Sign>
std::int64_t MaxFlow::sweep() {
    constexpr Tree kFrom = Sign > 0 ? Tree::source : Tree::sink;
    const bool all_met = find_places<Sign>(false);
    std::int64_t moved = 0;
    for (std::size_t k = active_count_; k-- > 0;) {
        const Index i = active_[k];
        std::int64_t& own = terminal_[i];
        for (Index arc = 3 * i; arc < 3 * i + 3 && Sign * own > 0; arc++) {
            if (static_cast<std::uint32_t>(place_[arcs_[arc].head()]) >= k) continue;   // met later, or not at all
            std::int64_t& other = terminal_[arcs_[arc].head()];
            const auto amount = static_cast<Index>(std::min<std::int64_t>(Sign * own, from_root(arc, kFrom)));
            push(arc, Sign * amount);
            if (Sign * other < 0) flow_ += std::min<std::int64_t>(amount, -Sign * other);
            own -= Sign * amount;
            other += Sign * amount;
            moved += amount;
        }
    }
    if (!all_met) set_apart();
    active_count_ = 0;
    return moved;
}

// The places of nodes, breadth-first from the sinks (Sign 1) or the sources (-1), against the direction in which a sweep moves:
// of all nodes that can be met, or until those are met that have something to move. Whether they are. The nodes that were met are
// in active_ then, nearest first.
template <int Sign>
bool MaxFlow::find_places(bool all) {
    constexpr Tree kFrom = Sign > 0 ? Tree::source : Tree::sink;
    Index waiting = all;
    for (const Index i : within_) {
        const std::int64_t terminal = Sign * terminal_[i];
        place_[i] = terminal > 0 ? kWaiting : kNone;
        waiting += terminal > 0;
        if (terminal >= 0) continue;
        place_[i] = static_cast<Index>(active_count_);
        active_[active_count_++] = i;
    }
    std::size_t count = active_count_;
    for (std::size_t k = 0; k < count && waiting > 0; k++) {
        const Index near = active_[k];
        for (Index arc = 3 * near; arc < 3 * near + 3; arc++) {   // without branches, which nothing could foretell
            const Index other = arcs_[arc].head(), place = place_[other];
            const bool met = (place == kNone || place == kWaiting) & (toward_root(arc, kFrom) != 0);
            place_[other] = met ? static_cast<Index>(count) : place;
            active_[count] = other;
            count += met;
            waiting -= met & (place == kWaiting);
        }
    }
    active_count_ = count;
    return waiting == 0;
}

// A node that a complete search has not met can't take part any more: what moves later stays among those that were met, so
// it opens no way to them.
void MaxFlow::set_apart() {
    for (const Index i : within_)
        if (place_[i] < 0) place_[i] = kApart;
    within_.assign(active_.begin(), active_.begin() + static_cast<std::ptrdiff_t>(active_count_));
}

std::int64_t MaxFlow::solve() {
    // In turn from both ends: each direction soon stands before what the other one opens. Once a sweep moves less than a
    // quarter of a unit per node, the trees are quicker.
    within_.resize(nodes());
    std::iota(within_.begin(), within_.end(), 0);
    while (4 * sweep<1>() > static_cast<Index>(within_.size()) && 4 * sweep<-1>() > static_cast<Index>(within_.size())) continue;
    const auto has = [&](int sign) {
        return std::any_of(within_.begin(), within_.end(), [&](Index i) { return sign * terminal_[i] > 0; });
    };
    if (has(1) && has(-1)) grow_trees();
    // Who can still reach a sink?
    within_.resize(nodes());
    std::iota(within_.begin(), within_.end(), 0);
    find_places<1>(true);
    return flow_;
}

// Grows the two trees from the terminals until they meet, augments the path, repairs the trees, and goes on from there:
// when no active node is left, no residual path joins source and sink.
void MaxFlow::grow_trees() {
    nodes_.assign(nodes(), Node{});
    for (Index i = 0; i < nodes(); i++)
        if (place_[i] == kApart) nodes_[i].tree = Tree::apart;
    for (const Index i : within_) {
        if (terminal_[i] == 0) continue;
        nodes_[i].tree = terminal_[i] > 0 ? Tree::source : Tree::sink;
        nodes_[i].parent = kRoot;
        nodes_[i].distance = 1;
        activate(i);
    }
    while (active_count_ > 0) {
        const Index node = active_[active_begin_];
        active_begin_ = active_begin_ + 1 == active_.size() ? 0 : active_begin_ + 1;
        active_count_--;
        nodes_[node].queued = false;
        for (Index arc = 3 * node; arc < 3 * node + 3 && nodes_[node].tree != Tree::none;) {
            if (!join_or_meet(node, arc)) {
                arc++;
                continue;
            }
            augment(nodes_[node].tree == Tree::source ? arc : arcs_[arc].sister);
            for (std::size_t i = 0; i < orphans_.size(); i++) adopt(orphans_[i]);
            orphans_.clear();
            // The same arc again: it may have capacity left, or its other end may have become free.
        }
    }
}

// Flow along the arc, or against it where the amount is negative.
void MaxFlow::push(Index arc, Index amount) {
    Arc &there = arcs_[arc], &sister = arcs_[there.sister];
    there.residual -= amount;
    there.back += amount;
    sister.residual += amount;
    sister.back -= amount;
}

// Residual capacity along the direction in which flow runs through the tree, for an arc that points to the parent:
// from the parent in the source tree, to the parent in the sink tree.
Index MaxFlow::toward_root(Index arc, Tree tree) const { return tree == Tree::source ? arcs_[arc].back : arcs_[arc].residual; }

// The same for an arc that points away from the root.
Index MaxFlow::from_root(Index arc, Tree tree) const { return tree == Tree::source ? arcs_[arc].residual : arcs_[arc].back; }

// Growth of `node` along one arc. True if the other end belongs to the other tree: an augmenting path.
bool MaxFlow::join_or_meet(Index node, Index arc) {
    const Tree tree = nodes_[node].tree;
    if (from_root(arc, tree) == 0) return false;
    const Index other = arcs_[arc].head();
    if (nodes_[other].tree == Tree::none) {
        nodes_[other].tree = tree;
        nodes_[other].parent = arcs_[arc].sister;
        nodes_[other].stamp = nodes_[node].stamp;
        nodes_[other].distance = nodes_[node].distance + 1;
        activate(other);
    } else if (nodes_[other].tree != tree) {
        return nodes_[other].tree != Tree::apart;
    } else if (nodes_[other].stamp <= nodes_[node].stamp && nodes_[other].distance > nodes_[node].distance + 1) {
        // A shorter way to the root: keeps the trees shallow, and the paths short.
        nodes_[other].parent = arcs_[arc].sister;
        nodes_[other].stamp = nodes_[node].stamp;
        nodes_[other].distance = nodes_[node].distance + 1;
    }
    return false;
}

// Pushes as much as possible along the path root - tail(arc) - head(arc) - root; `arc` leads from the source tree to the
// sink tree. Nodes whose link to the parent is saturated become orphans.
void MaxFlow::augment(Index arc) {
    const Index ends[2] = {arcs_[arcs_[arc].sister].head(), arcs_[arc].head()};
    Index amount = arcs_[arc].residual;
    for (const Index end : ends) {
        Index i = end;
        for (; nodes_[i].parent != kRoot; i = arcs_[nodes_[i].parent].head())
            amount = std::min(amount, toward_root(nodes_[i].parent, nodes_[i].tree));
        amount = static_cast<Index>(std::min<std::int64_t>(amount, std::abs(terminal_[i])));
    }
    augmentations_++;
    flow_ += amount;
    push(arc, amount);
    for (const Index end : ends) {
        Index i = end;
        while (nodes_[i].parent != kRoot) {
            const Index up = nodes_[i].parent;
            push(up, nodes_[i].tree == Tree::source ? -amount : amount);
            if (toward_root(up, nodes_[i].tree) == 0) make_orphan(i);
            i = arcs_[up].head();
        }
        terminal_[i] -= terminal_[i] > 0 ? amount : -amount;
        if (terminal_[i] == 0) make_orphan(i);
    }
}

// Finds a new parent for an orphan, in its own tree and with a way to the root; or sets it free and orphans its children.
void MaxFlow::adopt(Index node) {
    const Tree tree = nodes_[node].tree;
    Index best = kNone, best_distance = kFar;
    for (Index arc = 3 * node; arc < 3 * node + 3; arc++) {
        const Index other = arcs_[arc].head();
        if (nodes_[other].tree != tree || toward_root(arc, tree) == 0) continue;
        const Index distance = distance_to_root(other);
        if (distance < best_distance) {
            best = arc;
            best_distance = distance;
        }
    }
    nodes_[node].parent = best;
    if (best != kNone) {
        nodes_[node].stamp = augmentations_;
        nodes_[node].distance = best_distance + 1;
        return;
    }
    for (Index arc = 3 * node; arc < 3 * node + 3; arc++) {
        const Index other = arcs_[arc].head();
        if (nodes_[other].tree != tree) continue;
        if (toward_root(arc, tree) > 0) activate(other);   // it could have had this node as a child
        if (nodes_[other].parent >= 0 && arcs_[nodes_[other].parent].head() == node) make_orphan(other);
    }
    nodes_[node].tree = Tree::none;
}

// Number of arcs from the node to its terminal, or kFar if the way ends at an orphan. The nodes on the way remember it.
Index MaxFlow::distance_to_root(Index node) {
    Index distance = 0, i = node;
    while (true) {
        if (nodes_[i].stamp == augmentations_) {
            distance += nodes_[i].distance;
            break;
        }
        distance++;
        if (nodes_[i].parent == kRoot) {
            nodes_[i].stamp = augmentations_;
            nodes_[i].distance = 1;
            break;
        }
        if (nodes_[i].parent < 0) return kFar;
        i = arcs_[nodes_[i].parent].head();
    }
    Index left = distance;
    for (i = node; nodes_[i].stamp != augmentations_; i = arcs_[nodes_[i].parent].head()) {
        nodes_[i].stamp = augmentations_;
        nodes_[i].distance = left--;
    }
    return distance;
}

void MaxFlow::activate(Index node) {
    if (nodes_[node].queued) return;
    nodes_[node].queued = true;
    const std::size_t end = active_begin_ + active_count_++;
    active_[end < active_.size() ? end : end - active_.size()] = node;
}

void MaxFlow::make_orphan(Index node) {
    nodes_[node].parent = kOrphan;
    orphans_.push_back(node);
}

}   // namespace polylab

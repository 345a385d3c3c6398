#include "polylab/alpha_expansion.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace polylab {

namespace {

// Capacity of an edge between two sites without alpha, both ways, costs doubled. Of p and q with different labels, each
// pays half the weight for keeping, and half is for separating them:
//
//                 q takes   q keeps        equal labels: w in both directions
//    p takes         0         w           different labels: w/2 for "p keeps", w/2 for "q keeps",
//    p keeps         w     0 or w          w/2 in both directions
Index capacity(Index weight, Label p, Label q) { return p == q ? 2 * weight : weight; }

}   // namespace

std::int64_t PottsEnergy::operator()(const Labeling& labels) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < data.size(); i++) sum += data[i][labels[i]];
    for (std::size_t e = 0; e < weight.size(); e++) sum += labels[ends[2 * e]] != labels[ends[2 * e + 1]] ? weight[e] : 0;
    return sum;
}

Expansion::Expansion(PottsEnergy energy) : data_(std::move(energy.data)), first_(data_.size() + 2, 0) {
    const std::size_t edges = energy.weight.size(), sites = data_.size();
    // first_[i + 2] counts the arcs of i, then first_[i + 1] is the place for its next arc, and in the end where they end.
    for (std::size_t e = 0; e < edges; e++) {
        assert(energy.ends[2 * e] != energy.ends[2 * e + 1]);
        if (energy.weight[e] == 0) continue;
        first_[energy.ends[2 * e] + 2]++;
        first_[energy.ends[2 * e + 1] + 2]++;
    }
    for (std::size_t i = 2; i < first_.size(); i++) first_[i] += first_[i - 1];
    arcs_.resize(first_.back());
    for (std::size_t e = 0; e < edges; e++) {
        const Index p = energy.ends[2 * e], q = energy.ends[2 * e + 1], w = energy.weight[e];
        if (w == 0) continue;
        arcs_[first_[p + 1]++] = {q, w};
        arcs_[first_[q + 1]++] = {p, w};
    }
    choice_.resize(sites);
    excess_.resize(sites);
    around_.resize(sites);
    node_.resize(sites);
}

bool Expansion::move(Label alpha, Labeling& labels) {
    const Index sites = static_cast<Index>(data_.size());
    queue_.clear();
    for (Index i = 0; i < sites; i++) {
        if (labels[i] == alpha) {
            choice_[i] = Choice::keeps;
            continue;
        }
        Index excess = 2 * (data_[i][labels[i]] - data_[i][alpha]), around = 0;
        for (Index a = arc_begin(i); a < arc_end(i); a++) {
            const Label other = labels[arcs_[a].site];
            const Index w = arcs_[a].weight;
            if (other == alpha || other != labels[i]) excess += other == alpha ? 2 * w : w;
            if (other != alpha) around += capacity(w, labels[i], other);
        }
        excess_[i] = excess;
        around_[i] = around;
        decide(i);
    }
    settle_edges(labels);
    collect_core(labels);
    if (!core_.empty()) solve_core(labels);
    if (gain(alpha, labels) == 0) return false;
    for (Index i = 0; i < sites; i++)
        if (choice_[i] == Choice::takes) labels[i] = alpha;
    return true;
}

// Decides a site that its neighbours can't change any more.   tie: taking alpha
void Expansion::decide(Index i) {
    choice_[i] = excess_[i] >= around_[i] ? Choice::takes : -excess_[i] > around_[i] ? Choice::keeps : Choice::open;
    if (choice_[i] != Choice::open) queue_.push_back(i);
}

void Expansion::settle_edges(const Labeling& labels) {
    for (std::size_t k = 0; k < queue_.size(); k++) {
        const Index i = queue_[k];
        for (Index a = arc_begin(i); a < arc_end(i); a++) {
            const Index j = arcs_[a].site;
            if (choice_[j] != Choice::open) continue;
            const Index c = capacity(arcs_[a].weight, labels[i], labels[j]);
            around_[j] -= c;
            excess_[j] += choice_[i] == Choice::takes ? c : -c;
            decide(j);
        }
    }
}

// Groups of connected open sites, breadth-first, so that neighbours lie close together in the network.
void Expansion::collect_core(const Labeling& labels) {
    core_.clear();
    for (Index seed = 0; seed < static_cast<Index>(labels.size()); seed++) {
        if (choice_[seed] != Choice::open) continue;
        const std::size_t begin = core_.size();
        bool gains = false, loses = false;
        core_.push_back(seed);
        choice_[seed] = Choice::in_core;
        for (std::size_t k = begin; k < core_.size(); k++) {
            const Index i = core_[k];
            node_[i] = static_cast<Index>(k);
            gains |= excess_[i] > 0;
            loses |= excess_[i] < 0;
            for (Index a = arc_begin(i); a < arc_end(i); a++) {
                const Index j = arcs_[a].site;
                if (choice_[j] != Choice::open) continue;
                choice_[j] = Choice::in_core;
                core_.push_back(j);
            }
        }
        if (gains && loses) continue;
        for (std::size_t k = begin; k < core_.size(); k++) choice_[core_[k]] = loses ? Choice::keeps : Choice::takes;
        core_.resize(begin);
    }
}

void Expansion::solve_core(const Labeling& labels) {
    core_ends_.clear();
    core_capacity_.clear();
    const auto nodes = static_cast<Index>(core_.size());
    for (const Index i : core_)
        for (Index a = arc_begin(i); a < arc_end(i); a++) {
            const Index j = arcs_[a].site;
            if (choice_[j] != Choice::in_core || node_[j] < node_[i]) continue;
            core_ends_.push_back(node_[i]);
            core_ends_.push_back(node_[j]);
            core_capacity_.push_back(capacity(arcs_[a].weight, labels[i], labels[j]));
        }
    network_.reset(nodes, core_ends_);
    for (Index k = 0; k < nodes; k++) network_.add_terminals(k, std::max(excess_[core_[k]], 0), std::max(-excess_[core_[k]], 0));
    for (Index e = 0; e < static_cast<Index>(core_capacity_.size()); e++)
        network_.add_edge_capacity(e, core_capacity_[e], core_capacity_[e]);
    network_.solve();
    for (const Index i : core_) choice_[i] = network_.on_source_side(node_[i]) ? Choice::takes : Choice::keeps;
}

// Twice the energy that the move saves.
std::int64_t Expansion::gain(Label alpha, const Labeling& labels) const {
    std::int64_t sum = 0;
    for (Index i = 0; i < static_cast<Index>(labels.size()); i++) {
        if (choice_[i] != Choice::takes) continue;
        sum += 2 * (data_[i][labels[i]] - data_[i][alpha]);
        for (Index a = arc_begin(i); a < arc_end(i); a++) {
            const Index j = arcs_[a].site, w = arcs_[a].weight;
            const bool both = choice_[j] == Choice::takes;   // then the edge is met twice
            sum += (labels[i] != labels[j] ? (both ? w : 2 * w) : 0) - (both || labels[j] == alpha ? 0 : 2 * w);
        }
    }
    assert(sum >= 0);
    return sum;
}

Labeling alpha_expansion(PottsEnergy energy, Labeling start, int cycles, const Stop& stop) {
    Expansion expansion(std::move(energy));
    bool changed = true;
    for (int cycle = 0; cycle < cycles && changed; cycle++) {
        changed = false;
        for (Label alpha = 0; alpha < kLabels; alpha++) {
            if (stop && stop()) return start;
            changed |= expansion.move(alpha, start);
        }
    }
    return start;
}

}   // namespace polylab

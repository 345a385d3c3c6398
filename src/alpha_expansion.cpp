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

PottsEnergy::PottsEnergy(Index sites) : data(sites), arcs(sites) {
    for (Index i = 0; i < sites; i++) arcs[i].fill({i, 0});
}

void PottsEnergy::connect(Index a, Index b, Index weight) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        std::array<Arc, 3>& own = arcs[from];
        const auto free = std::find_if(own.begin(), own.end(), [from = from](const Arc& arc) { return arc.site == from; });
        assert(free != own.end() && a != b);
        *free = {to, weight};
    }
}

std::int64_t PottsEnergy::operator()(const Labeling& labels) const {
    std::int64_t sum = 0, twice = 0;   // each edge is met from both ends
    for (Index i = 0; i < sites(); i++) {
        sum += data[i][labels[i]];
        for (const Arc& arc : arcs[i]) twice += labels[i] != labels[arc.site] ? arc.weight : 0;
    }
    return sum + twice / 2;
}

bool Expansion::move(Label alpha, Labeling& labels) {
    const Index sites = energy_.sites();
    sites_.resize(sites);
    bool gains = false;
    for (Index i = 0; i < sites; i++) {
        const Label own = labels[i];
        if (own == alpha) {
            sites_[i].choice = Choice::keeps;
            continue;
        }
        Index won = 0, weights = 0;   // by the edges: twice to a site with alpha, once to one with a third label
        for (const PottsEnergy::Arc& arc : energy_.arcs[i]) {
            const Label other = labels[arc.site];
            won += arc.weight * (1 + (other == alpha) - (other == own));
            weights += arc.weight;
        }
        const Index excess = 2 * (energy_.data[i][own] - energy_.data[i][alpha]) + won;
        sites_[i] = {excess, 2 * weights - won, kNone, Choice::open};
        gains |= excess > 0;
    }
    if (!gains) return false;   // what all together would gain is at most the sum of their excess
    queue_.clear();
    for (Index i = 0; i < sites; i++)
        if (sites_[i].choice == Choice::open) decide(i);
    settle_edges(labels);
    collect_core();
    if (!core_.empty()) solve_core(labels);
    if (gain(alpha, labels) == 0) return false;
    for (Index i = 0; i < sites; i++)
        if (sites_[i].choice == Choice::takes) labels[i] = alpha;
    return true;
}

// Decides a site that its neighbours can't change any more.   tie: taking alpha
void Expansion::decide(Index i) {
    Site& site = sites_[i];
    site.choice = site.excess >= site.around ? Choice::takes : -site.excess > site.around ? Choice::keeps : Choice::open;
    if (site.choice != Choice::open) queue_.push_back(i);
}

void Expansion::settle_edges(const Labeling& labels) {
    for (std::size_t k = 0; k < queue_.size(); k++) {
        const Index i = queue_[k];
        for (const PottsEnergy::Arc& arc : energy_.arcs[i]) {
            Site& other = sites_[arc.site];
            if (other.choice != Choice::open || arc.weight == 0) continue;
            const Index c = capacity(arc.weight, labels[i], labels[arc.site]);
            other.around -= c;
            other.excess += sites_[i].choice == Choice::takes ? c : -c;
            decide(arc.site);
        }
    }
}

// Groups of connected open sites, breadth-first, so that neighbours lie close together in the network.
void Expansion::collect_core() {
    core_.clear();
    for (Index seed = 0; seed < energy_.sites(); seed++) {
        if (sites_[seed].choice != Choice::open) continue;
        const std::size_t begin = core_.size();
        bool gains = false, loses = false;
        core_.push_back(seed);
        sites_[seed].choice = Choice::in_core;
        for (std::size_t k = begin; k < core_.size(); k++) {
            Site& site = sites_[core_[k]];
            site.node = static_cast<Index>(k);
            gains |= site.excess > 0;
            loses |= site.excess < 0;
            for (const PottsEnergy::Arc& arc : energy_.arcs[core_[k]]) {
                if (sites_[arc.site].choice != Choice::open || arc.weight == 0) continue;
                sites_[arc.site].choice = Choice::in_core;
                core_.push_back(arc.site);
            }
        }
        if (gains && loses) continue;
        for (std::size_t k = begin; k < core_.size(); k++) sites_[core_[k]].choice = loses ? Choice::keeps : Choice::takes;
        core_.resize(begin);
    }
}

void Expansion::solve_core(const Labeling& labels) {
    const auto nodes = static_cast<Index>(core_.size());
    network_.reset(nodes);
    for (Index k = 0; k < nodes; k++) {
        const Index i = core_[k], excess = sites_[i].excess;
        network_.add_terminals(k, std::max(excess, 0), std::max(-excess, 0));
        for (const PottsEnergy::Arc& arc : energy_.arcs[i]) {
            const Site& other = sites_[arc.site];
            if (other.choice != Choice::in_core || other.node <= k || arc.weight == 0) continue;
            const Index c = capacity(arc.weight, labels[i], labels[arc.site]);
            network_.connect(k, other.node, c, c);
        }
    }
    network_.solve();
    for (Index k = 0; k < nodes; k++) sites_[core_[k]].choice = network_.on_source_side(k) ? Choice::takes : Choice::keeps;
}

// Twice the energy that the move saves.
std::int64_t Expansion::gain(Label alpha, const Labeling& labels) const {
    std::int64_t sum = 0;
    for (Index i = 0; i < energy_.sites(); i++) {
        if (sites_[i].choice != Choice::takes) continue;
        sum += 2 * (energy_.data[i][labels[i]] - energy_.data[i][alpha]);
        for (const auto& [j, w] : energy_.arcs[i]) {
            const bool both = sites_[j].choice == Choice::takes;   // then the edge is met twice
            sum += (labels[i] != labels[j] ? (both ? w : 2 * w) : 0) - (both || labels[j] == alpha ? 0 : 2 * w);
        }
    }
    assert(sum >= 0);
    return sum;
}

Labeling alpha_expansion(const PottsEnergy& energy, Labeling start, int cycles, const Stop& stop) {
    Expansion expansion(energy);
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

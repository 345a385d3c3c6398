#include "polylab/alpha_expansion.h"

#include <algorithm>
#include <cassert>
#include <cstring>
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

void Expansion::begin(Labeling start) {
    assert(static_cast<Index>(start.size()) == energy_.sites());
    labels_ = std::move(start);
    sites_.resize(labels_.size());
    ready_.assign((labels_.size() + 7) / 8 * 8, 0);
    for (Index i = 0; i < energy_.sites(); i++) find_ready(i);
}

// Calls visit(i) for each site that has the bit. Eight sites at a glance: in most of them nothing is ready.
template <class Visit>
void Expansion::for_each_with(unsigned char bit, const Visit& visit) const {
    for (Index begin = 0; begin < energy_.sites(); begin += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, &ready_[begin], 8);
        if ((eight & 0x0101010101010101u * bit) == 0) continue;
        for (Index i = begin; i < begin + 8; i++)
            if ((ready_[i] & bit) != 0) visit(i);
    }
}

// The labels by which the site would not lose: excess() of each of them, all at once.
void Expansion::find_ready(Index i) {
    const std::array<Index, kLabels>& data = energy_.data[i];
    const Label own = labels_[i];
    Index won[kLabels] = {}, around = 0;
    for (const auto& [j, weight] : energy_.arcs[i]) {
        if (labels_[j] == own) continue;
        around += weight;
        won[labels_[j]] += weight;
    }
    unsigned bits = 0;
    for (Label l = 0; l < kLabels; l++) bits |= static_cast<unsigned>(2 * (data[own] - data[l]) + around + won[l] >= 0) << l;
    ready_[i] = static_cast<unsigned char>(bits & ~(1u << own));
}

// What a site gains by alpha: twice an edge to a site with alpha, and half of twice an edge to a third label, see capacity().
Index Expansion::excess(Index i, Label alpha) const {
    const Label own = labels_[i];
    Index sum = 2 * (energy_.data[i][own] - energy_.data[i][alpha]);
    for (const auto& [j, weight] : energy_.arcs[i]) sum += weight * (1 + (labels_[j] == alpha) - (labels_[j] == own));
    return sum;
}

bool Expansion::move(Label alpha) {
    for_each_with(kChanged, [&](Index i) { find_ready(i); });
    grow_region(alpha);
    settle_edges();
    collect_core();
    if (!core_.empty()) solve_core();
    const bool better = gain(alpha) > 0;
    if (better) take(alpha);
    for (const Index i : region_) sites_[i].choice = Choice::outside;
    for (const Index i : beside_) sites_[i].choice = Choice::outside;
    return better;
}

// Sites that do not get into the region lose more, all together, than all of the region's edges to them could spare.
void Expansion::grow_region(Label alpha) {
    region_.clear();
    beside_.clear();
    for_each_with(static_cast<unsigned char>(1u << alpha), [&](Index i) {
        sites_[i] = {excess(i, alpha), 0, Choice::open};
        region_.push_back(i);
    });
    for (std::size_t k = 0; k < region_.size(); k++) {
        const Index i = region_[k];
        for (const auto& [j, weight] : energy_.arcs[i]) {
            if (weight == 0 || labels_[j] == alpha) continue;
            Site& other = sites_[j];
            if (other.choice == Choice::outside) {
                other = {excess(j, alpha), 0, Choice::beside};
                beside_.push_back(j);
            }
            other.around += capacity(weight, labels_[i], labels_[j]);
            if (other.choice == Choice::open || other.around < -other.excess) continue;
            other.choice = Choice::open;
            region_.push_back(j);
        }
    }
    for (const Index i : region_)
        for (const auto& [j, weight] : energy_.arcs[i])
            if (weight > 0 && sites_[j].choice == Choice::beside) sites_[i].excess -= capacity(weight, labels_[i], labels_[j]);
}

// Decides a site that its neighbours can't change any more.   tie: taking alpha
void Expansion::decide(Index i) {
    Site& site = sites_[i];
    site.choice = site.excess >= site.around ? Choice::takes : -site.excess > site.around ? Choice::keeps : Choice::open;
    if (site.choice != Choice::open) queue_.push_back(i);
}

void Expansion::settle_edges() {
    queue_.clear();
    for (const Index i : region_) decide(i);
    for (std::size_t k = 0; k < queue_.size(); k++) {
        const Index i = queue_[k];
        for (const auto& [j, weight] : energy_.arcs[i]) {
            Site& other = sites_[j];
            if (other.choice != Choice::open || weight == 0) continue;
            const Index c = capacity(weight, labels_[i], labels_[j]);
            other.around -= c;
            other.excess += sites_[i].choice == Choice::takes ? c : -c;
            decide(j);
        }
    }
}

// Groups of connected open sites, breadth-first, so that neighbours lie close together in the network.
void Expansion::collect_core() {
    core_.clear();
    for (const Index seed : region_) {
        if (sites_[seed].choice != Choice::open) continue;
        const std::size_t begin = core_.size();
        bool gains = false, loses = false;
        core_.push_back(seed);
        sites_[seed].choice = Choice::in_core;
        for (std::size_t k = begin; k < core_.size(); k++) {
            Site& site = sites_[core_[k]];
            site.around = static_cast<Index>(k);
            gains |= site.excess > 0;
            loses |= site.excess < 0;
            for (const auto& [j, weight] : energy_.arcs[core_[k]]) {
                if (sites_[j].choice != Choice::open || weight == 0) continue;
                sites_[j].choice = Choice::in_core;
                core_.push_back(j);
            }
        }
        if (gains && loses) continue;
        for (std::size_t k = begin; k < core_.size(); k++) sites_[core_[k]].choice = loses ? Choice::keeps : Choice::takes;
        core_.resize(begin);
    }
}

void Expansion::solve_core() {
    const auto nodes = static_cast<Index>(core_.size());
    network_.reset(nodes);
    for (Index k = 0; k < nodes; k++) {
        const Index i = core_[k], excess = sites_[i].excess;
        network_.add_terminals(k, std::max(excess, 0), std::max(-excess, 0));
        for (const auto& [j, weight] : energy_.arcs[i]) {
            const Site& other = sites_[j];
            if (weight == 0 || other.choice != Choice::in_core || other.around <= k) continue;
            const Index c = capacity(weight, labels_[i], labels_[j]);
            network_.connect(k, other.around, c, c);
        }
    }
    network_.solve();
    for (Index k = 0; k < nodes; k++) sites_[core_[k]].choice = network_.on_source_side(k) ? Choice::takes : Choice::keeps;
}

// Twice the energy that the move saves.
std::int64_t Expansion::gain(Label alpha) const {
    std::int64_t sum = 0;
    for (const Index i : region_) {
        if (sites_[i].choice != Choice::takes) continue;
        sum += 2 * (energy_.data[i][labels_[i]] - energy_.data[i][alpha]);
        for (const auto& [j, weight] : energy_.arcs[i]) {
            const bool both = sites_[j].choice == Choice::takes;   // then the edge is met twice
            sum += (labels_[i] != labels_[j] ? (both ? weight : 2 * weight) : 0) - (both || labels_[j] == alpha ? 0 : 2 * weight);
        }
    }
    assert(sum >= 0);
    return sum;
}

void Expansion::take(Label alpha) {
    for (const Index i : region_) {
        if (sites_[i].choice != Choice::takes) continue;
        labels_[i] = alpha;
        ready_[i] |= kChanged;
        for (const PottsEnergy::Arc& arc : energy_.arcs[i]) ready_[arc.site] |= kChanged;
    }
}

Labeling alpha_expansion(const PottsEnergy& energy, Labeling start, int cycles, const Stop& stop) {
    Expansion expansion(energy);
    expansion.begin(std::move(start));
    bool changed = true;
    for (int cycle = 0; cycle < cycles && changed; cycle++) {
        changed = false;
        for (Label alpha = 0; alpha < kLabels; alpha++) {
            if (stop && stop()) return expansion.labels();
            changed |= expansion.move(alpha);
        }
    }
    return expansion.labels();
}

}   // namespace polylab

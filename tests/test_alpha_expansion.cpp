#include "polylab/alpha_expansion.h"

#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace polylab;
using shapes::Lcg;

namespace {

constexpr Index kForbidden = 100000;

Index free_arcs(const PottsEnergy& energy, Index site) {
    const auto& arcs = energy.arcs[site];
    return static_cast<Index>(std::count_if(arcs.begin(), arcs.end(), [&](const auto& arc) { return arc.site == site; }));
}

// At most `edges`: some may find no free place.
PottsEnergy random_energy(Lcg& random, Index n, Index edges, Index largest_data, Index largest_weight) {
    PottsEnergy energy(n);
    for (auto& costs : energy.data)
        for (Index& c : costs) c = random.below(largest_data + 1);
    for (Index e = 0; e < edges && n > 1; e++) {
        const Index a = random.below(n), b = (a + 1 + random.below(n - 1)) % n, weight = random.below(largest_weight + 1);
        if (free_arcs(energy, a) > 0 && free_arcs(energy, b) > 0) energy.connect(a, b, weight);
    }
    return energy;
}

Labeling random_labels(Lcg& random, Index n) {
    Labeling labels(n);
    for (Label& l : labels) l = static_cast<Label>(random.below(kLabels));
    return labels;
}

// The best move towards alpha, by trying all: of the best ones together, where all best moves' sites take alpha.
Labeling best_move(const PottsEnergy& energy, Label alpha, const Labeling& labels) {
    const Index n = energy.sites();
    const std::int64_t before = energy(labels);
    std::int64_t least = before;
    unsigned takes = 0;   // union of the best moves, one bit per site
    for (unsigned move = 0; move < 1u << n; move++) {
        Labeling moved = labels;
        for (Index i = 0; i < n; i++)
            if (move >> i & 1u) moved[i] = alpha;
        const std::int64_t value = energy(moved);
        if (value < least) takes = 0;
        if (value <= least) takes |= move;
        least = std::min(least, value);
    }
    if (least == before) return labels;
    Labeling best = labels;
    for (Index i = 0; i < n; i++)
        if (takes >> i & 1u) best[i] = alpha;
    REQUIRE(energy(best) == least);   // the union of best moves is a best move
    return best;
}

Labeling naive_expansion(const PottsEnergy& energy, Labeling labels, int cycles) {
    for (int cycle = 0; cycle < cycles; cycle++)
        for (Label alpha = 0; alpha < kLabels; alpha++) labels = best_move(energy, alpha, labels);
    return labels;
}

// The best move towards alpha by one minimum cut of all sites, costs doubled.
Labeling move_by_one_cut(const PottsEnergy& energy, Label alpha, const Labeling& labels) {
    MaxFlow network(energy.sites());
    for (Index i = 0; i < energy.sites(); i++) {
        if (labels[i] == alpha) continue;
        Index gain = 2 * (energy.data[i][labels[i]] - energy.data[i][alpha]);
        for (const auto& [j, weight] : energy.arcs[i]) {
            const bool same = labels[i] == labels[j];
            gain += weight * (labels[j] == alpha ? 2 : same ? 0 : 1);
            if (labels[j] != alpha && i < j) network.connect(i, j, same ? 2 * weight : weight, same ? 2 * weight : weight);
        }
        network.add_terminals(i, std::max(gain, 0), std::max(-gain, 0));
    }
    network.solve();
    Labeling moved = labels;
    for (Index i = 0; i < energy.sites(); i++)
        if (labels[i] != alpha && network.on_source_side(i)) moved[i] = alpha;
    return energy(moved) < energy(labels) ? moved : labels;
}

bool expand(Expansion& expansion, Label alpha, Labeling& labels) {
    expansion.begin(labels);
    const bool changed = expansion.move(alpha);
    labels = expansion.labels();
    return changed;
}
bool expand(const PottsEnergy& energy, Label alpha, Labeling& labels) {
    Expansion expansion(energy);
    return expand(expansion, alpha, labels);
}

}   // namespace

TEST_CASE("alpha expansion: the energy is data plus weights of edges with different labels") {
    PottsEnergy energy(3);
    energy.data = {{1, 2, 3, 4, 5, 6}, {10, 20, 30, 40, 50, 60}, {100, 200, 300, 400, 500, 600}};
    energy.connect(0, 1, 1000);
    energy.connect(2, 1, 2000);
    energy.connect(1, 2, 4000);   // parallel
    CHECK(energy({0, 0, 0}) == 111);
    CHECK(energy({5, 5, 5}) == 666);
    CHECK(energy({0, 1, 1}) == 221 + 1000);
    CHECK(energy({3, 3, 2}) == 344 + 2000 + 4000);
    CHECK(energy({2, 4, 1}) == 253 + 7000);
    CHECK(PottsEnergy{}({}) == 0);
    // 64 bits: 1000 sites at 2^24
    energy = PottsEnergy(1000);
    energy.data.assign(1000, {0, 1 << 24, 0, 0, 0, 0});
    CHECK(energy(Labeling(1000, 1)) == 16777216000);
}

TEST_CASE("alpha expansion: a move drawn by hand") {
    // Three sites in a row, labels 0 1 2, edges of weight 10. Towards 3:
    //   data of its own label  8   0   8
    //   data of 3              0   5   0          all keep: 16 + 20; all take: 5; ends alone: 20; so all take.
    PottsEnergy energy(3);
    energy.data.assign(3, {50, 50, 50, 50, 50, 50});
    energy.data[0][0] = energy.data[2][2] = 8;
    energy.data[0][3] = energy.data[2][3] = 0;
    energy.data[1][1] = 0;
    energy.data[1][3] = 5;
    energy.connect(0, 1, 10);
    energy.connect(1, 2, 10);
    Labeling labels = {0, 1, 2};
    CHECK(expand(energy, 3, labels));
    CHECK(labels == Labeling{3, 3, 3});
    CHECK_FALSE(expand(energy, 3, labels));
    CHECK(labels == Labeling{3, 3, 3});
    // With 25 in the middle: ends alone 20 is the best.
    energy.data[1][3] = 25;
    labels = {0, 1, 2};
    CHECK(expand(energy, 3, labels));
    CHECK(labels == Labeling{3, 1, 3});
    // With 20 both are: most sites take.
    energy.data[1][3] = 20;
    labels = {0, 1, 2};
    CHECK(expand(energy, 3, labels));
    CHECK(labels == Labeling{3, 3, 3});
}

TEST_CASE("alpha expansion: a move that gains nothing is not made") {
    PottsEnergy energy(2);
    energy.data.assign(2, {4, 4, 4, 4, 4, 5});
    energy.connect(0, 1, 3);
    for (Label alpha = 0; alpha < kLabels; alpha++) {
        Labeling labels = {0, 0};
        CHECK_FALSE(expand(energy, alpha, labels));
        CHECK(labels == Labeling{0, 0});
    }
}

TEST_CASE("alpha expansion: every move is the best one, ties going to alpha") {
    Lcg random(8);
    int failures = 0;
    for (int round = 0; round < 1500 && failures < 3; round++) {
        const Index n = 1 + random.below(round % 50 == 0 ? 10 : 7);
        const bool ties = round % 3 != 0;
        const PottsEnergy energy = random_energy(random, n, random.below(1 + 3 * n), ties ? 3 : 100, ties ? 3 : 60);
        const Labeling start = random_labels(random, n);
        Expansion expansion(energy);   // the same one for all moves
        for (Label alpha = 0; alpha < kLabels; alpha++) {
            const Labeling expected = best_move(energy, alpha, start);
            Labeling labels = start;
            const bool changed = expand(expansion, alpha, labels);
            failures += labels != expected || changed != (expected != start);
            CAPTURE(round);
            CHECK(labels == expected);
            CHECK(changed == (expected != start));
        }
    }
}

TEST_CASE("alpha expansion: cycles are moves towards 0 to 5 in this order") {
    Lcg random(9);
    for (int round = 0; round < 300; round++) {
        const Index n = 1 + random.below(6);
        const PottsEnergy energy = random_energy(random, n, random.below(1 + 3 * n), 5, 5);
        const Labeling start = round % 2 == 0 ? Labeling(n, 0) : random_labels(random, n);
        for (int cycles = 0; cycles < 4; cycles++)
            CHECK(alpha_expansion(energy, start, cycles) == naive_expansion(energy, start, cycles));
        CHECK(alpha_expansion(energy, start) == naive_expansion(energy, start, 2));
    }
}

TEST_CASE("alpha expansion: two labels are solved exactly") {
    // The others cost too much, so from 0 everywhere the move towards 1 tries every labeling, and nothing follows.
    Lcg random(10);
    for (int round = 0; round < 200; round++) {
        const Index n = 1 + random.below(9);
        PottsEnergy energy = random_energy(random, n, random.below(1 + 3 * n), round % 2 == 0 ? 3 : 100, round % 2 == 0 ? 3 : 60);
        for (auto& costs : energy.data) std::fill(costs.begin() + 2, costs.end(), kForbidden);
        const Labeling labels = alpha_expansion(energy, Labeling(n, 0));
        std::int64_t least = energy(Labeling(n, 0));
        for (unsigned bits = 0; bits < 1u << n; bits++) {
            Labeling tried(n);
            for (Index i = 0; i < n; i++) tried[i] = static_cast<Label>(bits >> i & 1u);
            least = std::min(least, energy(tried));
        }
        CHECK(energy(labels) == least);
        CHECK(labels == best_move(energy, 1, Labeling(n, 0)));
    }
}

TEST_CASE("alpha expansion: moves of many sites are the minimum cuts of whole networks") {
    Lcg random(18);
    for (int round = 0; round < 60; round++) {
        const Index n = 300 + random.below(20);
        const bool blocks = round % 2 == 0;   // runs of sites that like one label, as flat faces do, and ties all over
        PottsEnergy energy = random_energy(random, n, 0, blocks ? 2 : 8, 0);
        for (Index i = 0; blocks && i < n; i++)
            for (Label l = 0; l < kLabels; l++) energy.data[i][l] += i / 40 % kLabels == l ? 0 : 3 + random.below(3) / 2;
        for (Index i = 0; i < n; i++) energy.connect(i, (i + 1) % n, random.below(3));
        for (Index i = 0; i + 7 < n; i += 1 + random.below(3))
            if (free_arcs(energy, i) > 0 && free_arcs(energy, i + 7) > 0) energy.connect(i, i + 7, random.below(4));
        Labeling labels = round % 3 == 0 ? Labeling(n, 0) : random_labels(random, n);
        Expansion expansion(energy);
        expansion.begin(labels);   // once: the moves themselves have to keep track of what they change
        for (int move = 0; move < 18; move++) {
            const Label alpha = static_cast<Label>(move % kLabels);
            const Labeling expected = move_by_one_cut(energy, alpha, labels);
            CHECK(expansion.move(alpha) == (expected != labels));
            REQUIRE(expansion.labels() == expected);
            labels = expected;
        }
    }
}

TEST_CASE("alpha expansion: the energy goes down with every move that is made") {
    Lcg random(11);
    for (int round = 0; round < 20; round++) {
        const Index n = 300;
        const PottsEnergy energy = random_energy(random, n, 500, 300, round < 10 ? 100 : 1000);
        Labeling labels = random_labels(random, n);
        Expansion expansion(energy);
        bool changed = true;
        int moves = 0;
        for (; changed && moves < 60; moves += kLabels) {
            changed = false;
            for (Label alpha = 0; alpha < kLabels; alpha++) {
                const Labeling before = labels;
                if (expand(expansion, alpha, labels)) {
                    changed = true;
                    CHECK(energy(labels) < energy(before));
                    for (Index i = 0; i < n; i++) CHECK((labels[i] == before[i] || labels[i] == alpha));
                } else {
                    CHECK(labels == before);
                }
            }
        }
        CHECK_FALSE(changed);   // it ends, and stays: no move of any label is left
        CHECK(alpha_expansion(energy, labels, 5) == labels);
    }
}

TEST_CASE("alpha expansion: without weights each site takes its cheapest label") {
    Lcg random(12);
    for (const Index edges : {0, 100}) {
        const PottsEnergy energy = random_energy(random, 50, edges, 100000, 0);
        const Labeling labels = alpha_expansion(energy, random_labels(random, 50));
        for (Index i = 0; i < 50; i++)
            CHECK(energy.data[i][labels[i]] == *std::min_element(energy.data[i].begin(), energy.data[i].end()));
    }
    CHECK(alpha_expansion(PottsEnergy{}, {}).empty());
}

TEST_CASE("alpha expansion: large weights make one label of a connected part") {
    // Costs up to the promised 2^24. Sites 0..4 in a row, 5..9 in a row; label 4 is the cheapest for the first, 1 for the
    // second row in sum, though not for each site.
    PottsEnergy energy(10);
    energy.data.assign(10, {9, 9, 9, 9, 9, 9});
    for (Index i = 0; i < 10; i++) {
        energy.data[i][i < 5 ? 4 : 1] = 5;
        if (i % 5 == 2) energy.data[i][3] = 0;
        if (i % 5 != 4) energy.connect(i, i + 1, 1 << 24);
    }
    CHECK(alpha_expansion(energy, Labeling(10, 0)) == Labeling{4, 4, 4, 4, 4, 1, 1, 1, 1, 1});
    // A label locked at 2^24 elsewhere spreads: keeping it costs 0, so the whole row follows it.
    energy.data[7] = {1 << 24, 1 << 24, 1 << 24, 1 << 24, 1 << 24, 0};
    CHECK(alpha_expansion(energy, Labeling(10, 0)) == Labeling{4, 4, 4, 4, 4, 5, 5, 5, 5, 5});
}

TEST_CASE("alpha expansion: the numbering of the sites does not matter") {
    Lcg random(13);
    for (int round = 0; round < 50; round++) {
        const Index n = 100;
        const PottsEnergy energy = random_energy(random, n, 150, 3, 3);   // many ties
        const std::vector<Index> place = random.permutation(n);
        PottsEnergy other(n);
        for (Index i = 0; i < n; i++) {
            other.data[place[i]] = energy.data[i];
            const Index turn = random.below(3);
            for (Index k = 0; k < 3; k++)
                other.arcs[place[i]][(k + turn) % 3] = {place[energy.arcs[i][k].site], energy.arcs[i][k].weight};
        }
        const Labeling labels = alpha_expansion(energy, Labeling(n, 0)), renumbered = alpha_expansion(other, Labeling(n, 0));
        for (Index i = 0; i < n; i++) CHECK(renumbered[place[i]] == labels[i]);
    }
}

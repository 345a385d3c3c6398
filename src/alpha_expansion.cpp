#include "polylab/alpha_expansion.h"

#include <algorithm>
#include <cassert>

namespace polylab {

std::int64_t PottsEnergy::operator()(const Labeling& labels) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < data.size(); i++) sum += data[i][labels[i]];
    for (std::size_t e = 0; e < weight.size(); e++) sum += labels[ends[2 * e]] != labels[ends[2 * e + 1]] ? weight[e] : 0;
    return sum;
}

// In the network a site on the source side takes alpha, one on the sink side keeps its label. A site that has alpha
// already keeps it, so its edges cost either 0 or w at the other end alone. For an edge between two others, with a
// "takes alpha" for each end:
//
//                 q takes   q keeps        equal labels: w in both directions
//    p takes         0         w           different labels: the table minus w for "p keeps" leaves w for
//    p keeps         w     0 or w          "p takes, q keeps" alone: one direction, and w on p's terminal
bool expand(const PottsEnergy& energy, MaxFlow& network, Label alpha, Labeling& labels) {
    const Index sites = static_cast<Index>(energy.data.size()), edges = static_cast<Index>(energy.weight.size());
    network.clear();
    std::int64_t before = 0;   // energy of "all keep", but for the terms that no site can change
    for (Index i = 0; i < sites; i++) {
        if (labels[i] == alpha) continue;
        network.add_terminals(i, energy.data[i][labels[i]], energy.data[i][alpha]);
        before += energy.data[i][labels[i]];
    }
    for (Index e = 0; e < edges; e++) {
        const Index p = energy.ends[2 * e], q = energy.ends[2 * e + 1], w = energy.weight[e];
        if (w == 0 || (labels[p] == alpha && labels[q] == alpha)) continue;
        if (labels[p] != labels[q]) before += w;
        if (labels[p] == alpha) {
            network.add_terminals(q, w, 0);
        } else if (labels[q] == alpha) {
            network.add_terminals(p, w, 0);
        } else if (labels[p] == labels[q]) {
            network.add_edge_capacity(e, w, w);
        } else {
            network.add_terminals(p, w, 0);
            network.add_edge_capacity(e, w, 0);
        }
    }
    const std::int64_t after = network.solve();
    assert(after <= before);
    if (after == before) return false;
    for (Index i = 0; i < sites; i++)
        if (labels[i] != alpha && network.on_source_side(i)) labels[i] = alpha;
    return true;
}

Labeling alpha_expansion(const PottsEnergy& energy, Labeling start, int cycles, const Stop& stop) {
    MaxFlow network(static_cast<Index>(energy.data.size()), energy.ends);
    bool changed = true;
    for (int cycle = 0; cycle < cycles && changed; cycle++) {
        changed = false;
        for (Label alpha = 0; alpha < kLabels; alpha++) {
            if (stop && stop()) return start;
            changed |= expand(energy, network, alpha, start);
        }
    }
    return start;
}

}   // namespace polylab

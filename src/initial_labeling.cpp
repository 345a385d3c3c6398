#include "polylab/initial_labeling.h"

#include <algorithm>

namespace polylab {

namespace {

constexpr double kDataSigma = 0.20, kPairwiseSigma = 0.25;   // published code; the forms come from Evocube
constexpr int kCostScale = 100;
constexpr int kCycles = 2;
constexpr Index kLockCost = 100000;   // published code

bool is_to_tilt(const Vec3& n, double sensitivity) {
    // Of two opposite labels one has weight 0, so the two largest weights are the two largest components.
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const double largest = std::max({x, y, z}), second = std::max(std::min(x, y), std::min(std::max(x, y), z));
    audit("facet to tilt", std::abs(largest - second - sensitivity));
    audit(largest - second < sensitivity ? "naive label of tilted facets" : "naive label of the others", largest - second);
    return largest - second < sensitivity;
}

}   // namespace

Labeling naive_labeling(const TriMesh& mesh) {
    Labeling labels(mesh.facets());
    for (Index f = 0; f < mesh.facets(); f++) {
        Label best = 0;
        for (Label l = 1; l < kLabels; l++)   // negative components count as 0, as in the published weights
            if (std::max(0.0, along(mesh.normal[f], l)) > std::max(0.0, along(mesh.normal[f], best)))
                best = l;   // tie: smallest label
        labels[f] = best;
    }
    return labels;
}

std::vector<char> facets_to_tilt(const TriMesh& mesh, double sensitivity) {
    std::vector<char> tilt(mesh.facets());
    for (Index f = 0; f < mesh.facets(); f++) tilt[f] = is_to_tilt(mesh.normal[f], sensitivity);
    return tilt;
}

Vec3 tilted(const Vec3& n, const SinCos& angle) {
    const auto [s, c] = angle;
    return {c * c * n.x + s * c * (s - 1) * n.y + s * (c * c + s) * n.z,
            s * c * n.x + (s * s * s + c * c) * n.y + s * c * (s - 1) * n.z, -s * n.x + s * c * n.y + c * c * n.z};
}

int data_cost(const Vec3& normal, Label l, int fidelity) {
    return well_cost(along(normal, l) - 1, kDataSigma, kCostScale * fidelity);
}

int pairwise_cost(const Vec3& normal, const Vec3& neighbour, int compactness) {
    return bell_cost(dot(normal, neighbour) - 1, kPairwiseSigma, kCostScale * compactness);
}

PottsEnergy labeling_energy(const TriMesh& mesh, const InitialOptions& options) {
    PottsEnergy energy(mesh.facets());
    const SinCos angle = sin_cos(options.angle);
    Vec3 last;   // the facets of a plane often come one after the other: the same normal, the same costs
    for (Index f = 0; f < mesh.facets(); f++) {
        if (f > 0 && mesh.normal[f] == last) {
            energy.data[f] = energy.data[f - 1];
            continue;
        }
        last = mesh.normal[f];
        const Vec3 n = is_to_tilt(last, options.sensitivity) ? tilted(last, angle) : last;
        for (Label l = 0; l < kLabels; l++) energy.data[f][l] = data_cost(n, l, options.fidelity);
    }
    double cosine = 1;   // likewise
    int cost = bell_cost(0, kPairwiseSigma, kCostScale * options.compactness);
    for (Index f = 0; f < mesh.facets(); f++)
        for (int k = 0; k < 3; k++) {
            const Index h = 3 * f + k, back = mesh.opposite[h], g = facet(back);
            if (f > g) continue;
            const double c = dot(mesh.normal[f], mesh.normal[g]);
            if (c != cosine) cost = bell_cost(c - 1, kPairwiseSigma, kCostScale * options.compactness);
            cosine = c;
            const int weight = options.free_features && mesh.feature[h] ? 0 : cost;
            energy.arcs[f][k] = {g, weight};
            energy.arcs[g][back - 3 * g] = {f, weight};
        }
    return energy;
}

Labeling graphcut_labeling(const TriMesh& mesh, const InitialOptions& options, const Labeling& locks, const Stop& stop) {
    const auto energy = [&] {
        PottsEnergy locked = labeling_energy(mesh, options);
        for (std::size_t f = 0; f < locks.size(); f++)
            for (Label l = 0; l < kLabels; l++)
                if (locks[f] != kNoLabel && locks[f] != l) locked.data[f][l] += kLockCost;
        return locked;
    };
    Labeling labels = alpha_expansion(energy(), Labeling(mesh.facets(), 0), kCycles, stop);
    if (!stop || !stop()) return labels;
    Labeling naive = naive_labeling(mesh);
    for (std::size_t f = 0; f < locks.size(); f++)
        if (locks[f] != kNoLabel) naive[f] = locks[f];
    const PottsEnergy judge = energy();
    return judge(naive) < judge(labels) ? naive : labels;
}

}   // namespace polylab

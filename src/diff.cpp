#include "polylab/diff.h"

#include <algorithm>
#include <cstdio>

namespace polylab {

std::vector<ChangedPatch> changed_patches(const TriMesh& mesh, const Labeling& a, const Labeling& b) {
    std::vector<ChangedPatch> patches;
    std::vector<char> seen(mesh.facets(), 0);
    for (Index seed = 0; seed < mesh.facets(); seed++) {
        if (seen[seed] || a[seed] == b[seed]) continue;
        ChangedPatch patch{a[seed], b[seed], {seed}};
        seen[seed] = 1;
        for (std::size_t i = 0; i < patch.facets.size(); i++) {
            for (Index h = 3 * patch.facets[i]; h < 3 * patch.facets[i] + 3; h++) {
                const Index g = mesh.right(h);
                if (seen[g] || a[g] != patch.before || b[g] != patch.after) continue;
                seen[g] = 1;
                patch.facets.push_back(g);
            }
        }
        patches.push_back(std::move(patch));
    }
    std::stable_sort(patches.begin(), patches.end(),
                     [](const ChangedPatch& p, const ChangedPatch& q) { return p.facets.size() > q.facets.size(); });
    return patches;
}

std::string diff_text(const TriMesh& mesh, const Labeling& a, const Labeling& b) {
    char line[256];
    std::string text;
    const std::vector<ChangedPatch> patches = changed_patches(mesh, a, b);
    std::size_t changed = 0;
    for (const ChangedPatch& patch : patches) changed += patch.facets.size();
    std::snprintf(line, sizeof line, "%zu of %d facets differ, in %zu patches\n", changed, mesh.facets(), patches.size());
    text += line;
    const Statistics s = statistics(mesh, a, build_graph(mesh, a)), t = statistics(mesh, b, build_graph(mesh, b));
    const auto row = [&](const char* name, Index before, Index after) {
        if (before == after) return;
        std::snprintf(line, sizeof line, "%-24s %8d -> %d\n", name, before, after);
        text += line;
    };
    row("charts", s.charts, t.charts);
    row("invalid charts", s.invalid_charts, t.invalid_charts);
    row("boundaries", s.boundaries, t.boundaries);
    row("invalid boundaries", s.invalid_boundaries, t.invalid_boundaries);
    row("corners", s.corners, t.corners);
    row("invalid corners", s.invalid_corners, t.invalid_corners);
    row("turning-points", s.turning_points, t.turning_points);
    row("feature edges lost", s.features_lost, t.features_lost);
    if (s.fidelity_avg != t.fidelity_avg) {
        std::snprintf(line, sizeof line, "%-24s %8.5f -> %.5f\n", "fidelity, average", s.fidelity_avg, t.fidelity_avg);
        text += line;
    }
    for (const ChangedPatch& patch : patches) {
        const Vec3& p = mesh.points[mesh.origin[3 * patch.facets[0]]];
        std::snprintf(line, sizeof line, "%6zu facets %s -> %s, from facet %d near %.4g %.4g %.4g\n", patch.facets.size(),
                      kLabelName[patch.before], kLabelName[patch.after], patch.facets[0], p.x, p.y, p.z);
        text += line;
    }
    return text;
}

}   // namespace polylab

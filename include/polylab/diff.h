// diff.h: what changed between two labelings of one mesh.
#pragma once

#include "polylab/statistics.h"

#include <string>
#include <vector>

namespace polylab {

// Edge-connected facets that changed from one label to another.
struct ChangedPatch {
    Label before = 0, after = 0;
    std::vector<Index> facets;
};

// Largest first. tie: by smallest facet. O(n)
std::vector<ChangedPatch> changed_patches(const TriMesh& mesh, const Labeling& a, const Labeling& b);

// Counts side by side, where they differ, then the patches.
std::string diff_text(const TriMesh& mesh, const Labeling& a, const Labeling& b);

}   // namespace polylab

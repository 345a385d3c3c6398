// stages.h: what each step of the method gives for a part, as text that another program can be compared with.
//
// Integers and words, one item per line, in canonical order; see golden/README.md for the contract. A port that prints the
// same stages for the same parts is right, and the first one that differs tells where it is not.
#pragma once

#include "polylab/mesh.h"

#include <string>
#include <vector>

namespace polylab {

struct Stage {
    std::string name;   // 01-mesh, 02-costs, …: also the name of its file, without .txt
    std::string text;
};

// All stages in the order of the method, all options at their defaults. The cost of a full run, several times over.
std::vector<Stage> stages(const TriMesh& mesh);

}   // namespace polylab

// stages.h: what each step of the method gives for a part, as text that another program can be compared with.
//
// Integers and words, one item per line, in canonical order; see golden/README.md for the contract. A port that prints the
// same stages for the same parts is right, and the first one that differs tells where it is not.
#pragma once

#include "polylab/mesh.h"

#include <string>
#include <vector>

namespace polylab {

// In the order of the method: mesh costs naive tilted graphcut graph turning-points trace labels statistics.
const std::vector<std::string>& stage_names();

// The text of one stage, all options at their defaults. Throws InputError where there is no such stage.
std::string stage_text(const TriMesh& mesh, const std::string& stage);

}   // namespace polylab

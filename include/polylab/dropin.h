// dropin.h: the commands of the paper's published code, for pipelines that call them.
//
// Pipelines point at a folder that holds the commands by name: `make install` fills PREFIX/libexec/polylab with links to the
// one program, which goes by the name that it is called by. Command lines, defaults, files and exit status are the published
// ones: file names first, then key=value; 0 also where the labeling is not valid; labels without a newline at the end.
#pragma once

#include "polylab/base.h"

#include <string>
#include <vector>

namespace polylab {

// Whether a program of this name, without folders, is one of the commands.
bool is_dropin(const std::string& name);

// Runs the command; what it has to say goes to standard output, as there. Returns the exit status: 0 done; 1 no result, and
// one line on standard error says why.
int run_dropin(const std::string& name, const std::vector<std::string>& words);

// One usage per line.
std::string dropin_overview();

}   // namespace polylab

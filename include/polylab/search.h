// search.h: the whole way from an initial labeling to the result, and other starts where one start is not enough.
//
// Not in the paper, which leaves the order of its operators fixed: here its routines (effort 0) are followed by polish, and
// where they leave something invalid or a turning-point they are run again from other cuts.
#pragma once

#include "polylab/initial_labeling.h"
#include "polylab/polish.h"

namespace polylab {

inline constexpr int kDefaultEffort = 2;
inline constexpr int kMostEffort = 3;

// What search() is to start from: at effort 0 the graph-cut of the paper; else one in which borders on kept feature edges cost
// nothing, so that those of obtuse edges, which are as dear as within a face, are drawn from the beginning and not left to luck.
Labeling search_start(const TriMesh& mesh, int effort = kDefaultEffort, InitialOptions initial = {}, const Labeling& locks = {},
                      const Stop& stop = {});

// effort 0: the paper's routines alone. 1: polish where they have changed something or a feature edge is lost. 2: if something
// is invalid or turns, by our count or the published one, the same from such cuts of compactness 2, 3, 4, 6 and 10, until
// nothing is or 20000 proposals (20 per facet, if that is more) have been tried: then the part itself is to blame. 3: from all
// of these in any case.
// The result is the one of the best score, where the published turning-points stand before the loss.   tie: the first start. Up
// to six times the bound of the routines and of polish. In the trace, the steps of other starts count as parts of a sequence,
// which ends with a step "start-again COMPACTNESS".
State search(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options = {}, int effort = kDefaultEffort);

}   // namespace polylab

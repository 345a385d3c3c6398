// search.h: the whole way from an initial labeling to the result, and other starts where one start is not enough.
//
// Not in the paper, which leaves the order of its operators fixed: here its routines (effort 0) are followed by polish, and
// where they leave something invalid or a turning-point, a best-first search goes on from there, and then they are run again from
// other cuts.
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
// is invalid or turns, by our count or the published one, at up to 20 places, a best-first search: all operators at all that is
// wrong with the labeling of the best score, whose proposals, whatever they cost, are searched likewise, each labeling once,
// until nothing is wrong or 1000 proposals have been tried; then polish again. If that does not do, the same from such cuts of
// compactness 2, 3, 4, 6 and 10, until nothing is or 20000 proposals (20 per facet, if that is more) have been tried: then the
// part itself is to blame. 3: from all of these in any case. The result is the one of the best score, where the published
// turning-points stand before the loss.   tie: the first start. Up to six times the bounds of the routines, of polish twice, and
// of the best-first search. In the trace, the steps of other starts count as parts of a sequence, which ends with a step
// "start-again COMPACTNESS"; likewise "expand NUMBER" per labeling searched, before "explore -1".
State search(const TriMesh& mesh, const Labeling& start, const RoutineOptions& options = {}, int effort = kDefaultEffort);

}   // namespace polylab

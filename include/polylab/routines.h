// routines.h: Algorithms 1 and 2 of the paper (Section 7): first a valid labeling, then one without turning-points.
//
// differs: every step is kept only if the score improves (state.h), so the routines end, and end with the best labeling
// seen. Monotonicity is attempted on whatever validity leaves. An element is tried again only if something
// around it has changed, or if a later pass allows the loss that it was refused for.
#pragma once

#include "polylab/quality_operators.h"

#include <functional>
#include <string>

namespace polylab {

// One operator applied to one element.
struct Step {
    std::string operation;
    Index element = kNone;      // chart, boundary or corner number; the vertex of a turning-point
    bool in_sequence = false;   // part of a sequence that may be given up as a whole
    bool kept = false;
    Index proposals = 0;   // how many variants were tried
    Index facets = 0;      // how many of them the one that is kept relabels; 0 if none is
    Score before, after;   // the same if none is
};

struct RoutineOptions {
    bool validity = true, monotonicity = true;   // which of the two routines run
    bool allow_opposite = true;
    Labeling locks;                           // facet -> label that it keeps, or kNoLabel; empty: none
    std::function<void(const Step&)> trace;   // called after each step, if set
    Stop stop;                                // asked before each proposal; once it says so, the best so far is the result
};

// The best labeling found from `start`, never worse than it by the score, also when it is stopped.
// Bounded: each kept step lowers the score, and a pass that keeps none is the last.
State run_routines(const TriMesh& mesh, Labeling start, const RoutineOptions& options = {});

// What all operators propose for all that is invalid; where nothing is, for the given turning-points.
Proposals all_proposals(const TriMesh& mesh, const State& state, const std::vector<TurningPoint>& points);

// A line per step: `operation element kept|refused proposals facets before… after…`, scores as `invalid turning-points loss`,
// with `| ` in front inside sequences.
std::string trace_line(const Step& step);

}   // namespace polylab

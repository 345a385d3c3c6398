// explain.h: which chart, boundary or corner is invalid, where, and why; where boundaries turn.
#pragma once

#include "polylab/statistics.h"

#include <string>
#include <vector>

namespace polylab {

struct Problem {
    enum class Kind { chart, boundary, corner, turning_point };
    Kind kind;
    Index element = kNone;   // chart or boundary number, corner number; of a turning-point its boundary
    Index vertex = kNone;    // of a corner or turning-point
    Vec3 position;           // where to look: centre of a chart's area, middle of a boundary, the vertex
    double size = 0;         // area of a chart, length of a boundary; orders problems of one kind
    std::string text;        // one line, in words
};

// Every problem, worst first: invalid charts (largest first), boundaries (longest first), corners, then turning-points
// (the algorithms' own, see turning_points.h), these by number. Empty if and only if valid and monotone. O(n)
std::vector<Problem> explain(const TriMesh& mesh, const LabelingGraph& graph);

// A sentence where the part itself is the trouble, as when most of its area is more than 20 degrees from every axis;
// empty otherwise.
std::string hint(const TriMesh& mesh);

// Statistics and problems as one JSON object: the published keys and ours.
std::string statistics_json(const Statistics& s, const std::vector<Problem>& problems, const std::vector<double>& rotation = {});

}   // namespace polylab

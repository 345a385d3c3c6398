// statistics.h: what a labeling is worth in numbers (paper, Sections 3.3, 3.4 and the tables of Section 8).
#pragma once

#include "polylab/json.h"
#include "polylab/polycube.h"
#include "polylab/turning_points.h"

#include <optional>
#include <string>

namespace polylab {

// The paper's classes. They follow the published criteria and the published count of turning-points.
enum class Class { valid_monotone, valid_turning_points, invalid };

// (n . direction + 1) / 2: 1 where the label is the normal, 0.854 at 45 degrees, 0.5 at 90 degrees or without normal.
double fidelity(const Vec3& normal, Label l);

struct Statistics {
    Index facets = 0;
    Index charts = 0, invalid_charts = 0;
    Index boundaries = 0, invalid_boundaries = 0, non_monotone_boundaries = 0;   // the last as published
    Index corners = 0, invalid_corners = 0;
    Index turning_points = 0;       // vertices, as published
    Index own_turning_points = 0;   // independent of numbers and directions: drives the algorithms
    double fidelity_min = 0, fidelity_avg = 0, fidelity_max = 0, fidelity_sd = 0;   // over facets, as published
    double fidelity_area_avg = 0;                                                   // weighted by area
    Index features_preserved = 0;   // kept feature edges with different labels at their sides
    Index features_lost = 0;        // kept feature edges with one label
    Index features_ignored = 0;     // feature edges of the file that are not kept
    bool allow_opposite = true;
    std::optional<Distortion> distortion;   // of the polycube: takes longer than the rest, so for the caller to fill in

    Index invalid() const { return invalid_charts + invalid_boundaries + invalid_corners; }
    Class result_class() const {
        return invalid() > 0 ? Class::invalid : turning_points > 0 ? Class::valid_turning_points : Class::valid_monotone;
    }
};

// O(n)
Statistics statistics(const TriMesh& mesh, const Labeling& labels, const LabelingGraph& graph);

// Two lines for people: class and counts, fidelity and feature edges.
std::string summary(const Statistics& s);

// The published keys alone, as the published `labeling_stats` writes them.
std::string published_json(const Statistics& s);

// The published keys, in the published layout, and ours under "polylab". The object stays open for more keys:
// those that sort before and after "problems" are written by the two halves. rotation: the nine entries, row by row, of the
// matrix by which the part was turned, if it was (align.h).
void write_json(JsonWriter& json, const Statistics& s, const std::vector<double>& rotation = {});
void write_json_end(JsonWriter& json, const Statistics& s);

}   // namespace polylab

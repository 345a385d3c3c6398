#include "polylab/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace polylab {

namespace {

void measure_fidelity(const TriMesh& mesh, const Labeling& labels, Statistics& s) {
    double sum = 0, squares = 0, area = 0, area_sum = 0;
    s.fidelity_min = 1;
    s.fidelity_max = 0;
    for (Index f = 0; f < mesh.facets(); f++) {
        const double x = fidelity(mesh.normal[f], labels[f]), a = norm(mesh.area_vector(f));
        s.fidelity_min = std::min(s.fidelity_min, x);
        s.fidelity_max = std::max(s.fidelity_max, x);
        sum += x;
        area += a;
        area_sum += a * x;
    }
    s.fidelity_avg = sum / mesh.facets();
    s.fidelity_area_avg = area > 0 ? area_sum / area : s.fidelity_avg;
    for (Index f = 0; f < mesh.facets(); f++) {
        const double d = fidelity(mesh.normal[f], labels[f]) - s.fidelity_avg;
        squares += d * d;
    }
    s.fidelity_sd = std::sqrt(squares / mesh.facets());
}

}   // namespace

double fidelity(const Vec3& normal, Label l) { return (along(normal, l) + 1) / 2; }

Statistics statistics(const TriMesh& mesh, const Labeling& labels, const LabelingGraph& graph) {
    Statistics s;
    s.facets = mesh.facets();
    s.charts = static_cast<Index>(graph.charts.size());
    s.boundaries = static_cast<Index>(graph.boundaries.size());
    s.corners = static_cast<Index>(graph.corners.size());
    s.invalid_charts = graph.invalid_charts;
    s.invalid_boundaries = graph.invalid_boundaries;
    s.invalid_corners = graph.invalid_corners;
    s.allow_opposite = graph.allow_opposite;
    const TurningPoints published = published_turning_points(mesh, graph);
    s.turning_points = published.vertices;
    s.non_monotone_boundaries = published.non_monotone_boundaries;
    s.own_turning_points = static_cast<Index>(find_turning_points(mesh, graph).points.size());
    measure_fidelity(mesh, labels, s);
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && h < mesh.opposite[h]) (graph.is_border(h) ? s.features_preserved : s.features_lost)++;
    s.features_ignored = std::max(0, mesh.features_given - mesh.features_kept);   // none where they were detected
    return s;
}

std::string summary(const Statistics& s) {
    const char* name = s.result_class() == Class::invalid          ? "not valid"
                       : s.result_class() == Class::valid_monotone ? "valid, all monotone"
                                                                   : "valid, with turning-points";
    char text[512];
    std::snprintf(text, sizeof text,
                  "%s: %d charts (%d invalid), %d boundaries (%d invalid), %d corners (%d invalid), %d turning-points\n"
                  "fidelity %.4f on average, %.4f at least; feature edges: %d preserved, %d lost, %d ignored",
                  name, s.charts, s.invalid_charts, s.boundaries, s.invalid_boundaries, s.corners, s.invalid_corners,
                  s.turning_points, s.fidelity_avg, s.fidelity_min, s.features_preserved, s.features_lost, s.features_ignored);
    return text;
}

namespace {

// The published keys that sort before "polylab".
void write_published(JsonWriter& json, const Statistics& s) {
    json.open_object("boundaries");
    json.value("invalid", s.invalid_boundaries);
    json.value("nb", s.boundaries);
    json.value("non-monotone", s.non_monotone_boundaries);
    json.close_object();
    json.open_object("charts");
    json.value("invalid", s.invalid_charts);
    json.value("nb", s.charts);
    json.close_object();
    json.open_object("corners");
    json.value("invalid", s.invalid_corners);
    json.value("nb", s.corners);
    json.close_object();
    json.open_object("feature-edges");
    json.value("lost", s.features_lost);
    json.value("preserved", s.features_preserved);
    json.value("removed", s.features_ignored);
    json.close_object();
    json.open_object("fidelity");
    json.value("avg", s.fidelity_avg);
    json.value("max", s.fidelity_max);
    json.value("min", s.fidelity_min);
    json.value("sd", s.fidelity_sd);
    json.close_object();
    json.value("is_allowing_boundaries_between_opposite_labels", s.allow_opposite);
}

}   // namespace

std::string published_json(const Statistics& s) {
    JsonWriter json;
    json.open_object();
    write_published(json, s);
    write_json_end(json, s);
    return json.text() + "\n";
}

void write_json(JsonWriter& json, const Statistics& s, const std::vector<double>& rotation) {
    json.open_object();
    write_published(json, s);
    json.open_object("polylab");
    json.value("class", s.result_class() == Class::invalid          ? "invalid"
                        : s.result_class() == Class::valid_monotone ? "valid_monotone"
                                                                    : "valid_turning_points");
    if (s.distortion) {
        json.open_object("distortion");
        json.value("angle", s.distortion->angle);
        json.value("area", s.distortion->area);
        json.value("collapsed", s.distortion->collapsed);
        json.value("isometric", s.distortion->isometric);
        json.value("stretch", s.distortion->stretch);
        json.value("turned", s.distortion->turned);
        json.close_object();
    }
    json.value("facets", s.facets);
    json.value("fidelity_area_avg", s.fidelity_area_avg);
    if (!rotation.empty()) {
        json.open_array("rotation");
        for (const double r : rotation) json.value("", r);
        json.close_array();
    }
    json.value("turning_points", s.own_turning_points);
    json.close_object();
}

void write_json_end(JsonWriter& json, const Statistics& s) {
    json.open_object("turning-points");
    json.value("nb", s.turning_points);
    json.close_object();
    json.close_object();
}

}   // namespace polylab

#include "polylab/stages.h"

#include "polylab/polylab.h"

#include <initializer_list>

namespace polylab {

namespace {

void line(std::string& out, const std::string& word, std::initializer_list<std::int64_t> numbers) {
    out += word;
    for (const std::int64_t i : numbers) out += ' ' + std::to_string(i);
    out += '\n';
}

std::string mesh_stage(const TriMesh& mesh) {
    std::string out;
    line(out, "vertices", {mesh.vertices()});
    line(out, "facets", {mesh.facets()});
    line(out, "components", {mesh.components});
    line(out, "cavities", {mesh.cavities});
    line(out, "turned_components", {mesh.turned_components});
    line(out, "turned_facets", {mesh.turned_facets});
    line(out, "isolated_vertices", {mesh.isolated_vertices});
    line(out, "flat_facets", {mesh.flat_facets});
    line(out, "features_given", {mesh.features_given});
    line(out, "features_kept", {mesh.features_kept});
    line(out, "features_off", {mesh.features_off});
    // The connectivity is the file's; only what was decided about it: facets with exchanged vertices, kept feature edges.
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && h < mesh.opposite[h]) line(out, "feature", {h, mesh.opposite[h]});
    return out;
}

std::string costs_stage(const TriMesh& mesh) {
    std::string out;
    const PottsEnergy energy = labeling_energy(mesh);
    for (const auto& d : energy.data) line(out, "data", {d[0], d[1], d[2], d[3], d[4], d[5]});
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (h < mesh.opposite[h]) line(out, "pair", {h, energy.arcs[facet(h)][h % 3].weight});
    return out;
}

std::string tilted_stage(const TriMesh& mesh) {
    std::string out;
    const std::vector<char> tilt = facets_to_tilt(mesh, InitialOptions{}.sensitivity);
    for (Index f = 0; f < mesh.facets(); f++)
        if (tilt[f]) line(out, "facet", {f});
    return out;
}

std::string turning_points_stage(const TriMesh& mesh, const LabelingGraph& graph) {
    std::string out;
    const TurningPoints turning = find_turning_points(mesh, graph);
    for (const TurningPoint& t : turning.points) {
        line(out, "turning-point", {t.boundary, t.position, t.vertex});
        line(out, leans_left(mesh, graph, t) ? "leans left, closest corner" : "leans right, closest corner",
             {closest_corner(mesh, graph, t)});
    }
    const TurningPoints published = published_turning_points(mesh, graph);
    line(out, "own count", {static_cast<Index>(turning.points.size())});
    line(out, "published vertices", {published.vertices});
    line(out, "published non-monotone boundaries", {published.non_monotone_boundaries});
    return out;
}

// Floats are rounded to 1e-6, far above what the order of a sum can change.
std::string statistics_stage(const TriMesh& mesh, const Labeling& labels) {
    std::string out;
    const Statistics s = statistics(mesh, labels, build_graph(mesh, labels));
    const auto micro = [](double x) { return static_cast<std::int64_t>(x * 1e6 + 0.5); };
    line(out, "charts", {s.charts, s.invalid_charts});
    line(out, "boundaries", {s.boundaries, s.invalid_boundaries, s.non_monotone_boundaries});
    line(out, "corners", {s.corners, s.invalid_corners});
    line(out, "turning-points", {s.turning_points, s.own_turning_points});
    line(out, "feature-edges preserved, lost, ignored", {s.features_preserved, s.features_lost, s.features_ignored});
    line(out, "fidelity min, avg, max, sd in millionths",
         {micro(s.fidelity_min), micro(s.fidelity_avg), micro(s.fidelity_max), micro(s.fidelity_sd)});
    line(out, "class", {static_cast<int>(s.result_class())});
    return out;
}

}   // namespace

std::vector<Stage> stages(const TriMesh& mesh) {
    const Labeling graphcut = graphcut_labeling(mesh);
    const LabelingGraph graph = build_graph(mesh, graphcut);
    const Labeling start = search_start(mesh);
    std::string trace;
    for (Index f = 0; f < mesh.facets(); f++)
        if (start[f] != graphcut[f]) line(trace, "start", {f, start[f]});
    RoutineOptions options;
    options.trace = [&](const Step& step) { trace += trace_line(step); };
    const Labeling labels = search(mesh, start, options).labels;
    const std::string energy = "energy " + std::to_string(labeling_energy(mesh)(graphcut)) + "\n";
    return {{"01-mesh", mesh_stage(mesh)},
            {"02-costs", costs_stage(mesh)},
            {"03-naive", labels_text(naive_labeling(mesh))},
            {"04-tilted", tilted_stage(mesh)},
            {"05-graphcut", energy + labels_text(graphcut)},
            {"06-graph", graph_text(graph)},
            {"07-turning-points", turning_points_stage(mesh, graph)},
            {"08-trace", trace},
            {"09-labels", labels_text(labels)},
            {"10-statistics", statistics_stage(mesh, labels)}};
}

}   // namespace polylab

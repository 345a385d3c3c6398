#include "polylab/explain.h"

#include <algorithm>
#include <cstdio>

namespace polylab {

namespace {

constexpr double kCos20 = 0.93969262078590838;
constexpr const char* kAxisName[3] = {"X", "Y", "Z"};

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

std::string place(const Vec3& p) { return format("%.4g %.4g %.4g", p.x, p.y, p.z); }

std::string count(Index n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

class Explainer {
public:
    Explainer(const TriMesh& mesh, const LabelingGraph& graph) : mesh_(mesh), graph_(graph) {}

    std::vector<Problem> explain() {
        charts();
        boundaries();
        corners();
        std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {   // tie: by number
            return a.kind < b.kind || (a.kind == b.kind && a.size > b.size);
        });
        turning_points();
        return std::move(problems_);
    }

private:
    std::string chart_name(Index c) const { return std::to_string(c) + " (" + kLabelName[graph_.charts[c].label] + ")"; }

    void charts() {
        if (graph_.invalid_charts == 0) return;
        std::vector<Problem> found(graph_.charts.size());
        for (Index f = 0; f < mesh_.facets(); f++) {
            if (graph_.charts[graph_.chart[f]].valid) continue;
            Problem& p = found[graph_.chart[f]];
            const double area = norm(mesh_.area_vector(f)) / 2;
            const Vec3 centre = (mesh_.points[mesh_.origin[3 * f]] + mesh_.points[mesh_.origin[3 * f + 1]] +
                                 mesh_.points[mesh_.origin[3 * f + 2]]) *
                                (1.0 / 3);
            if (f == graph_.charts[graph_.chart[f]].smallest_facet) p.position = centre;
            // The running mean of the centres, weighted by area.
            p.size += area;
            if (p.size > 0) p.position += (centre - p.position) * (area / p.size);
        }
        for (Index c = 0; c < static_cast<Index>(found.size()); c++) {
            const Chart& chart = graph_.charts[c];
            if (chart.valid) continue;
            Problem& p = found[c];
            p.kind = Problem::Kind::chart;
            p.element = c;
            p.text = "chart " + std::to_string(c) + " (" + kLabelName[chart.label] + ", " + count(chart.facets, "facet") +
                     " near " + place(p.position) + "): ";
            p.text += chart.boundaries.size() == 0   ? "no boundary"
                      : chart.boundaries.size() == 1 ? "1 boundary"
                                                     : std::to_string(chart.boundaries.size()) + " boundaries";
            p.text += ", needs at least 4";
            const char* separator = "; neighbours ";
            for (Index i = chart.boundaries.first; i < chart.boundaries.last; i++) {
                p.text += separator + chart_name(graph_.neighbour(graph_.chart_boundaries[i], c));
                separator = ", ";
            }
            problems_.push_back(p);
        }
    }

    void boundaries() {
        for (Index b = 0; b < static_cast<Index>(graph_.boundaries.size()); b++) {
            const Boundary& boundary = graph_.boundaries[b];
            if (boundary.valid) continue;
            Problem p;
            p.kind = Problem::Kind::boundary;
            p.element = b;
            Index convex = 0;
            for (Index i = boundary.halfedges.first; i < boundary.halfedges.last; i++) {
                p.size += norm(mesh_.vector(graph_.halfedges[i]));
                convex += is_convex(mesh_, graph_.halfedges[i]);
            }
            p.position = mesh_.points[mesh_.from(graph_.halfedges[(boundary.halfedges.first + boundary.halfedges.last) / 2])];
            p.text = "boundary " + std::to_string(b) + " (" + count(boundary.halfedges.size(), "edge") + " near " +
                     place(p.position) + "): opposite labels of charts " + chart_name(boundary.left) + " and " +
                     chart_name(boundary.right);
            p.text += graph_.allow_opposite ? " meet at less than 180 degrees along " + count(convex, "edge")
                                            : std::string(" meet, which this run does not allow");
            problems_.push_back(p);
        }
    }

    std::string ring_axes(const Ring& ring) const {
        std::string axes;
        for (Index i = ring.halfedges.first; i < ring.halfedges.last; i++) {
            const int axis = graph_.boundaries[graph_.boundary[graph_.ring_halfedges[i]]].axis;
            axes += (i > ring.halfedges.first ? " " : "") + std::string(axis == kNone ? "-" : kAxisName[axis]);
        }
        return axes;
    }

    void corners() {
        for (Index c = 0; c < static_cast<Index>(graph_.corners.size()); c++) {
            const Corner& corner = graph_.corners[c];
            if (corner.valid) continue;
            Problem p;
            p.kind = Problem::Kind::corner;
            p.element = c;
            p.vertex = corner.vertex;
            p.position = mesh_.points[corner.vertex];
            p.text = "corner at vertex " + std::to_string(corner.vertex) + " (" + place(p.position) + "): ";
            const char* separator = "";
            for (Index r = corner.rings.first; r < corner.rings.last; r++) {
                if (graph_.rings[r].valid) continue;
                p.text += separator + ring_axes(graph_.rings[r]);
                separator = " and ";
            }
            p.text += ", neither pairs of one axis nor a trio X Y Z";
            problems_.push_back(p);
        }
    }

    void turning_points() {
        for (const TurningPoint& t : find_turning_points(mesh_, graph_).points) {
            const Boundary& boundary = graph_.boundaries[t.boundary];
            Problem p;
            p.kind = Problem::Kind::turning_point;
            p.element = t.boundary;
            p.vertex = t.vertex;
            p.position = mesh_.points[t.vertex];
            p.text = "turning-point at vertex " + std::to_string(t.vertex) + " (" + place(p.position) + ") on boundary " +
                     std::to_string(t.boundary) + " (axis " + kAxisName[boundary.axis] + ") between charts " +
                     chart_name(boundary.left) + " and " + chart_name(boundary.right);
            problems_.push_back(p);
        }
    }

    const TriMesh& mesh_;
    const LabelingGraph& graph_;
    std::vector<Problem> problems_;
};

}   // namespace

std::vector<Problem> explain(const TriMesh& mesh, const LabelingGraph& graph) { return Explainer(mesh, graph).explain(); }

std::string hint(const TriMesh& mesh) {
    double area = 0, tilted = 0;
    for (Index f = 0; f < mesh.facets(); f++) {
        const Vec3& n = mesh.normal[f];
        const double a = norm(mesh.area_vector(f));
        area += a;
        if (std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) < kCos20) tilted += a;
    }
    if (!(tilted > area / 2)) return "";
    return format(
        "%.0f %% of the part's area is more than 20 degrees from every axis: try --align, or turn the part so that its main faces "
        "lie along X, Y and Z",
        100 * tilted / area);
}

std::string statistics_json(const Statistics& s, const std::vector<Problem>& problems, const std::vector<double>& rotation) {
    constexpr const char* kKind[] = {"chart", "boundary", "corner", "turning-point"};
    JsonWriter json;
    write_json(json, s, rotation);
    json.open_array("problems");
    for (const Problem& p : problems) {
        json.open_object();
        json.value(p.kind == Problem::Kind::turning_point ? "boundary" : "element", p.element);
        json.value("kind", kKind[static_cast<int>(p.kind)]);
        json.open_array("position");
        for (int a = 0; a < 3; a++) json.value("", p.position[a]);
        json.close_array();
        json.value("text", p.text);
        if (p.vertex != kNone) json.value("vertex", p.vertex);
        json.close_object();
    }
    json.close_array();
    write_json_end(json, s);
    return json.text() + "\n";
}

}   // namespace polylab

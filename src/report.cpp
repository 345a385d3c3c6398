#include "polylab/report.h"

#include "polylab/explain.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

namespace polylab {

namespace {

// The page's three parts, each in a file of its own that is a raw string: its first line opens it, its last line closes it.
constexpr const char* kPage =
#include "report.html"
    ;
constexpr const char* kStyle =
#include "report.css"
    ;
constexpr const char* kScript =
#include "report.js"
    ;

using Bytes = std::vector<unsigned char>;

void append_little_endian(Bytes& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; i++) out.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

// Whole numbers >= 0 in 1, 2 or 4 bytes each, whichever is enough for the largest: {"bytes": 2, "data": "…"}.
template <class Number>
void write_array(JsonWriter& json, const char* key, const std::vector<Number>& numbers) {
    const Index largest = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
    const int bytes = largest < 256 ? 1 : largest < 65536 ? 2 : 4;
    Bytes packed;
    packed.reserve(numbers.size() * bytes);
    for (const Number n : numbers) append_little_endian(packed, static_cast<std::uint32_t>(n), bytes);
    json.open_object(key);
    json.value("bytes", Index(bytes));
    json.value("data", base64(packed));
    json.close_object();
}

// Where the page's coordinates begin and end: it shows (p - centre) * scale, which lies within the unit ball.
struct Frame {
    Vec3 centre;
    double scale = 1;
};

Frame frame_of(const std::vector<Vec3>& points, const std::vector<Index>& used) {
    Vec3 low = points[used[0]], high = low;
    for (const Index v : used)
        for (int a = 0; a < 3; a++) {
            low[a] = std::min(low[a], points[v][a]);
            high[a] = std::max(high[a], points[v][a]);
        }
    const double radius = norm(high - low) / 2;
    return {(low + high) * 0.5, radius > 0 ? 1 / radius : 1};
}

// Three floats per vertex, in the frame of those that have facets.
void write_points(JsonWriter& json, const char* key, const std::vector<Vec3>& points, const Frame& frame) {
    Bytes packed;
    packed.reserve(points.size() * 12);
    for (const Vec3& p : points) {
        const Vec3 q = (p - frame.centre) * frame.scale;
        for (int a = 0; a < 3; a++) {
            const float x = static_cast<float>(q[a]);
            std::uint32_t bits;
            std::memcpy(&bits, &x, sizeof bits);
            append_little_endian(packed, bits, 4);
        }
    }
    json.value(key, base64(packed));
}

void write_statistics(JsonWriter& json, const Statistics& s) {
    const auto text = [](double x) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.4f", x);
        return std::string(digits);
    };
    json.open_object("statistics");
    json.value("class", s.result_class() == Class::invalid          ? "invalid"
                        : s.result_class() == Class::valid_monotone ? "valid, monotone"
                                                                    : "valid, with turning-points");
    json.value("charts", s.charts);
    json.value("invalid charts", s.invalid_charts);
    json.value("boundaries", s.boundaries);
    json.value("invalid boundaries", s.invalid_boundaries);
    json.value("corners", s.corners);
    json.value("invalid corners", s.invalid_corners);
    json.value("turning-points", s.turning_points);
    json.value("non-monotone boundaries", s.non_monotone_boundaries);
    json.value("average fidelity", text(s.fidelity_avg));
    json.value("fidelity by area", text(s.fidelity_area_avg));
    json.value("least fidelity", text(s.fidelity_min));
    json.value("feature edges kept", s.features_preserved);
    json.value("lost", s.features_lost);
    json.value("ignored", s.features_ignored);
    json.close_object();
}

void write_problems(JsonWriter& json, const TriMesh& mesh, const std::vector<Problem>& problems, const Frame& frame) {
    constexpr const char* kKind[] = {"chart", "boundary", "corner", "turning-point"};
    json.open_array("problems");
    for (const Problem& p : problems) {
        json.open_object();
        json.value("kind", kKind[static_cast<int>(p.kind)]);
        json.value("element", p.element);
        json.value("text", p.text);
        const Vec3 at = (p.position - frame.centre) * frame.scale;
        json.open_array("at");
        for (int a = 0; a < 3; a++) json.value("", at[a]);
        json.close_array();
        // How much of the part around it is to be seen: a few edges at least.
        const double extent = p.kind == Problem::Kind::chart ? std::sqrt(p.size) : p.size / 2;
        json.value("radius", std::max(extent, 8 * mesh.mean_edge) * frame.scale);
        json.close_object();
    }
    json.close_array();
}

void write_layer(JsonWriter& json, const TriMesh& mesh, const Report::Layer& layer, const Frame& frame) {
    const LabelingGraph graph = build_graph(mesh, layer.labels);
    std::vector<char> invalid_charts, invalid_borders, invalid_corners, lost;
    std::vector<Index> borders, corners, turning_points;
    for (const Chart& c : graph.charts) invalid_charts.push_back(!c.valid);
    for (const Boundary& b : graph.boundaries)
        for (Index i = b.halfedges.first; i < b.halfedges.last; i++) {
            borders.push_back(mesh.from(graph.halfedges[i]));
            borders.push_back(mesh.to(graph.halfedges[i]));
            invalid_borders.push_back(!b.valid);
        }
    for (const Corner& c : graph.corners) {
        corners.push_back(c.vertex);
        invalid_corners.push_back(!c.valid);
    }
    for (const TurningPoint& t : find_turning_points(mesh, graph).points) turning_points.push_back(t.vertex);
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && mesh.edge(h) == h) lost.push_back(!graph.is_border(h));

    json.open_object();
    json.value("name", layer.name);
    write_array(json, "labels", layer.labels);
    write_array(json, "charts", graph.chart);
    write_array(json, "invalid_charts", invalid_charts);
    write_array(json, "borders", borders);   // 2 vertices per edge
    write_array(json, "invalid_borders", invalid_borders);
    write_array(json, "corners", corners);
    write_array(json, "invalid_corners", invalid_corners);
    write_array(json, "turning_points", turning_points);
    write_array(json, "lost", lost);   // of `features`
    write_statistics(json, statistics(mesh, layer.labels, graph));
    write_problems(json, mesh, explain(mesh, graph), frame);
    json.close_object();
}

std::string data_of(const TriMesh& mesh, const Report& report) {
    const Frame frame = frame_of(mesh.points, mesh.origin);
    std::vector<Index> features;
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && mesh.edge(h) == h) {
            features.push_back(mesh.from(h));
            features.push_back(mesh.to(h));
        }
    JsonWriter json;
    json.open_object();
    json.value("title", report.title);
    json.open_object("parameters");
    for (const Report::Parameter& p : report.parameters) json.value(p.name, p.value);
    json.close_object();
    json.value("facets", mesh.facets());
    json.value("vertices", mesh.vertices());
    json.value("hint", hint(mesh));
    write_points(json, "points", mesh.points, frame);
    write_points(json, "polycube", report.polycube, report.polycube.empty() ? Frame{} : frame_of(report.polycube, mesh.origin));
    write_array(json, "triangles", mesh.origin);
    write_array(json, "features", features);   // 2 vertices per kept feature edge
    json.open_array("layers");
    for (const Report::Layer& layer : report.layers) write_layer(json, mesh, layer, frame);
    json.close_array();
    json.close_object();
    return json.text();
}

// For text between tags; inside JSON strings the same characters are written as \u003c.
std::string escaped(const std::string& text, const char* less, const char* ampersand) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            out += less;
        else if (c == '&')
            out += ampersand;
        else
            out += c;
    return out;
}

// The page with its marks replaced in their order, so that a mark within a replacement stays.
std::string filled(std::string_view page, const std::vector<std::pair<const char*, std::string>>& replacements) {
    std::string out;
    for (const auto& [mark, text] : replacements) {
        const std::size_t at = page.find(mark);
        out += page.substr(0, at);
        out += text;
        page.remove_prefix(at + std::strlen(mark));
    }
    return out += page;
}

}   // namespace

std::string title_of(const std::string& path) {
    std::size_t at = path.find_last_of("/\\");
    if (at != std::string::npos && at > 0) at = path.find_last_of("/\\", at - 1);
    return at == std::string::npos ? path : path.substr(at + 1);
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; k++) bits = bits << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; k++) out += k <= left ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

std::string report_html(const TriMesh& mesh, const Report& report) {
    return filled(kPage, {{"@TITLE@", escaped(report.title, "&lt;", "&amp;")},
                          {"@STYLE@", kStyle},
                          {"@DATA@", escaped(data_of(mesh, report), "\\u003c", "\\u0026")},
                          {"@SCRIPT@", kScript}});
}

}   // namespace polylab

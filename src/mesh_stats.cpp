#include "polylab/mesh_stats.h"

#include "polylab/json.h"

#include <algorithm>
#include <cmath>

namespace polylab {

namespace {

constexpr int kTetEdge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr int kTetTriangle[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {0, 2, 1}};
constexpr int kHexEdge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr int kHexQuad[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr int kHexCorner[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
constexpr int kHexAround06[7] = {1, 2, 3, 7, 4, 5, 1};   // tetrahedra (0, this, next, 6) fill the hexahedron

struct Spread {
    double least = 0, most = 0, mean = 0, deviation = 0, sum = 0;
};

Spread spread(const std::vector<double>& values) {
    Spread s;
    if (values.empty()) return s;
    const double n = static_cast<double>(values.size());
    s.least = s.most = values[0];
    for (const double x : values) {
        s.least = std::min(s.least, x);
        s.most = std::max(s.most, x);
        s.sum += x;
    }
    s.mean = s.sum / n;
    double squares = 0;
    for (const double x : values) squares += (x - s.mean) * (x - s.mean);
    s.deviation = std::sqrt(squares / n);
    return s;
}

void write_spread(JsonWriter& json, const char* key, const Spread& s, bool with_sum = false) {
    json.open_object(key);
    json.value("avg", s.mean);
    json.value("max", s.most);
    json.value("min", s.least);
    json.value("sd", s.deviation);
    if (with_sum) json.value("sum", s.sum);
    json.close_object();
}

// Sets of N vertices, however they are turned.
template <std::size_t N>
class VertexSets {
public:
    void add(std::array<Index, N> vertices) {
        std::sort(vertices.begin(), vertices.end());
        sets_.push_back(vertices);
    }
    Index count() {
        std::sort(sets_.begin(), sets_.end());
        return static_cast<Index>(std::unique(sets_.begin(), sets_.end()) - sets_.begin());
    }

private:
    std::vector<std::array<Index, N>> sets_;
};

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return dot(cross(b - a, c - a), d - a) / 6; }

void check_indices(const char* what, const std::vector<Index>& elements, std::size_t n, std::size_t vertices) {
    for (std::size_t i = 0; i < elements.size(); i++)
        if (elements[i] < 0 || static_cast<std::size_t>(elements[i]) >= vertices)
            throw InputError(std::string(what) + " " + std::to_string(i / n) + ": expected a vertex from 0 to " +
                             std::to_string(static_cast<std::int64_t>(vertices) - 1) + ", found " + std::to_string(elements[i]));
}

void write_cells(JsonWriter& json, const MeshData& data) {
    const std::size_t tets = data.tets.size() / 4, hexes = data.hexes.size() / 8;
    VertexSets<2> edges;
    VertexSets<3> triangles;
    VertexSets<4> quads;
    double total = 0;
    for (std::size_t c = 0; c < tets; c++) {
        const Index* const v = &data.tets[4 * c];
        for (const auto& e : kTetEdge) edges.add({v[e[0]], v[e[1]]});
        for (const auto& t : kTetTriangle) triangles.add({v[t[0]], v[t[1]], v[t[2]]});
        total += std::abs(volume(data.points[v[0]], data.points[v[1]], data.points[v[2]], data.points[v[3]]));
    }
    std::vector<double> quality;
    for (std::size_t c = 0; c < hexes; c++) {
        const Index* const v = &data.hexes[8 * c];
        std::array<Vec3, 8> p;
        for (int k = 0; k < 8; k++) p[k] = data.points[v[k]];
        for (const auto& e : kHexEdge) edges.add({v[e[0]], v[e[1]]});
        for (const auto& q : kHexQuad) quads.add({v[q[0]], v[q[1]], v[q[2]], v[q[3]]});
        double signed_volume = 0;
        for (int k = 0; k < 6; k++) signed_volume += volume(p[0], p[kHexAround06[k]], p[kHexAround06[k + 1]], p[6]);
        total += std::abs(signed_volume);
        quality.push_back(scaled_jacobian(p));
    }
    json.open_object("cells");
    if (tets + hexes > 0) {
        json.open_object("by_type");
        json.value("hexahedra", static_cast<Index>(hexes));
        json.value("tetrahedra", static_cast<Index>(tets));
        json.close_object();
        json.value("edges", edges.count());
        json.value("facets", triangles.count() + quads.count());
    }
    json.value("nb", static_cast<Index>(tets + hexes));
    if (hexes > 0) {
        json.open_object("quality");
        write_spread(json, "hex_SJ", spread(quality));
        json.close_object();
    }
    if (tets + hexes > 0) json.value("volume", total);
    json.close_object();
}

void write_facets(JsonWriter& json, const MeshData& data) {
    const std::vector<Index>& t = data.triangles;
    std::vector<double> area;
    VertexSets<2> edges;
    double inside = 0;   // signed, about the first vertex
    for (std::size_t i = 0; i < t.size(); i += 3) {
        const Vec3 &a = data.points[t[i]], &b = data.points[t[i + 1]], &c = data.points[t[i + 2]];
        area.push_back(norm(cross(b - a, c - a)) / 2);
        inside += volume(data.points[0], a, b, c);
        for (std::size_t k = 0; k < 3; k++) edges.add({t[i + k], t[i + (k + 1) % 3]});
    }
    json.open_object("facets");
    if (!area.empty()) {
        write_spread(json, "area", spread(area), /* with_sum= */ true);
        json.value("edges", edges.count());
    }
    json.value("nb", static_cast<Index>(area.size()));
    if (!area.empty()) json.value("normals_outward", inside >= 0);
    json.close_object();
}

void write_vertices(JsonWriter& json, const std::vector<Vec3>& points) {
    json.open_object("vertices");
    json.value("nb", static_cast<Index>(points.size()));
    if (!points.empty()) {
        json.open_array("principal_axes");
        for (const Vec3& axis : principal_axes(points).axis) {
            json.open_array({});
            for (int a = 0; a < 3; a++) json.value("", axis[a]);
            json.close_array();
        }
        json.close_array();
        std::vector<double> x(points.size());
        for (int a = 0; a < 3; a++) {
            for (std::size_t v = 0; v < x.size(); v++) x[v] = points[v][a];
            constexpr const char* kAxis[] = {"x", "y", "z"};
            write_spread(json, kAxis[a], spread(x));
        }
    }
    json.close_object();
}

}   // namespace

// Jacobi's rotations on the covariances: each makes one entry beside the diagonal zero. A dozen is enough for doubles.
PrincipalAxes principal_axes(const std::vector<Vec3>& points) {
    const double n = static_cast<double>(points.size());
    PrincipalAxes axes;
    for (const Vec3& p : points) axes.centre += p * (1 / n);
    double m[3][3] = {};
    for (const Vec3& p : points) {
        const Vec3 d = p - axes.centre;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) m[i][j] += d[i] * d[j] / n;
    }
    Vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int round = 0; round < 36; round++) {
        const int i = round % 3, j = (i + 1) % 3;
        if (m[i][j] == 0) continue;
        const double slope = (m[j][j] - m[i][i]) / (2 * m[i][j]);
        const double t = (slope < 0 ? -1 : 1) / (std::abs(slope) + std::sqrt(slope * slope + 1));   // tangent of the angle
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (auto& row : m) {
            const double a = row[i], b = row[j];
            row[i] = c * a - s * b;
            row[j] = s * a + c * b;
        }
        for (int k = 0; k < 3; k++) {
            const double a = m[i][k], b = m[j][k];
            m[i][k] = c * a - s * b;
            m[j][k] = s * a + c * b;
        }
        const Vec3 a = column[i];
        column[i] = a * c - column[j] * s;
        column[j] = a * s + column[j] * c;
    }
    int order[3] = {0, 1, 2};
    std::stable_sort(order, order + 3, [&](int a, int b) { return m[a][a] > m[b][b]; });
    for (int k = 0; k < 3; k++) {
        const Vec3 v = column[order[k]];
        int largest = 0;
        for (int a = 1; a < 3; a++)
            if (std::abs(v[a]) > std::abs(v[largest])) largest = a;
        axes.axis[k] = v[largest] < 0 ? -v : v;
        axes.extent[k] = std::sqrt(std::max(0.0, m[order[k]][order[k]]));
    }
    return axes;
}

double scaled_jacobian(const std::array<Vec3, 8>& hex) {
    double least = 1;
    for (int k = 0; k < 8; k++) {
        const auto edge = [&](int i) { return unit(hex[kHexCorner[k][i]] - hex[k]); };
        least = std::min(least, dot(cross(edge(0), edge(1)), edge(2)));
    }
    return least;
}

std::string mesh_stats_json(const MeshData& data) {
    check_indices("edge", data.edges, 2, data.points.size());
    check_indices("triangle", data.triangles, 3, data.points.size());
    check_indices("tetrahedron", data.tets, 4, data.points.size());
    check_indices("hexahedron", data.hexes, 8, data.points.size());
    JsonWriter json;
    json.open_object();
    write_cells(json, data);
    json.open_object("edges");
    json.value("nb", static_cast<Index>(data.edges.size() / 2));
    json.close_object();
    write_facets(json, data);
    write_vertices(json, data.points);
    json.close_object();
    return json.text() + "\n";
}

}   // namespace polylab

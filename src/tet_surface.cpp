#include "polylab/tet_surface.h"

#include "polylab/text.h"

#include <algorithm>
#include <array>

namespace polylab {

namespace {

constexpr int kFacetVertex[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {0, 2, 1}};

struct TetFacet {
    Index middle, largest;   // its other vertices; filed under the smallest
    Index id;                // 4 * tetrahedron + k

    bool same_vertices(const TetFacet& b) const { return middle == b.middle && largest == b.largest; }
};

void check_tets(const MeshData& data) {
    if (data.tets.empty()) throw InputError("expected tetrahedra, found none");
    if (data.tets.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        throw InputError("expected at most 536870911 tetrahedra, found " + std::to_string(data.tets.size() / 4));
    const Index vertices = static_cast<Index>(data.points.size());
    for (std::size_t i = 0; i < data.tets.size(); i++) {
        const Index v = data.tets[i];
        const std::string tet = "tetrahedron " + std::to_string(i / 4);
        if (v < 0 || v >= vertices)
            throw InputError(tet + ": expected vertices 0.." + std::to_string(vertices - 1) + ", found " + std::to_string(v));
        for (std::size_t j = i - i % 4; j < i; j++)
            if (data.tets[j] == v)
                throw InputError(tet + ": expected four vertices, found vertex " + std::to_string(v) + " twice");
    }
    for (const Index v : data.edges)
        if (v < 0 || v >= vertices)
            throw InputError("feature edges: expected vertices 0.." + std::to_string(vertices - 1) + ", found " +
                             std::to_string(v));
}

// Facet ids of the facets that only one tetrahedron has, in increasing order. A counting sort by the smallest vertex,
// then small sorts.
std::vector<Index> boundary_facets(const MeshData& data) {
    const Index n = static_cast<Index>(data.tets.size());   // four facets per tetrahedron, as many as vertices
    const auto vertices = [&](Index id) {
        std::array<Index, 3> v;
        for (int k = 0; k < 3; k++) v[k] = data.tets[id - id % 4 + kFacetVertex[id % 4][k]];
        std::sort(v.begin(), v.end());
        return v;
    };
    std::vector<Index> first(data.points.size() + 1, 0);
    for (Index id = 0; id < n; id++) first[vertices(id)[0] + 1]++;
    for (std::size_t v = 0; v + 1 < first.size(); v++) first[v + 1] += first[v];
    std::vector<Index> place(first.begin(), first.end() - 1);
    std::vector<TetFacet> facets(n);
    for (Index id = 0; id < n; id++) {
        const auto [smallest, middle, largest] = vertices(id);
        facets[place[smallest]++] = {middle, largest, id};
    }
    std::vector<char> on_boundary(n, 0);
    for (std::size_t v = 0; v + 1 < first.size(); v++) {
        const auto begin = facets.begin() + first[v], end = facets.begin() + first[v + 1];
        std::sort(begin, end, [](const TetFacet& a, const TetFacet& b) {
            return std::array{a.middle, a.largest, a.id} < std::array{b.middle, b.largest, b.id};
        });
        auto last = begin;
        for (auto f = begin; f != end; f = last) {
            for (last = f; last != end && last->same_vertices(*f);) ++last;
            on_boundary[f->id] = last - f == 1;
            if (last - f > 2)
                throw InputError("tetrahedra " + std::to_string(f[0].id / 4) + ", " + std::to_string(f[1].id / 4) + " and " +
                                 std::to_string(f[2].id / 4) + ": expected two tetrahedra at a facet, found " +
                                 std::to_string(last - f));
        }
    }
    std::vector<Index> ids;
    for (Index id = 0; id < n; id++)
        if (on_boundary[id]) ids.push_back(id);
    return ids;
}

}   // namespace

TetSurface extract_surface(const MeshData& data) {
    check_tets(data);
    TetSurface result;
    result.map.tets = static_cast<Index>(data.tets.size() / 4);
    result.map.tet_facet = boundary_facets(data);

    MeshData& surface = result.surface;
    std::vector<Index> number(data.points.size(), kNone);   // vertex -> its number on the surface
    for (const Index id : result.map.tet_facet)
        for (int k = 0; k < 3; k++) number[data.tets[id - id % 4 + kFacetVertex[id % 4][k]]] = 0;
    for (std::size_t v = 0; v < number.size(); v++) {
        if (number[v] == kNone) continue;
        number[v] = static_cast<Index>(surface.points.size());
        surface.points.push_back(data.points[v]);
    }
    surface.triangles.reserve(3 * result.map.tet_facet.size());
    for (const Index id : result.map.tet_facet)
        for (int k = 0; k < 3; k++) surface.triangles.push_back(number[data.tets[id - id % 4 + kFacetVertex[id % 4][k]]]);
    for (std::size_t e = 0; e < data.edges.size(); e += 2) {
        const Index a = number[data.edges[e]], b = number[data.edges[e + 1]];
        if (a != kNone && b != kNone) surface.edges.insert(surface.edges.end(), {a, b});
    }
    return result;
}

Labeling volume_labels(const Labeling& surface_labels, const SurfaceMap& map) {
    if (surface_labels.size() != map.tet_facet.size())
        throw InputError("expected " + std::to_string(map.tet_facet.size()) +
                         " labels, one per triangle of the surface map, found " + std::to_string(surface_labels.size()));
    Labeling volume(4 * static_cast<std::size_t>(map.tets), kNoLabel);
    for (std::size_t i = 0; i < surface_labels.size(); i++) volume[map.tet_facet[i]] = surface_labels[i];
    return volume;
}

std::string surface_map_text(const SurfaceMap& map) {
    std::string out;
    append(out, static_cast<Index>(map.tet_facet.size()));
    out += " triangles\n";
    append(out, map.tets);
    out += " tetrahedra\n";
    for (const Index id : map.tet_facet) {
        append(out, id);
        out += '\n';
    }
    return out;
}

SurfaceMap read_surface_map_text(std::string_view text, const std::string& name) {
    Scanner in(text, name);
    const auto head = [&](const std::string& word) {
        const Index count = in.integer(("a number of " + word).c_str());
        const std::string_view token = in.token();
        if (token != word) in.fail("'" + word + "'", token);
        if (count < 0 || count > std::numeric_limits<Index>::max() / 4) in.fail("a number of " + word, std::to_string(count));
        return count;
    };
    SurfaceMap map;
    const Index triangles = head("triangles");
    map.tets = head("tetrahedra");
    map.tet_facet.reserve(std::min<std::size_t>(triangles, in.bytes_left() / 2 + 1));
    const std::string what = "a tetrahedron facet from 0 to " + std::to_string(4 * map.tets - 1);
    for (Index i = 0; i < triangles; i++) {
        const std::string_view token = in.token();
        const Index id = in.to_integer(token, what.c_str());
        if (id < 0 || id >= 4 * map.tets) in.fail(what, token);
        if (i > 0 && id <= map.tet_facet.back()) in.fail("increasing numbers", token);
        map.tet_facet.push_back(id);
    }
    const std::string_view token = in.token();
    if (!token.empty()) throw InputError(name, in.line(), "expected " + std::to_string(triangles) + " triangles, found more");
    return map;
}

SurfaceMap read_surface_map(const std::string& path) { return read_surface_map_text(read_file(path), path); }

}   // namespace polylab

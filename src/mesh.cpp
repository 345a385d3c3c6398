#include "polylab/mesh.h"

#include "polylab/orientation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace polylab {

namespace {

constexpr double kLargestCoordinate = 1e75;   // the square of a squared length must stay finite

std::string named(const char* what, Index i) { return std::string(what) + " " + std::to_string(i); }

void check_elements(const MeshData& data) {
    const Index vertices = static_cast<Index>(data.points.size());
    const auto& t = data.triangles;
    if (t.empty()) throw InputError("expected a surface of triangles, found no triangle");
    if (t.size() + data.edges.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        throw InputError("expected at most 715827882 triangles, found " + std::to_string(t.size() / 3));
    for (Index v = 0; v < vertices; v++)
        for (int a = 0; a < 3; a++)
            if (!(std::abs(data.points[v][a]) <= kLargestCoordinate))
                throw InputError(named("vertex", v) + ": expected coordinates up to 1e75, found " +
                                 std::to_string(data.points[v][a]));
    for (Index h = 0; h < static_cast<Index>(t.size()); h++) {
        if (t[h] < 0 || t[h] >= vertices)
            throw InputError(named("facet", h / 3) + ": expected vertices 0.." + std::to_string(vertices - 1) + ", found " +
                             std::to_string(t[h]));
        if (t[h] == t[next(h)])
            throw InputError(named("facet", h / 3) + ": expected three vertices, found " + named("vertex", t[h]) + " twice");
    }
    for (std::size_t e = 0; e < data.edges.size(); e++)
        if (data.edges[e] < 0 || data.edges[e] >= vertices)
            throw InputError(named("feature edge", static_cast<Index>(e / 2)) + ": expected vertices 0.." +
                             std::to_string(vertices - 1) + ", found " + std::to_string(data.edges[e]));
}

// One end of an edge, filed under its smaller vertex: a half-edge of a facet, or (from 3F on) a feature edge of the file.
struct EdgeUse {
    Index larger;   // the larger vertex of the edge
    Index id;       // half-edge, or 3F + index of the feature edge
};

struct EdgeTable {
    std::vector<Index> first;    // vertex -> its first use in `uses`; one more at the end
    std::vector<EdgeUse> uses;   // under each vertex sorted by (larger, id): equal edges side by side
};

// A counting sort by the smaller vertex, then small sorts: linear for any mesh with bounded vertex degrees.
EdgeTable sort_edges(const MeshData& data) {
    const Index n = static_cast<Index>(data.triangles.size()), m = static_cast<Index>(data.edges.size() / 2);
    const auto for_each_edge = [&](const auto& visit) {
        for (Index h = 0; h < n; h += 3) {
            const Index a = data.triangles[h], b = data.triangles[h + 1], c = data.triangles[h + 2];
            visit(h, a, b);
            visit(h + 1, b, c);
            visit(h + 2, c, a);
        }
        for (Index e = 0; e < m; e++) visit(n + e, data.edges[2 * e], data.edges[2 * e + 1]);
    };
    EdgeTable table;
    table.first.assign(data.points.size() + 1, 0);
    table.uses.resize(static_cast<std::size_t>(n) + m);
    for_each_edge([&](Index, Index a, Index b) { table.first[std::min(a, b) + 1]++; });
    for (std::size_t v = 0; v + 1 < table.first.size(); v++) table.first[v + 1] += table.first[v];
    std::vector<Index> place(table.first.begin(), table.first.end() - 1);
    for_each_edge([&](Index id, Index a, Index b) { table.uses[place[std::min(a, b)]++] = {std::max(a, b), id}; });
    // By (larger, id): the ids under a vertex come in order, so that only `larger` is compared.
    for (std::size_t v = 0; v + 1 < table.first.size(); v++) {
        EdgeUse *const begin = table.uses.data() + table.first[v], *const end = table.uses.data() + table.first[v + 1];
        const auto less = [](const EdgeUse& x, const EdgeUse& y) { return x.larger < y.larger; };
        if (end - begin > 32) {
            std::stable_sort(begin, end, less);
            continue;
        }
        for (EdgeUse* i = begin; i < end; i++) {
            const EdgeUse moved = *i;
            EdgeUse* j = i;
            for (; j > begin && less(moved, j[-1]); j--) *j = j[-1];
            *j = moved;
        }
    }
    return table;
}

[[noreturn]] void refuse_edge(const MeshData& data, const EdgeUse* uses, Index count) {
    const Index a = data.triangles[uses[0].id], b = data.triangles[next(uses[0].id)];
    for (Index i = 0; i < count; i++)
        for (Index j = i + 1; j < count; j++)
            if (data.triangles[prev(uses[i].id)] == data.triangles[prev(uses[j].id)])
                throw InputError(named("facet", facet(uses[j].id)) + ": expected each facet once, found the vertices of " +
                                 named("facet", facet(uses[i].id)) + " again");
    // Exports that repeat vertices facet by facet look open everywhere: then a vertex here has a twin.
    std::string twin;
    const Index vertices = static_cast<Index>(data.points.size());
    for (Index v = 0; count == 1 && v < vertices && twin.empty(); v++)
        for (const Index end : {a, b})
            if (v != end && data.points[v] == data.points[end])
                twin = "; " + named("vertex", v) + " is at the same place as " + named("vertex", end) + ": --weld makes them one";
    std::string facets;
    for (Index i = 0; i < count && i < 4; i++) facets += (i ? ", " : "") + std::to_string(facet(uses[i].id));
    throw InputError("edge " + std::to_string(a) + "-" + std::to_string(b) + ": expected two facets (a closed surface), found " +
                     std::to_string(count) + (count == 1 ? " (facet " : " (facets ") + facets + (count > 4 ? ", …)" : ")") +
                     twin);
}

// Pairs the half-edges and marks those that the file calls feature edges.
void connect(const MeshData& data, TriMesh& mesh) {
    const Index n = static_cast<Index>(data.triangles.size());
    const EdgeTable table = sort_edges(data);
    mesh.opposite.assign(n, kNone);
    mesh.feature.assign(n, 0);
    mesh.features_given = static_cast<Index>(data.edges.size() / 2);
    for (std::size_t v = 0; v + 1 < table.first.size(); v++) {
        Index end;
        for (Index i = table.first[v]; i < table.first[v + 1]; i = end) {
            for (end = i; end < table.first[v + 1] && table.uses[end].larger == table.uses[i].larger;) end++;
            const EdgeUse* uses = &table.uses[i];
            Index halfedges = 0;
            while (halfedges < end - i && uses[halfedges].id < n) halfedges++;
            if (halfedges == 0) {
                mesh.features_off += end - i;
                continue;
            }
            const Index h = uses[0].id, o = uses[1 < halfedges ? 1 : 0].id;
            // Two facets on the same three vertices are a closed (flat) component if they face opposite ways.
            const bool twice =
                halfedges == 2 && data.triangles[prev(h)] == data.triangles[prev(o)] && data.triangles[h] == data.triangles[o];
            if (halfedges != 2 || twice) refuse_edge(data, uses, halfedges);
            mesh.opposite[h] = o;
            mesh.opposite[o] = h;
            mesh.feature[h] = mesh.feature[o] = end - i > 2;
        }
    }
}

// Turned facets exchange their vertices 1 and 2, hence their half-edges 0 and 2.
void turn_facets(TriMesh& mesh, const std::vector<char>& turn) {
    if (std::count(turn.begin(), turn.end(), 0) == static_cast<std::ptrdiff_t>(turn.size())) return;
    const auto moved = [&](Index h) { return turn[facet(h)] ? 3 * facet(h) + 2 - h % 3 : h; };
    for (Index& o : mesh.opposite) o = moved(o);
    for (Index f = 0; f < static_cast<Index>(turn.size()); f++) {
        if (!turn[f]) continue;
        mesh.turned_facets++;
        std::swap(mesh.origin[3 * f + 1], mesh.origin[3 * f + 2]);
        std::swap(mesh.opposite[3 * f], mesh.opposite[3 * f + 2]);
        std::swap(mesh.feature[3 * f], mesh.feature[3 * f + 2]);
    }
}

void measure(TriMesh& mesh) {
    const Index n = static_cast<Index>(mesh.origin.size() / 3);
    mesh.normal.resize(n);
    double sum = 0;
    for (Index f = 0; f < n; f++) {
        mesh.normal[f] = unit(mesh.area_vector(f));
        if (mesh.normal[f] == Vec3{}) mesh.flat_facets++;
        const Vec3 &p = mesh.points[mesh.origin[3 * f]], &q = mesh.points[mesh.origin[3 * f + 1]],
                   &r = mesh.points[mesh.origin[3 * f + 2]];
        sum += norm(q - p);
        sum += norm(r - q);
        sum += norm(p - r);
    }
    mesh.mean_edge = sum / mesh.halfedges();
}

void find_fans(TriMesh& mesh) {
    mesh.outgoing.assign(mesh.points.size(), kNone);
    std::vector<char> met(mesh.origin.size(), 0);
    for (Index first = 0; first < mesh.halfedges(); first++) {
        if (met[first]) continue;
        Index& outgoing = mesh.outgoing[mesh.from(first)];
        if (outgoing == kNone)
            outgoing = first;
        else
            mesh.fans.push_back(first);
        Index h = first;
        do {
            met[h] = 1;
            h = mesh.ccw(h);
        } while (h != first);
    }
    std::stable_sort(mesh.fans.begin(), mesh.fans.end(), [&](Index a, Index b) { return mesh.from(a) < mesh.from(b); });
    mesh.isolated_vertices = static_cast<Index>(std::count(mesh.outgoing.begin(), mesh.outgoing.end(), kNone));
}

// Keeps the sharp ones among the named edges, or finds all sharp edges. A facet without area has no angle to anything.
void keep_sharp_features(TriMesh& mesh, const FeatureOptions& options) {
    if (options.detect) mesh.features_given = mesh.features_off = 0;   // the file's list is not asked
    for (Index h = 0; h < mesh.halfedges(); h++) {
        const Index o = mesh.opposite[h];
        if (h > o || !(options.detect || mesh.feature[h])) continue;
        const Vec3 &a = mesh.normal[facet(h)], &b = mesh.normal[facet(o)];
        const bool flat = a == Vec3{} || b == Vec3{};
        if (!flat) audit("feature angle", std::abs(dot(a, b) - options.cosine));
        const bool sharp = !flat && dot(a, b) <= options.cosine;   // tie: an angle of exactly the threshold is sharp
        mesh.feature[h] = mesh.feature[o] = sharp;
        mesh.features_kept += sharp;
    }
}

}   // namespace

TriMesh build_mesh(MeshData data, const FeatureOptions& features) {
    check_elements(data);
    TriMesh mesh;
    connect(data, mesh);
    mesh.points = std::move(data.points);
    mesh.origin = std::move(data.triangles);
    const Orientation orientation = orient(mesh.points, mesh.origin, mesh.opposite);
    mesh.components = orientation.components;
    mesh.cavities = orientation.cavities;
    mesh.turned_components = orientation.turned_components;
    turn_facets(mesh, orientation.turn);
    measure(mesh);
    find_fans(mesh);
    keep_sharp_features(mesh, features);
    return mesh;
}

std::vector<std::string> notes(const TriMesh& mesh) {
    std::vector<std::string> lines;
    const auto say = [&](Index count, const std::string& singular, const std::string& plural, const std::string& rest) {
        if (count > 0) lines.push_back(std::to_string(count) + " " + (count == 1 ? singular : plural) + rest);
    };
    say(mesh.turned_facets, "facet was", "facets were",
        " turned to face outward (" + std::to_string(mesh.turned_components) + " of " + std::to_string(mesh.components) +
            " components as a whole); labels refer to the turned facets");
    say(mesh.isolated_vertices, "vertex has", "vertices have", " no facet and will be left alone");
    say(mesh.flat_facets, "facet has", "facets have", " no area");
    say(mesh.features_off, "feature edge is", "feature edges are", " not on the surface and will be ignored");
    return lines;
}

void validate(const TriMesh& mesh) {
    const auto require = [](bool holds, const char* what, Index i) {
        if (!holds) throw std::logic_error(std::string("TriMesh: ") + what + " at " + std::to_string(i));
    };
    const Index n = mesh.halfedges();
    require(n == 3 * mesh.facets() && mesh.opposite.size() == mesh.origin.size() && mesh.feature.size() == mesh.origin.size(),
            "array sizes", n);
    Index kept = 0;
    for (Index h = 0; h < n; h++) {
        const Index o = mesh.opposite[h];
        require(o >= 0 && o < n && o != h, "opposite out of range", h);
        require(mesh.opposite[o] == h, "opposite of the opposite", h);
        require(facet(o) != facet(h), "facet beside itself", h);
        require(mesh.from(h) == mesh.to(o) && mesh.to(h) == mesh.from(o), "edge ends", h);
        require(mesh.feature[h] == mesh.feature[o], "feature edge with two opinions", h);
        require(mesh.from(h) != mesh.to(h), "edge without length", h);
        kept += mesh.feature[h];
    }
    require(kept == 2 * mesh.features_kept, "count of feature edges", kept);
    std::vector<char> met(n, 0);
    for (Index v = 0; v < mesh.vertices(); v++)
        mesh.for_each_leaving(v, [&](Index h) {
            require(mesh.from(h) == v && !met[h], "fan", h);
            met[h] = 1;
        });
    require(std::count(met.begin(), met.end(), 1) == n, "fans", n);
}

}   // namespace polylab

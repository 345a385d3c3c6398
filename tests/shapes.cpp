#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace polylab::shapes {

namespace {

// Facets between points of the integer grid; each point becomes one vertex.
class GridSurface {
public:
    // The side of a unit cell in direction l, as two facets.
    void add_side(const Cell& cell, Label l) {
        const int a = axis(l), b = (a + 1) % 3, c = (a + 2) % 3;
        Cell p = cell;
        p[a] += l % 2 == 0;
        Cell q = p, r = p, s = p;   // p q r s run counter-clockwise around +a
        q[b]++, r[b]++, r[c]++, s[c]++;
        if (l % 2 == 1) std::swap(q, s);
        add_triangle(p, q, r);
        add_triangle(p, r, s);
    }

    MeshData data;

private:
    void add_triangle(const Cell& p, const Cell& q, const Cell& r) {
        for (const Cell& c : {p, q, r}) data.triangles.push_back(vertex(c));
    }

    Index vertex(const Cell& p) {
        const auto [entry, is_new] = vertices_.emplace(p, static_cast<Index>(vertices_.size()));
        if (is_new) data.points.push_back({double(p[0]), double(p[1]), double(p[2])});
        return entry->second;
    }

    std::map<Cell, Index> vertices_;
};

std::pair<Index, Index> sorted_edge(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

Mapped mapped(const MeshData& data, const std::array<Label, 3>& image_of_axis, bool mirror) {
    Mapped m{data, {}};
    for (int a = 0; a < 3; a++) {
        m.image[2 * a] = image_of_axis[a];
        m.image[2 * a + 1] = opposite(image_of_axis[a]);
    }
    for (Vec3& p : m.data.points) {
        Vec3 q;
        for (int a = 0; a < 3; a++) q += direction(image_of_axis[a]) * p[a];   // from +0, so that no -0 appears
        p = q;
    }
    if (mirror) m.data = turned(std::move(m.data));
    return m;
}

}   // namespace

std::vector<Index> Lcg::permutation(Index n) {
    std::vector<Index> p(n);
    std::iota(p.begin(), p.end(), 0);
    for (Index i = n - 1; i > 0; i--) std::swap(p[i], p[below(i + 1)]);
    return p;
}

MeshData tetrahedron() {
    MeshData data;
    data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    data.triangles = {1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1};
    return data;
}

MeshData octahedron() {
    MeshData data;
    data.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    data.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    return data;
}

MeshData box(int nx, int ny, int nz) {
    const Cell size = {nx, ny, nz};
    GridSurface surface;
    for (Label l = 0; l < kLabels; l++) {
        const int a = axis(l), b = (a + 1) % 3, c = (a + 2) % 3;
        Cell cell{};
        cell[a] = l % 2 == 0 ? size[a] - 1 : 0;
        for (cell[c] = 0; cell[c] < size[c]; cell[c]++)
            for (cell[b] = 0; cell[b] < size[b]; cell[b]++) surface.add_side(cell, l);
    }
    return surface.data;
}

MeshData cube(int n) { return box(n, n, n); }

MeshData voxels(const std::vector<Cell>& cells) {
    std::vector<Cell> sorted = cells;
    std::sort(sorted.begin(), sorted.end());
    GridSurface surface;
    for (const Cell& cell : cells)
        for (Label l = 0; l < kLabels; l++) {
            Cell neighbour = cell;
            neighbour[axis(l)] += l % 2 == 0 ? 1 : -1;
            if (!std::binary_search(sorted.begin(), sorted.end(), neighbour)) surface.add_side(cell, l);
        }
    return surface.data;
}

MeshData l_shape() { return voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}); }

MeshData stair(int steps) {
    std::vector<Cell> cells;
    for (int x = 0; x < steps; x++)
        for (int z = 0; z <= x; z++) cells.push_back({x, 0, z});
    return voxels(cells);
}

MeshData frame() { return voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}}); }

MeshData hollow_box() {
    std::vector<Cell> cells;
    for (int i = 0; i < 27; i++)
        if (i != 13) cells.push_back({i % 3, i / 3 % 3, i / 9});
    return voxels(cells);
}

MeshData two_cubes_at_a_vertex() { return voxels({{0, 0, 0}, {1, 1, 1}}); }

MeshData pinched_ring() {
    return voxels({{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 0, 1}, {3, 0, 2}, {3, 1, 2}, {2, 1, 2}, {1, 1, 2}});
}

MeshData prism(const std::vector<Vec3>& polygon, int height) {
    const Index n = static_cast<Index>(polygon.size());
    MeshData data;
    data.points = polygon;
    for (const Vec3& p : polygon) data.points.push_back(p + Vec3{0, 0, double(height)});
    const auto add = [&](Index a, Index b, Index c) { data.triangles.insert(data.triangles.end(), {a, b, c}); };
    for (Index i = 0; i < n; i++) {
        const Index j = (i + 1) % n;
        add(i, j, n + j);
        add(i, n + j, n + i);
    }
    for (Index i = 1; i + 1 < n; i++) add(0, i + 1, i);
    for (Index i = 1; i + 1 < n; i++) add(n, n + i, n + i + 1);
    return data;
}

MeshData triangular_prism(int a, int b, int height) { return prism({{0, 0, 0}, {double(a), 0, 0}, {0, double(b), 0}}, height); }

MeshData pyramid(int n) {
    MeshData data;
    for (int i = 0; i < n; i++) {   // rounding is safe: 1000 cos is never near a half for small n
        const double angle = 2 * std::acos(-1.0) * i / n;
        data.points.push_back({std::round(1000 * std::cos(angle)), std::round(1000 * std::sin(angle)), 0});
    }
    data.points.push_back({0, 0, 1000});
    for (Index i = 0; i < n; i++) data.triangles.insert(data.triangles.end(), {i, (i + 1) % n, n});
    for (Index i = 1; i + 1 < n; i++) data.triangles.insert(data.triangles.end(), {0, i + 1, i});
    return data;
}

MeshData pillow() {
    MeshData data;
    data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    data.triangles = {0, 1, 2, 0, 2, 1};
    return data;
}

MeshData tetrahedron_with_flat_facet() {
    MeshData data;
    data.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
    data.triangles = {1, 2, 3, 0, 3, 2, 0, 4, 3, 0, 2, 1, 0, 1, 4, 4, 1, 3};
    return data;
}

MeshData mobius_strip(int n) {
    MeshData data;
    for (int i = 0; i < n; i++)
        for (int side = 0; side < 2; side++) data.points.push_back({double(i), double(side), double(i * i)});
    for (Index i = 0; i < n; i++) {   // rungs 2i, 2i+1; the last one meets the first one upside down
        const bool last = i + 1 == n;
        const Index a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : b + 2;
        data.triangles.insert(data.triangles.end(), {a, c, d, a, d, b});
    }
    return data;
}

// The icosahedron with opposite points identified: vertex 0, its neighbours 1..5 in a ring, and nothing else.
MeshData projective_plane() {
    MeshData data;
    data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 3, 5}, {5, 2, 3}};
    for (Index i = 0; i < 5; i++) {
        data.triangles.insert(data.triangles.end(), {0, 1 + i, 1 + (i + 1) % 5});
        data.triangles.insert(data.triangles.end(), {1 + i, 1 + (i + 1) % 5, 1 + (i + 3) % 5});
    }
    return data;
}

void append(MeshData& data, const MeshData& other) {
    const Index shift = static_cast<Index>(data.points.size());
    data.points.insert(data.points.end(), other.points.begin(), other.points.end());
    const auto append_shifted = [shift](std::vector<Index>& to, const std::vector<Index>& from) {
        for (const Index v : from) to.push_back(v + shift);
    };
    append_shifted(data.edges, other.edges);
    append_shifted(data.triangles, other.triangles);
    append_shifted(data.tets, other.tets);
    append_shifted(data.hexes, other.hexes);
}

MeshData joined(MeshData a, const MeshData& b) {
    append(a, b);
    return a;
}

MeshData moved(MeshData data, const Vec3& by) {
    for (Vec3& p : data.points) p += by;
    return data;
}

MeshData scaled(MeshData data, double by) {
    for (Vec3& p : data.points) p = p * by;
    return data;
}

MeshData turned(MeshData data) { return turned(data, std::vector<char>(data.triangles.size() / 3, 1)); }

MeshData turned(MeshData data, const std::vector<char>& turn) {
    for (std::size_t f = 0; f < turn.size(); f++)
        if (turn[f]) std::swap(data.triangles[3 * f + 1], data.triangles[3 * f + 2]);
    return data;
}

MeshData refined(const MeshData& data) {
    MeshData fine;
    for (const Vec3& p : data.points) fine.points.push_back(p * 2);
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
        const auto [entry, is_new] = middles.emplace(sorted_edge(a, b), static_cast<Index>(fine.points.size()));
        if (is_new) fine.points.push_back(data.points[a] + data.points[b]);
        return entry->second;
    };
    for (std::size_t h = 0; h < data.triangles.size(); h += 3) {
        const Index a = data.triangles[h], b = data.triangles[h + 1], c = data.triangles[h + 2];
        const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    for (std::size_t e = 0; e < data.edges.size(); e += 2) {
        const Index a = data.edges[e], b = data.edges[e + 1], ab = middle(a, b);
        fine.edges.insert(fine.edges.end(), {a, ab, ab, b});
    }
    return fine;
}

std::vector<Index> creases(const MeshData& data) {
    struct Side {
        Vec3 normal;    // of the first facet met
        bool forward;   // whether it runs from the smaller vertex to the larger one
        bool told;
    };
    std::map<std::pair<Index, Index>, Side> sides;
    std::vector<Index> edges;
    for (Index h = 0; h < static_cast<Index>(data.triangles.size()); h++) {
        const Index a = data.triangles[h], b = data.triangles[next(h)];
        const Vec3 &p = data.points[a], &q = data.points[b], &r = data.points[data.triangles[prev(h)]];
        const Vec3 normal = cross(q - p, r - p);
        const auto [entry, is_new] = sides.emplace(sorted_edge(a, b), Side{normal, a < b, false});
        if (is_new) continue;
        Side& side = entry->second;
        const Vec3 other = side.forward == (a < b) ? -normal : normal;   // the same direction: one of them is turned
        if (side.told || (cross(side.normal, other) == Vec3{} && dot(side.normal, other) >= 0)) continue;
        side.told = true;
        edges.insert(edges.end(), {std::min(a, b), std::max(a, b)});
    }
    return edges;
}

MeshData creased(MeshData data) {
    data.edges = creases(data);
    return data;
}

Labeling Renumbered::labels(const Labeling& old) const {
    Labeling result(old.size());
    for (std::size_t f = 0; f < old.size(); f++) result[facet[f]] = old[f];
    return result;
}

Renumbered renumbered(const MeshData& data, Lcg& random) {
    const Index facets = static_cast<Index>(data.triangles.size() / 3), edges = static_cast<Index>(data.edges.size() / 2);
    Renumbered r;
    r.vertex = random.permutation(static_cast<Index>(data.points.size()));
    r.facet = random.permutation(facets);
    r.data = data;
    for (std::size_t v = 0; v < data.points.size(); v++) r.data.points[r.vertex[v]] = data.points[v];
    for (Index f = 0; f < facets; f++) {
        const Index rotation = random.below(3);
        for (Index k = 0; k < 3; k++) r.data.triangles[3 * r.facet[f] + (k + rotation) % 3] = r.vertex[data.triangles[3 * f + k]];
    }
    const std::vector<Index> place = random.permutation(edges);
    for (Index e = 0; e < edges; e++) {
        const Index rotation = random.below(2);
        for (Index k = 0; k < 2; k++) r.data.edges[2 * place[e] + (k + rotation) % 2] = r.vertex[data.edges[2 * e + k]];
    }
    for (Index& v : r.data.tets) v = r.vertex[v];
    for (Index& v : r.data.hexes) v = r.vertex[v];
    return r;
}

Labeling Mapped::labels(Labeling old) const {
    for (Label& l : old) l = image[l];
    return old;
}

Mapped rotated_axes(const MeshData& data, int i) {
    const Label x = static_cast<Label>(i / 4);   // +X goes to any of six directions, +Y to one of the four orthogonal ones
    const Label y = static_cast<Label>((2 * axis(x) + 2 + i % 4) % 6);
    const Vec3 z = cross(direction(x), direction(y));   // a rotation keeps X cross Y = Z
    Label l = 0;
    while (!(dot(direction(l), z) > 0)) l++;
    return mapped(data, {x, y, l}, false);
}

Mapped mirrored(const MeshData& data, int axis) {
    std::array<Label, 3> image = {0, 2, 4};
    image[axis] = opposite(image[axis]);
    return mapped(data, image, true);
}

}   // namespace polylab::shapes

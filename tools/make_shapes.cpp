// make_shapes.cpp: the shapes of golden/cases/ that no CAD kernel is needed for.
//
//   make_shapes NAME > in.obj        writes a shape; without NAME, lists them
//   make_shapes convert IN OUT       rewrites a mesh file, with its feature edges
//
// Only + - * / and sqrt are used, which round the same way everywhere, so the same bytes come out on every machine.
#include "polylab/costs.h"
#include "polylab/io.h"
#include "polylab/text.h"

#include "../tests/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace polylab;
using namespace polylab::shapes;

constexpr double kTurn = 6.283185307179586;

// ---- from shape to shape

template <class Map>
MeshData mapped(MeshData data, Map map) {
    for (Vec3& p : data.points) p = map(p);
    return data;
}

MeshData refined(MeshData data, int times) {
    for (; times > 0; times--) data = shapes::refined(data);
    return data;
}

// Unit cells with the creases as feature edges, each side cut in 4^times times two facets; coordinates times 2^times.
MeshData blocks(const std::vector<Cell>& cells, int times) { return refined(creased(voxels(cells)), times); }

// All facets turned outward; feature edges where the normals differ by 0.5 rad or more.
MeshData sharp(MeshData data) {
    FeatureOptions features;
    features.detect = true;
    return mesh_data(build_mesh(std::move(data), features));
}

MeshData without_features(MeshData data) {
    data.edges.clear();
    return data;
}

MeshData all_edges_named(MeshData data) {
    std::set<std::pair<Index, Index>> edges;
    for (Index h = 0; h < static_cast<Index>(data.triangles.size()); h++) {
        const Index a = data.triangles[h], b = data.triangles[next(h)];
        edges.insert({std::min(a, b), std::max(a, b)});
    }
    data.edges.clear();
    for (const auto& [a, b] : edges) data.edges.insert(data.edges.end(), {a, b});
    return data;
}

// Turned around the Z axis by the angle whose tangent is y / x, and scaled by the length of (x, y).
MeshData turned_around_z(MeshData data, double x, double y) {
    return mapped(std::move(data), [&](const Vec3& p) { return Vec3{x * p.x - y * p.y, y * p.x + x * p.y, p.z}; });
}

// x y z -> y z x
MeshData cycled(MeshData data) {
    return mapped(std::move(data), [](const Vec3& p) { return Vec3{p.y, p.z, p.x}; });
}

// Cells of a box at the origin for which `keep` holds.
template <class Keep>
std::vector<Cell> cells_of(const Cell& size, Keep keep) {
    std::vector<Cell> cells;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++)
                if (keep(x, y, z)) cells.push_back({x, y, z});
    return cells;
}

// ---- shapes with flat faces

// Flat faces given by their vertices, in any direction of turning; each is seen whole from its first vertex.
MeshData polyhedron(std::vector<Vec3> points, const std::vector<std::vector<Index>>& faces) {
    MeshData data;
    data.points = std::move(points);
    for (const std::vector<Index>& face : faces)
        for (std::size_t i = 2; i < face.size(); i++)
            data.triangles.insert(data.triangles.end(), {face[0], face[i - 1], face[i]});
    return creased(mesh_data(build_mesh(std::move(data))));
}

// Polygon in the plane z = 0, all of it seen from `apex`, which stands above.
MeshData spire(const std::vector<Vec3>& polygon, const Vec3& apex) {
    const Index n = static_cast<Index>(polygon.size());
    MeshData data;
    data.points = polygon;
    data.points.push_back(apex);
    data.points.push_back({apex.x, apex.y, 0});
    for (Index i = 0; i < n; i++) data.triangles.insert(data.triangles.end(), {i, (i + 1) % n, n, (i + 1) % n, i, n + 1});
    return creased(mesh_data(build_mesh(std::move(data))));
}

MeshData rhombic_dodecahedron() {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; i++) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    for (Label l = 0; l < kLabels; l++) points.push_back(direction(l) * 2);
    std::vector<std::vector<Index>> faces;
    for (Index i = 0; i < 8; i++)
        for (int a = 0; a < 3; a++) {
            const Index j = i | 1 << a;
            if (i == j) continue;
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            faces.push_back({i, 8 + 2 * b + !(i >> b & 1), j, 8 + 2 * c + !(i >> c & 1)});
        }
    return polyhedron(std::move(points), faces);
}

// A dodecahedron whose pentagons have a longest side, so that all vertices are exact.
MeshData pyritohedron() {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; i++) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    const auto roof = [](int a, int i) {
        return static_cast<Index>(8 + 4 * a + i);
    };   // on +-a, above or below the next axis but one
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 4; i++) {
            Vec3 p;
            p[a] = i & 1 ? 1.5 : -1.5;
            p[(a + 2) % 3] = i & 2 ? 0.75 : -0.75;
            points.push_back(p);
        }
    std::vector<std::vector<Index>> faces;
    for (int a = 0; a < 3; a++)   // the face over (a, +-) and (b, +-)
        for (int i = 0; i < 4; i++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3, sa = i & 1, sb = i >> 1;
            const Index up = static_cast<Index>(sa << a | sb << b | 1 << c), down = static_cast<Index>(sa << a | sb << b);
            faces.push_back({roof(a, sa), roof(a, sa | 2), up, roof(b, sb | sa << 1), down});
        }
    return polyhedron(std::move(points), faces);
}

// A square bar along a path whose corners lie in planes of constant z, mitred there; both ends are vertical.
MeshData bar(const std::vector<Vec3>& path, double half_width, double half_height) {
    MeshData data;
    const std::size_t n = path.size();
    const auto side = [&](std::size_t i) {   // horizontal, to the right of the segment behind point i
        const Vec3 d = path[i + 1] - path[i];
        const double length = std::sqrt(d.x * d.x + d.y * d.y);
        return Vec3{d.y / length, -d.x / length, 0} * half_width;
    };
    for (std::size_t i = 0; i < n; i++) {
        Vec3 out = i + 1 < n ? side(i) : side(i - 1);
        if (i > 0 && i + 1 < n) {   // the mitre of two segments at an angle
            const Vec3 sum = side(i - 1) + side(i);
            out = sum * (2 * half_width * half_width / dot(sum, sum));
        }
        const Vec3 up{0, 0, half_height};
        for (const Vec3& p : {path[i] - out - up, path[i] + out - up, path[i] + out + up, path[i] - out + up})
            data.points.push_back(p);
    }
    const auto add = [&](Index a, Index b, Index c, Index d) { data.triangles.insert(data.triangles.end(), {a, b, c, a, c, d}); };
    for (Index i = 0; i + 1 < static_cast<Index>(n); i++)
        for (Index k = 0; k < 4; k++) add(4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k);
    const Index last = static_cast<Index>(4 * n - 4);
    add(0, 3, 2, 1);
    add(last, last + 1, last + 2, last + 3);
    return creased(mesh_data(build_mesh(std::move(data))));
}

// ---- curved shapes, bent from boxes

// A box of n^3 cells bent into the unit sphere, whose radius is then changed: p -> p * radius(p).
template <class Radius>
MeshData ball(int n, Radius radius) {
    return mapped(cube(n), [&](const Vec3& q) {
        const Vec3 p = q * 2 - Vec3{double(n), double(n), double(n)};
        const Vec3 u = unit(p);
        return u * radius(u);
    });
}

// Rings of `sides` points, point(i, k) being the k-th of ring i, joined one to the next; `closed`: the last one to the first,
// otherwise both ends get a flat cover.
template <class Point>
MeshData tube(int rings, int sides, bool closed, Point point) {
    MeshData data;
    for (int i = 0; i < rings; i++)
        for (int k = 0; k < sides; k++) data.points.push_back(point(i, k));
    const auto add = [&](Index a, Index b, Index c) { data.triangles.insert(data.triangles.end(), {a, b, c}); };
    for (Index i = 0; i < (closed ? rings : rings - 1); i++)
        for (Index k = 0; k < sides; k++) {
            const Index a = i * sides + k, b = i * sides + (k + 1) % sides, up = (i + 1) % rings * sides - i * sides;
            add(a, b, b + up);
            add(a, b + up, a + up);
        }
    if (closed) return mesh_data(build_mesh(std::move(data)));
    for (const Index first : {0, (rings - 1) * sides}) {
        Vec3 sum;
        for (Index k = 0; k < sides; k++) sum += data.points[first + k];
        data.points.push_back(sum * (1.0 / sides));
        const Index middle = static_cast<Index>(data.points.size()) - 1;
        for (Index k = 0; k < sides; k++) {
            const Index a = first + k, b = first + (k + 1) % sides;
            first == 0 ? add(middle, b, a) : add(middle, a, b);
        }
    }
    return sharp(std::move(data));
}

// Point k of n on the border of the square |x|, |z| <= 1, or on the unit circle.
Vec3 on_square(int k, int n) {
    const double t = -1 + 8.0 * (k % (n / 4)) / n;
    const int side = 4 * k / n;
    return side == 0 ? Vec3{t, 0, -1} : side == 1 ? Vec3{1, 0, t} : side == 2 ? Vec3{-t, 0, 1} : Vec3{-1, 0, -t};
}
Vec3 on_circle(int k, int n) {
    const SinCos s = sin_cos(kTurn * k / n);
    return {s.cos, 0, s.sin};
}

// A tube of the section given (x outward, z up) around a helix; `slices` of it in each turn.
MeshData helix(int slices, double turns, Vec3 (*section)(int, int), int sides, double radius, double pitch, double thickness) {
    return tube(static_cast<int>(slices * turns) + 1, sides, false, [=](int i, int k) {
        const Vec3 at = on_circle(i % slices, slices), p = section(k, sides) * thickness;
        return Vec3{(radius + p.x) * at.x, (radius + p.x) * at.z, pitch * i / slices + p.z};
    });
}

MeshData torus(int n, int m, double radius, double thickness) {
    return tube(n, m, true, [=](int i, int k) {
        const Vec3 at = on_circle(i, n), p = on_circle(k, m) * thickness;
        return Vec3{(radius + p.x) * at.x, (radius + p.x) * at.z, p.z};
    });
}

// A post along Z whose radius is changed: radius(angle as a point of the unit circle, height from 0 to 1).
template <class Radius>
MeshData post(int rings, int sides, double height, Radius radius) {
    return tube(rings, sides, false, [&](int i, int k) {
        const Vec3 at = on_circle(k, sides);
        const double z = double(i) / (rings - 1), r = radius(at, z);
        return Vec3{r * at.x, r * at.z, height * z};
    });
}

// Twisted around the Z axis through (x, y): `turns` from bottom to top.
MeshData twisted(MeshData data, double x, double y, double height, double turns) {
    return sharp(mapped(std::move(data), [&](const Vec3& p) {
        const SinCos t = sin_cos(kTurn * turns * p.z / height);
        return Vec3{t.cos * (p.x - x) - t.sin * (p.y - y), t.sin * (p.x - x) + t.cos * (p.y - y), p.z};
    }));
}

// ---- the list

MeshData cross_bar(int arm, int height) {
    return creased(voxels(cells_of({2 * arm + 2, 2 * arm + 2, height}, [&](int x, int y, int) {
        const bool in_x = x >= arm && x < arm + 2, in_y = y >= arm && y < arm + 2;
        return in_x || in_y;
    })));
}

// A flat facet a-m-b beside the middle m of an edge a-b, for every 7th edge: one facet of the edge is cut in two at m.
MeshData with_needles(MeshData data) {
    const std::size_t halfedges = data.triangles.size();
    std::set<Index> used;   // facets that are changed, each once
    const TriMesh mesh = build_mesh(data);
    for (Index h = 0; h < static_cast<Index>(halfedges); h += 7) {
        const Index f = facet(h), a = mesh.from(h), b = mesh.to(h), c = mesh.to(next(h));
        if (mesh.feature[h] || !used.insert(f).second) continue;
        const Index m = static_cast<Index>(data.points.size());
        data.points.push_back((data.points[a] + data.points[b]) * 0.5);
        for (int k = 0; k < 3; k++) data.triangles[3 * f + k] = std::array<Index, 3>{a, m, c}[k];
        data.triangles.insert(data.triangles.end(), {m, b, c, a, b, m});
    }
    return data;
}

// ---- at random, but the same each time

double within(Lcg& random, double size) { return size * (random.below(2001) - 1000) / 1000.0; }

// A ball with bumps and dents of up to `height` each.
MeshData bumpy_ball(int seed, int n, int bumps, double height) {
    Lcg random(seed);
    std::vector<std::pair<Vec3, double>> hills;   // direction, height
    for (int i = 0; i < bumps; i++) {
        Vec3 v;
        for (int a = 0; a < 3; a++) v[a] = within(random, 1);
        hills.push_back({unit(v), within(random, height)});
    }
    return ball(n, [&](const Vec3& u) {
        double r = 1;
        for (const auto& [v, h] : hills) {
            const double c = dot(u, v), near = c > 0 ? c * c : 0;
            r += h * near * near * near;
        }
        return r;
    });
}

// Radii that vary from vertex to vertex by up to `roughness`.
MeshData rough_ball(int seed, int n, double roughness) {
    Lcg random(seed);
    return ball(n, [&](const Vec3&) { return 1 + within(random, roughness); });
}

MeshData rough_post(int seed, int rings, int sides, double height, double roughness) {
    Lcg random(seed);
    return post(rings, sides, height, [&](const Vec3&, double) { return 1 + within(random, roughness); });
}

// A twisted square bar whose vertices are moved by up to `roughness` along each axis.
MeshData rough_bar(int seed, int n, int length, double turns, double roughness) {
    Lcg random(seed);
    MeshData data = twisted(box(n, n, length), n / 2.0, n / 2.0, length, turns);
    for (Vec3& p : data.points)
        for (int a = 0; a < 3; a++) p[a] += within(random, roughness);
    return sharp(std::move(data));
}

struct Shape {
    const char* name;
    MeshData (*make)();
};

MeshData doorstop() { return refined(creased(triangular_prism(8, 2, 3)), 3); }
MeshData unit_ball() {
    return ball(8, [](const Vec3&) { return 1.0; });
}

const Shape kShapes[] = {
    // whole parts of flat faces
    {"cube_12", [] { return creased(cube(1)); }},
    {"cube_45", [] { return turned_around_z(refined(creased(cube(1)), 3), 1, 1); }},
    {"four_cubes",
     [] {
         return blocks({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 2);
     }},
    {"three_cubes_at_a_block",
     [] {
         return blocks({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 2);
     }},
    {"cheese",
     [] {
         return blocks(cells_of({3, 3, 3}, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) < 2; }), 1);
     }},
    {"notched_corner",
     [] {
         return blocks({{1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}, 2);
     }},
    {"slope_branches",
     [] {
         return refined(bar({{0, 0, 0}, {8, 0, 2}, {8, 8, 4}, {0, 8, 6}, {0, 0, 8}, {8, 0, 10}}, 1, 1), 2);
     }},
    {"tetrahedron", [] { return refined(creased(tetrahedron()), 4); }},
    {"octahedron", [] { return refined(creased(octahedron()), 3); }},
    {"octahedron_turned",
     [] { return cycled(turned_around_z(cycled(turned_around_z(refined(creased(octahedron()), 3), 15, 8)), 15, 8)); }},
    {"rhombic_dodecahedron", [] { return refined(rhombic_dodecahedron(), 2); }},
    {"pyritohedron", [] { return refined(pyritohedron(), 2); }},
    {"steep_pyramid",
     [] {
         return refined(spire({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {0, 0, 5}), 3);
     }},
    {"l_spire",
     [] {
         return refined(spire({{-2, -2, 0}, {6, -2, 0}, {6, 2, 0}, {2, 2, 0}, {2, 6, 0}, {-2, 6, 0}}, {0, 0, 9}), 3);
     }},
    {"star_spire",
     [] {
         return refined(
             spire({{6, 0, 0}, {2, 2, 0}, {0, 6, 0}, {-2, 2, 0}, {-6, 0, 0}, {-2, -2, 0}, {0, -6, 0}, {2, -2, 0}}, {0, 0, 8}), 2);
     }},
    {"wedge_45", [] { return refined(creased(triangular_prism(4, 4, 4)), 3); }},
    {"doorstop", doorstop},
    {"doorstop_no_features", [] { return without_features(doorstop()); }},
    {"roof",
     [] {
         return refined(creased(prism({{0, 0, 0}, {8, 0, 0}, {4, 7, 0}}, 12)), 3);
     }},
    {"deep_groove",
     [] {
         return refined(creased(prism({{4, 1, 0}, {2, 8, 0}, {0, 8, 0}, {0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {6, 8, 0}}, 8)), 2);
     }},
    {"part_turned_28",
     [] {
         return turned_around_z(blocks({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 1, 0}}, 2), 15, 8);
     }},

    // curved parts
    {"sphere", unit_ball},
    {"ellipsoid_turned",
     [] {
         return turned_around_z(mapped(unit_ball(), [](const Vec3& p) { return Vec3{3 * p.x, p.y, p.z}; }), 15, 8);
     }},
    {"torus", [] { return torus(32, 12, 4, 1.5); }},
    {"square_helix", [] { return helix(32, 2.25, on_square, 8, 6, 4, 1); }},
    {"spring", [] { return helix(32, 2.5, on_circle, 8, 5, 3, 1); }},
    {"steep_spring", [] { return helix(24, 1.5, on_circle, 8, 4, 24, 1); }},
    {"propeller", [] { return twisted(cross_bar(4, 12), 5, 5, 12, 0.25); }},
    {"propeller_turned", [] { return twisted(cross_bar(4, 12), 5, 5, 12, 0.75); }},
    {"spiral_blade", [] { return twisted(box(8, 2, 18), 4, 1, 18, 1); }},
    {"twisted_bar", [] { return twisted(box(3, 3, 18), 1.5, 1.5, 18, 0.5); }},
    {"corkscrew_post",
     [] {
         return tube(25, 24, false, [](int i, int k) {
             const Vec3 at = on_circle(k, 24) * 4, off = on_circle(2 * i % 24, 24) * 1.5;
             return Vec3{at.x + off.x, at.z + off.z, 0.5 * i};
         });
     }},
    {"necked_post",
     [] {
         return tube(25, 24, false, [](int i, int k) {
             const double r = 4 + 1.5 * on_circle(3 * i % 24, 24).z;
             const Vec3 at = on_circle(k, 24) * r;
             return Vec3{at.x, at.z, 0.5 * i};
         });
     }},
    {"rough_post", [] { return without_features(rough_post(4, 20, 32, 4, 0.05)); }},
    {"rough_ball", [] { return rough_ball(7, 10, 0.08); }},
    {"rough_bar", [] { return rough_bar(1, 4, 16, 0.25, 0.2); }},
    {"rough_bar_strong", [] { return rough_bar(24, 4, 16, 0.3, 0.3); }},
    {"rough_bar_half_turn", [] { return rough_bar(66, 4, 16, 0.5, 0.1); }},
    {"blob", [] { return bumpy_ball(12, 9, 30, 0.6); }},
    {"blob_few_bumps", [] { return bumpy_ball(41, 9, 30, 0.6); }},
    {"blob_many_bumps", [] { return bumpy_ball(52, 8, 60, 0.9); }},
    {"blob_turning_point", [] { return bumpy_ball(72, 8, 60, 0.9); }},
    {"features_everywhere", [] { return all_edges_named(rough_ball(11, 6, 0.3)); }},

    // unusual meshes
    {"two_solids_at_vertex", [] { return refined(creased(two_cubes_at_a_vertex()), 2); }},
    {"pinched_ring", [] { return refined(creased(pinched_ring()), 1); }},
    {"cavity", [] { return refined(creased(hollow_box()), 1); }},
    {"components",
     [] {
         MeshData data = blocks({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2);
         append(data, moved(refined(creased(octahedron()), 2), {20, 0, 0}));
         append(data, moved(refined(creased(triangular_prism(2, 2, 2)), 2), {0, 20, 0}));
         return data;
     }},
    {"inward_component",
     [] {
         const MeshData inward = turned(refined(creased(triangular_prism(2, 3, 2)), 2));
         return joined(blocks({{0, 0, 0}, {1, 0, 0}}, 2), moved(inward, {12, 0, 0}));
     }},
    {"isolated_vertices",
     [] {
         MeshData data;
         data.points = {{100, 0, 0}, {-100, 0, 0}};   // before and behind the used ones
         append(data, blocks({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, 2));
         data.points.push_back({0, 100, 0});
         return data;
     }},
    {"needles",
     [] {
         return with_needles(refined(creased(prism({{0, 0, 0}, {8, 0, 0}, {8, 3, 0}, {0, 5, 0}}, 4)), 2));
     }},
    {"slivers",
     [] {
         const auto squeezed = [](const Vec3& p) { return Vec3{p.x + p.y / 8, p.y * p.y * p.y / 4096, p.z * p.z / 8}; };
         return mapped(blocks({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 3), squeezed);
     }},
    {"shuffled",
     [] {
         Lcg random(3);
         return renumbered(doorstop(), random).data;
     }},
    {"far_and_tiny",
     [] {
         const MeshData part = refined(creased(prism({{0, 0, 0}, {8, 0, 0}, {8, 2, 0}, {2, 6, 0}, {0, 6, 0}}, 4)), 2);
         return moved(scaled(part, 1.0 / (1 << 20)), {1 << 10, -(1 << 10), 1 << 9});
     }},
};

}   // namespace

int main(int argc, char** argv) try {
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "convert" && argc == 4) {
        const MeshData data = read_mesh(argv[2]);
        build_mesh(data);   // throws where polylab would refuse it
        write_mesh(argv[3], data);
        return 0;
    }
    for (const Shape& shape : kShapes) {
        if (argc == 1) std::puts(shape.name);
        if (argc == 2 && command == shape.name) {
            const MeshData data = shape.make();
            build_mesh(data);
            write_file("-", obj_text(data));
            return 0;
        }
    }
    if (argc == 1) return 0;
    std::fprintf(stderr, "make_shapes: no shape %s\n", command.c_str());
    return 2;
} catch (const std::exception& e) {
    std::fprintf(stderr, "make_shapes: %s\n", e.what());
    return 2;
}

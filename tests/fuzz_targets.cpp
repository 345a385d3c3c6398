#include "fuzz_targets.h"

#include "polylab/diff.h"
#include "polylab/explain.h"
#include "polylab/exports.h"
#include "polylab/picture.h"
#include "polylab/polylab.h"
#include "polylab/report.h"
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace polylab::fuzz {

namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

// Whether the action was accepted; a refusal has to be one line of readable characters.
template <class Action>
bool accepted(const Action& action) {
    try {
        action();
        return true;
    } catch (const InputError& error) {
        const std::string text = error.what();
        require(!text.empty(), "a refusal says something");
        for (const char c : text) require(static_cast<unsigned char>(c) >= 32, "a refusal is one line");
        return false;
    }
}

bool same(const MeshData& a, const MeshData& b) {
    return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end()) && a.edges == b.edges &&
           a.triangles == b.triangles && a.tets == b.tets && a.hexes == b.hexes;
}

void check_data(const MeshData& data) {
    const Index vertices = static_cast<Index>(data.points.size());
    for (const Vec3& p : data.points)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "coordinates are finite");
    for (const std::vector<Index>* list : {&data.edges, &data.triangles, &data.tets, &data.hexes})
        for (const Index v : *list) require(v >= 0 && v < vertices, "indices are in range");
}

void check_labels(const TriMesh& mesh, const Labeling& labels) {
    const LabelingGraph graph = build_graph(mesh, labels);
    validate(mesh, labels, graph);
    require(!statistics_json(statistics(mesh, labels, graph), explain(mesh, graph)).empty(), "statistics");
    require(diff_text(mesh, labels, labels).find("0 of ") == 0, "no difference from itself");
}

// What other programs are given of a labeled mesh reads back, also where coordinates are extreme.
void check_outputs(TriMesh mesh, const Labeling& labels) {
    const std::vector<Vec3> polycube = surface_polycube(mesh, labels);
    distortion(mesh, polycube);
    const auto exported = [&](const char* path) { return export_files(path, mesh, labels).at(0).content; };
    require(read_vtk(exported("l.vtk"), "l.vtk").triangles == mesh.origin, "VTK reads back");
    require(read_medit(exported("l.mesh"), "l.mesh").triangles == mesh.origin, "MEDIT reads back");
    require(read_obj(exported("l.obj"), "l.obj").triangles == mesh.origin, "OBJ reads back");
    accepted([&] { require(!exported("l.glb").empty(), "GLB"); });   // refused where single precision is too small
    require(!png_picture(mesh, build_graph(mesh, labels), 32).empty(), "picture");
    require(!report_html(mesh, {"part", {}, {{"given", labels}}, polycube}).empty(), "report");
    rotate(mesh, own_frame(mesh));
    validate(mesh);
}

// What is done with each mesh that a reader lets through; where it is refused, once more with its vertices welded.
void check_surface(MeshData data) {
    const auto build = [](MeshData d) {
        if (!d.tets.empty()) {
            const TetSurface surface = extract_surface(d);
            const Labeling labels(surface.map.tet_facet.size(), 3);
            require(volume_labels(labels, surface.map).size() == d.tets.size(), "four labels per tetrahedron");
            d = surface.surface;
        }
        const TriMesh mesh = build_mesh(std::move(d));
        validate(mesh);
        check_labels(mesh, naive_labeling(mesh));
    };
    if (accepted([&] { build(data); })) return;
    weld(data);
    accepted([&] { build(data); });
}

void target_obj(std::string_view bytes) {
    accepted([&] {
        MeshData data = read_obj(bytes, "in.obj");
        check_data(data);
        require(same(data, read_obj(obj_text(data), "again.obj")), "OBJ reads back");
        check_surface(std::move(data));
    });
}

void target_medit(std::string_view bytes) {
    accepted([&] {
        MeshData data = read_medit(bytes, "in.mesh");
        check_data(data);
        require(same(data, read_medit(medit_text(data), "again.mesh")), "MEDIT reads back");
        check_surface(std::move(data));
    });
}

void target_stl(std::string_view bytes) {
    accepted([&] {
        MeshData data = read_stl(bytes, "in.stl");
        check_data(data);
        check_surface(std::move(data));
    });
}

void target_vtk(std::string_view bytes) {
    accepted([&] {
        MeshData data = read_vtk(bytes, "in.vtk");
        check_data(data);
        check_surface(std::move(data));
    });
}

void target_labels(std::string_view bytes) {
    const Choose choose = choices_of_bytes(bytes.substr(0, 2));
    const bool allow_free = choose(2) == 1;
    const Index facets = choose(64);
    accepted([&] {
        const Labeling labels = read_labels_text(bytes.substr(std::min<std::size_t>(2, bytes.size())), "l", facets, allow_free);
        require(static_cast<Index>(labels.size()) == facets, "a label per facet");
        for (const Label l : labels) require(l >= (allow_free ? kNoLabel : 0) && l < kLabels, "labels are in range");
        require(read_labels_text(labels_text(labels), "again", facets, allow_free) == labels, "labels read back");
    });
}

void target_surface_map(std::string_view bytes) {
    accepted([&] {
        const SurfaceMap map = read_surface_map_text(bytes, "map");
        const SurfaceMap again = read_surface_map_text(surface_map_text(map), "again");
        require(again.tets == map.tets && again.tet_facet == map.tet_facet, "a surface map reads back");
        if (map.tets < 10000) volume_labels(Labeling(map.tet_facet.size(), 0), map);
    });
}

// Arbitrary labels on an arbitrary mesh: charts, boundaries, corners, turning-points, their explanation and statistics; at times
// all that is written of them.
void target_labeling(std::string_view bytes) {
    const Choose choose = choices_of_bytes(bytes);
    accepted([&] {
        const TriMesh mesh = build_mesh(soup(choose));
        Labeling labels(mesh.facets());
        for (Label& l : labels) l = static_cast<Label>(choose(kLabels));
        check_labels(mesh, labels);
        if (choose(64) == 1) check_outputs(mesh, labels);
    });
}

// Small meshes and, most times, small budgets: many runs tell more than long ones, which test_soup.cpp has.
void target_pipeline(std::string_view bytes) {
    constexpr std::size_t kMostFacets = 60;
    constexpr int kBudgets[] = {2, 2, 4, 4, 8, 16, 32, 200};
    const Choose choose = choices_of_bytes(bytes);
    const Index kind = choose(32);
    const MeshData data = soup(choose);
    if (data.triangles.size() <= 3 * kMostFacets) label_soup(data, choose, /* noise= */ kind % 4 > 0, kBudgets[kind / 4]);
}

// ---- soups

// A closed surface of any shape: facets of a tetrahedron are cut in three at new vertices, edges are turned.
MeshData crumpled(const Choose& choose) {
    MeshData d = shapes::tetrahedron();
    const Index range = 2 + choose(9);
    const auto point = [&] {
        const Index x = choose(range), y = choose(range), z = choose(range);
        return Vec3{1.0 * x, 1.0 * y, 1.0 * z};
    };
    for (Vec3& p : d.points)
        if (choose(2)) p = point();
    for (Index i = choose(30); i > 0; i--) {
        const Index f = choose(static_cast<Index>(d.triangles.size() / 3)), v = static_cast<Index>(d.points.size());
        const Index a = d.triangles[3 * f], b = d.triangles[3 * f + 1], c = d.triangles[3 * f + 2];
        d.points.push_back(point());
        d.triangles[3 * f + 2] = v;
        d.triangles.insert(d.triangles.end(), {b, c, v, c, a, v});
    }
    return d;
}

MeshData loose(const Choose& choose) {
    MeshData d;
    const Index n = 3 + choose(8);
    for (Index v = 0; v < n; v++) {
        const Index x = choose(4), y = choose(4), z = choose(4);
        d.points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    }
    for (Index i = 3 * (1 + choose(12)); i > 0; i--) d.triangles.push_back(choose(n));
    return d;
}

MeshData solid(const Choose& choose) {
    std::vector<shapes::Cell> cells;
    const int side = 1 + choose(3), density = 1 + choose(4);
    for (int x = 0; x < side; x++)
        for (int y = 0; y < side; y++)
            for (int z = 0; z < side; z++)
                if (choose(4) < density) cells.push_back({x, y, z});
    if (cells.empty()) cells.push_back({0, 0, 0});
    return shapes::voxels(cells);
}

MeshData part(const Choose& choose) {
    switch (choose(12)) {
        case 0: return shapes::octahedron();
        case 1: {
            const int x = 1 + choose(2), y = 1 + choose(2);
            return shapes::box(x, y, 1 + choose(2));
        }
        case 2: return shapes::pyramid(3 + choose(6));
        case 3: {
            const int a = 1 + choose(4), b = 1 + choose(4);
            return shapes::triangular_prism(a, b, 1 + choose(4));
        }
        case 4: return loose(choose);
        case 5: return choose(2) ? shapes::frame() : shapes::pinched_ring();
        case 6: return shapes::pillow();
        case 7: {
            const MeshData odd[] = {shapes::mobius_strip(3), shapes::projective_plane(), shapes::tetrahedron_with_flat_facet()};
            return odd[choose(3)];
        }
        case 8:
        case 9: return solid(choose);
        default: return crumpled(choose);
    }
}

void spoil(MeshData& d, const Choose& choose) {
    const Index vertices = static_cast<Index>(d.points.size()), facets = static_cast<Index>(d.triangles.size() / 3);
    const Index f = choose(facets), v = choose(vertices), w = choose(vertices);
    const auto corner = d.triangles.begin() + 3 * f;
    switch (choose(14)) {
        case 0: std::swap(corner[0], corner[1]); break;
        case 1: d = shapes::turned(std::move(d)); break;
        case 2:
            if (facets > 1) d.triangles.erase(corner, corner + 3);
            break;
        case 3: {
            const Index copy[3] = {corner[0], corner[1], corner[2]};
            d.triangles.insert(d.triangles.end(), copy, copy + 3);
            break;
        }
        case 4: std::replace(d.triangles.begin(), d.triangles.end(), v, w); break;
        case 5: d.points[v] = d.points[w]; break;
        case 6: weld(d); break;
        case 7: {
            const double scales[] = {1e-200, 1e-30, 1e-9, 0, 1e9, 1e70, 1e75, 1e300};
            d = shapes::scaled(std::move(d), scales[choose(8)]);
            break;
        }
        case 8: {
            const Index axis = choose(3);
            for (Vec3& p : d.points) p[axis] = 0;   // all facets in one plane
            break;
        }
        case 9: d.points[v][choose(3)] += 1e-7 * choose(256); break;
        case 10: d.points.push_back(d.points[v]); break;
        case 11:
            for (Index i = choose(20); i > 0; i--) {
                const Index a = choose(vertices);
                d.edges.insert(d.edges.end(), {a, choose(vertices)});
            }
            break;
        case 12:
            for (Index h = 0; h < 3 * facets; h++) d.edges.insert(d.edges.end(), {d.triangles[h], d.triangles[next(h)]});
            break;
        case 13: {
            const double strange[] = {NAN, INFINITY, -INFINITY, 1e76, 5e-324, -0.0};
            d.points[v][choose(3)] = strange[choose(6)];
            break;
        }
    }
}

}   // namespace

Choose choices_of_bytes(std::string_view bytes) {
    return [bytes, at = std::size_t{0}](Index n) mutable {
        if (at >= bytes.size()) return Index{0};
        return static_cast<Index>(static_cast<unsigned char>(bytes[at++])) % n;
    };
}

Choose choices_of_seed(std::uint64_t seed) {
    return [random = shapes::Lcg(seed)](Index n) mutable { return random.below(n); };
}

MeshData soup(const Choose& choose) {
    MeshData d = part(choose);
    for (Index more = choose(8) < 5 ? 0 : 1 + choose(2); more > 0; more--) {
        const Index x = choose(4), y = choose(4), z = choose(4);
        MeshData other = shapes::moved(part(choose), {1.0 * x, 1.0 * y, 1.0 * z});
        if (choose(8) == 0) other = shapes::refined(other);
        shapes::append(d, other);
    }
    for (Index i = choose(2) ? 0 : 1 + choose(3); i > 0; i--) spoil(d, choose);
    return d;
}

bool label_soup(const MeshData& data, const Choose& choose, bool noise, int most) {
    return accepted([&] {
        const TriMesh mesh = build_mesh(data);
        validate(mesh);
        Labeling labels = noise ? Labeling(mesh.facets()) : graphcut_labeling(mesh);
        RoutineOptions options;
        int asked = 0;
        options.stop = [&] { return asked++ >= most; };
        if (noise) {
            for (Label& l : labels) l = static_cast<Label>(choose(kLabels));
            if (choose(4) == 0) {
                options.locks.assign(mesh.facets(), kNoLabel);
                for (Label& l : options.locks)
                    if (choose(8) == 0) l = static_cast<Label>(choose(kLabels));
            }
        }
        const Score start = Judge(mesh, true, options.locks).state(labels).score;
        const State result = search(mesh, labels, options);
        require(!(start < result.score), "the result is no worse than its start");
        require(result.score == Judge(mesh, true, options.locks).state(result.labels).score, "the score is of the labels");
        for (std::size_t f = 0; f < options.locks.size(); f++)
            require(options.locks[f] == kNoLabel || options.locks[f] == result.labels[f], "locks hold");
        check_labels(mesh, result.labels);
    });
}

const std::vector<Target>& targets() {
    static const std::vector<Target> table = {
        {"obj", target_obj},           {"medit", target_medit},       {"stl", target_stl},
        {"vtk", target_vtk},           {"labels", target_labels},     {"surface_map", target_surface_map},
        {"labeling", target_labeling}, {"pipeline", target_pipeline},
    };
    return table;
}

}   // namespace polylab::fuzz

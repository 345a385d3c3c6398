// The commands of the published code: links to the program, with their command lines, files and exit status; mesh_stats.
#include "polylab/dropin.h"

#include "polylab/exports.h"
#include "polylab/io.h"
#include "polylab/mesh_stats.h"
#include "polylab/polylab.h"
#include "scratch.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace polylab;
using shapes::cube;
namespace fs = std::filesystem;

namespace {

const std::string kCubeLabels = "0\n0\n1\n1\n2\n2\n3\n3\n4\n4\n5\n5";   // of cube(1), as the published code ends the file

// `NAME ARGUMENTS` by a link beside the part, as a pipeline finds it in its folder of commands.
Result run_as(const Scratch& scratch, const std::string& name, const std::string& arguments) {
    const std::string link = scratch.path(name);
    if (!fs::exists(link)) fs::create_symlink(POLYLAB_PROGRAM, link);
    return scratch.run(arguments, "", link);
}

Result check_runs(const Scratch& scratch, const std::string& name, const std::string& arguments) {
    CAPTURE(name + " " + arguments);
    const Result r = run_as(scratch, name, arguments);
    CHECK(r.status == 0);
    CHECK(r.err.empty());
    return r;
}

void check_fails(const Scratch& scratch, const std::string& name, const std::string& arguments, const std::string& message) {
    CAPTURE(name + " " + arguments);
    fs::remove(scratch.path(name));
    const std::size_t before = scratch.entries();
    const Result r = run_as(scratch, name, arguments);
    CHECK(r.status == 1);
    CHECK(r.out.empty());
    CAPTURE(r.err);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK(r.err.find(name + ": ") == 0);
    CHECK(r.err.find(message) != std::string::npos);
    CHECK(scratch.entries() == before + 1);   // the link
}

// Two tetrahedra on one facet, of a corner at the origin, and a feature edge that is not on a sharp edge of the surface.
MeshData tet_pair() {
    MeshData d;
    d.points = {{0, 0, 0}, {9, 9, 9}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2}};   // vertex 1 is of no tetrahedron
    d.tets = {0, 2, 3, 4, 2, 3, 4, 5};
    d.edges = {0, 2};
    return d;
}

// A box of 1 x 2 x 3 in MEDIT's order.
MeshData hex_box() {
    MeshData d;
    d.points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
    d.hexes = {0, 1, 2, 3, 4, 5, 6, 7};
    return d;
}

std::array<Vec3, 8> corners(const MeshData& hex) {
    std::array<Vec3, 8> p;
    for (std::size_t k = 0; k < 8; k++) p[k] = hex.points[hex.hexes[k]];
    return p;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}   // namespace

TEST_CASE("dropin: labelings by the names that pipelines call") {
    const Scratch scratch;
    const std::string parameters = "compactness=1 fidelity=3 sensitivity=1e-9 angle_of_rotation=0.05 gui=false output=g.txt";
    CHECK(holds(check_runs(scratch, "graphcut_labeling", "cube.obj " + parameters).out, "valid, all monotone: 6 charts"));
    check_runs(scratch, "naive_labeling", "cube.obj n.txt");
    check_runs(scratch, "automatic_polycube", "cube.obj gui=false output=a.txt");
    check_runs(scratch, "automatic_polycube", "cube.obj n.txt gui=false output=i.txt");
    for (const char* file : {"g.txt", "n.txt", "a.txt", "i.txt"}) CHECK(scratch.read(file) == kCubeLabels);
    check_runs(scratch, "automatic_polycube", "cube.obj");
    CHECK(scratch.read("labeling.txt") == kCubeLabels);
}

TEST_CASE("dropin: a labeling that is not valid is a result like any other") {
    const Scratch scratch;
    scratch.write("tetrahedron.obj", obj_text(shapes::tetrahedron()));
    const Result r = check_runs(scratch, "naive_labeling", "tetrahedron.obj n.txt");
    CHECK(holds(r.out, "not valid: 4 charts"));
    CHECK(holds(check_runs(scratch, "labeling_stats", "tetrahedron.obj n.txt").out, "\"charts\": {\n        \"invalid\": 4,"));
}

TEST_CASE("dropin: labeling_stats has the published keys only") {
    const Scratch scratch;
    check_runs(scratch, "labeling_stats", "cube.obj naive.txt s.json");
    CHECK(
        scratch.read("s.json") ==
        "{\n"
        "    \"boundaries\": {\n        \"invalid\": 0,\n        \"nb\": 12,\n        \"non-monotone\": 0\n    },\n"
        "    \"charts\": {\n        \"invalid\": 0,\n        \"nb\": 6\n    },\n"
        "    \"corners\": {\n        \"invalid\": 0,\n        \"nb\": 8\n    },\n"
        "    \"feature-edges\": {\n        \"lost\": 0,\n        \"preserved\": 0,\n        \"removed\": 0\n    },\n"
        "    \"fidelity\": {\n        \"avg\": 1.0,\n        \"max\": 1.0,\n        \"min\": 1.0,\n        \"sd\": 0.0\n    },\n"
        "    \"is_allowing_boundaries_between_opposite_labels\": true,\n"
        "    \"turning-points\": {\n        \"nb\": 0\n    }\n"
        "}\n");
    const std::string strict = check_runs(scratch, "labeling_stats", "cube.obj naive.txt allow-opposite-labels=false").out;
    CHECK(holds(strict, "\"is_allowing_boundaries_between_opposite_labels\": false"));
}

TEST_CASE("dropin: extract_surface and volume_labeling") {
    const Scratch scratch;
    scratch.write("t.mesh", medit_text(tet_pair()));
    check_runs(scratch, "extract_surface", "t.mesh s.obj m.txt");
    CHECK(scratch.read("m.txt") == "6 triangles\n2 tetrahedra\n1\n2\n3\n4\n5\n6\n");
    const std::string surface = scratch.read("s.obj");
    CHECK(read_obj(surface, "s.obj").points.size() == 5);
    CHECK(holds(surface, "l 1 2\n"));
    scratch.write("l.txt", "1\n3\n5\n1\n0\n0");
    check_runs(scratch, "volume_labeling", "l.txt m.txt v.txt");
    CHECK(scratch.read("v.txt") == "-1\n1\n3\n5\n1\n0\n0\n-1\n");

    // A surface that is there stays, if it is the right one.
    std::string theirs = surface;
    theirs.replace(theirs.find("2 0 0"), 5, "2.1 0 0");   // as if with fewer digits
    scratch.write("s.obj", theirs);
    check_runs(scratch, "extract_surface", "t.mesh s.obj m2.txt");
    CHECK(scratch.read("m2.txt") == scratch.read("m.txt"));
    CHECK(scratch.read("s.obj") == theirs);
    check_fails(scratch, "extract_surface", "t.mesh cube.obj m3.txt", "cube.obj: expected the surface of t.mesh");

    // With its cells: vertices of the tet mesh, and the triangles.
    check_runs(scratch, "extract_surface", "t.mesh c.mesh m4.txt write-cells=1");
    const MeshData cells = read_medit(scratch.read("c.mesh"), "c.mesh");
    CHECK(cells.points == tet_pair().points);
    CHECK(cells.tets == tet_pair().tets);
    CHECK(cells.triangles == std::vector<Index>{0, 4, 3, 4, 0, 2, 0, 3, 2, 3, 4, 5, 2, 5, 4, 5, 2, 3});
}

TEST_CASE("dropin: to_glTF and polycube_distortion") {
    const Scratch scratch;
    check_runs(scratch, "to_glTF", "cube.obj a.glb");
    check_runs(scratch, "to_glTF", "cube.obj b.glb labeling=naive.txt");
    check_runs(scratch, "to_glTF", "cube.obj c.glb labeling=naive.txt polycube=cube.obj");
    const TriMesh mesh = build_mesh(cube(1));
    CHECK(scratch.read("a.glb") == glb_text(mesh, {}));
    CHECK(scratch.read("b.glb") == glb_text(mesh, naive_labeling(mesh)));
    CHECK(scratch.read("c.glb") == glb_text(mesh, naive_labeling(mesh), mesh.points));
    CHECK(check_runs(scratch, "polycube_distortion", "cube.obj cube.obj").out ==
          "{\n    \"angle_distortion\": 1.0,\n    \"area_distortion\": 1.0,\n    \"isometric_distortion\": 1.0,\n"
          "    \"stretch\": 1.0\n}\n");
    scratch.write("other.obj", obj_text(cube(2)));
    check_fails(scratch, "to_glTF", "cube.obj d.glb polycube=other.obj",
                "other.obj: expected the 8 vertices of the surface, found 26");
    check_fails(scratch, "polycube_distortion", "cube.obj other.obj d.json", "other.obj: expected the 8 vertices");
}

TEST_CASE("dropin: viewers say where the page is") {
    const Scratch scratch;
    const std::string said = check_runs(scratch, "labeling_viewer", "cube.obj naive.txt v.geogram").out;
    CHECK(holds(said, scratch.path("naive.html")));
    CHECK(holds(scratch.read("naive.html"), "<title>cube.obj - polylab</title>"));
    CHECK(holds(check_runs(scratch, "labeling_painter", "cube.obj naive.txt").out, "--lock"));
    check_fails(scratch, "hex_mesh_viewer", "hex.mesh", "hex.mesh: hexahedra can't be shown here");
}

TEST_CASE("dropin: what fails is one line and status 1, and leaves no file") {
    const Scratch scratch;
    scratch.write("short.txt", "0 0");
    check_fails(scratch, "automatic_polycube", "", "missing SURFACE (usage: automatic_polycube SURFACE [INITIAL_LABELING]");
    check_fails(scratch, "automatic_polycube", "none.obj output=l.txt", "none.obj: can't be read");
    check_fails(scratch, "automatic_polycube", "cube.obj short.txt output=l.txt", "short.txt: expected 12 labels");
    check_fails(scratch, "automatic_polycube", "cube.obj output=none/l.txt", "none/l.txt: can't be written");
    check_fails(scratch, "automatic_polycube", "cube.obj size=3", "unknown key 'size'");
    check_fails(scratch, "graphcut_labeling", "cube.obj compactness=x output=l.txt", "compactness: expected an integer from 0");
    check_fails(scratch, "naive_labeling", "cube.obj", "missing LABELING");
    check_fails(scratch, "naive_labeling", "cube.obj a.txt b.txt", "unexpected 'b.txt'");
    check_fails(scratch, "labeling_stats", "cube.obj naive.txt allow-opposite-labels=no", "expected true or false, found 'no'");
    check_fails(scratch, "extract_surface", "cube.obj s.obj m.txt", "cube.obj: expected tetrahedra, found none");
    check_fails(scratch, "volume_labeling", "naive.txt none.txt v.txt", "none.txt: can't be read");
    check_fails(scratch, "mesh_stats", "none.mesh s.json", "none.mesh: can't be read");
    CHECK(check_runs(scratch, "naive_labeling", "--help").out == "usage: naive_labeling SURFACE LABELING\n");
    fs::create_directory(scratch.path("a=b"));   // a folder before the '=': an operand
    check_runs(scratch, "naive_labeling", "cube.obj ./a=b/l.txt");
}

TEST_CASE("mesh_stats: a box as hexahedron") {
    const std::string json = mesh_stats_json(hex_box());
    CHECK(
        holds(json,
              "    \"cells\": {\n"
              "        \"by_type\": {\n            \"hexahedra\": 1,\n            \"tetrahedra\": 0\n        },\n"
              "        \"edges\": 12,\n        \"facets\": 6,\n        \"nb\": 1,\n"
              "        \"quality\": {\n            \"hex_SJ\": {\n                \"avg\": 1.0,\n                \"max\": 1.0,\n"
              "                \"min\": 1.0,\n                \"sd\": 0.0\n            }\n        },\n"
              "        \"volume\": 6.0\n    },\n"
              "    \"edges\": {\n        \"nb\": 0\n    },\n    \"facets\": {\n        \"nb\": 0\n    },\n"));
    CHECK(holds(json, "        \"nb\": 8,\n"));
    CHECK(holds(
        json,
        "\"z\": {\n            \"avg\": 1.5,\n            \"max\": 3.0,\n            \"min\": 0.0,\n            \"sd\": 1.5\n"));
}

TEST_CASE("mesh_stats: scaled Jacobian") {
    MeshData hex = hex_box();
    CHECK(scaled_jacobian(corners(hex)) == 1);
    hex.points[6] = {1, 2, 0};   // on vertex 2: an edge has no length
    CHECK(scaled_jacobian(corners(hex)) == 0);
    hex = hex_box();
    for (int k = 4; k < 8; k++) hex.points[k].x += 3;   // sheared by 45 degrees
    CHECK(scaled_jacobian(corners(hex)) == doctest::Approx(std::sqrt(0.5)));
    hex = hex_box();
    for (Vec3& p : hex.points) p.z = -p.z;   // inside out
    CHECK(scaled_jacobian(corners(hex)) == doctest::Approx(-1));
}

TEST_CASE("mesh_stats: triangles and tetrahedra") {
    MeshData data = tet_pair();
    data.triangles = cube(1).triangles;
    data.points = cube(1).points;
    data.tets.clear();
    data.edges.clear();
    const std::string surface = mesh_stats_json(data);
    CHECK(holds(surface, "\"edges\": 18,\n        \"nb\": 12,\n        \"normals_outward\": true\n"));
    CHECK(holds(surface, "\"sum\": 6.0\n"));
    CHECK(holds(mesh_stats_json(shapes::turned(cube(1))), "\"normals_outward\": false"));
    const std::string tets = mesh_stats_json(tet_pair());
    CHECK(holds(
        tets,
        "\"tetrahedra\": 2\n        },\n        \"edges\": 9,\n        \"facets\": 7,\n        \"nb\": 2,\n        \"volume\": 4.0\n"));
    MeshData wrong = tet_pair();
    wrong.tets[0] = 6;
    CHECK_THROWS_AS(mesh_stats_json(wrong), InputError);
    CHECK(holds(mesh_stats_json({}), "\"vertices\": {\n        \"nb\": 0\n    }\n"));
}

TEST_CASE("mesh_stats: principal axes, longest first") {
    const PrincipalAxes box = principal_axes(hex_box().points);
    CHECK(box.centre == Vec3{0.5, 1, 1.5});
    CHECK(box.axis == std::array<Vec3, 3>{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}});
    CHECK(box.extent == std::array<double, 3>{1.5, 1, 0.5});
    std::vector<Vec3> turned;   // around Z by the angle of a 3-4-5 triangle, then around X
    for (const Vec3& p : hex_box().points) {
        const Vec3 q = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
        turned.push_back({q.x, 0.8 * q.y - 0.6 * q.z, 0.6 * q.y + 0.8 * q.z});
    }
    const PrincipalAxes axes = principal_axes(turned);
    for (std::size_t k = 0; k < 3; k++) {
        CHECK(axes.extent[k] == doctest::Approx(box.extent[k]));
        for (std::size_t j = 0; j < k; j++) CHECK(dot(axes.axis[j], axes.axis[k]) == doctest::Approx(0).epsilon(1e-12));
    }
    CHECK(norm(axes.axis[0] - Vec3{0, -0.6, 0.8}) < 1e-12);
    const Scratch scratch;
    scratch.write("box.mesh", medit_text(hex_box()));
    check_runs(scratch, "mesh_stats", "box.mesh s.json principal_axes=axes.obj");
    CHECK(scratch.read("s.json") == mesh_stats_json(hex_box()));
    CHECK(scratch.read("axes.obj") == "v 0.5 1 1.5\nv 0.5 1 3\nv 0.5 2 1.5\nv 1 1 1.5\nl 1 2\nl 1 3\nl 1 4\n");
}

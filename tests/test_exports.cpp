// Files for other programs: read back by our own readers where we have one, and glTF by its layout.
#include "polylab/exports.h"

#include "polylab/io.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace polylab;

namespace {

const Labeling kCube = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};

std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t u = 0;
    for (std::size_t i = 0; i < 4; i++) u |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return u;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) n++;
    return n;
}

std::string refusal(const std::string& text) {
    try {
        read_vtk(text, "t.vtk");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

const std::string kVtkHead = "# vtk DataFile Version 2.0\na title # of any kind\nASCII\nDATASET UNSTRUCTURED_GRID\n";

// The first file.
std::string exported(const std::string& path, const TriMesh& mesh, const Labeling& labels) {
    return export_files(path, mesh, labels).at(0).content;
}

float number(const std::string& bytes, std::size_t at) {
    const std::uint32_t bits = word(bytes, at);
    float x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

}   // namespace

TEST_CASE("exports: the extension decides, others are for labels") {
    const TriMesh mesh = build_mesh(shapes::cube(1));
    for (const char* name : {"a.txt", "a", "-", "", "vtk", "a.obj.txt"}) CHECK(export_files(name, mesh, kCube).empty());
    CHECK(exported("A.VTK", mesh, kCube) == exported("a.vtk", mesh, kCube));
}

TEST_CASE("exports: .vtk holds the surface and four values per facet") {
    const TriMesh mesh = build_mesh(shapes::cube(1));
    const std::string text = exported("a.vtk", mesh, kCube);
    const MeshData back = read_vtk(text, "a.vtk");
    CHECK(back.points == mesh.points);
    CHECK(back.triangles == mesh.origin);
    const std::string head = "CELL_DATA 12\nSCALARS label int 1\nLOOKUP_TABLE default\n";
    const std::size_t data = text.find(head);
    REQUIRE(data != std::string::npos);
    const std::string lookup = "\nLOOKUP_TABLE default\n";
    CHECK(text.substr(data) == head + labels_text(kCube) + "SCALARS chart int 1" + lookup +
                                   labels_text(kCube) /* a chart per side */ + "SCALARS fidelity double 1" + lookup +
                                   "1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\nVECTORS normal double\n" +
                                   "1 0 0\n1 0 0\n-1 0 0\n-1 0 0\n0 1 0\n0 1 0\n0 -1 0\n0 -1 0\n0 0 1\n0 0 1\n0 0 -1\n0 0 -1\n");
}

TEST_CASE("exports: .mesh and .obj hold surface, feature edges and labels") {
    const MeshData shape = shapes::creased(shapes::cube(1));
    const TriMesh mesh = build_mesh(shape);
    const std::string medit = exported("a.mesh", mesh, kCube), obj = exported("a.obj", mesh, kCube);
    for (const MeshData& back : {read_medit(medit, "a.mesh"), read_obj(obj, "a.obj")}) {
        CHECK(back.points == mesh.points);
        CHECK(back.triangles == mesh.origin);
        CHECK(back.edges == mesh_data(mesh).edges);
    }
    std::string expected = "Triangles\n12\n";
    for (Index f = 0; f < 12; f++)
        for (int k = 0; k < 4; k++)
            expected += std::to_string(k < 3 ? mesh.origin[3 * f + k] + 1 : kCube[f]) + (k < 3 ? " " : "\n");
    CHECK(medit.substr(medit.find("Triangles")) == expected + "End\n");
    for (const char* material : {"red", "darkred", "green", "darkgreen", "blue", "darkblue"})
        CHECK(occurrences(obj, std::string("usemtl ") + material + "\nf ") == 2);
}

TEST_CASE("exports: .obj refers to the .mtl beside it, which has its materials") {
    const TriMesh mesh = build_mesh(shapes::cube(1));
    const std::vector<ExportedFile> files = export_files("some folder/a.b.OBJ", mesh, kCube);
    REQUIRE(files.size() == 2);
    CHECK(files[0].path == "some folder/a.b.OBJ");
    CHECK(files[0].content.find("mtllib a.b.mtl\nv ") == 0);
    CHECK(files[1].path == "some folder/a.b.mtl");
    CHECK(files[1].content ==
          "newmtl red\nKd 1 0 0\nnewmtl darkred\nKd 0.6 0 0\nnewmtl green\nKd 0 1 0\nnewmtl darkgreen\nKd 0 0.6 0\n"
          "newmtl blue\nKd 0 0 1\nnewmtl darkblue\nKd 0 0 0.6\n");
}

TEST_CASE("exports: .glb of a surface without labels, and with its way to the polycube") {
    const TriMesh mesh = build_mesh(shapes::cube(1));
    const std::string plain = glb_text(mesh, {});
    CHECK(occurrences(plain, "\"baseColorFactor\"") == 1);
    CHECK(occurrences(plain, "\"count\": 36,") == 1);
    CHECK(plain.find("animations") == std::string::npos);
    std::vector<Vec3> polycube = mesh.points;
    for (Vec3& p : polycube) p = p + p + Vec3{0, 0, 1};
    const std::string glb = glb_text(mesh, kCube, polycube);
    CHECK(occurrences(glb, "\"targets\"") == 6);
    CHECK(occurrences(glb, "\"path\": \"weights\"") == 1);
    const std::size_t bin = 20 + word(glb, 12) + 8;
    for (Index v = 0; v < 8; v++)   // where each vertex goes, after where they are
        for (int a = 0; a < 3; a++)
            CHECK(number(glb, bin + 96 + 4 * static_cast<std::size_t>(3 * v + a)) == polycube[v][a] - mesh.points[v][a]);
    const float expected[] = {0, 1, 4, 5, 8, 0, 0, 1, 1, 0};   // seconds, then weights
    for (std::size_t i = 0; i < 10; i++) CHECK(number(glb, bin + 192 + 4 * i) == expected[i]);
    CHECK(glb.size() == bin + 192 + 40 + 36 * 4);
}

TEST_CASE("exports: .glb") {
    const TriMesh mesh = build_mesh(shapes::moved(shapes::cube(1), {-0.5, 0, 2}));
    Labeling labels = kCube;
    labels[1] = 2;   // one facet of +X, three of +Y
    const std::string glb = exported("a.glb", mesh, labels);
    REQUIRE(glb.size() > 20);
    CHECK(glb.substr(0, 4) == "glTF");
    CHECK(word(glb, 4) == 2);
    CHECK(word(glb, 8) == glb.size());
    const std::size_t json_size = word(glb, 12), bin = 20 + json_size;
    CHECK(json_size % 4 == 0);
    CHECK(glb.substr(16, 4) == "JSON");
    const std::string json = glb.substr(20, json_size);
    REQUIRE(glb.size() == bin + 8 + 8 * 12 + 36 * 4);   // 8 vertices, 36 indices
    CHECK(word(glb, bin) == 8 * 12 + 36 * 4);
    CHECK(glb.substr(bin + 4, 4) == std::string("BIN\0", 4));
    for (Index v = 0; v < 8; v++)
        for (int a = 0; a < 3; a++) CHECK(number(glb, bin + 8 + 4 * static_cast<std::size_t>(3 * v + a)) == mesh.points[v][a]);
    std::size_t at = bin + 8 + 8 * 12;
    for (Label l = 0; l < kLabels; l++)
        for (Index f = 0; f < 12; f++)
            for (Index k = 0; k < 3 && labels[f] == l; k++, at += 4)
                CHECK(word(glb, at) == static_cast<std::uint32_t>(mesh.origin[3 * f + k]));
    CHECK(occurrences(json, "\"indices\"") == 6);
    CHECK(occurrences(json, "\"count\": 9,") == 1);
    CHECK(occurrences(json, "\"count\": 3,") == 1);
    CHECK(json.find("\"min\": [\n                -0.5,\n                0.0,\n                2.0\n            ]") !=
          std::string::npos);
    const std::string one = exported("a.glb", mesh, Labeling(12, 4));   // only labels that occur have a primitive
    CHECK(occurrences(one, "\"indices\"") == 1);
    CHECK_THROWS_AS(glb_text(build_mesh(shapes::scaled(shapes::cube(1), 1e39)), kCube), InputError);
}

TEST_CASE("io: legacy .vtk with vertices, feature edges, triangles and tetrahedra") {
    const MeshData d = read_vtk(kVtkHead +
                                    "POINTS 5 float\n0 0 0 1 0 0\n0 1 0 0 0 1\n1e2 1 1\n"
                                    "CELLS 5 17\n1 0\n2 0 1\n3 0 2 1\n4 0 1 2 3\n4 1 2 3 4\n\nCELL_TYPES 5\n1\n3\n5\n10\n10\n"
                                    "CELL_DATA 5\nSCALARS color int 1\nLOOKUP_TABLE default\n1\n2\n3\n4\n5\n",
                                "t.vtk");
    CHECK(d.points == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {100, 1, 1}});
    CHECK(d.edges == std::vector<Index>{0, 1});
    CHECK(d.triangles == std::vector<Index>{0, 2, 1});
    CHECK(d.tets == std::vector<Index>{0, 1, 2, 3, 1, 2, 3, 4});
}

TEST_CASE("io: .vtk that can't be read") {
    const std::string points = kVtkHead + "POINTS 3 double\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK(refusal("") == "t.vtk:1: expected '# vtk DataFile Version 2.0'");
    CHECK(refusal("# vtk DataFile Version 2.0\nt\nBINARY\n").find("t.vtk:3: expected 'ASCII', found") == 0);
    CHECK(refusal("# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\n").find("t.vtk:4: expected 'UNSTRUCTURED_GRID'") == 0);
    CHECK(refusal(points + "CELLS 1 4\n3 0 1 3\nCELL_TYPES 1\n5\n") == "t.vtk:10: expected a vertex index from 0 to 2, found 3");
    CHECK(refusal(points + "CELLS 1 3\n2 0 1\nCELL_TYPES 1\n5\n") ==
          "t.vtk:10: expected 3 vertices for a cell of type 5, found 2");
    CHECK(refusal(points + "CELLS 1 5\n4 0 1 2 2\nCELL_TYPES 1\n9\n").find("t.vtk:10: expected a vertex, line, triangle") == 0);
    CHECK(refusal(points + "CELLS 2 4\nOFFSETS vtktypeint64\n").find("t.vtk:10: expected cells as in versions 2 to 4") == 0);
    CHECK(refusal(points + "CELLS 1 4\n3 0 1 2\n").find("expected CELL_TYPES for 1 cells") != std::string::npos);
    CHECK(refusal(points + "CELLS 9999999999 4\n").find("t.vtk:9: expected") == 0);
    CHECK(refusal(points + "CELLS 1 4\n3 0 1").find("expected a vertex index") != std::string::npos);
    CHECK(refusal(points + "HEXES 1 4\n").find("expected 'POINTS'") != std::string::npos);
}

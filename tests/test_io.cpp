// Mesh and label files: dialects, identity of read and write, and what is refused, where.
#include "polylab/io.h"

#include "polylab/text.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <locale>
#include <memory>
#include <sstream>

using namespace polylab;
namespace fs = std::filesystem;

namespace {

using Reader = MeshData (*)(std::string_view, const std::string&);

// The bytes in a heap block of exactly their size, so that a sanitizer sees every read beyond them.
struct Exact {
    std::unique_ptr<char[]> bytes;
    std::size_t size;
    explicit Exact(const std::string& text) : bytes(new char[text.size()]), size(text.size()) {
        if (size > 0) std::memcpy(bytes.get(), text.data(), size);
    }
    std::string_view view() const { return {bytes.get(), size}; }
};

// Equal bit for bit: 0.0 is not -0.0.
bool same(const MeshData& a, const MeshData& b) {
    return a.points.size() == b.points.size() &&
           (a.points.empty() || std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vec3)) == 0) &&
           a.edges == b.edges && a.triangles == b.triangles && a.tets == b.tets && a.hexes == b.hexes;
}

template <class T>
bool starts(const std::vector<T>& part, const std::vector<T>& whole) {
    return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

// What MeshData promises of every file that was read.
bool in_range(const MeshData& d) {
    for (const auto* list : {&d.edges, &d.triangles, &d.tets, &d.hexes})
        for (const Index v : *list)
            if (v < 0 || v >= static_cast<Index>(d.points.size())) return false;
    for (const Vec3& p : d.points)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    return d.edges.size() % 2 == 0 && d.triangles.size() % 3 == 0 && d.tets.size() % 4 == 0 && d.hexes.size() % 8 == 0;
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

// "t:line: expected …, found …token…", in one line.
void check_error(const std::string& error, Index line, const std::string& found) {
    CAPTURE(error);
    const std::string start = "t:" + std::to_string(line) + ": expected ";
    CHECK(error.compare(0, start.size(), start) == 0);
    const std::size_t at = error.find(", found ");
    CHECK(at != std::string::npos);
    CHECK((at != std::string::npos && error.find(found, at + 8) != std::string::npos));
    CHECK(error.find('\n') == std::string::npos);
}

struct Bad {
    const char* text;
    Index line;
    const char* found;
};

void check_refused(Reader read, const std::string& before, const std::vector<Bad>& table) {
    for (const Bad& bad : table) {
        const std::string text = before + bad.text;
        CAPTURE(text);
        check_error(error_of([&] { read(Exact(text).view(), "t"); }), bad.line, bad.found);
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) text.replace(at, from.size(), to);
    return text;
}

std::string point(int x, int y, int z) { return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z); }

// Every cut of the text is read in the way that `expected` says: a mesh, or nothing for an error.
void check_cuts(Reader read, const std::string& text, const std::function<std::unique_ptr<MeshData>(std::size_t)>& expected) {
    for (std::size_t cut = 0; cut < text.size(); cut++) {
        const std::string part = text.substr(0, cut);
        CAPTURE(part);
        const std::unique_ptr<MeshData> mesh = expected(cut);
        MeshData got;
        const std::string error = error_of([&] { got = read(Exact(part).view(), "t"); });
        CHECK((error == "no error") == (mesh != nullptr));
        if (mesh && error == "no error") CHECK(same(got, *mesh));
    }
}

std::string stl_float(float x) {
    std::uint32_t u;
    std::memcpy(&u, &x, sizeof u);
    std::string bytes;
    for (int i = 0; i < 4; i++) bytes += static_cast<char>(u >> (8 * i) & 255);
    return bytes;
}

// Header, count, and per facet a normal, nine coordinates and two bytes of attributes.
std::string binary_stl(std::string header, std::uint32_t count, const std::vector<float>& corners) {
    header.resize(80, ' ');
    for (int i = 0; i < 4; i++) header += static_cast<char>(count >> (8 * i) & 255);
    for (std::size_t i = 0; i < corners.size(); i++) {
        if (i % 9 == 0) header += stl_float(0) + stl_float(0) + stl_float(NAN);   // the normal is not used
        header += stl_float(corners[i]);
        if (i % 9 == 8) header += "ab";
    }
    return header;
}

std::string ascii_stl(const std::vector<std::string>& corners) {
    std::string text = "solid a name\n";
    for (std::size_t i = 0; i < corners.size(); i++) {
        if (i % 3 == 0) text += "  facet normal 0 0 1\n    outer loop\n";
        text += "      vertex " + corners[i] + "\n";
        if (i % 3 == 2) text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a name\n";
}

// Values that lose bits in careless hands, on the corners of one element of each kind.
MeshData hard_mesh() {
    MeshData d;
    d.points = {{0.1, 1e-300, 1 / 3.},
                {123456789.123456789, -0.0, 0.0},
                {4.9e-324, -2.2e-308, 1.7976931348623157e308},
                {1e22, 9007199254740993.0, -1e-5},
                {0.30000000000000004, 5e-324, 1e23},
                {2e0 / 3, 100000, 1e6},
                {1, 2, 3},
                {-1, -2, -3}};
    std::uint64_t random = 7;
    for (int i = 0; i < 300; i++) {
        Vec3 p;
        for (int a = 0; a < 3; a++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            double x;
            std::memcpy(&x, &random, sizeof x);
            if (std::isfinite(x)) p[a] = x;
        }
        d.points.push_back(p);
    }
    d.edges = {0, 307, 307, 0};
    d.triangles = {0, 1, 2, 307, 3, 5};
    d.tets = {3, 2, 1, 0};
    d.hexes = {7, 6, 5, 4, 3, 2, 1, 0};
    return d;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";   // four lines
const std::string kMedit =
    "MeshVersionFormatted 2\nDimension\n3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";   // nine lines

}   // namespace

TEST_CASE("io: obj facets in every form of index") {
    const std::vector<Index> expected = {0, 1, 2};
    for (const char* f : {"1 2 3", "1/9 2/8 3/7", "1//9 2//8 3//7", "1/9/9 2/8/8 3/7/7", "-4 -3 -2", "-4/9 -3/1/2 -2//5",
                          "1 2/5 -2", " +1\t2  3 "}) {
        CAPTURE(f);
        CHECK(read_obj(kSquare + "f " + f, "t").triangles == expected);
    }
    // A negative index counts from the vertices so far, not from all of the file.
    CHECK(read_obj(replaced(kSquare, "v 0 1 0", "f -3 -2 -1\nv 0 1 0"), "t").triangles == expected);
}

TEST_CASE("io: an obj polyline of k vertices is k - 1 edges") {
    CHECK(read_obj(kSquare + "l 1 2\n", "t").edges == std::vector<Index>{0, 1});
    CHECK(read_obj(kSquare + "l 1 -1 3/5 2\nl 4 1\n", "t").edges == std::vector<Index>{0, 3, 3, 2, 2, 1, 3, 0});
}

TEST_CASE("io: an obj dialect does not change the mesh") {
    const std::string plain = kSquare + "f 1 2 3\nf 1 3 4\nl 1 2 3\n";
    const MeshData expected = read_obj(plain, "t");
    CHECK(expected.points[2] == Vec3{1, 1, 0});
    CHECK(expected.triangles == std::vector<Index>{0, 1, 2, 0, 2, 3});
    const std::string other = "# c\nmtllib m.mtl\no cube\ng a b\ns off\nusemtl red\nvt 0 1\nvn 0 0 1\nvp 1\n\n";
    for (const std::string& text :
         {replaced(plain, "\n", "\r\n"), replaced(plain, "\n", "\r"), plain.substr(0, plain.size() - 1),
          replaced(plain, " 0\n", " 0 1.0\n"), replaced(plain, " 0\n", " 0 0.5 0.25 1 # red\n"), replaced(plain, "\n", " \t\n\n"),
          other + plain + other, replaced(plain, "v ", other + " v\t"), "l 1 2 3\nf 1 2 3\nf 1 3 4\n" + kSquare}) {
        CAPTURE(text);
        CHECK(same(read_obj(Exact(text).view(), "t"), expected));
    }
}

TEST_CASE("io: obj errors name the line and what was found") {
    // clang-format off
    check_refused(read_obj, "", {
        {"v", 1, "the end of the file"}, {"v 0 0", 1, "the end of the file"}, {"v 0 0\nv 1 1 1\n", 1, "the end of the line"},
        {"v 0 0 x\n", 1, "'x'"}, {"v 0,5 0 0\n", 1, "'0,5'"}, {"v 0 nan 0\n", 1, "'nan'"}, {"\n\nv inf 0 0\n", 3, "'inf'"},
        {"#\r\nv 0 0 1e999\r\n", 2, "'1e999'"}, {"#\rv 0 0 0x1\r", 2, "'0x1'"}, {"f 1 2 3\n", 1, "3"}});
    check_refused(read_obj, kSquare, {
        {"f\n", 5, "the end of the line"}, {"f 1 2\nf 1 2 3", 5, "the end of the line"}, {"f 1 2 x\n", 5, "'x'"},
        {"f 1.5 2 3\n", 5, "'1.5"}, {"f /1 2 3\n", 5, "/1"}, {"f 0 1 2\n", 5, "0"}, {"\n#\nf 1 2 5\n", 7, "5"},
        {"f 1 2 -5\n", 5, "-5"}, {"f 1 2 2147483648\n", 5, "'2147483648'"}, {"f 1 -2147483648 2\n", 5, "-2147483648"},
        {"v 0 0 0 x\nf 1 2 6\n", 6, "6"}, {"f 1 2 3 4\n", 5, "a polygon with more than three sides"},
        {"l\n", 5, "the end of the line"}, {"l 1\n", 5, "the end of the line"}, {"l 1 5\n", 5, "5"},
        {"l 0 1\n", 5, "0"}, {"l 1 2 x\n", 5, "'x'"}});
    // clang-format on
}

TEST_CASE("io: a medit dialect does not change the mesh") {
    std::string plain = "MeshVersionFormatted 2\nDimension\n3\nVertices\n8\n";
    for (int i = 0; i < 8; i++) plain += point(i & 1, i >> 1 & 1, i >> 2) + " 0\n";
    plain += "Edges\n1\n1 2 0\nTriangles\n2\n1 3 2 0\n2 3 4 0\nTetrahedra\n1\n1 2 3 5 0\nHexahedra\n1\n1 2 4 3 5 6 8 7 0\nEnd\n";
    const MeshData expected = read_medit(plain, "t");
    CHECK(expected.points[3] == Vec3{1, 1, 0});
    CHECK(expected.edges == std::vector<Index>{0, 1});
    CHECK(expected.triangles == std::vector<Index>{0, 2, 1, 1, 2, 3});
    CHECK(expected.tets == std::vector<Index>{0, 1, 2, 4});
    CHECK(expected.hexes == std::vector<Index>{0, 1, 3, 2, 4, 5, 7, 6});
    std::string one_line = replaced(plain, "Dimension\n", "Dimension "), ends = plain, others = plain;
    for (const char* keyword : {"Vertices", "Edges", "Triangles", "Tetrahedra", "Hexahedra"}) {
        one_line = replaced(one_line, std::string(keyword) + "\n", std::string(keyword) + " ");
        ends = replaced(ends, keyword, std::string("End\n\n") + keyword);
        others = replaced(others, keyword,
                          std::string("Corners\n2\n1\n2\nRidges 1\n1\nNormals\n1\n0 -1e-3 +.5\nRequiredVertices\n0\n") + keyword);
    }
    for (const std::string& text :
         {one_line, ends, others, others + "NormalAtVertices\n1\n1 1", replaced(plain, "\n", "\r\n"), replaced(plain, "\n", "\r"),
          replaced(plain, "\nEnd\n", ""), " " + replaced(plain, "\n", "\n "), replaced(plain, "\n", " # c\n\n"),
          replaced(plain, "ted 2", "ted 1"), replaced(plain, "ted 2", "ted\n3"), replaced(plain, " 0\n", " -7\n")}) {
        CAPTURE(text);
        CHECK(same(read_medit(Exact(text).view(), "t"), expected));
    }
}

TEST_CASE("io: medit errors name the line and what was found") {
    // clang-format off
    check_refused(read_medit, "", {
        {"", 1, "the end of the file"}, {"Vertices\n0\n", 1, "'Vertices'"}, {"MeshVersionFormatted x", 1, "'x'"},
        {"\nMeshVersionFormatted 0", 2, "0"}, {"MeshVersionFormatted 5\n", 1, "5"}});
    check_refused(read_medit, "MeshVersionFormatted 2\n", {
        {"Dimension 2\n", 2, "2"}, {"Dimension\n\n2\n", 4, "2"}, {"Dimension\n3", 3, "the end of the file"}, {"]\n", 2, "']'"},
        {"Vertices x\n", 2, "'x'"}, {"Vertices\n-1\n", 3, "-1"}, {"Vertices\n3000000000\n", 3, "3000000000"},
        {"Vertices\n1.0\n", 3, "1.0"}, {"Vertices\n1\n0 0 x 0\n", 4, "'x'"}, {"Vertices\n1\n0 0 0 x\n", 4, "'x'"},
        {"Vertices\n1\n0 inf 0 0\n", 4, "'inf'"}, {"Vertices\r\n2\r\n0 0 0 0\r\nEnd\r\n", 5, "'End'"}});
    check_refused(read_medit, kMedit, {
        {"Triangles\n1\n1 2 5 0\n", 12, "5"}, {"Triangles\n2\n1 2 3 0\n0 1 2 0\n", 13, "0"},
        {"Triangles\n1\n1 2 -1 0\n", 12, "-1"}, {"Triangles\n1\n1 2 x 0\n", 12, "'x'"},
        {"Triangles\n1\n1 2 3\nEnd\n", 13, "'End'"}, {"Triangles\nEnd\n", 11, "'End'"},
        {"Triangles\n1\n1 2 3.0 0\n", 12, "'3.0'"}, {"Edges\n1\n1 9 0\n", 12, "9"}, {"Tetrahedra\n1\n1 2\n3 6 0", 13, "6"},
        {"Hexahedra 1\n1 2 3 4 5 1 2 3 0\n", 11, "5"}, {"Triangles\n2\n1 2 3 0\n4 1 2 0\n1 2 3 0\n", 14, "'1'"},
        {"Triangles\n2\n1 2 3 0", 12, "the end of the file"}});
    // clang-format on
}

TEST_CASE("io: a reader that goes line by line understands medit files") {
    const struct {
        const char* keyword;
        std::size_t columns;   // besides the reference
        std::vector<Index> MeshData::*list;
    } kinds[] = {{"Vertices", 3, nullptr},
                 {"Edges", 2, &MeshData::edges},
                 {"Triangles", 3, &MeshData::triangles},
                 {"Tetrahedra", 4, &MeshData::tets},
                 {"Hexahedra", 8, &MeshData::hexes}};
    const std::string header = "MeshVersionFormatted 2\nDimension\n3\n", text = medit_text(hard_mesh());
    REQUIRE(text.compare(0, header.size(), header) == 0);
    std::istringstream in(text.substr(header.size()));
    MeshData got;
    std::string line;
    for (const auto& kind : kinds) {
        std::getline(in, line);
        REQUIRE(line == kind.keyword);   // alone on its line
        std::getline(in, line);
        const std::size_t count = std::stoul(line);
        REQUIRE(line == std::to_string(count));   // alone too
        for (std::size_t i = 0; i < count; i++) {
            std::getline(in, line);
            std::istringstream words(line);
            std::vector<double> element;
            for (double x; words >> x;) element.push_back(x);
            REQUIRE(words.eof());
            REQUIRE(element.size() == kind.columns + 1);   // neither less nor more of it on the line
            if (!kind.list) got.points.push_back({element[0], element[1], element[2]});
            for (std::size_t k = 0; kind.list && k < kind.columns; k++)
                (got.*kind.list).push_back(static_cast<Index>(element[k]) - 1);
        }
    }
    CHECK((std::getline(in, line) && line == "End"));
    CHECK(same(got, hard_mesh()));
}

TEST_CASE("io: stl corners with the same coordinates are one vertex, numbered by first appearance") {
    // Two triangles of a square; zeros of both signs are the same number, the nearest other number is another.
    const std::vector<Vec3> points = {{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 1, 0}};
    const std::vector<Index> triangles = {0, 1, 2, 2, 1, 3};
    const std::string text = ascii_stl({"1 0 0", "1 1 0", "0 0 0", "-0 0.0 -0e0", "1e0 +1 -0", "0 1 0"});
    const std::string bytes = binary_stl("binary", 2, {1, 0, 0, 1, 1, 0, 0, 0, 0, -0.f, 0, -0.f, 1, 1, -0.f, 0, 1, 0});
    for (const std::string& file : {text, replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"), replaced(text, "a name", ""),
                                    text.substr(0, text.size() - 1), replaced(text, "0 0 1", "nan nan nan"), " \n" + text, bytes,
                                    "solid" + bytes.substr(5)}) {
        CAPTURE(file);
        const MeshData d = read_stl(Exact(file).view(), "t");
        CHECK(d.points == points);
        CHECK(d.triangles == triangles);
        CHECK(d.edges.empty());
    }
    CHECK(read_stl(ascii_stl({"1 0 0", "1.0000000000000002 0 0", "0 0 0"}), "t").points.size() == 3);
    // Many corners, by hand: a strip in which triangle i has the vertices i, i + 1, i + 2.
    std::vector<float> strip;
    for (int i = 0; i < 2000; i++)
        for (int k = i; k < i + 3; k++)
            strip.insert(strip.end(), {static_cast<float>(k) * 0.1f, static_cast<float>(k % 2), -1e-40f});
    const MeshData d = read_stl(binary_stl("", 2000, strip), "t");
    REQUIRE(d.points.size() == 2002);
    for (Index i = 0; i < 6000; i++) REQUIRE(d.triangles[i] == i / 3 + i % 3);
    CHECK(d.points[1234] == Vec3{static_cast<double>(1234 * 0.1f), 0, static_cast<double>(-1e-40f)});
}

TEST_CASE("io: stl errors name the line or the facet") {
    // clang-format off
    check_refused(read_stl, "solid a b\n", {
        {"facets", 2, "'facets'"}, {"facet norm 0 0 1", 2, "'norm'"}, {"facet normal 0 0\nouter loop\n", 3, "'loop'"},
        {"outer loop\r\n", 2, "'outer'"}, {"\r\nendfacet\r\n", 3, "'endfacet'"}});
    check_refused(read_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", {
        {"vertex 0 0 x\n", 6, "'x'"}, {"vertex 0 0 1e999\n", 6, "'1e999'"}, {"vertex 0 0 nan\n", 6, "'nan'"},
        {"vertex 0 0\nendloop\n", 7, "'endloop'"}, {"endloop\n", 6, "'endloop'"}, {"vertex 0 1 0\nvertex 1 1 0\n", 7, "'vertex'"},
        {"vertex 0 1 0\nendloop\nendsolid", 8, "'endsolid'"}});
    // clang-format on
    const std::string infinite = binary_stl("", 2, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, INFINITY});
    CHECK(error_of([&] { read_stl(infinite, "t"); }).find("t: facet 1: expected ") == 0);
    for (const std::string& file : {std::string(), std::string("facet"), std::string(200, '\0'), binary_stl("", 0, {}) + "x",
                                    binary_stl("", 0xffffffffu, {})})
        CHECK(error_of([&] { read_stl(Exact(file).view(), "t"); }).find("t: expected ") == 0);
}

TEST_CASE("io: what is written is read again bit for bit") {
    const fs::path dir = fs::path(POLYLAB_BUILD_DIR) / ("test_io." + std::to_string(::getpid()));
    fs::create_directories(dir);
    MeshData d = hard_mesh();
    for (const char* name : {"a.mesh", "a.b.MESH", "a.obj", "a.Obj"}) {
        CAPTURE(name);
        const std::string path = (dir / name).string();
        const bool medit = std::strchr(name, 'm') || std::strchr(name, 'M');
        if (!medit) d.tets = d.hexes = {};   // obj has no room for them
        write_mesh(path, d);
        const std::string first = read_file(path);
        const MeshData got = read_mesh(path);
        CHECK(same(got, d));
        CHECK(first == (medit ? medit_text(got) : obj_text(got)));
    }
    std::ofstream((dir / "a.STL").string(), std::ios::binary) << binary_stl("", 1, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    CHECK(read_mesh((dir / "a.STL").string()).triangles == std::vector<Index>{0, 1, 2});
    write_file((dir / "labels").string(), "0 1\n5");
    CHECK(read_labels((dir / "labels").string(), 3) == Labeling{0, 1, 5});
    for (const char* name : {"none.obj", "none.mesh", "none.stl", "a.txt", "obj", ".me", "", "a.obj.gz"}) {
        const std::string path = name[0] ? (dir / name).string() : "";
        CHECK(error_of([&] { read_mesh(path); }).find(path + ": ") == 0);
    }
    for (const char* name : {"a.stl", "a.vtk", "a"})
        CHECK(error_of([&] { write_mesh((dir / name).string(), d); }).find((dir / name).string() + ": ") == 0);
    CHECK_FALSE(fs::exists(dir / "a.stl"));
    fs::remove_all(dir);
}

TEST_CASE("io: a built mesh is written as it is turned now, with the feature edges it kept") {
    // A tetrahedron whose second facet is turned inward. Its edges are sharp: 0-1 and 3-2 are kept, 0-4 is not on it.
    const MeshData d =
        read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 5 5\nf 1 3 2\nf 1 4 2\nf 2 3 4\nf 1 4 3\nl 1 2\nl 1 5\nl 4 3\n", "t");
    const TriMesh mesh = build_mesh(d);
    const MeshData out = mesh_data(mesh);
    CHECK(out.triangles == std::vector<Index>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
    CHECK(out.points == d.points);
    const TriMesh again = build_mesh(read_obj(obj_text(out), "t"));
    CHECK(mesh.turned_facets == 1);
    CHECK(again.turned_facets == 0);
    CHECK(again.features_given == 2);
    CHECK(again.features_off == 0);
    CHECK(again.feature == mesh.feature);
}

TEST_CASE("io: a cut obj file is refused, or is the shorter file that ends there") {
    const std::string text =
        "# c\nv 0 0 0\nv 1 0 0 1\nv 0 -1 0 .5 1 1\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/3\nf -3//1 -2/1/1 -1\nl 1 2 -1\n";
    const MeshData whole = read_obj(text, "t");
    check_cuts(read_obj, text, [&](std::size_t cut) -> std::unique_ptr<MeshData> {
        // All of its numbers have one digit: a cut line is complete if it has its tokens and does not end with a sign.
        std::istringstream lines(text.substr(0, cut));
        std::size_t points = 0, facets = 0, edges = 0;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string keyword;
            std::size_t n = 0;
            words >> keyword;
            for (std::string word; words >> word; n++)
                if (word == "-") return nullptr;
            if ((keyword == "v" || keyword == "f") && n < 3) return nullptr;
            if (keyword == "l" && n < 2) return nullptr;
            points += keyword == "v";
            facets += keyword == "f";
            if (keyword == "l") edges += n - 1;
        }
        auto part = std::make_unique<MeshData>(whole);
        part->points.resize(points);
        part->triangles.resize(3 * facets);
        part->edges.resize(2 * edges);
        return part;
    });
}

TEST_CASE("io: a cut medit file is refused, or ends between its blocks") {
    const struct {
        const char* text;
        std::vector<Index> MeshData::*list;
    } blocks[] = {{"MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n", nullptr},
                  {"Edges\n2\n1 2 0\n3 4 0\n", &MeshData::edges},
                  {"Triangles 1\n1 2 3 0\n", &MeshData::triangles},
                  {"Tetrahedra\n1\n1 2 3 4 0\n", &MeshData::tets},
                  {"Hexahedra\n1\n1 2 3 4 1 2 3 4 0\n", &MeshData::hexes}};
    std::string text;
    for (const auto& block : blocks) text += block.text;
    const MeshData whole = read_medit(text, "t");
    check_cuts(read_medit, text, [&](std::size_t cut) -> std::unique_ptr<MeshData> {
        auto part = std::make_unique<MeshData>();
        part->points = whole.points;
        std::size_t begin = 0;
        for (const auto& block : blocks) {
            const std::size_t end = begin + std::strlen(block.text), word = std::strcspn(block.text, " \n");
            const bool complete = cut + 1 >= end;   // without the last line end
            if (!complete && !block.list) return nullptr;
            if (!complete && cut >= begin + word) return nullptr;   // half a keyword is a block that means nothing
            if (complete && block.list) part.get()->*block.list = whole.*block.list;
            begin = end;
        }
        return part;
    });
}

TEST_CASE("io: every cut stl file is refused") {
    const std::string text = ascii_stl({"0 0 0", "1 0 0", "0 1 0", "0 1 0", "1 0 0", "1 1 0"});
    const MeshData whole = read_stl(text, "t");
    check_cuts(read_stl, text, [&](std::size_t cut) {   // the name after endsolid says nothing
        return text.substr(0, cut).find("endsolid") == std::string::npos ? nullptr : std::make_unique<MeshData>(whole);
    });
    const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
    for (const char* header : {"binary", "solid", "solid x\n"})   // some programs begin their binary files so
        check_cuts(read_stl, binary_stl(header, 2, corners), [](std::size_t) { return nullptr; });
}

TEST_CASE("io: a changed byte is an error or another mesh with its indices in range") {
    const std::string obj = kSquare + "f 1 2 3\nf -1/1/1 2 3//1\nl 1 2 4\n",
                      medit = kMedit + "Triangles\n1\n1 2 3 0\nTetrahedra 1\n1 2 3 4 0\nEnd\n";
    const std::string stl = ascii_stl({"0 0 0", "1 0 0", "0 1 0"}), binary = binary_stl("solid", 1, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    const struct {
        Reader read;
        const std::string& text;
    } files[] = {{read_obj, obj}, {read_medit, medit}, {read_stl, stl}, {read_stl, binary}};
    for (const auto& file : files) {
        int refused = 0;
        for (std::size_t at = 0; at < file.text.size(); at++)
            for (const char c : {'\0', '\n', '\r', ' ', '#', '-', '.', '/', '0', '9', 'e', 'n', 'v', '\x7f', '\xff'}) {
                std::string text = file.text;
                text[at] = c;
                CAPTURE(text);
                MeshData d;
                refused += error_of([&] { d = file.read(Exact(text).view(), "t"); }) != "no error";
                REQUIRE(in_range(d));
            }
        CHECK(refused > 0);
    }
}

TEST_CASE("io: memory is reserved by the size of the file, not by a count in it") {
    const auto peak = [] {   // largest size of the address space so far, in KiB; 0 where the system does not tell
        std::ifstream in("/proc/self/status");
        for (std::string word; in >> word;)
            if (word == "VmPeak:" && in >> word) return std::stoll(word);
        return 0LL;
    };
    const long long before = peak();
    const std::string head = "MeshVersionFormatted 2\n";
    for (const char* count : {"100000000", "268435455", "715827882", "2147483647"}) {
        CHECK(error_of([&] { read_medit(head + "Vertices\n" + count + "\n", "t"); }).find("t:") == 0);
        for (const char* keyword : {"Edges", "Triangles", "Tetrahedra", "Hexahedra"})
            CHECK(error_of([&] { read_medit(kMedit + keyword + " " + count + "\n1 2", "t"); }).find("t:") == 0);
        CHECK(error_of([&] { read_labels_text("0 0", "t", std::stoi(count)); }).find("t:") == 0);
    }
    CHECK(error_of([&] { read_stl(binary_stl("", 0x7fffffffu, {}), "t"); }).find("t: ") == 0);
    CHECK(peak() - before < 100000);
}

TEST_CASE("io: labels are as many as facets, and within range") {
    CHECK(read_labels_text(" 0 1\t2\n\n3 # c\r\n4\r5", "t", 6) == Labeling{0, 1, 2, 3, 4, 5});
    CHECK(read_labels_text("", "t", 0).empty());
    CHECK(read_labels_text("-1\n5\n", "t", 2, true) == Labeling{kNoLabel, 5});
    CHECK(labels_text({0, 5, kNoLabel}) == "0\n5\n-1\n");
    const Labeling all = {5, 4, 3, 2, 1, 0};
    const std::string text = labels_text(all);
    CHECK(read_labels_text(text, "t", 6) == all);
    const Bad table[] = {{"0\n1\nx\n", 3, "'x'"},
                         {"0\n\n6\n0", 3, "6"},
                         {"-1\n0\n0", 1, "-1"},
                         {"0 1 2 3", 1, ""},
                         {"0\r\n1\r\n2\r\n\r\n3\r\n", 5, ""},
                         {"0\n1.0\n", 2, "1.0"},
                         {"0\n256\n0", 2, "256"},
                         {"0\n99999999999\n", 2, "99999999999"},
                         {"0 1,2 0", 1, "1,2"}};
    for (const Bad& bad : table) {
        CAPTURE(bad.text);
        check_error(error_of([&] { read_labels_text(Exact(bad.text).view(), "t", 3); }), bad.line, bad.found);
    }
    check_error(error_of([] { read_labels_text("-1 -2", "t", 2, true); }), 1, "-2");
    CHECK(error_of([] { read_labels_text("", "t", 1); }).find("t:") == 0);
    for (std::size_t cut = 0; cut < text.size(); cut++) {   // one digit each: complete once the sixth is there
        const std::string error = error_of([&] { read_labels_text(Exact(text.substr(0, cut)).view(), "t", 6); });
        CAPTURE(error);
        CHECK((error == "no error") == (cut + 1 == text.size()));
        if (cut + 1 < text.size()) CHECK(error.find("found " + std::to_string((cut + 1) / 2)) != std::string::npos);
    }
}

TEST_CASE("io: quadrilaterals are refused, an empty block of them is not") {
    const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nQuadrilaterals\n";
    CHECK(read_medit(head + "0\nEnd\n", "q.mesh").points.size() == 1);
    CHECK(error_of([&] { read_medit(head + "1\n1 1 1 1 0\nEnd\n", "q.mesh"); }) ==
          "q.mesh:7: expected triangles, found 'Quadrilaterals'");
}

TEST_CASE("io: no locale changes a file") {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    MeshData d = hard_mesh();
    const std::string stl = ascii_stl({"0.5 0 0", "1 0 0", "0 1000.25 0"}), medit = medit_text(d);
    d.tets = d.hexes = {};
    const std::string obj = obj_text(d);
    const MeshData welded = read_stl(stl, "t");
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));   // for C++ streams
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", ""})                // for C, where one is installed
        if (std::setlocale(LC_ALL, name) && *std::localeconv()->decimal_point == ',') break;
    const bool equal = medit_text(hard_mesh()) == medit && obj_text(d) == obj && same(read_stl(stl, "t"), welded) &&
                       same(read_obj(obj, "t"), d) && same(read_medit(medit, "t"), hard_mesh());
    const Labeling labels = read_labels_text(labels_text(Labeling(1200, 3)), "t", 1200);
    const std::string count = error_of([] { read_labels_text(labels_text(Labeling(1200, 3)), "t", 1201); });
    std::locale::global(before);
    std::setlocale(LC_ALL, "C");
    CHECK(equal);
    CHECK(labels.size() == 1200);
    CHECK(count.find("found 1200") != std::string::npos);
}

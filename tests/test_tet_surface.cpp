// From tetrahedra to their surface, and from labels of the surface back to the tetrahedra.
#include "polylab/tet_surface.h"

#include "polylab/text.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

using namespace polylab;

namespace {

constexpr Index kFacet[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {0, 2, 1}};   // the table of tet_surface.h

MeshData one_tet() {
    MeshData d;
    d.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    d.tets = {0, 1, 2, 3};
    return d;
}

// A second tetrahedron on the facet 1 2 3 of the first; it lies at its own vertex 3.
MeshData two_tets() {
    MeshData d = one_tet();
    d.points.push_back({1, 1, 1});
    d.tets.insert(d.tets.end(), {1, 2, 3, 4});
    return d;
}

// n * n * n cubes of six tetrahedra each: along every monotone path of edges from the low to the high corner of a cube.
MeshData block(Index n) {
    MeshData d;
    const auto vertex = [&](const std::array<Index, 3>& p) { return p[0] + (n + 1) * (p[1] + (n + 1) * p[2]); };
    for (Index z = 0; z <= n; z++)
        for (Index y = 0; y <= n; y++)
            for (Index x = 0; x <= n; x++) d.points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    for (Index cube = 0; cube < n * n * n; cube++) {
        std::array<int, 3> axes = {0, 1, 2};
        do {
            std::array<Index, 3> p = {cube % n, cube / n % n, cube / n / n};
            std::array<Index, 4> tet = {vertex(p)};
            for (std::size_t i = 0; i < 3; i++) {
                p[static_cast<std::size_t>(axes[i])]++;
                tet[i + 1] = vertex(p);
            }
            if ((axes[1] - axes[0] + 3) % 3 != 1) std::swap(tet[1], tet[2]);   // an odd permutation: positive volume
            d.tets.insert(d.tets.end(), tet.begin(), tet.end());
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
    return d;
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

// The text in a heap block of exactly its size, so that a sanitizer sees every read beyond it.
SurfaceMap read(const std::string& text) {
    const std::unique_ptr<char[]> exact(new char[text.size()]);
    if (!text.empty()) std::memcpy(exact.get(), text.data(), text.size());
    return read_surface_map_text({exact.get(), text.size()}, "t");
}

bool same(const SurfaceMap& a, const SurfaceMap& b) { return a.tets == b.tets && a.tet_facet == b.tet_facet; }

}   // namespace

TEST_CASE("tet surface: one tetrahedron has its four facets, each opposite to its vertex, seen from outside") {
    const MeshData d = one_tet();
    const TetSurface s = extract_surface(d);
    CHECK(s.map.tets == 1);
    CHECK(s.map.tet_facet == std::vector<Index>{0, 1, 2, 3});
    CHECK(s.surface.points == d.points);
    REQUIRE(s.surface.triangles.size() == 12);
    for (Index k = 0; k < 4; k++) {
        CHECK(std::equal(kFacet[k], kFacet[k] + 3, &s.surface.triangles[3 * k]));
        const Vec3 &a = d.points[kFacet[k][0]], &b = d.points[kFacet[k][1]], &c = d.points[kFacet[k][2]];
        CHECK(dot(cross(b - a, c - a), d.points[k] - a) < 0);   // vertex k is behind facet k
    }
    CHECK(build_mesh(s.surface).turned_facets == 0);
}

TEST_CASE("tet surface: the facet between two tetrahedra is not on it") {
    const TetSurface s = extract_surface(two_tets());
    // The shared facet is 0 of the first and, opposite to its vertex 3 which is 4, facet 3 of the second.
    CHECK(s.map.tets == 2);
    CHECK(s.map.tet_facet == std::vector<Index>{1, 2, 3, 4, 5, 6});
    CHECK(s.surface.triangles == std::vector<Index>{0, 3, 2, 3, 0, 1, 0, 2, 1, 2, 3, 4, 1, 4, 3, 4, 1, 2});
    CHECK(build_mesh(s.surface).turned_facets == 0);
    // Whatever the order of the vertices in the second one.
    MeshData d = two_tets();
    std::sort(d.tets.begin() + 4, d.tets.end());
    do {
        const TetSurface turned = extract_surface(d);
        REQUIRE(turned.map.tet_facet.size() == 6);
        for (Index i = 3; i < 6; i++) REQUIRE(d.tets[turned.map.tet_facet[i]] != 4);   // opposite to 4 is the shared one
    } while (std::next_permutation(d.tets.begin() + 4, d.tets.end()));
}

TEST_CASE("tet surface: inner and unused vertices are dropped, the others keep their order") {
    // A vertex (1) inside of a tetrahedron (0 2 4 5) cuts it into four; nothing uses vertex 3.
    MeshData d;
    d.points = {{0, 0, 0}, {1, 1, 1}, {9, 0, 0}, {5, 5, 5}, {0, 9, 0}, {0, 0, 9}};
    d.tets = {1, 2, 4, 5, 0, 1, 4, 5, 0, 2, 1, 5, 0, 2, 4, 1};
    d.edges = {0, 2, 2, 1, 5, 4, 3, 0, 1, 3, 4, 0};
    const TetSurface s = extract_surface(d);
    CHECK(s.surface.points == std::vector<Vec3>{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}});
    CHECK(s.map.tet_facet == std::vector<Index>{0, 5, 10, 15});   // each facet is opposite to the inner vertex
    CHECK(s.surface.triangles == std::vector<Index>{1, 2, 3, 0, 3, 2, 3, 0, 1, 0, 2, 1});
    CHECK(s.surface.edges == std::vector<Index>{0, 1, 3, 2, 2, 0});   // without those that end at 1 or 3
    CHECK(s.surface.tets.empty());
    CHECK(s.surface.hexes.empty());
}

TEST_CASE("tet surface: a block of n^3 cubes has 12 n^2 triangles on 6 n^2 + 2 vertices, all outward") {
    for (const Index n : {1, 2, 3}) {
        const MeshData d = block(n);
        const TetSurface s = extract_surface(d);
        CHECK(s.surface.triangles.size() == 3 * 12 * n * n);
        CHECK(s.surface.points.size() == 6 * n * n + 2);
        const auto& ids = s.map.tet_facet;
        CHECK(std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<Index>()) == ids.end());   // strictly increasing
        const TriMesh mesh = build_mesh(s.surface);
        CHECK(mesh.turned_facets == 0);
        CHECK(mesh.components == 1);
        CHECK(mesh.isolated_vertices == 0);
        // Each side of the block gets its label, through the map and back.
        Labeling labels;
        for (const Vec3& normal : mesh.normal)
            for (Label l = 0; l < kLabels; l++)
                if (along(normal, l) > 0.5) labels.push_back(l);
        const Labeling volume = volume_labels(labels, read(surface_map_text(s.map)));
        REQUIRE(volume.size() == d.tets.size());
        Index labeled = 0;
        for (Index id = 0; id < static_cast<Index>(volume.size()); id++) {
            Vec3 middle;
            for (const Index k : kFacet[id % 4]) middle += d.points[d.tets[id - id % 4 + k]] * (1 / 3.);
            Label expected = kNoLabel;
            for (Label l = 0; l < kLabels; l++)
                if (std::abs(middle[axis(l)] - (l % 2 == 0 ? n : 0)) < 1e-9) expected = l;
            REQUIRE(volume[id] == expected);
            labeled += volume[id] != kNoLabel;
        }
        CHECK(labeled == 12 * n * n);
    }
}

TEST_CASE("tet surface: what has no surface is an error that names the tetrahedra") {
    const auto error = [](const MeshData& d) { return error_of([&] { extract_surface(d); }); };
    CHECK(error(MeshData()).find("expected tetrahedra, found") == 0);
    MeshData d = two_tets();
    d.points.push_back({2, 2, 2});
    d.tets.insert(d.tets.end(), {5, 3, 2, 1});   // the third at the facet 1 2 3
    CHECK(error(d).find("tetrahedra 0, 1 and 2: expected two ") == 0);
    const struct {
        Index vertex;
        const char* message;
    } table[] = {
        {1, "tetrahedron 1: expected "}, {-1, "tetrahedron 1: expected "}, {5, "tetrahedron 1: expected "}, {4, "no error"}};
    for (const auto& row : table) {
        d = two_tets();
        d.tets[7] = row.vertex;   // 1 is there already, -1 and 5 are no vertices
        CHECK(error(d).find(row.message) == 0);
    }
}

TEST_CASE("tet surface: volume labels are at 4 * tetrahedron + k, and none inside") {
    const SurfaceMap map = extract_surface(two_tets()).map;
    CHECK(volume_labels({0, 1, 2, 3, 4, 5}, map) == Labeling{kNoLabel, 0, 1, 2, 3, 4, 5, kNoLabel});
    for (const std::size_t size : {0u, 5u, 7u}) {
        const std::string error = error_of([&] { volume_labels(Labeling(size, 0), map); });
        CHECK(error.find("expected 6 labels") == 0);
        CHECK(error.find("found " + std::to_string(size)) != std::string::npos);
    }
}

TEST_CASE("tet surface: a surface map is read as it was written") {
    const SurfaceMap map = extract_surface(two_tets()).map;
    const std::string text = "6 triangles\n2 tetrahedra\n1\n2\n3\n4\n5\n6\n";
    CHECK(surface_map_text(map) == text);
    CHECK(same(read(text), map));
    CHECK(same(read("6 triangles 2 tetrahedra\r1 2 3\r\n4 5 6 # c"), map));
    const SurfaceMap large = {536870911, {0, 7, 2147483643}};   // the most tetrahedra that the numbers allow
    CHECK(same(read(surface_map_text(large)), large));
    const auto file = std::filesystem::path(POLYLAB_BUILD_DIR) / ("test_tet_surface." + std::to_string(::getpid()));
    write_file(file.string(), text);
    CHECK(same(read_surface_map(file.string()), map));
    std::filesystem::remove(file);
    CHECK(error_of([&] { read_surface_map(file.string()); }).find(file.string() + ": ") == 0);
    // Each number has one digit: only the cut that takes the last line end leaves a map.
    for (std::size_t cut = 0; cut < text.size(); cut++) {
        const std::string error = error_of([&] { read(text.substr(0, cut)); });
        CAPTURE(cut);
        CHECK((error == "no error") == (cut + 1 == text.size()));
    }
}

TEST_CASE("tet surface: errors in a surface map name the line and what was found") {
    const std::string head = "2 triangles\n1 tetrahedra\n";
    const struct {
        std::string text;
        Index line;
        const char* found;
    } table[] = {
        {"", 1, "the end of the file"},
        {"x triangles\n", 1, "'x'"},
        {"-1 triangles\n1 tetrahedra\n", 1, "-1"},
        {"2 facets\n", 1, "'facets'"},
        {"2 triangles\n\n1 hexahedra\n", 3, "'hexahedra'"},
        {"2 tetrahedra\n1 triangles\n", 1, "'tetrahedra'"},
        {"0 triangles\n-1 tetrahedra", 2, "-1"},
        {"0 triangles\n600000000 tetrahedra\n", 2, "600000000"},
        {"0 triangles\n99999999999 tetrahedra\n", 2, "'99999999999'"},
        {"2000000000 triangles\n1 tetrahedra\n0", 0, ""},
        {"500000000 triangles\n500000000 tetrahedra\n0\n1", 4, "the end of the file"},
        {head + "0\nx\n", 4, "'x'"},
        {head + "0\n4\n", 4, "4"},
        {head + "-1\n0\n", 3, "-1"},
        {head + "0\n1.0\n", 4, "1.0"},
        {head + "0\n\n1\n2\n", 6, ""},
        {head + "0\r1\r#\rx", 6, ""},
        {head + "0", 3, "the end of the file"},
        {head + "1\n1\n", 4, "1"},
        {head + "2\n1\n", 4, "1"},   // not increasing
    };
    for (const auto& bad : table) {
        CAPTURE(bad.text);
        const std::string error = error_of([&] { read(bad.text); });
        CAPTURE(error);
        CHECK(error.find(bad.line > 0 ? "t:" + std::to_string(bad.line) + ": expected " : "t:") == 0);
        const std::size_t at = error.find(", found ");
        CHECK((at != std::string::npos && error.find(bad.found, at) != std::string::npos));
        CHECK(error.find('\n') == std::string::npos);
    }
}

TEST_CASE("tet surface: feature edges out of range are refused") {
    MeshData data;
    data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    data.tets = {0, 1, 2, 3};
    data.edges = {0, 4};   // vertices are 0..3
    CHECK_THROWS_AS(extract_surface(data), InputError);
}

TEST_CASE("tet surface: memory is reserved by the size of the map, not by a count in it") {
    const auto peak = [] {   // largest size of the address space so far, in KiB; 0 where the system does not tell
        std::ifstream in("/proc/self/status");
        for (std::string word; in >> word;)
            if (word == "VmPeak:" && in >> word) return std::stoll(word);
        return 0LL;
    };
    const long long before = peak();
    CHECK(error_of([] { read("536870911 triangles\n536870911 tetrahedra\n0\n"); }).find("t:") == 0);
    CHECK(peak() - before < 100000);
}

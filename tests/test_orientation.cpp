#include "polylab/orientation.h"

#include "polylab/labels.h"
#include "polylab/mesh.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <utility>

using namespace polylab;
using shapes::append;
using shapes::cube;
using shapes::joined;
using shapes::moved;
using shapes::scaled;
using shapes::turned;

namespace {

// A cube whose side is `size`, its lower corner at (at, at, at).
MeshData cube_at(double at, double size, int n = 1) { return moved(scaled(cube(n), size / n), {at, at, at}); }

// What a right orientation looks like: `expected` has every facet as it should be.
void check_becomes(const MeshData& data, const MeshData& expected, Index components, Index cavities, Index turned_components) {
    const TriMesh mesh = build_mesh(data);
    validate(mesh);
    CHECK(mesh.origin == expected.triangles);
    CHECK(mesh.components == components);
    CHECK(mesh.cavities == cavities);
    CHECK(mesh.turned_components == turned_components);
    // Once right, nothing is turned any more.
    const Orientation again = orient(mesh.points, mesh.origin, mesh.opposite);
    CHECK(again.turn == std::vector<char>(mesh.facets(), 0));
    CHECK(again.components == components);
    CHECK(again.cavities == cavities);
    CHECK(again.turned_components == 0);
}

}   // namespace

TEST_CASE("orientation: an inward cube is turned") {
    check_becomes(cube(2), cube(2), 1, 0, 0);
    check_becomes(turned(cube(2)), cube(2), 1, 0, 1);
    const TriMesh mesh = build_mesh(turned(cube(2)));
    CHECK(mesh.turned_facets == 48);
    for (Index f = 0; f < mesh.facets(); f++) CHECK(mesh.normal[f] == direction(static_cast<Label>(f / 8)));
}

TEST_CASE("orientation: each component is judged alone") {
    const MeshData right = joined(cube(1), cube_at(5, 2));
    check_becomes(right, right, 2, 0, 0);
    check_becomes(joined(cube(1), turned(cube_at(5, 2))), right, 2, 0, 1);
    check_becomes(joined(turned(cube(1)), cube_at(5, 2)), right, 2, 0, 1);
    check_becomes(turned(right), right, 2, 0, 2);
    // Some facets of both: no component as a whole.
    std::vector<char> turn(24, 0);
    turn[0] = turn[5] = turn[23] = 1;
    check_becomes(turned(right, turn), right, 2, 0, 0);
}

TEST_CASE("orientation: the shell of a cavity faces inward") {
    const MeshData right = joined(cube_at(0, 5), turned(cube_at(2, 1)));
    check_becomes(right, right, 2, 1, 0);
    check_becomes(joined(cube_at(0, 5), cube_at(2, 1)), right, 2, 1, 1);
    check_becomes(turned(right), right, 2, 1, 2);
    const MeshData inner_first = joined(turned(cube_at(2, 1)), cube_at(0, 5));
    check_becomes(joined(cube_at(2, 1), cube_at(0, 5)), inner_first, 2, 1, 1);
    const TriMesh mesh = build_mesh(right);
    for (Index f = 0; f < 12; f++) CHECK(mesh.normal[12 + f] == -direction(static_cast<Label>(f / 2)));
}

TEST_CASE("orientation: shells inside of shells alternate") {
    const MeshData shells[] = {cube_at(0, 9), turned(cube_at(1, 7)), cube_at(2, 5), turned(cube_at(3, 3))};
    const int orders[][4] = {{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}};
    for (const auto& order : orders) {
        MeshData right, all_outward;
        for (const int i : order) {
            append(right, shells[i]);
            append(all_outward, i % 2 == 0 ? shells[i] : turned(shells[i]));
        }
        check_becomes(right, right, 4, 2, 0);
        check_becomes(all_outward, right, 4, 2, 2);
    }
    // Two cavities side by side, an island in one of them, and a part outside.
    MeshData right = joined(moved(shapes::box(20, 10, 10), {}), turned(cube_at(1, 5)));
    append(right, turned(moved(cube(3), {12, 4, 4})));
    append(right, cube_at(2, 1));
    append(right, moved(cube(1), {25, 0, 0}));
    check_becomes(right, right, 5, 2, 0);
    check_becomes(turned(right), right, 5, 2, 5);
}

TEST_CASE("orientation: rays through vertices and edges of the container are counted right") {
    // The facets' centres of the inner cube (side 3) have integer coordinates: rays along X meet grid vertices and
    // diagonals of the outer cube, wherever the inner one is.
    const MeshData outer = cube(8);
    for (int i = 0; i < 64; i++) {
        const Vec3 at = {double(1 + i % 4), double(1 + i / 4 % 4), double(1 + i / 16)};
        const MeshData inner = moved(scaled(cube(1), 3), at);
        CAPTURE(i);
        check_becomes(joined(outer, inner), joined(outer, turned(inner)), 2, 1, 1);
    }
    // Sides that lean to all directions: |x| + |y| + |z| < 24, in 4^3 facets per side.
    MeshData lean = scaled(shapes::octahedron(), 3);
    for (int i = 0; i < 3; i++) lean = shapes::refined(lean);
    for (int i = 0; i < 64; i++) {
        const Vec3 at = {double(3 * (i % 4) - 6), double(3 * (i / 4 % 4) - 6), double(3 * (i / 16) - 6)};
        const MeshData inner = moved(scaled(cube(1), 3), at);   // farthest corner: 6 + 6 + 6
        CAPTURE(i);
        check_becomes(joined(inner, lean), joined(turned(inner), lean), 2, 1, 1);
    }
}

TEST_CASE("orientation: a part in a notch or a hole is no cavity, though its box is inside") {
    const MeshData notch = joined(scaled(shapes::l_shape(), 4), moved(cube(2), {5, 5, 1}));
    check_becomes(notch, notch, 2, 0, 0);
    check_becomes(turned(notch), notch, 2, 0, 2);
    const MeshData hole = joined(scaled(shapes::frame(), 4), moved(cube(2), {5, 5, 1}));
    check_becomes(hole, hole, 2, 0, 0);
    check_becomes(turned(hole), hole, 2, 0, 2);
}

TEST_CASE("orientation: a part that fills a notch or a hole is no cavity") {
    // Its sides lie in those of the other part, as in an assembly: pin and plate.
    shapes::Lcg random(3);
    const MeshData plugs[] = {joined(shapes::frame(), moved(cube(1), {1, 1, 0})),
                              joined(scaled(shapes::frame(), 3), moved(cube(3), {3, 3, 0})),
                              joined(scaled(shapes::frame(), 3), moved(shapes::box(3, 3, 2), {3, 3, 1})),
                              joined(shapes::l_shape(), moved(cube(1), {1, 1, 0}))};
    for (const MeshData& right : plugs)
        for (int i = 0; i < 24; i++) {
            CAPTURE(i);
            const MeshData data = shapes::renumbered(shapes::rotated_axes(right, i).data, random).data;
            check_becomes(data, data, 2, 0, 0);
            check_becomes(turned(data), data, 2, 0, 2);
        }
}

TEST_CASE("orientation: a part given twice is not inside of itself") {
    shapes::Lcg random(16);
    for (int i = 0; i < 20; i++) {
        CAPTURE(i);
        const MeshData data = shapes::renumbered(joined(cube(1), cube(1)), random).data;
        check_becomes(data, data, 2, 0, 0);
    }
}

TEST_CASE("orientation: a cavity may touch the wall") {
    // The inner box has one side in a side of the outer cube.
    const MeshData outer = cube(6), inner = turned(moved(cube(2), {0, 2, 2}));
    for (const MeshData& data : {joined(outer, inner), joined(inner, outer)})
        for (int i = 0; i < 24; i++) {
            CAPTURE(i);
            const MeshData right = shapes::rotated_axes(data, i).data;
            check_becomes(right, right, 2, 1, 0);
            check_becomes(turned(right), right, 2, 1, 2);
        }
}

TEST_CASE("orientation: thousands of components") {
    // A big box of many facets, and in it a lattice of small cubes: as many along X as across, then all in one layer.
    const int sizes[][3] = {{20, 20, 20}, {1, 64, 64}};
    for (const auto& size : sizes) {
        const Index count = size[0] * size[1] * size[2];
        MeshData data = shapes::refined(shapes::box(2 * size[0] + 1, 2 * size[1] + 1, 2 * size[2] + 1));
        data = moved(scaled(std::move(data), 0.5), {-1, -1, -1});
        const MeshData small = cube(1);
        for (int i = 0; i < count; i++)
            append(data, moved(small, {2.0 * (i % size[0]), 2.0 * (i / size[0] % size[1]), 2.0 * (i / size[0] / size[1])}));
        const TriMesh mesh = build_mesh(data);
        CHECK(mesh.components == count + 1);
        CHECK(mesh.cavities == count);
        CHECK(mesh.turned_components == count);
        CHECK(mesh.turned_facets == 12 * count);
    }
}

TEST_CASE("orientation: a component without volume stays as it is") {
    const MeshData right = shapes::pillow();
    check_becomes(right, right, 1, 0, 0);
    check_becomes(turned(right), turned(right), 1, 0, 0);
    const MeshData beside = joined(right, moved(cube(1), {5, 5, 5}));
    check_becomes(beside, beside, 2, 0, 0);
    // In a cube it bounds a cavity of no volume.
    const MeshData inside = joined(moved(right, {2, 2, 2}), cube(5));
    check_becomes(inside, inside, 2, 1, 0);
}

TEST_CASE("orientation: a small part far from the origin is judged by its own size") {
    // Taken about the origin, the terms of the volume would be 2^60 times the volume: no digit of it would be left.
    const double tiny = 1.0 / 1024, far = 1 << 20;
    for (const MeshData& shape : {cube(2), shapes::tetrahedron(), shapes::frame()}) {
        const MeshData right = moved(scaled(shape, tiny), {far, -far, far});
        check_becomes(right, right, 1, 0, 0);
        check_becomes(turned(right), right, 1, 0, 1);
    }
    const MeshData nested = moved(joined(cube_at(0, 5), turned(cube_at(2, 1))), {1e6, -1e6, 1e6});
    check_becomes(turned(nested), nested, 2, 1, 2);
    const MeshData apart = joined(cube(1), moved(cube(1), {1e6, 1e6, 1e6}));
    check_becomes(turned(apart), apart, 2, 0, 2);
}

TEST_CASE("orientation: any facets may disagree, in any numbering") {
    shapes::Lcg random(4);
    MeshData nested = joined(cube_at(0, 9, 3), turned(cube_at(1, 7, 2)));
    append(nested, cube_at(2, 5));
    append(nested, moved(scaled(shapes::frame(), 2), {20, 0, 0}));
    for (int round = 0; round < 50; round++) {
        const MeshData right = shapes::renumbered(nested, random).data;
        std::vector<char> turn(right.triangles.size() / 3);
        Index count = 0;
        for (char& t : turn) count += t = static_cast<char>(random.below(2));
        const TriMesh mesh = build_mesh(turned(right, turn));
        CHECK(mesh.origin == right.triangles);
        CHECK(mesh.turned_facets == count);
        CHECK(mesh.components == 4);
        CHECK(mesh.cavities == 1);
    }
}

#include "polylab/align.h"
#include "polylab/polylab.h"
#include "shapes.h"

#include <doctest/doctest.h>

using namespace polylab;

namespace {

Rotation turn(double x, double y, double z) {
    const auto [sx, cx] = sin_cos(x);
    const auto [sy, cy] = sin_cos(y);
    const auto [sz, cz] = sin_cos(z);
    Rotation r;
    r.row[0] = {cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz};
    r.row[1] = {cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz};
    r.row[2] = {-sy, sx * cy, cx * cy};
    return r;
}

MeshData turned(MeshData data, const Rotation& r) {
    for (Vec3& p : data.points) p = r(p);
    return data;
}

double trace(const Rotation& r) { return r.row[0].x + r.row[1].y + r.row[2].z; }

}   // namespace

TEST_CASE("align: a part that lies along the axes stays where it is, to the last bit") {
    for (const MeshData& data : {shapes::cube(2), shapes::l_shape(), shapes::stair(3)}) {
        const Rotation r = own_frame(build_mesh(data));
        for (int a = 0; a < 3; a++) CHECK(r.row[a] == Rotation{}.row[a]);
    }
}

TEST_CASE("align: a turned part is turned back, up to a quarter turn about each axis, by no more than it has to be") {
    for (const Rotation& away : {turn(0.1, 0, 0), turn(0, 0.7, 0), turn(0.3, -0.4, 0.2), turn(2, 1, -3)}) {
        TriMesh mesh = build_mesh(turned(shapes::stair(3), away));
        const Rotation back = own_frame(mesh);
        CHECK(trace(back) >= trace(turn(1.1, 0, 0)));   // 62.8 degrees are enough for any position of a cube
        rotate(mesh, back);
        for (const Vec3& n : mesh.normal)
            CHECK(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("align: a rotation keeps lengths, orientation and connectivity") {
    const TriMesh before = build_mesh(turned(shapes::l_shape(), turn(0.3, -0.4, 0.2)));
    TriMesh after = before;
    const Rotation r = own_frame(before);
    rotate(after, r);
    CHECK(dot(cross(r.row[0], r.row[1]), r.row[2]) == doctest::Approx(1));
    CHECK(after.origin == before.origin);
    CHECK(after.opposite == before.opposite);
    for (Index h = 0; h < after.halfedges(); h++) CHECK(norm(after.vector(h)) == doctest::Approx(norm(before.vector(h))));
    for (Index f = 0; f < after.facets(); f++) CHECK(norm(after.normal[f] - r(before.normal[f])) < 1e-12);
}

TEST_CASE("align: a turned part gets the labels of the part at rest, by other names") {
    const TriMesh rest = build_mesh(shapes::stair(4));
    const Labeling expected = label_polycube(rest);
    for (const Rotation& away : {turn(0.4, 0, 0), turn(0.3, -0.4, 0.2), turn(2, 1, -3)}) {
        TriMesh mesh = build_mesh(turned(shapes::stair(4), away));
        rotate(mesh, own_frame(mesh));
        const Labeling labels = label_polycube(mesh);
        Label name[kLabels] = {kNoLabel, kNoLabel, kNoLabel, kNoLabel, kNoLabel, kNoLabel};
        for (Index f = 0; f < mesh.facets(); f++) {
            if (name[expected[f]] == kNoLabel) name[expected[f]] = labels[f];
            CHECK(labels[f] == name[expected[f]]);
        }
    }
}

TEST_CASE("align: a surface without directions is left alone") {
    MeshData flat;
    flat.points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    flat.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const Rotation r = own_frame(build_mesh(flat));
    for (int a = 0; a < 3; a++) CHECK(r.row[a] == Rotation{}.row[a]);
}

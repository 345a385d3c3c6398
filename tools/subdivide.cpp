// subdivide IN OUT: every triangle of a closed surface becomes four, edges are halved, feature edges stay: the same shape
// with four times the facets, to see how time and memory grow.
#include "polylab/io.h"

#include <cstdio>

using namespace polylab;

static MeshData subdivided(const TriMesh& mesh) {
    MeshData fine;
    fine.points = mesh.points;
    std::vector<Index> middle(mesh.halfedges());   // half-edge -> vertex in the middle of its edge
    for (Index h = 0; h < mesh.halfedges(); h++) {
        if (h != mesh.edge(h)) continue;
        middle[h] = middle[mesh.opposite[h]] = static_cast<Index>(fine.points.size());
        fine.points.push_back((mesh.points[mesh.from(h)] + mesh.points[mesh.to(h)]) * 0.5);
        if (mesh.feature[h]) fine.edges.insert(fine.edges.end(), {mesh.from(h), middle[h], middle[h], mesh.to(h)});
    }
    for (Index h = 0; h < mesh.halfedges(); h += 3) {
        const Index a = mesh.origin[h], b = mesh.origin[h + 1], c = mesh.origin[h + 2];
        const Index ab = middle[h], bc = middle[h + 1], ca = middle[h + 2];
        fine.triangles.insert(fine.triangles.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return fine;
}

int main(int argc, char** argv) {
    try {
        if (argc != 3) throw InputError("usage: subdivide IN OUT");
        write_mesh(argv[2], subdivided(build_mesh(read_mesh(argv[1]))));
    } catch (const InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}

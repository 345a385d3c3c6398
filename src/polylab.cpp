#include "polylab/polylab.h"

namespace polylab {

TriMesh read_surface(const std::string& path, const FeatureOptions& features, bool welded) {
    MeshData data = read_mesh(path);
    if (welded) weld(data);
    try {
        if (!data.tets.empty()) data = extract_surface(data).surface;
        return build_mesh(std::move(data), features);
    } catch (const InputError& error) {
        throw error.in(path);
    }
}

TetSurface outward_surface(const MeshData& tets, const std::string& name, std::vector<std::string>& said) {
    try {
        TetSurface result = extract_surface(tets);
        std::vector<Index> edges = result.surface.edges;   // also those that are not sharp
        TriMesh mesh = build_mesh(std::move(result.surface));
        said = notes(mesh);
        result.surface = {};
        result.surface.points = std::move(mesh.points);
        result.surface.edges = std::move(edges);
        result.surface.triangles = std::move(mesh.origin);
        return result;
    } catch (const InputError& error) {
        throw error.in(name);
    }
}

Labeling label_polycube(const TriMesh& mesh) { return search(mesh, search_start(mesh)).labels; }

}   // namespace polylab

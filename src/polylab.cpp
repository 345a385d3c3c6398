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

Labeling label_polycube(const TriMesh& mesh) { return search(mesh, graphcut_labeling(mesh)).labels; }

}   // namespace polylab

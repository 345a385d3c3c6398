// exports.h: a labeled surface as files for other programs.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>
#include <vector>

namespace polylab {

struct ExportedFile {
    std::string path, content;
};

// The files that the extension of `path` asks for, that one first:
//  .vtk   legacy 2.0 ASCII (ParaView): triangles with the cell data label, chart, fidelity and normal
//  .glb   glb_text()
//  .mesh  MEDIT, the labels as references of the triangles; feature edges
//  .obj   a `usemtl` before each facet: red darkred green darkgreen blue darkblue (PolyCut's names) for the labels 0..5;
//         feature edges; and beside it the .mtl of the same name, with these materials
// Vertices and facets keep their numbers (in .glb the facets are sorted by label). Empty for any other extension: labels_text()
// is the format then. O(n)
std::vector<ExportedFile> export_files(const std::string& path, const TriMesh& mesh, const Labeling& labels);

// Binary glTF 2.0, coordinates in single precision: coloured by label, or grey where `labels` is empty; with `polycube`
// (vertex -> position; empty: none) an animation that goes there and back.
// Throws InputError where a coordinate does not fit into single precision. O(n)
std::string glb_text(const TriMesh& mesh, const Labeling& labels, const std::vector<Vec3>& polycube = {});

}   // namespace polylab

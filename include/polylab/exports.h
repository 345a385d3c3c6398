// exports.h: a labeled surface as files for other programs.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>

namespace polylab {

// The file that the extension of its name asks for:
//  .vtk   legacy 2.0 ASCII (ParaView): triangles with the cell data label, chart, fidelity and normal
//  .glb   binary glTF 2.0, coloured by label, coordinates in single precision
//  .mesh  MEDIT, the labels as references of the triangles; feature edges
//  .obj   a `usemtl` before each facet: red darkred green darkgreen blue darkblue for the labels 0..5; feature edges
// Vertices and facets keep their numbers (in .glb the facets are sorted by label). Empty for any other extension: labels_text()
// is the format then. Throws InputError where a coordinate does not fit into .glb's single precision. O(n)
std::string export_text(const std::string& path, const TriMesh& mesh, const Labeling& labels);

}   // namespace polylab

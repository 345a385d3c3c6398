// io.h: mesh and label files.
//
// Every reader returns a complete value or throws InputError `file:line: expected …, found …`; memory is reserved by the
// size of the file, never by a count that the file claims. Every writer makes text from which its reader gets the same
// values, bit for bit.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>
#include <string_view>

namespace polylab {

// Reads a mesh file by its extension: .obj, .mesh (MEDIT ASCII), .stl (ASCII or binary), .vtk
// (legacy ASCII). O(size of the file)
//  OBJ    v, f (1, 1/2, 1//3, 1/2/3; negative indices count back), l polylines = feature edges; the rest is skipped.
//         Polygons with more than three sides are an error.
//  MEDIT  Vertices, Edges (= feature edges), Triangles, Tetrahedra, Hexahedra; other blocks are skipped, but
//         quadrilaterals are an error. Versions 1-3.
//  STL    corners with exactly the same coordinates become one vertex, numbered by first appearance.
//  VTK    UNSTRUCTURED_GRID of versions 2 to 4: lines (= feature edges), triangles, tetrahedra, hexahedra; vertices are skipped,
//         other cells are an error. Point and cell data are not read.
MeshData read_mesh(const std::string& path);

// The same from memory; `name` stands for the file in errors.
MeshData read_obj(std::string_view text, const std::string& name);
MeshData read_medit(std::string_view text, const std::string& name);
MeshData read_stl(std::string_view bytes, const std::string& name);
MeshData read_vtk(std::string_view text, const std::string& name);

// Whether the name ends with the extension (".obj"), in capitals or not.
bool has_extension(const std::string& path, const char* extension);

// Vertices with exactly the same coordinates become the first of them; the others are left without facet, so that numbers
// stay. O(n)
void weld(MeshData& data);

// The text of a mesh file, by the extension of its name: .obj (v, f, l) or .mesh. Other extensions are an error.
std::string mesh_text(const std::string& path, const MeshData& data);
void write_mesh(const std::string& path, const MeshData& data);
std::string obj_text(const MeshData& data);
// Keyword and count on lines of their own, as strictly line-based readers want.
std::string medit_text(const MeshData& data);

// What a built mesh would be as a file: its facets as they are turned now, its kept feature edges.
MeshData mesh_data(const TriMesh& mesh);

// Labels: integers 0..5 separated by blanks, one per facet; with `allow_free` also -1 (kNoLabel).
// Throws InputError where their number is not `facets`.
Labeling read_labels(const std::string& path, Index facets, bool allow_free = false);
Labeling read_labels_text(std::string_view text, const std::string& name, Index facets, bool allow_free = false);
std::string labels_text(const Labeling& labels);   // one per line

}   // namespace polylab

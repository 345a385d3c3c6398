// polylab.h: all of the library that a program needs to label parts.
//
//   #include <polylab/polylab.h>
//
//   polylab::TriMesh mesh = polylab::read_surface("part.obj");         // or build_mesh() from your own arrays
//   polylab::Labeling labels = polylab::label_polycube(mesh);
//   polylab::write_file("labels.txt", polylab::labels_text(labels));
#pragma once

#include "polylab/align.h"
#include "polylab/costs.h"
#include "polylab/initial_labeling.h"
#include "polylab/io.h"
#include "polylab/polycube.h"
#include "polylab/search.h"
#include "polylab/statistics.h"
#include "polylab/tet_surface.h"
#include "polylab/text.h"

#include <string>

namespace polylab {

inline constexpr const char* kVersion = "0.1.0";

// Reads a surface (.obj, .stl, .mesh), or the surface of a tet mesh (.mesh), and builds it; with `welded`, after
// weld(). Throws InputError.
TriMesh read_surface(const std::string& path, const FeatureOptions& features = {}, bool welded = false);

// The surface of a tet mesh, turned to face outward, and its map; what notes() says of it goes to `said`.
// Throws InputError, said of the file `name`.
TetSurface outward_surface(const MeshData& tets, const std::string& name, std::vector<std::string>& said);

// The whole method: graph-cut, then search() with its defaults. statistics() tells what the result is worth.
Labeling label_polycube(const TriMesh& mesh);

}   // namespace polylab

// report.h: a labeling as one HTML page: 3-D view, statistics, problems, parameters of the run. Nothing of the method.
//
// The page is self-contained: it opens from disk, without server or network, in a browser with WebGL 2. Its script is
// src/report.js, its style src/report.css; the mesh and the labelings are inlined as base64 of little-endian arrays:
// about 45 bytes per facet.
#pragma once

#include "polylab/labels.h"
#include "polylab/mesh.h"

#include <string>
#include <vector>

namespace polylab {

struct Report {
    struct Layer {
        std::string name;   // "naive", "graph-cut", "final"
        Labeling labels;    // one per facet
    };
    struct Parameter {
        std::string name, value;
    };

    std::string title;
    std::vector<Parameter> parameters;   // of the run, in the order in which they are shown
    std::vector<Layer> layers;           // what the page switches between; it opens with the last one
    std::vector<Vec3> polycube;          // vertex -> position in the polycube of the last layer; empty: there is none
};

// The page. Same report, same bytes. O(n) per layer
std::string report_html(const TriMesh& mesh, const Report& report);

// What to call the page of a part: its file with the folder it lies in, as many files are called the same.
std::string title_of(const std::string& path);

// `bytes` in base64, with padding (RFC 4648).
std::string base64(const std::vector<unsigned char>& bytes);

}   // namespace polylab

// picture.h: a small picture of a labeling, for lists of many parts (paper, Figure 1). Nothing of the method.
#pragma once

#include "polylab/labeling_graph.h"

#include <string>
#include <vector>

namespace polylab {

// A PNG of size x size pixels: the part seen from +X +Y +Z, facets in the colours of their labels, borders of charts dark,
// invalid charts striped, the background transparent. Same input, same bytes. size: 16..4096
// O(n + pixels covered)
std::string png_picture(const TriMesh& mesh, const LabelingGraph& graph, int size = 480);

// A PNG file of one palette index per pixel, in rows of `width`; palette: 3 bytes per colour, at most 256 colours, of which
// number 0 is transparent. Only runs of equal pixels are compressed.
std::string png_text(const std::vector<unsigned char>& pixels, int width, const std::vector<unsigned char>& palette);

}   // namespace polylab

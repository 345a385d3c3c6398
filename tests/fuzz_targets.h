// Hostile input: what is checked on arbitrary bytes, and arbitrary triangle soups. tests/fuzz/driver.cpp gives the targets to
// libFuzzer, test_fuzz.cpp runs them on the seeds, and test_soup.cpp walks the soups.
#pragma once

#include "polylab/mesh.h"

#include <functional>
#include <string_view>
#include <vector>

namespace polylab::fuzz {

// A source of choices: 0..n-1 for each n. Made of bytes, so that a fuzzer steers it, or of a seed.
using Choose = std::function<Index(Index n)>;
Choose choices_of_bytes(std::string_view bytes);   // 0 once they are used up
Choose choices_of_seed(std::uint64_t seed);

// Up to a few hundred triangles: solids of small integer coordinates, closed surfaces that cross themselves, loose triangles;
// then flipped, cut, merged, scaled, given feature edges, …
MeshData soup(const Choose& choose);

// Runs the whole method on it, from the graph-cut or (`noise`) from labels that are chosen, and checks what always holds.
// The run is stopped after it has asked `most` times.
// False: build_mesh refused it, in one line. Throws std::logic_error where a check fails.
bool label_soup(const MeshData& data, const Choose& choose, bool noise, int most);

struct Target {
    const char* name;
    void (*run)(std::string_view bytes);   // throws std::logic_error, or crashes, where something is wrong
};
const std::vector<Target>& targets();

}   // namespace polylab::fuzz

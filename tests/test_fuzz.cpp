// The fuzz targets on their seeds, and on each seed cut short or with a byte changed.

#include "fuzz_targets.h"

#include "polylab/text.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>

using namespace polylab;
namespace fs = std::filesystem;

TEST_CASE("fuzz: every target stands its seeds, whole, cut short and damaged") {
    for (const fuzz::Target& target : fuzz::targets()) {
        std::vector<fs::path> seeds;
        for (const auto& entry : fs::directory_iterator(fs::path(POLYLAB_SOURCE_DIR) / "tests/fuzz/seeds" / target.name))
            seeds.push_back(entry.path());
        std::sort(seeds.begin(), seeds.end());
        REQUIRE(!seeds.empty());
        const bool slow = std::string(target.name) == "pipeline";
        for (const fs::path& seed : seeds) {
            CAPTURE(seed.string());
            const std::string bytes = read_file(seed.string());
            CHECK_NOTHROW(target.run(bytes));
            shapes::Lcg random(1);
            for (std::size_t size = 0; size < bytes.size(); size += slow ? 16 : 1) {
                CAPTURE(size);
                CHECK_NOTHROW(target.run(bytes.substr(0, size)));
                std::string damaged = bytes;
                damaged[size] = static_cast<char>(random.below(256));
                CHECK_NOTHROW(target.run(damaged));
            }
        }
    }
}

// Triangle soups: each ends in a labeling or a refusal. A few here; POLYLAB_SOUPS=FIRST:COUNT walks others, one in fifty of
// them to the very end, and says which took longest.

#include "fuzz_targets.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>

using namespace polylab;

TEST_CASE("soup: every triangle soup ends in a labeling or a refusal") {
    unsigned long long first = 0, count = 500;
    const char* asked = std::getenv("POLYLAB_SOUPS");
    if (asked) REQUIRE(std::sscanf(asked, "%llu:%llu", &first, &count) == 2);
    unsigned long long labeled = 0, facets = 0, slowest = first, slow = 0;
    double longest = 0;
    for (unsigned long long seed = first; seed < first + count; seed++) {
        CAPTURE(seed);
        const std::clock_t begin = std::clock();
        const fuzz::Choose choose = fuzz::choices_of_seed(seed);
        const MeshData data = fuzz::soup(choose);
        const int most = asked && seed % 100 < 2 ? std::numeric_limits<int>::max() : 20;   // a whole run may take half a second
        bool accepted = false;
        REQUIRE_NOTHROW(accepted = fuzz::label_soup(data, choose, /* noise= */ seed % 2 == 1, most));
        if (accepted) facets += data.triangles.size() / 3;
        labeled += accepted;
        const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        slow += seconds > 1;
        if (seconds > longest) {
            longest = seconds;
            slowest = seed;
        }
    }
    if (asked)
        std::printf(
            "%llu soups from %llu: %llu labeled (%llu facets), %llu refused; longest %.3f s (soup %llu), %llu above 1 s\n", count,
            first, labeled, facets, count - labeled, longest, slowest, slow);
    else {
        CHECK(labeled > count / 4);   // the generator is worth something on both sides
        CHECK(labeled < count);
    }
}

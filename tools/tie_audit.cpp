// tie_audit.cpp: by how much the comparisons that decide labels were decided, over the parts given as arguments.
//
// Built with -DPOLYLAB_TIE_AUDIT, which makes them report (base.h). A margin near rounding noise (1e-15 of the value) that is
// not zero is a place where a port may decide otherwise. Zero margins are ties, which go by rule and are counted apart.

#include "polylab/polylab.h"
#include "polylab/stages.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace {

struct Margins {
    long comparisons = 0, ties = 0, below = 0;   // below: closer than kNoise, but no tie
    double least = 1e300;
    std::string part;   // where the least one was met
};

constexpr double kNoise = 1e-12;
std::map<std::string, Margins> margins;
std::string current;

}   // namespace

void polylab::audit(const char* comparison, double margin) {
    Margins& m = margins[comparison];
    m.comparisons++;
    if (margin == 0) {
        m.ties++;
        return;
    }
    m.below += margin < kNoise;
    if (margin >= m.least) return;
    m.least = margin;
    m.part = current;
}

int main(int argc, char** argv) {
    for (int i = 1; i < argc; i++) {
        current = argv[i];
        polylab::stages(polylab::read_surface(argv[i]));
    }
    std::printf("%-42s %12s %10s %12s %10s  %s\n", "comparison", "number", "ties", "below 1e-12", "least", "where");
    for (const auto& [name, m] : margins)
        std::printf("%-42s %12ld %10ld %12ld %10.2g  %s\n", name.c_str(), m.comparisons, m.ties, m.below, m.least,
                    m.part.c_str());
}

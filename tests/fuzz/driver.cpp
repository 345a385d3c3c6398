// The targets of fuzz_targets.cpp for libFuzzer, one program for all: `fuzz TARGET [options of libFuzzer] [corpus]`.

#include "../fuzz_targets.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace polylab;

static const fuzz::Target* target = nullptr;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    target->run({reinterpret_cast<const char*>(data), size});
    return 0;
}

// Takes the target's name off the arguments before libFuzzer reads them.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    const char* name = *argc > 1 ? (*argv)[1] : "";
    for (const fuzz::Target& t : fuzz::targets())
        if (std::strcmp(t.name, name) == 0) target = &t;
    if (!target) {
        std::fprintf(stderr, "usage: fuzz TARGET [options of libFuzzer] [corpus]\ntargets:");
        for (const fuzz::Target& t : fuzz::targets()) std::fprintf(stderr, " %s", t.name);
        std::fprintf(stderr, "\n");
        std::exit(2);
    }
    (*argv)[1] = (*argv)[0];
    (*argc)--;
    (*argv)++;
    return 0;
}

// bench PART: labels one part and prints a line per stage: name, CPU milliseconds, peak memory of the process so far in kB.
// One run per process, so that the peak is the run's own. tools/bench.sh repeats it and makes the tables.
#include "polylab/heap.h"
#include "polylab/polylab.h"

#include <sys/resource.h>

#include <cstdio>
#include <map>

using namespace polylab;

static rusage used() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return u;
}
static double cpu_ms() {
    const rusage u = used();
    return 1e3 * static_cast<double>(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
           1e-3 * static_cast<double>(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

// Charges the time since the last call to a stage.
static void lap(const char* stage) {
    static double last = 0;
    const double now = cpu_ms();
    std::printf("%s %.3f %ld\n", stage, now - last, used().ru_maxrss);
    last = cpu_ms();
}

int main(int argc, char** argv) {
    prepare_heap();
    try {
        if (argc != 2) throw InputError("usage: bench PART");
        lap("start");
        MeshData data = read_mesh(argv[1]);
        lap("read");
        const TriMesh mesh = build_mesh(std::move(data));
        lap("mesh");
        naive_labeling(mesh);
        lap("naive");
        Labeling labels = search_start(mesh);
        lap("graph-cut");
        build_graph(mesh, labels);
        lap("graph");
        std::map<std::string, double> operators;   // time from the end of one step to the end of the next
        double last = cpu_ms();
        RoutineOptions options;
        options.trace = [&](const Step& step) {
            operators[step.operation] += cpu_ms() - last;
            last = cpu_ms();
        };
        labels = search(mesh, labels, options).labels;
        lap("search");
        for (const auto& [name, ms] : operators) std::printf("%s %.3f %ld\n", name.c_str(), ms, used().ru_maxrss);
        write_file("/dev/null", labels_text(labels));
        lap("write");
        std::printf("all %.3f %ld\nfacets %d 0\n", cpu_ms(), used().ru_maxrss, mesh.facets());
    } catch (const InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}

// main.cpp: the command line. What each command does is in the library; here are its words, messages and exit status.

#include "polylab/align.h"
#include "polylab/cli.h"
#include "polylab/diff.h"
#include "polylab/dropin.h"
#include "polylab/explain.h"
#include "polylab/exports.h"
#include "polylab/heap.h"
#include "polylab/picture.h"
#include "polylab/polylab.h"
#include "polylab/report.h"
#include "polylab/stages.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
static bool on_terminal() { return isatty(2) != 0; }
#else
static bool on_terminal() { return false; }
#endif

#if !defined(POLYLAB_COMMIT)
#define POLYLAB_COMMIT "unknown"
#endif

namespace polylab {
namespace {

enum ExitStatus { kDone = 0, kNotValid = 1, kNoResult = 2 };

// Messages on standard error. Summary and progress are for people at a terminal; warnings are for everyone.
class Console {
public:
    explicit Console(const Arguments& arguments)
        : quiet_(arguments.has("--quiet")), verbose_(arguments.has("--verbose")), talk_(!quiet_ && (verbose_ || on_terminal())) {}

    bool talks() const { return talk_; }
    void say(const std::string& line) const {
        if (talk_) print(line);
    }
    void detail(const std::string& line) const {
        if (verbose_ && !quiet_) print(line);
    }
    void warn(const std::string& line) const {
        if (!quiet_) print(line);
    }

private:
    static void print(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

    bool quiet_, verbose_, talk_;
};

class Stopwatch {
public:
    std::string seconds() const {
        char text[32];
        std::snprintf(text, sizeof text, "%.3f s",
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
        return text;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The first SIGINT or SIGTERM asks the run to end with what it has, the second one kills. A signal that whoever started the
// program had ignored (as shells do for what runs in the background) stays ignored.
volatile std::sig_atomic_t signalled = 0;
constexpr int kSignals[] = {SIGINT, SIGTERM};

void note_signal(int) {
    signalled = 1;
    for (const int s : kSignals)
        if (std::signal(s, SIG_DFL) == SIG_IGN) std::signal(s, SIG_IGN);
}
void listen_to_signals() {
    for (const int s : kSignals)
        if (std::signal(s, note_signal) == SIG_IGN) std::signal(s, SIG_IGN);
}
bool interrupted() { return signalled != 0; }

const Option kOutput = {"-o", "FILE", "where the result goes; standard output without this, or with -"};
const Option kFeatures = {"--features", "SOURCE",
                          "file: the sharp ones among the file's feature edges (default)\n"
                          "detect[=ANGLE]: every edge at which normals differ by ANGLE (0.5) rad or more"};
const Option kReport = {"--report", "HTML", "also write a page with a 3-D view of the labels, the statistics and the problems"};
const Option kPicture = {"--picture", "PNG", "also write a small picture of the part with its labels"};
const Option kAlign = {"--align", "",
                       "turn the part so that its own faces lie along the axes; labels refer to the turned part,\n"
                       "and the matrix by which it was turned stands in messages and under polylab in statistics"};
const Option kWeld = {"--weld", "", "vertices with exactly the same coordinates become one"};
const Option kQuiet = {"--quiet", "", "errors only"};
const Option kVerbose = {"--verbose", "", "progress and summary, also where standard error is not a terminal"};

FeatureOptions feature_options(const Arguments& arguments) {
    FeatureOptions options;
    const std::string source = arguments.get("--features", "file");
    const std::size_t equal = source.find('=');
    options.detect = source.substr(0, equal) == "detect";
    if (!options.detect && source != "file")
        throw UsageError("--features: expected 'file' or 'detect[=ANGLE]', found '" + source + "'");
    if (options.detect && equal != std::string::npos) {
        Arguments angle;
        angle.options["--features detect"] = source.substr(equal + 1);
        options.cosine = sin_cos(angle.number("--features detect", 0.5, 0, 3.1415926535897931)).cos;
    }
    return options;
}

// Once the size of the part is known: what to say where memory is short. Measured: 190 bytes per
// facet on a cube of 388800 facets.
std::string memory_needed;
constexpr Index kFacetsPerMegabyte = 5000;
constexpr Index kTetsPerMegabyte = 62500;   // four labels of one byte each, their text of three

std::int64_t megabytes_here() {
#if defined(_SC_PHYS_PAGES)
    return static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE) / 1000000;
#else
    return std::numeric_limits<std::int64_t>::max();
#endif
}

// With --align the mesh comes turned, and `rotation` says how, row by row; otherwise it is empty.
TriMesh read_part(const Arguments& arguments, const Console& console, std::vector<double>& rotation) {
    const std::string& path = arguments.operands[0];
    TriMesh mesh = read_surface(path, feature_options(arguments), arguments.has("--weld"));
    memory_needed = "; labeling " + std::to_string(mesh.facets()) + " facets takes about " +
                    std::to_string(1 + mesh.facets() / kFacetsPerMegabyte) + " MB";
    for (const std::string& note : notes(mesh)) console.warn(path + ": " + note);
    console.say(path + ": " + std::to_string(mesh.facets()) + " facets, " + std::to_string(mesh.vertices()) + " vertices, " +
                std::to_string(mesh.features_kept) + " feature edges");
    rotation.clear();
    if (!arguments.has("--align")) return mesh;
    const Rotation own = own_frame(mesh);
    rotate(mesh, own);
    std::string rows;
    for (const Vec3& row : own.row) {
        rows += rows.empty() ? "(" : "; ";
        for (int a = 0; a < 3; a++) {
            if (a > 0) rows += ' ';
            append(rows, row[a]);
            rotation.push_back(row[a]);
        }
    }
    console.say(path + ": turned by " + rows + ")");
    return mesh;
}

TriMesh read_part(const Arguments& arguments, const Console& console) {
    std::vector<double> rotation;
    return read_part(arguments, console, rotation);
}

ExitStatus status_of(const LabelingGraph& graph) { return graph.valid() ? kDone : kNotValid; }

std::string program_name() { return std::string("polylab ") + kVersion + " (commit " + POLYLAB_COMMIT + ")"; }

// What `label` does unless told otherwise.
std::vector<Report::Parameter> label_defaults() {
    const InitialOptions initial;
    std::string sensitivity, angle;
    append(sensitivity, initial.sensitivity);
    append(angle, initial.angle);
    return {{"--method", "full"},
            {"--routine", "both"},
            {"--effort", std::to_string(kDefaultEffort)},
            {"--compactness", std::to_string(initial.compactness)},
            {"--fidelity", std::to_string(initial.fidelity)},
            {"--sensitivity", sensitivity},
            {"--angle", angle},
            {"--features", "file"}};
}

// The page of `--report`. `layers` end with the labeling that it is about.
std::string report_of(const char* command, const Arguments& arguments, const TriMesh& mesh, std::vector<Report::Layer> layers) {
    Report report;
    const std::string& part = arguments.operands[0];
    report.title = title_of(part);
    report.parameters = {{"command", command}, {"part", part}};
    if (arguments.operands.size() > 1) report.parameters.push_back({"labels", arguments.operands[1]});
    for (const auto& [name, value] : arguments.options) report.parameters.push_back({name, value.empty() ? "yes" : value});
    if (std::string(command) == "label")
        for (const auto& [name, value] : label_defaults())
            if (!arguments.has(name)) report.parameters.push_back({name, value + " (default)"});
    report.parameters.push_back({"program", program_name()});
    if (build_graph(mesh, layers.back().labels).valid()) report.polycube = surface_polycube(mesh, layers.back().labels);
    report.layers = std::move(layers);
    return report_html(mesh, report);
}

// For labelings from a file: the two initial ones beside it.
std::string report_of(const char* command, const Arguments& arguments, const TriMesh& mesh, const Labeling& labels) {
    return report_of(command, arguments, mesh,
                     {{"naive", naive_labeling(mesh)}, {"graph-cut", graphcut_labeling(mesh)}, {"given", labels}});
}

// The paper's routines and what comes after them, with a line of progress per step that is kept; `trace` gets a line per step.
State run_full(const TriMesh& mesh, const Labeling& start, Labeling locks, int effort, const Arguments& arguments,
               const Console& console, std::string& trace) {
    const std::string routine = arguments.get("--routine", "both");
    RoutineOptions options;
    options.validity = routine != "monotonicity";
    options.monotonicity = routine != "validity";
    options.locks = std::move(locks);
    options.stop = interrupted;
    options.trace = [&](const Step& step) {
        if (arguments.has("--trace")) trace += trace_line(step);
        if (step.kept && !step.in_sequence)
            console.detail(step.operation + ": " + std::to_string(step.after.invalid) + " invalid, " +
                           std::to_string(step.after.turning_points) + " turning-points left");
    };
    return search(mesh, start, options, effort);
}

std::vector<Output> outputs_of(const std::vector<ExportedFile>& files) {
    std::vector<Output> outputs(files.size());
    for (std::size_t i = 0; i < files.size(); i++) outputs[i] = {files[i].path, files[i].content};
    return outputs;
}

int run_label(const Arguments& arguments) {
    const Console console(arguments);
    const Stopwatch watch;
    const std::string method = arguments.get("--method", "full"), output = arguments.get("-o", "-");
    if (method != "full" && method != "graphcut" && method != "naive")
        throw UsageError("--method: expected 'full', 'graphcut' or 'naive', found '" + method + "'");
    for (const char* name : {"--init", "--trace", "--routine", "--effort"})
        if (arguments.has(name) && method != "full") throw UsageError(std::string(name) + " only goes with --method full");
    const std::string routine = arguments.get("--routine", "both");
    if (routine != "validity" && routine != "monotonicity" && routine != "both")
        throw UsageError("--routine: expected 'validity', 'monotonicity' or 'both', found '" + routine + "'");
    if (routine != "both" && arguments.has("--effort")) throw UsageError("--effort only goes with --routine both");
    const int effort = arguments.integer("--effort", routine == "both" ? kDefaultEffort : 0, 0, kMostEffort);
    InitialOptions initial;
    initial.compactness = arguments.integer("--compactness", initial.compactness, 0, 1000);
    initial.fidelity = arguments.integer("--fidelity", initial.fidelity, 0, 1000);
    initial.sensitivity = arguments.number("--sensitivity", initial.sensitivity, 0, 1);
    initial.angle = arguments.number("--angle", initial.angle, -1, 1);

    std::vector<double> rotation;
    const TriMesh mesh = read_part(arguments, console, rotation);
    listen_to_signals();   // before this there is nothing to save
    console.detail("read and built in " + watch.seconds());
    Labeling locks, labels;
    std::vector<Report::Layer> layers;   // for the report only
    if (arguments.has("--lock")) locks = read_labels(arguments.get("--lock"), mesh.facets(), /* allow_free= */ true);
    if (arguments.has("--init"))
        labels = read_labels(arguments.get("--init"), mesh.facets());
    else if (method == "naive")
        labels = naive_labeling(mesh);
    else if (method == "graphcut")
        labels = graphcut_labeling(mesh, initial, locks, interrupted);
    else
        labels = search_start(mesh, effort, initial, locks, interrupted);
    for (std::size_t f = 0; f < locks.size(); f++)   // the other methods honour them too
        if (locks[f] != kNoLabel) labels[f] = locks[f];
    console.detail("initial labeling after " + watch.seconds());
    if (arguments.has("--report")) {
        if (method != "naive") layers.push_back({"naive", naive_labeling(mesh)});
        if (method == "full" && !arguments.has("--init"))   // the paper's, to compare with, not the one that is repaired
            layers.push_back({"graph-cut", graphcut_labeling(mesh, initial, locks, interrupted)});
        else
            layers.push_back({arguments.has("--init") ? "initial" : method == "naive" ? "naive" : "graph-cut", labels});
    }
    std::string trace;
    LabelingGraph graph;
    if (method == "full") {
        State state = run_full(mesh, labels, std::move(locks), effort, arguments, console, trace);
        labels = std::move(state.labels);
        graph = std::move(state.graph);
        console.detail("final labeling after " + watch.seconds());
        if (arguments.has("--report")) layers.push_back({"final", labels});
    } else {
        graph = build_graph(mesh, labels);
    }
    std::vector<ExportedFile> files = export_files(output, mesh, labels);
    if (files.empty()) files = {{output, labels_text(labels)}};
    std::string json;
    std::vector<Output> outputs = outputs_of(files);
    if (arguments.has("--stats")) {
        json = statistics_json(statistics(mesh, labels, graph), explain(mesh, graph), rotation);
        outputs.push_back({arguments.get("--stats"), json});
    }
    std::string report, picture;
    if (arguments.has("--report"))
        outputs.push_back({arguments.get("--report"), report = report_of("label", arguments, mesh, std::move(layers))});
    if (arguments.has("--picture")) outputs.push_back({arguments.get("--picture"), picture = png_picture(mesh, graph)});
    if (arguments.has("--trace")) outputs.push_back({arguments.get("--trace"), trace});
    write_files(outputs);
    if (console.talks()) console.say(summary(statistics(mesh, labels, graph)));
    console.say((output == "-" ? "labels written" : "labels written to " + output) + " after " + watch.seconds());
    if (const std::string advice = graph.valid() ? "" : hint(mesh); !advice.empty()) console.say("hint: " + advice);
    if (interrupted()) {
        console.warn("interrupted: these are the best labels so far");
        return kNotValid;
    }
    return method == "full" ? status_of(graph) : kDone;
}

int run_stats(const Arguments& arguments) {
    const Console console(arguments);
    std::vector<double> rotation;
    const TriMesh mesh = read_part(arguments, console, rotation);
    const Labeling labels = read_labels(arguments.operands[1], mesh.facets());
    const LabelingGraph graph = build_graph(mesh, labels);
    const Statistics counts = statistics(mesh, labels, graph);
    const std::string json = statistics_json(counts, explain(mesh, graph), rotation);
    std::string report, picture;
    std::vector<Output> outputs = {{arguments.get("-o", "-"), json}};
    if (arguments.has("--report"))
        outputs.push_back({arguments.get("--report"), report = report_of("stats", arguments, mesh, labels)});
    if (arguments.has("--picture")) outputs.push_back({arguments.get("--picture"), picture = png_picture(mesh, graph)});
    write_files(outputs);
    console.say(summary(counts));
    return status_of(graph);
}

int run_explain(const Arguments& arguments) {
    const Console console(arguments);
    const TriMesh mesh = read_part(arguments, console);
    const Labeling labels = read_labels(arguments.operands[1], mesh.facets());
    const LabelingGraph graph = build_graph(mesh, labels);
    std::string text;
    for (const Problem& p : explain(mesh, graph)) text += p.text + "\n";
    const std::string advice = hint(mesh);
    if (!text.empty() && !advice.empty()) text += "hint: " + advice + "\n";
    if (text.empty()) text = "valid, and every boundary is monotone\n";
    std::string report;
    std::vector<Output> outputs = {{arguments.get("-o", "-"), text}};
    if (arguments.has("--report"))
        outputs.push_back({arguments.get("--report"), report = report_of("explain", arguments, mesh, labels)});
    write_files(outputs);
    return status_of(graph);
}

int run_diff(const Arguments& arguments) {
    const Console console(arguments);
    const TriMesh mesh = read_part(arguments, console);
    const Labeling a = read_labels(arguments.operands[1], mesh.facets()), b = read_labels(arguments.operands[2], mesh.facets());
    write_file(arguments.get("-o", "-"), diff_text(mesh, a, b));
    return a == b ? kDone : kNotValid;
}

int run_surface(const Arguments& arguments) {
    const Console console(arguments);
    const std::string& path = arguments.operands[0];
    if (!arguments.has("-o")) throw UsageError("missing -o FILE.obj or FILE.mesh");
    std::vector<std::string> said;
    const TetSurface extracted = outward_surface(read_mesh(path), path, said);
    for (const std::string& note : said) console.warn(path + ": " + note);
    const std::string surface = mesh_text(arguments.get("-o"), extracted.surface), map = surface_map_text(extracted.map);
    std::vector<Output> outputs = {{arguments.get("-o"), surface}};
    if (arguments.has("--map")) outputs.push_back({arguments.get("--map"), map});
    write_files(outputs);
    console.say(path + ": " + std::to_string(extracted.map.tets) + " tetrahedra, " +
                std::to_string(extracted.map.tet_facet.size()) + " triangles on the surface");
    return kDone;
}

int run_polycube(const Arguments& arguments) {
    const Console console(arguments);
    const std::string output = arguments.get("-o", "-");
    std::vector<double> rotation;
    const TriMesh mesh = read_part(arguments, console, rotation);
    const Labeling labels = read_labels(arguments.operands[1], mesh.facets());
    MeshData polycube = mesh_data(mesh);
    polycube.points = surface_polycube(mesh, labels);
    const LabelingGraph graph = build_graph(mesh, labels);
    const Distortion d = distortion(mesh, polycube.points);
    Statistics counts = statistics(mesh, labels, graph);
    counts.distortion = d;
    const std::string text = output == "-" ? obj_text(polycube) : mesh_text(output, polycube);
    const std::string json = statistics_json(counts, explain(mesh, graph), rotation);
    std::vector<Output> outputs = {{output, text}};
    if (arguments.has("--stats")) outputs.push_back({arguments.get("--stats"), json});
    write_files(outputs);
    char line[160];
    std::snprintf(line, sizeof line,
                  "distortion: stretch %.3f, area %.3f, angle %.3f, isometric %.3f; %d collapsed, %d turned facets", d.stretch,
                  d.area, d.angle, d.isometric, d.collapsed, d.turned);
    console.say(line);
    return kDone;
}

int run_export(const Arguments& arguments) {
    const Console console(arguments);
    const std::string output = arguments.get("-o");
    const TriMesh mesh = read_part(arguments, console);
    const std::vector<ExportedFile> files = export_files(output, mesh, read_labels(arguments.operands[1], mesh.facets()));
    if (files.empty()) throw UsageError("expected -o FILE in .vtk, .glb, .mesh or .obj");
    write_files(outputs_of(files));
    return kDone;
}

int run_stages(const Arguments& arguments) {
    const std::vector<Stage> all = stages(read_surface(arguments.operands[0]));
    std::vector<Output> outputs;
    outputs.reserve(all.size());
    for (const Stage& stage : all) outputs.push_back({arguments.operands[1] + "/" + stage.name + ".txt", stage.text});
    write_files(outputs);
    return kDone;
}

int run_volume_labels(const Arguments& arguments) {
    const SurfaceMap map = read_surface_map(arguments.operands[1]);
    // The number of tetrahedra is only a claim of the file. Linux would hand out more than there is, and kill later.
    const std::int64_t megabytes = map.tets / kTetsPerMegabyte;
    memory_needed = "; the labels of " + std::to_string(map.tets) + " tetrahedra take about " + std::to_string(megabytes) + " MB";
    if (megabytes > megabytes_here()) throw std::bad_alloc();
    const Labeling labels = read_labels(arguments.operands[0], static_cast<Index>(map.tet_facet.size()));
    write_file(arguments.get("-o", "-"), labels_text(volume_labels(labels, map)));
    return kDone;
}

const std::string kPartFile =
    "PART    a closed surface of triangles (.obj .stl .mesh .vtk) or a tet mesh (.mesh .vtk); feature edges as lines";
const std::string kLabelsFile =
    "\nLABELS  one label per triangle, in the order of the file: 0 = +X, 1 = -X, 2 = +Y, 3 = -Y, 4 = +Z, 5 = -Z";
const std::string kElements = "\n\nElements in messages are counted from 0.";
const std::string kNoResultStatus =
    "2  no result: wrong use, wrong input, or an output that can't be written; one line says which";
const std::string kJudgedStatus =
    "0  the labeling is valid\n1  it is not; everything is written all the same\n" + kNoResultStatus;
const std::string kDoneStatus = "0  done\n" + kNoResultStatus;

const std::vector<Command>& commands() {
    static const std::vector<Command> table = {
        {"label",
         {"PART"},
         "Gives every triangle of a CAD part one of six labels so that they form a polycube.\n\n"
         "A graph-cut gives the first labels. The paper's operators repair charts, boundaries and corners until the labeling is\n"
         "valid, then boundaries until they are monotone; what they have changed is polished. Elements in messages are counted\n"
         "from 0.",
         {{"-o", "FILE",
           "where the labels go; standard output without this, or with -\n"
           "in .vtk (ParaView), .glb (coloured), .mesh (references) or .obj (materials): the labeled surface"},
          {"--init", "LABELS", "start from these labels instead of the graph-cut's"},
          {"--lock", "LABELS", "one label per facet that it must keep, or -1 to leave it free"},
          {"--method", "METHOD", "full (default), or one of the initial labelings: graphcut, naive"},
          {"--routine", "NAME", "of the full method: validity or monotonicity, which stop at --effort 0, or both (default)"},
          {"--effort", "N",
           "0: the paper's routines alone; 1: redraw what they have changed; 2 (default): if something is invalid or turns,\n"
           "start again from other graph-cuts; 3: from all of these in any case, for the best"},
          {"--stats", "JSON", "also write the statistics of the result"},
          kReport,
          kPicture,
          {"--trace", "FILE",
           "also write a line per operator application: operator, element, kept or refused,\n"
           "proposals, facets changed, then invalid elements, turning-points and loss before and after"},
          {"--compactness", "N", "graph-cut: weight of separating neighbours (default 1)"},
          {"--fidelity", "N", "graph-cut: weight of leaving the normal (default 3)"},
          {"--sensitivity", "X", "graph-cut: tilt facets whose two best labels are closer than X (default 1e-9)"},
          {"--angle", "RAD", "graph-cut: tilt them by this angle around X, Y and Z (default 0.05)"},
          kFeatures,
          kAlign,
          kWeld,
          kQuiet,
          kVerbose},
         run_label,
         "0  the labeling is valid; with --method graphcut or naive: done\n1  it is not, or the run was interrupted: the best labels so far are written\n" +
             kNoResultStatus,
         kPartFile + kLabelsFile,
         "polylab label part.obj -o labels.txt --report report.html\npolylab label tet.mesh -o labeled.vtk\npolylab label part.stl --weld --features detect --align -o labels.txt"},
        {"stats",
         {"PART", "LABELS"},
         "Counts charts, boundaries, corners, turning-points and feature edges of a labeling, as JSON." + kElements,
         {kOutput, kReport, kPicture, kFeatures, kAlign, kWeld, kQuiet, kVerbose},
         run_stats,
         kJudgedStatus,
         kPartFile + kLabelsFile,
         "polylab stats part.obj labels.txt -o stats.json"},
        {"explain",
         {"PART", "LABELS"},
         "Says in words which charts, boundaries and corners are invalid, and where boundaries turn; worst first." + kElements,
         {kOutput, kReport, kFeatures, kAlign, kWeld, kQuiet, kVerbose},
         run_explain,
         kJudgedStatus,
         kPartFile + kLabelsFile,
         "polylab explain part.obj labels.txt\npolylab explain part.obj labels.txt -o problems.txt --report report.html"},
        {"diff",
         {"PART", "A", "B"},
         "Says what changed from labeling A to labeling B." + kElements,
         {kOutput, kFeatures, kAlign, kWeld, kQuiet, kVerbose},
         run_diff,
         "0  the labelings are equal\n1  they differ\n" + kNoResultStatus,
         kPartFile + "\nA, B    labels, as LABELS of polylab label",
         "polylab diff part.obj before.txt after.txt"},
        {"surface",
         {"TETS"},
         "Extracts the surface of a tet mesh, facing outward.",
         {{"-o", "FILE", "the surface: .obj or .mesh"},
          {"--map", "FILE", "for each triangle of the surface: 4 * tetrahedron + local facet"},
          kQuiet,
          kVerbose},
         run_surface,
         kDoneStatus,
         "TETS    a tet mesh (.mesh .vtk); lines = feature edges, of which those on the surface stay",
         "polylab surface tet.mesh -o surface.obj --map map.txt"},
        {"volume-labels",
         {"LABELS", "MAP"},
         "Carries surface labels to the facets of the tetrahedra: four labels per tetrahedron, -1 inside.",
         {kOutput},
         run_volume_labels,
         kDoneStatus,
         "LABELS  one label per triangle of the surface\nMAP     what polylab surface --map wrote",
         "polylab volume-labels labels.txt map.txt -o volume_labels.txt"},
        {"export",
         {"PART", "LABELS"},
         "Writes a labeled surface for other programs." + kElements,
         {{"-o", "FILE", ".vtk (ParaView), .glb (coloured), .mesh (labels as references) or .obj (PolyCut's materials)"},
          kFeatures,
          kAlign,
          kWeld,
          kQuiet,
          kVerbose},
         run_export,
         kDoneStatus,
         kPartFile + kLabelsFile,
         "polylab export part.obj labels.txt -o labeled.glb"},
        {"polycube",
         {"PART", "LABELS"},
         "Moves the surface onto the polycube that its labels ask for.\n\n"
         "Each chart goes into a plane across its axis, by least squares. Vertices and facets keep their numbers.",
         {{"-o", "FILE", "the polycube: .obj or .mesh; as .obj to standard output without this, or with -"},
          {"--stats", "JSON", "also write the statistics, with the distortion of the polycube"},
          kFeatures,
          kAlign,
          kWeld,
          kQuiet,
          kVerbose},
         run_polycube,
         kDoneStatus,
         kPartFile + kLabelsFile,
         "polylab polycube part.obj labels.txt -o polycube.obj --stats stats.json"},
        {"stages",
         {"PART", "DIR"},
         "Writes what each step of the method gives, to compare a port with.\n\n"
         "The files are 01-mesh.txt … 10-statistics.txt, which golden/README.md explains. All options are at their defaults.",
         {},
         run_stages,
         kDoneStatus,
         kPartFile + "\nDIR     a folder that is there",
         "polylab stages part.obj stages"},
    };
    return table;
}

// No output goes to the place of the part.
void spare_part(const Arguments& arguments) {
    std::error_code ignored;
    for (const char* name : {"-o", "--stats", "--report", "--picture", "--trace", "--map"})
        if (arguments.has(name) && std::filesystem::is_regular_file(arguments.get(name), ignored) &&
            std::filesystem::equivalent(arguments.get(name), arguments.operands[0], ignored))
            throw InputError(arguments.get(name), 0, "can't be written: it is read as " + arguments.operands[0]);
}

std::string overview() {
    std::string text =
        "polylab gives every triangle of a CAD part's surface one of six labels +X -X +Y -Y +Z -Z: a polycube labeling.\n\n"
        "usage: polylab COMMAND …\n\n";
    for (const Command& command : commands()) {
        std::string name = "  " + command.name;
        name.resize(17, ' ');
        text += name + command.about.substr(0, command.about.find('\n')) + "\n";
    }
    return text +
           "\nfirst steps:\n"
           "  polylab label part.obj -o labels.txt      label a part\n"
           "  polylab explain part.obj labels.txt       what is wrong with the result, if anything\n"
           "  polylab help label                        all about a command\n\n"
           "exit status: 0 done (and valid), 1 done but not valid, or interrupted (the best labels so far are written),\n"
           "2 no result (wrong use, wrong input, output can't be written)\n\n"
           "the published commands, where the program is called by their names (PREFIX/libexec/polylab has links):\n" +
           dropin_overview();
}

int run(const std::vector<std::string>& words) {
    std::string first = words.empty() ? "" : words[0];
    bool wants_help = first == "--help" || first == "-h" || first == "help";
    if (wants_help && words.size() < 2) {
        write_file("-", overview());
        return kDone;
    }
    if (wants_help) first = words[1];
    if (first == "--version") {
        write_file("-",
                   program_name() + "\nthe same labels on Linux x86-64 and aarch64, built by g++ 12 or clang 14 and later\n");
        return kDone;
    }
    for (const Command& command : commands()) {
        if (command.name != first) continue;
        const std::vector<std::string> rest(words.begin() + 1, words.end());
        const auto end = std::find(rest.begin(), rest.end(), "--");
        wants_help = wants_help || std::find_if(rest.begin(), end,
                                                [](const std::string& word) { return word == "--help" || word == "-h"; }) != end;
        if (wants_help) {
            write_file("-", help("polylab", command));
            return kDone;
        }
        try {
            const Arguments arguments = parse_arguments(command, rest);
            spare_part(arguments);
            return command.run(arguments);
        } catch (const UsageError& error) {
            std::fprintf(stderr, "polylab %s: %s (see polylab %s --help)\n", first.c_str(), error.what(), first.c_str());
            return kNoResult;
        }
    }
    std::fprintf(stderr, "polylab: %s (see polylab --help)\n",
                 first.empty() ? "missing command" : ("unknown command '" + first + "'").c_str());
    return kNoResult;
}

}   // namespace
}   // namespace polylab

int main(int argc, char** argv) {
    polylab::prepare_heap();
    try {
        const std::string called = argc > 0 ? argv[0] : "", name = called.substr(called.find_last_of('/') + 1);
        const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
        return polylab::is_dropin(name) ? polylab::run_dropin(name, words) : polylab::run(words);
    } catch (const polylab::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "polylab: not enough memory%s\n", polylab::memory_needed.c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "polylab: internal error: %s\n", error.what());
    }
    return polylab::kNoResult;
}

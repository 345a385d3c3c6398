#include "polylab/dropin.h"

#include "polylab/cli.h"
#include "polylab/exports.h"
#include "polylab/mesh_stats.h"
#include "polylab/polylab.h"
#include "polylab/report.h"

#include <cstdio>
#include <filesystem>
#include <sstream>

namespace polylab {

namespace {

struct DropIn {
    const char* name;
    const char* usage;   // operands, in brackets where they can be left out, then keys with their defaults
    void (*run)(const Arguments&);
};

// ---- input and output

void tell(const std::string& line) { write_file("-", line + "\n"); }

void warn_of(const std::string& path, const std::vector<std::string>& said) {
    for (const std::string& note : said) std::fprintf(stderr, "%s: %s\n", path.c_str(), note.c_str());
}

TriMesh read_dropin_surface(const std::string& path) {
    TriMesh mesh = read_surface(path);
    warn_of(path, notes(mesh));
    return mesh;
}

void write_surface_labels(const std::string& path, const Labeling& labels) {
    std::string text = labels_text(labels);
    text.pop_back();   // the published code ends the last line with the file
    write_file(path, text);
}

// Labels, and a line of what they are worth.
void finish_labeling(const std::string& path, const TriMesh& mesh, const Labeling& labels) {
    write_surface_labels(path, labels);
    tell(summary(statistics(mesh, labels, build_graph(mesh, labels))));
}

// To the file that operand i names, or to standard output where there is none.
void write_operand(const Arguments& given, std::size_t i, const std::string& text) {
    write_file(given.operands.size() > i ? given.operands[i] : "-", text);
}

bool truth(const Arguments& given, const std::string& key) {
    const std::string text = given.get(key);
    if (text == "true" || text == "1") return true;
    if (text == "false" || text == "0") return false;
    throw UsageError(key + ": expected true or false, found '" + text + "'");
}

// ---- labelings

// differs: a labeling that is better, by the same routines and what comes after them; nothing is undone at the end.
void run_automatic_polycube(const Arguments& given) {
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    const bool start = given.operands.size() > 1;
    const Labeling labels = search(mesh, start ? read_labels(given.operands[1], mesh.facets()) : search_start(mesh)).labels;
    finish_labeling(given.get("output"), mesh, labels);
}

void run_graphcut_labeling(const Arguments& given) {
    InitialOptions options;
    options.compactness = given.integer("compactness", 0, 0, 1000);
    options.fidelity = given.integer("fidelity", 0, 0, 1000);
    options.sensitivity = given.number("sensitivity", 0, 0, 1);
    options.angle = given.number("angle_of_rotation", 0, -1, 1);
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    finish_labeling(given.get("output"), mesh, graphcut_labeling(mesh, options));
}

// differs: this and labeling_stats turn a surface that faces inward, as the other commands do in both programs.
void run_naive_labeling(const Arguments& given) {
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    finish_labeling(given.operands[1], mesh, naive_labeling(mesh));
}

void run_labeling_stats(const Arguments& given) {
    const bool allow_opposite = truth(given, "allow-opposite-labels");
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    const Labeling labels = read_labels(given.operands[1], mesh.facets());
    write_operand(given, 2, published_json(statistics(mesh, labels, build_graph(mesh, labels, allow_opposite))));
}

// ---- tetrahedra

// The tet mesh with the triangles of its surface, which count from 0 among the vertices on the surface.
MeshData with_cells(MeshData tets, const TetSurface& extracted) {
    std::vector<char> on_surface(tets.points.size(), 0);
    for (const Index id : extracted.map.tet_facet)
        for (Index k = 0; k < 4; k++)
            if (k != id % 4) on_surface[tets.tets[id - id % 4 + k]] = 1;
    std::vector<Index> vertex;   // on the surface -> in the tet mesh
    for (std::size_t v = 0; v < on_surface.size(); v++)
        if (on_surface[v]) vertex.push_back(static_cast<Index>(v));
    tets.triangles.clear();
    for (const Index v : extracted.surface.triangles) tets.triangles.push_back(vertex[v]);
    return tets;
}

// A surface that is there stays, and gets its map. differs: it has to have the facets of the extraction in their order, where
// the published code looks for the nearest vertices and takes tetrahedron 0 for what it does not find.
void run_extract_surface(const Arguments& given) {
    const std::string &input = given.operands[0], &output = given.operands[1];
    const MeshData tets = read_mesh(input);
    std::vector<std::string> said;
    const TetSurface extracted = outward_surface(tets, input, said);
    warn_of(input, said);
    const std::string map = surface_map_text(extracted.map);
    std::string surface;
    std::vector<Output> outputs = {{given.operands[2], map}};
    if (std::filesystem::exists(output)) {
        if (read_mesh(output).triangles != extracted.surface.triangles)
            throw InputError(output, 0, "expected the surface of " + input + " in the order of its tetrahedra, or no file here");
    } else {
        surface = mesh_text(output, truth(given, "write-cells") ? with_cells(tets, extracted) : extracted.surface);
        outputs.push_back({output, surface});
    }
    write_files(outputs);
    tell(std::to_string(extracted.map.tets) + " tetrahedra, " + std::to_string(extracted.map.tet_facet.size()) +
         " triangles on the surface");
}

void run_volume_labeling(const Arguments& given) {
    const SurfaceMap map = read_surface_map(given.operands[1]);
    const Labeling labels = read_labels(given.operands[0], static_cast<Index>(map.tet_facet.size()));
    write_file(given.operands[2], labels_text(volume_labels(labels, map)));
}

// ---- meshes

void run_mesh_stats(const Arguments& given) {
    const std::string axes_file = given.get("principal_axes");
    const MeshData data = read_mesh(given.operands[0]);
    const std::string json = mesh_stats_json(data);
    MeshData axes;   // a segment along each, as long as the vertices spread
    std::string axes_text;
    std::vector<Output> outputs = {{given.operands.size() > 1 ? given.operands[1] : "-", json}};
    if (!axes_file.empty()) {
        if (data.points.empty()) throw InputError(given.operands[0], 0, "expected vertices, found none");
        const PrincipalAxes found = principal_axes(data.points);
        axes.points = {found.centre};
        for (int k = 0; k < 3; k++) {
            axes.points.push_back(found.centre + found.axis[k] * found.extent[k]);
            axes.edges.insert(axes.edges.end(), {0, k + 1});
        }
        outputs.push_back({axes_file, axes_text = obj_text(axes)});
    }
    write_files(outputs);
}

// The vertices of a polycube that has those of the mesh.
std::vector<Vec3> read_polycube(const std::string& path, const TriMesh& mesh) {
    MeshData data = read_mesh(path);
    if (static_cast<Index>(data.points.size()) != mesh.vertices())
        throw InputError(path, 0,
                         "expected the " + std::to_string(mesh.vertices()) + " vertices of the surface, found " +
                             std::to_string(data.points.size()));
    return std::move(data.points);
}

void run_polycube_distortion(const Arguments& given) {
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    const Distortion d = distortion(mesh, read_polycube(given.operands[1], mesh));
    JsonWriter json;
    json.open_object();
    json.value("angle_distortion", d.angle);
    json.value("area_distortion", d.area);
    json.value("isometric_distortion", d.isometric);
    json.value("stretch", d.stretch);
    json.close_object();
    write_operand(given, 2, json.text() + "\n");
}

void run_to_gltf(const Arguments& given) {
    const std::string labels = given.get("labeling"), polycube = given.get("polycube");
    const TriMesh mesh = read_dropin_surface(given.operands[0]);
    write_file(given.operands[1], glb_text(mesh, labels.empty() ? Labeling{} : read_labels(labels, mesh.facets()),
                                           polycube.empty() ? std::vector<Vec3>{} : read_polycube(polycube, mesh)));
}

// ---- viewers

// There is no window: the page goes beside the labels.
void run_labeling_viewer(const Arguments& given) {
    const std::string &part = given.operands[0], &labels_file = given.operands[1];
    const TriMesh mesh = read_dropin_surface(part);
    const Labeling labels = read_labels(labels_file, mesh.facets());
    Report report;
    report.title = title_of(part);
    report.parameters = {{"part", part}, {"labels", labels_file}};
    report.layers = {{"naive", naive_labeling(mesh)}, {"graph-cut", graphcut_labeling(mesh)}, {"given", labels}};
    if (build_graph(mesh, labels).valid()) report.polycube = surface_polycube(mesh, labels);
    const std::string page = std::filesystem::path(labels_file).replace_extension(".html").string();
    write_file(page, report_html(mesh, report));
    tell("open this page in a browser: " + std::filesystem::absolute(page).string());
}

void run_labeling_painter(const Arguments& given) {
    run_labeling_viewer(given);
    tell("to change labels: polylab label --lock");
}

void run_hex_mesh_viewer(const Arguments& given) {
    throw InputError(given.operands[0], 0, "hexahedra can't be shown here; mesh_stats measures them, hexalab.net shows them");
}

// Makefile and CMakeLists.txt take the names from here: one entry begins on a line of its own.
constexpr DropIn kDropIns[] = {
    {"automatic_polycube", "SURFACE [INITIAL_LABELING] [gui=false] [output=labeling.txt]", run_automatic_polycube},
    {"graphcut_labeling",
     "SURFACE [compactness=1] [fidelity=3] [sensitivity=1e-9] [angle_of_rotation=0.05] [gui=false] [output=labeling.txt]",
     run_graphcut_labeling},
    {"naive_labeling", "SURFACE LABELING", run_naive_labeling},
    {"labeling_stats", "SURFACE LABELING [JSON] [allow-opposite-labels=true]", run_labeling_stats},
    {"extract_surface", "TETS SURFACE MAP [write-cells=false]", run_extract_surface},
    {"volume_labeling", "LABELING MAP VOLUME_LABELING", run_volume_labeling},
    {"mesh_stats", "MESH [JSON] [principal_axes=]", run_mesh_stats},
    {"polycube_distortion", "SURFACE POLYCUBE [JSON]", run_polycube_distortion},
    {"to_glTF", "SURFACE GLB [labeling=] [polycube=]", run_to_gltf},
    {"labeling_viewer", "SURFACE LABELING [GEOGRAM]", run_labeling_viewer},
    {"labeling_painter", "SURFACE LABELING", run_labeling_painter},
    {"hex_mesh_viewer", "HEXES", run_hex_mesh_viewer},
};

const DropIn* find_dropin(const std::string& name) {
    for (const DropIn& command : kDropIns)
        if (name == command.name) return &command;
    return nullptr;
}

// The words by the command's usage. A word with '=' is a key and its value, unless a folder comes before the '='.
Arguments parse_dropin(const DropIn& command, const std::vector<std::string>& words) {
    Arguments given;
    std::vector<std::string> wanted;   // operands
    std::size_t most = 0;
    std::istringstream usage(command.usage);
    for (std::string word; usage >> word;) {
        const bool optional = word[0] == '[';
        if (optional) word = word.substr(1, word.size() - 2);
        const std::size_t equal = word.find('=');
        if (equal != std::string::npos) {
            given.options[word.substr(0, equal)] = word.substr(equal + 1);
        } else {
            most++;
            if (!optional) wanted.push_back(word);
        }
    }
    for (const std::string& word : words) {
        const std::size_t equal = word.find('=');
        const std::string key = word.substr(0, equal);
        if (equal == std::string::npos || key.find('/') != std::string::npos) {
            if (given.operands.size() == most) throw UsageError("unexpected '" + word + "'");
            given.operands.push_back(word);
        } else if (given.has(key)) {
            given.options[key] = word.substr(equal + 1);
        } else {
            throw UsageError("unknown key '" + key + "'");
        }
    }
    if (given.operands.size() < wanted.size()) throw UsageError("missing " + wanted[given.operands.size()]);
    return given;
}

}   // namespace

bool is_dropin(const std::string& name) { return find_dropin(name) != nullptr; }

int run_dropin(const std::string& name, const std::vector<std::string>& words) {
    const DropIn& command = *find_dropin(name);
    const std::string usage = "usage: " + name + " " + command.usage;
    try {
        if (words.size() == 1 && (words[0] == "--help" || words[0] == "-h")) {
            tell(usage);
            return 0;
        }
        command.run(parse_dropin(command, words));
        return 0;
    } catch (const UsageError& error) {
        std::fprintf(stderr, "%s: %s (%s)\n", name.c_str(), error.what(), usage.c_str());
    } catch (const InputError& error) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    }
    return 1;
}

std::string dropin_overview() {
    std::string text;
    for (const DropIn& command : kDropIns) text += std::string("  ") + command.name + " " + command.usage + "\n";
    return text;
}

}   // namespace polylab

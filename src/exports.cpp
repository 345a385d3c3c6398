#include "polylab/exports.h"

#include "polylab/io.h"
#include "polylab/json.h"
#include "polylab/labeling_graph.h"
#include "polylab/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace polylab {

namespace {

void append_vector(std::string& out, const Vec3& p) {
    for (int a = 0; a < 3; a++) {
        append(out, p[a]);
        out += a < 2 ? ' ' : '\n';
    }
}

void append_indices(std::string& out, const std::vector<Index>& elements, std::size_t first, int n, Index base) {
    for (int k = 0; k < n; k++) {
        append(out, elements[first + k] + base);
        if (k + 1 < n) out += ' ';
    }
}

// ---- VTK

std::string vtk_text(const TriMesh& mesh, const Labeling& labels) {
    const LabelingGraph graph = build_graph(mesh, labels);
    const std::string facets = std::to_string(mesh.facets());
    std::string out =
        "# vtk DataFile Version 2.0\npolycube labeling: 0 +X, 1 -X, 2 +Y, 3 -Y, 4 +Z, 5 -Z\nASCII\n"
        "DATASET UNSTRUCTURED_GRID\nPOINTS " +
        std::to_string(mesh.vertices()) + " double\n";
    for (const Vec3& p : mesh.points) append_vector(out, p);
    out += "CELLS " + facets + " " + std::to_string(4 * std::int64_t{mesh.facets()}) + "\n";
    for (Index f = 0; f < mesh.facets(); f++) {
        out += "3 ";
        append_indices(out, mesh.origin, 3 * static_cast<std::size_t>(f), 3, 0);
        out += '\n';
    }
    out += "CELL_TYPES " + facets + "\n";
    for (Index f = 0; f < mesh.facets(); f++) out += "5\n";
    out += "CELL_DATA " + facets + "\nSCALARS label int 1\nLOOKUP_TABLE default\n" + labels_text(labels);
    out += "SCALARS chart int 1\nLOOKUP_TABLE default\n";
    for (const Index c : graph.chart) {
        append(out, c);
        out += '\n';
    }
    out += "SCALARS fidelity double 1\nLOOKUP_TABLE default\n";
    for (Index f = 0; f < mesh.facets(); f++) {
        append(out, fidelity(mesh.normal[f], labels[f]));
        out += '\n';
    }
    out += "VECTORS normal double\n";
    for (const Vec3& n : mesh.normal) append_vector(out, n);
    return out;
}

// ---- MEDIT and OBJ

std::string labeled_medit_text(const TriMesh& mesh, const Labeling& labels) {
    MeshData data = mesh_data(mesh);
    data.triangles.clear();
    std::string out = medit_text(data);
    out.resize(out.size() - std::strlen("End\n"));
    out += "Triangles\n" + std::to_string(mesh.facets()) + "\n";
    for (Index f = 0; f < mesh.facets(); f++) {
        append_indices(out, mesh.origin, 3 * static_cast<std::size_t>(f), 3, 1);
        out += ' ';
        append(out, Index{labels[f]});
        out += '\n';
    }
    return out + "End\n";
}

constexpr const char* kMaterial[kLabels] = {"red", "darkred", "green", "darkgreen", "blue", "darkblue"};

std::string mtl_text() {
    std::string out;
    for (Label l = 0; l < kLabels; l++) {
        const char* const value = l % 2 == 0 ? "1" : "0.6";
        out += std::string("newmtl ") + kMaterial[l] + "\nKd";
        for (int a = 0; a < 3; a++) out += std::string(" ") + (a == axis(l) ? value : "0");
        out += '\n';
    }
    return out;
}

std::string labeled_obj_text(const TriMesh& mesh, const Labeling& labels, const std::string& mtl) {
    const MeshData data = mesh_data(mesh);
    std::string out = "mtllib " + mtl + "\n";
    for (const Vec3& p : data.points) {
        out += "v ";
        append_vector(out, p);
    }
    for (Index f = 0; f < mesh.facets(); f++) {
        out += std::string("usemtl ") + kMaterial[labels[f]] + "\nf ";
        append_indices(out, mesh.origin, 3 * static_cast<std::size_t>(f), 3, 1);
        out += '\n';
    }
    for (std::size_t e = 0; e < data.edges.size(); e += 2) {
        out += "l ";
        append_indices(out, data.edges, e, 2, 1);
        out += '\n';
    }
    return out;
}

// ---- glTF

void append_word(std::string& out, std::uint32_t word) {
    for (int i = 0; i < 4; i++) out += static_cast<char>(word >> (8 * i) & 255);
}

// A chunk: length, kind, content filled up to a multiple of four.
void append_chunk(std::string& out, const char* kind, std::string content, char filler) {
    while (content.size() % 4 != 0) content += filler;
    append_word(out, static_cast<std::uint32_t>(content.size()));
    out.append(kind, 4);
    out += content;
}

// #FF0000 #990000 #FFFFFF #999999 #0000FF #000099 in linear light: 0x99 is 0.318547.
constexpr double kDark = 0.318547;
constexpr double kMaterialColour[kLabels][3] = {{1, 0, 0}, {kDark, 0, 0}, {1, 1, 1}, {kDark, kDark, kDark},
                                                {0, 0, 1}, {0, 0, kDark}};

// What the binary chunk holds: arrays one after the other, and how to read each.
class GlbArrays {
public:
    enum class Target { none = 0, vertices = 34962, triangles = 34963 };

    // Returns its number.
    Index add_vectors(const std::vector<Vec3>& vectors) {
        begin(kFloat, "VEC3", vectors.size(), Target::vertices);
        for (const Vec3& v : vectors)
            for (int a = 0; a < 3; a++) add_float(v[a], a);
        return number();
    }
    Index add_floats(const std::vector<double>& numbers) {
        begin(kFloat, "SCALAR", numbers.size(), Target::none);
        for (const double x : numbers) add_float(x, 0);
        return number();
    }
    // The vertices of the facets with label l, or of all without labels; kNone if there are none.
    Index add_facets(const TriMesh& mesh, const Labeling& labels, Label l) {
        begin(kUnsigned, "SCALAR", 0, Target::triangles);
        for (Index h = 0; h < mesh.halfedges(); h++) {
            if (!labels.empty() && labels[facet(h)] != l) continue;
            append_word(bytes, static_cast<std::uint32_t>(mesh.origin[h]));
            arrays_.back().count++;
        }
        if (arrays_.back().count > 0) return number();
        arrays_.pop_back();
        return kNone;
    }

    void write_json(JsonWriter& json) const {
        json.open_array("accessors");
        for (std::size_t i = 0; i < arrays_.size(); i++) {
            const Array& array = arrays_[i];
            json.open_object();
            json.value("bufferView", static_cast<Index>(i));
            json.value("componentType", Index{array.component});
            json.value("count", static_cast<Index>(array.count));
            for (const auto& [key, values] : {std::pair{"min", &array.least}, std::pair{"max", &array.most}}) {
                if (values->empty()) continue;
                json.open_array(key);
                for (const float x : *values) json.value("", double{x});
                json.close_array();
            }
            json.value("type", array.type);
            json.close_object();
        }
        json.close_array();
        json.open_array("bufferViews");
        for (std::size_t i = 0; i < arrays_.size(); i++) {
            const std::size_t end = i + 1 < arrays_.size() ? arrays_[i + 1].offset : bytes.size();
            json.open_object();
            json.value("buffer", Index{0});
            json.value("byteLength", static_cast<Index>(end - arrays_[i].offset));
            json.value("byteOffset", static_cast<Index>(arrays_[i].offset));
            if (arrays_[i].target != Target::none) json.value("target", static_cast<Index>(arrays_[i].target));
            json.close_object();
        }
        json.close_array();
    }

    std::string bytes;

private:
    static constexpr int kFloat = 5126, kUnsigned = 5125;
    struct Array {
        int component;
        const char* type;
        std::size_t count, offset;
        Target target;
        std::vector<float> least, most;   // per component, of floats
    };

    void begin(int component, const char* type, std::size_t count, Target target) {
        arrays_.push_back({component, type, count, bytes.size(), target, {}, {}});
    }
    Index number() const { return static_cast<Index>(arrays_.size()) - 1; }
    void add_float(double value, std::size_t component) {
        const float x = static_cast<float>(value);
        if (!std::isfinite(x)) throw InputError("expected coordinates up to 3e38 for .glb, found " + std::to_string(value));
        std::uint32_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        append_word(bytes, bits);
        Array& array = arrays_.back();
        if (array.least.size() <= component) {
            array.least.push_back(x);
            array.most.push_back(x);
        }
        array.least[component] = std::min(array.least[component], x);
        array.most[component] = std::max(array.most[component], x);
    }

    std::vector<Array> arrays_;
};

void write_material(JsonWriter& json, const char* name, const double (&colour)[3]) {
    json.open_object();
    json.value("name", name);
    json.open_object("pbrMetallicRoughness");
    json.open_array("baseColorFactor");
    for (const double c : colour) json.value("", c);
    json.value("", 1.0);
    json.close_array();
    json.value("metallicFactor", 0.0);
    json.value("roughnessFactor", 0.8);
    json.close_object();
    json.close_object();
}

// There and back in eight seconds, with a rest at both ends.
const std::vector<double> kMorphSeconds = {0, 1, 4, 5, 8}, kMorphWeights = {0, 0, 1, 1, 0};

void write_animation(JsonWriter& json, GlbArrays& arrays) {
    json.open_array("animations");
    json.open_object();
    json.open_array("channels");
    json.open_object();
    json.value("sampler", Index{0});
    json.open_object("target");
    json.value("node", Index{0});
    json.value("path", "weights");
    json.close_object();
    json.close_object();
    json.close_array();
    json.value("name", "polycube");
    json.open_array("samplers");
    json.open_object();
    json.value("input", arrays.add_floats(kMorphSeconds));
    json.value("interpolation", "LINEAR");
    json.value("output", arrays.add_floats(kMorphWeights));
    json.close_object();
    json.close_array();
    json.close_object();
    json.close_array();
}

// An array with one object, as most of glTF's are: of the key, and its value.
void write_only(JsonWriter& json, const char* array, const char* key, Index value) {
    json.open_array(array);
    json.open_object();
    json.value(key, value);
    json.close_object();
    json.close_array();
}

}   // namespace

// One primitive per label that occurs, all on one array of positions. Without normals, viewers shade facets flat.
std::string glb_text(const TriMesh& mesh, const Labeling& labels, const std::vector<Vec3>& polycube) {
    if (std::int64_t{mesh.vertices()} * 24 + std::int64_t{mesh.facets()} * 12 > 2000000000)
        throw InputError("expected a surface of at most 80 million facets for .glb");
    GlbArrays arrays;
    const Index positions = arrays.add_vectors(mesh.points);
    Index displacements = kNone;
    if (!polycube.empty()) {
        std::vector<Vec3> moved(mesh.points.size());
        for (std::size_t v = 0; v < moved.size(); v++) moved[v] = polycube[v] - mesh.points[v];
        displacements = arrays.add_vectors(moved);
    }

    JsonWriter json;
    json.open_object();
    if (displacements != kNone) write_animation(json, arrays);
    json.open_object("asset");
    json.value("generator", "polylab");
    json.value("version", "2.0");
    json.close_object();
    json.open_array("materials");
    const int materials = labels.empty() ? 1 : kLabels;
    if (labels.empty())
        write_material(json, "surface", {0.5, 0.5, 0.5});
    else
        for (int l = 0; l < materials; l++) write_material(json, kLabelName[l], kMaterialColour[l]);
    json.close_array();
    json.open_array("meshes");
    json.open_object();
    json.open_array("primitives");
    for (int l = 0; l < materials; l++) {
        const Index indices = arrays.add_facets(mesh, labels, static_cast<Label>(l));
        if (indices == kNone) continue;
        json.open_object();
        json.open_object("attributes");
        json.value("POSITION", positions);
        json.close_object();
        json.value("indices", indices);
        json.value("material", Index{l});
        if (displacements != kNone) write_only(json, "targets", "POSITION", displacements);
        json.close_object();
    }
    json.close_array();
    json.close_object();
    json.close_array();
    write_only(json, "nodes", "mesh", 0);
    json.value("scene", Index{0});
    json.open_array("scenes");
    json.open_object();
    json.open_array("nodes");
    json.value("", Index{0});
    json.close_array();
    json.close_object();
    json.close_array();
    arrays.write_json(json);
    write_only(json, "buffers", "byteLength", static_cast<Index>(arrays.bytes.size()));
    json.close_object();

    std::string chunks, out = "glTF";
    append_chunk(chunks, "JSON", json.text(), ' ');
    append_chunk(chunks, std::string("BIN\0", 4).c_str(), arrays.bytes, '\0');
    append_word(out, 2);
    append_word(out, static_cast<std::uint32_t>(12 + chunks.size()));
    return out + chunks;
}

std::vector<ExportedFile> export_files(const std::string& path, const TriMesh& mesh, const Labeling& labels) {
    if (has_extension(path, ".vtk")) return {{path, vtk_text(mesh, labels)}};
    if (has_extension(path, ".glb")) return {{path, glb_text(mesh, labels)}};
    if (has_extension(path, ".mesh")) return {{path, labeled_medit_text(mesh, labels)}};
    if (!has_extension(path, ".obj")) return {};
    const std::string mtl = path.substr(0, path.size() - 4) + ".mtl";
    return {{path, labeled_obj_text(mesh, labels, mtl.substr(mtl.find_last_of("/\\") + 1))}, {mtl, mtl_text()}};
}

}   // namespace polylab

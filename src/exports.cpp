#include "polylab/exports.h"

#include "polylab/io.h"
#include "polylab/json.h"
#include "polylab/labeling_graph.h"
#include "polylab/statistics.h"

#include <cmath>
#include <cstring>

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
    out += "NORMALS normal double\n";
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

std::string labeled_obj_text(const TriMesh& mesh, const Labeling& labels) {
    constexpr const char* kMaterial[kLabels] = {"red", "darkred", "green", "darkgreen", "blue", "darkblue"};   // PolyCut's names
    const MeshData data = mesh_data(mesh);
    std::string out;
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

void write_accessor(JsonWriter& json, Index view, std::size_t offset, int component_type, std::size_t count, const char* type) {
    json.value("bufferView", view);
    json.value("byteOffset", static_cast<Index>(offset));
    json.value("componentType", Index{component_type});
    json.value("count", static_cast<Index>(count));
    json.value("type", type);
}

void write_view(JsonWriter& json, std::size_t offset, std::size_t length, int target) {
    json.open_object();
    json.value("buffer", Index{0});
    json.value("byteLength", static_cast<Index>(length));
    json.value("byteOffset", static_cast<Index>(offset));
    json.value("target", Index{target});
    json.close_object();
}

// One primitive per label that occurs, all on one array of positions. Without normals, viewers shade facets flat.
std::string glb_text(const TriMesh& mesh, const Labeling& labels) {
    constexpr int kFloat = 5126, kUnsigned = 5125, kVertexTarget = 34962, kIndexTarget = 34963;
    if (std::int64_t{mesh.vertices()} * 12 + std::int64_t{mesh.facets()} * 12 > 2000000000)
        throw InputError("expected a surface of at most 80 million facets for .glb");
    std::string buffer;
    Vec3 least, most;
    for (Index v = 0; v < mesh.vertices(); v++)
        for (int a = 0; a < 3; a++) {
            const float x = static_cast<float>(mesh.points[v][a]);
            if (!std::isfinite(x)) throw InputError("vertex " + std::to_string(v) + ": expected coordinates up to 3e38 for .glb");
            std::uint32_t bits;
            std::memcpy(&bits, &x, sizeof bits);
            append_word(buffer, bits);
            if (v == 0 || x < least[a]) least[a] = x;
            if (v == 0 || x > most[a]) most[a] = x;
        }
    const std::size_t positions = buffer.size();
    std::size_t count[kLabels] = {};
    for (Label l = 0; l < kLabels; l++)
        for (Index h = 0; h < mesh.halfedges(); h++) {
            if (labels[facet(h)] != l) continue;
            append_word(buffer, static_cast<std::uint32_t>(mesh.origin[h]));
            count[l]++;
        }

    JsonWriter json;
    json.open_object();
    json.open_array("accessors");
    json.open_object();
    write_accessor(json, 0, 0, kFloat, mesh.points.size(), "VEC3");
    for (const auto& [key, p] : {std::pair{"min", least}, std::pair{"max", most}}) {
        json.open_array(key);
        for (int a = 0; a < 3; a++) json.value("", p[a]);
        json.close_array();
    }
    json.close_object();
    std::size_t offset = 0;
    for (Label l = 0; l < kLabels; l++) {
        if (count[l] == 0) continue;
        json.open_object();
        write_accessor(json, 1, offset, kUnsigned, count[l], "SCALAR");
        json.close_object();
        offset += 4 * count[l];
    }
    json.close_array();
    json.open_object("asset");
    json.value("generator", "polylab");
    json.value("version", "2.0");
    json.close_object();
    json.open_array("bufferViews");
    write_view(json, 0, positions, kVertexTarget);
    write_view(json, positions, buffer.size() - positions, kIndexTarget);
    json.close_array();
    json.open_array("buffers");
    json.open_object();
    json.value("byteLength", static_cast<Index>(buffer.size()));
    json.close_object();
    json.close_array();
    json.open_array("materials");
    for (Label l = 0; l < kLabels; l++) {
        json.open_object();
        json.value("name", kLabelName[l]);
        json.open_object("pbrMetallicRoughness");
        json.open_array("baseColorFactor");
        for (const double c : kMaterialColour[l]) json.value("", c);
        json.value("", 1.0);
        json.close_array();
        json.value("metallicFactor", 0.0);
        json.value("roughnessFactor", 0.8);
        json.close_object();
        json.close_object();
    }
    json.close_array();
    json.open_array("meshes");
    json.open_object();
    json.open_array("primitives");
    Index accessor = 1;
    for (Label l = 0; l < kLabels; l++) {
        if (count[l] == 0) continue;
        json.open_object();
        json.open_object("attributes");
        json.value("POSITION", Index{0});
        json.close_object();
        json.value("indices", accessor++);
        json.value("material", Index{l});
        json.close_object();
    }
    json.close_array();
    json.close_object();
    json.close_array();
    json.open_array("nodes");
    json.open_object();
    json.value("mesh", Index{0});
    json.close_object();
    json.close_array();
    json.value("scene", Index{0});
    json.open_array("scenes");
    json.open_object();
    json.open_array("nodes");
    json.value("", Index{0});
    json.close_array();
    json.close_object();
    json.close_array();
    json.close_object();

    std::string chunks, out = "glTF";
    append_chunk(chunks, "JSON", json.text(), ' ');
    append_chunk(chunks, std::string("BIN\0", 4).c_str(), buffer, '\0');
    append_word(out, 2);
    append_word(out, static_cast<std::uint32_t>(12 + chunks.size()));
    return out + chunks;
}

}   // namespace

std::string export_text(const std::string& path, const TriMesh& mesh, const Labeling& labels) {
    if (has_extension(path, ".vtk")) return vtk_text(mesh, labels);
    if (has_extension(path, ".glb")) return glb_text(mesh, labels);
    if (has_extension(path, ".mesh")) return labeled_medit_text(mesh, labels);
    if (has_extension(path, ".obj")) return labeled_obj_text(mesh, labels);
    return {};
}

}   // namespace polylab

#include "polylab/io.h"

#include "polylab/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace polylab {

namespace {

constexpr Index kLargestCount = std::numeric_limits<Index>::max() / 8;

Vec3 read_point(Scanner& in) {
    const double x = in.number("a coordinate"), y = in.number("a coordinate"), z = in.number("a coordinate");
    return {x, y, z};
}

// ---- OBJ

class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name) : in_(text, name) {
        Index points = 0, triangles = 0;   // of a file as most are; only to reserve memory
        for (std::size_t at = 0; at + 1 < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
            if (text[at + 1] != ' ') continue;
            points += text[at] == 'v';
            triangles += text[at] == 'f';
        }
        data_.points.reserve(points);
        data_.triangles.reserve(3 * static_cast<std::size_t>(triangles));
    }

    MeshData read() {
        do {
            const std::string_view keyword = in_.token_in_line();
            if (keyword == "v") read_vertex();
            if (keyword == "f") read_facet();
            if (keyword == "l") read_polyline();
        } while (in_.next_line());
        if (largest_ >= vertices()) throw InputError(in_.file(), largest_line_, range(largest_ + 1));
        return std::move(data_);
    }

private:
    Index vertices() const { return static_cast<Index>(data_.points.size()); }
    std::string range(Index found) const {
        return "expected a vertex index from 1 to " + std::to_string(vertices()) + ", found " + std::to_string(found);
    }

    void read_vertex() {
        Vec3 p;
        for (int a = 0; a < 3; a++) p[a] = in_.number_in_line("a coordinate");
        data_.points.push_back(p);
    }

    // `7`, `7/1`, `7//2`, `7/1/2`; -1 is the vertex read last. Vertices may follow the facets that use them.
    Index read_index(std::string_view token) {
        if (!token.empty() && token[0] == '/') in_.fail("a vertex index", token);
        return vertex(in_.to_integer(token.substr(0, token.find('/')), "a vertex index"));
    }

    Index vertex(Index i) {
        if (i == 0 || i < -vertices()) throw InputError(in_.file(), in_.line(), range(i));
        const Index v = i > 0 ? i - 1 : vertices() + i;
        if (v > largest_) {
            largest_ = v;
            largest_line_ = in_.line();
        }
        return v;
    }

    void read_facet() {
        for (int k = 0; k < 3; k++) {
            const Index i = in_.plain_index_in_line();
            data_.triangles.push_back(i != kNone ? vertex(i) : read_index(in_.token_in_line()));
        }
        if (!in_.token_in_line().empty())
            throw InputError(in_.file(), in_.line(),
                             "expected a triangle, found a polygon with more than three sides (triangulate the surface first)");
    }

    void read_polyline() {
        Index previous = read_index(in_.token_in_line());
        std::string_view token = in_.token_in_line();
        if (token.empty()) in_.fail("a second vertex index", token);
        for (; !token.empty(); token = in_.token_in_line()) {
            const Index v = read_index(token);
            data_.edges.insert(data_.edges.end(), {previous, v});
            previous = v;
        }
    }

    Scanner in_;
    MeshData data_;
    Index largest_ = kNone, largest_line_ = 0;   // largest vertex index used so far
};

void append_point(std::string& out, const Vec3& p) {
    for (int a = 0; a < 3; a++) {
        if (a) out += ' ';
        append(out, p[a]);
    }
}

// Elements of n vertices, one per line, indices from 1.
void append_elements(std::string& out, const char* head, const std::vector<Index>& elements, int n, const char* tail) {
    for (std::size_t i = 0; i < elements.size(); i += n) {
        out += head;
        for (int k = 0; k < n; k++) {
            if (k) out += ' ';
            append(out, elements[i + k] + 1);
        }
        out += tail;
    }
}

// ---- MEDIT

struct MeditBlock {
    const char* keyword;
    int vertices;
    std::vector<Index> MeshData::*elements;
};
constexpr std::array<MeditBlock, 4> kMeditBlocks = {{{"Edges", 2, &MeshData::edges},
                                                     {"Triangles", 3, &MeshData::triangles},
                                                     {"Tetrahedra", 4, &MeshData::tets},
                                                     {"Hexahedra", 8, &MeshData::hexes}}};

class MeditReader {
public:
    MeditReader(std::string_view text, const std::string& name) : in_(text, name) {}

    MeshData read() {
        std::string_view keyword = in_.token();
        if (keyword != "MeshVersionFormatted") in_.fail("'MeshVersionFormatted'", keyword);
        const Index version = in_.integer("a version from 1 to 3");
        if (version < 1 || version > 3) in_.fail("a version from 1 to 3", std::to_string(version));
        for (keyword = in_.token(); !keyword.empty(); keyword = read_block(keyword)) {}
        if (!vertices_read_) in_.fail("'Vertices'", "");
        for (const Use& use : largest_)
            if (use.vertex >= vertices())
                throw InputError(in_.file(), use.line,
                                 "expected a vertex index from 1 to " + std::to_string(vertices()) + ", found " +
                                     std::to_string(use.vertex + 1));
        return std::move(data_);
    }

private:
    struct Use {
        Index vertex = kNone, line = 0;
    };

    Index vertices() const { return static_cast<Index>(data_.points.size()); }

    // Reads the block that the keyword opens and returns the keyword after it.
    std::string_view read_block(std::string_view keyword) {
        if (keyword == "Dimension") {
            const Index dimension = in_.integer("a dimension");
            if (dimension != 3) in_.fail("dimension 3", std::to_string(dimension));
        } else if (keyword == "Vertices") {
            read_vertices();
        } else if (keyword == "Quadrilaterals") {
            if (read_count() > 0) in_.fail("triangles", "Quadrilaterals");
        } else if (keyword != "End") {
            for (std::size_t i = 0; i < kMeditBlocks.size(); i++) {
                if (keyword != kMeditBlocks[i].keyword) continue;
                read_elements(kMeditBlocks[i], largest_[i]);
                return in_.token();
            }
            return skip_block(keyword);
        }
        return in_.token();
    }

    Index read_count() {
        const Index count = in_.integer("a count");
        if (count < 0 || count > kLargestCount)
            in_.fail("a count from 0 to " + std::to_string(kLargestCount), std::to_string(count));
        return count;
    }

    // An element takes at least two bytes per number in the file, whatever the count claims.
    std::size_t credible(Index count, int numbers) const {
        return std::min(static_cast<std::size_t>(count), in_.bytes_left() / (2 * static_cast<std::size_t>(numbers)) + 1);
    }

    void read_vertices() {
        const Index count = read_count();
        vertices_read_ = true;
        data_.points.clear();
        data_.points.reserve(credible(count, 4));
        for (Index i = 0; i < count; i++) {
            data_.points.push_back(read_point(in_));
            in_.number("a reference");
        }
    }

    void read_elements(const MeditBlock& block, Use& largest) {
        const Index count = read_count();
        std::vector<Index>& elements = data_.*block.elements;
        elements.clear();
        largest = {};
        elements.reserve(credible(count, block.vertices + 1) * block.vertices);
        for (Index i = 0; i < count; i++) {
            for (int k = 0; k < block.vertices; k++) {
                const Index v = in_.integer("a vertex index") - 1;
                if (v < 0) in_.fail("a vertex index from 1", std::to_string(v + 1));
                if (v > largest.vertex) largest = {v, in_.line()};
                elements.push_back(v);
            }
            in_.number("a reference");
        }
    }

    // A block that means nothing here: numbers up to the next word.
    std::string_view skip_block(std::string_view keyword) {
        const auto is_word = [](std::string_view t) {
            return t.empty() || (t[0] >= 'A' && t[0] <= 'Z') || (t[0] >= 'a' && t[0] <= 'z');
        };
        if (!is_word(keyword)) in_.fail("a keyword", keyword);
        std::string_view token = in_.token();
        while (!is_word(token)) {
            in_.to_number(token, "a number or a keyword");
            token = in_.token();
        }
        return token;
    }

    Scanner in_;
    MeshData data_;
    std::array<Use, kMeditBlocks.size()> largest_;   // per block, its largest vertex index
    bool vertices_read_ = false;
};

// ---- STL

// Gives corners with equal coordinates one vertex: open addressing on the coordinates' bits, first come first numbered.
class Welder {
public:
    explicit Welder(std::vector<Vec3>& points) : points_(points), slots_(64, kNone) {}

    Index vertex(const Vec3& p) {
        const Vec3 q = {p.x + 0.0, p.y + 0.0, p.z + 0.0};   // -0.0 + 0.0 is +0.0: equal numbers get equal bits
        if (2 * points_.size() >= slots_.size()) grow();
        Index& slot = slots_[find(q)];
        if (slot == kNone) {
            slot = static_cast<Index>(points_.size());
            points_.push_back(q);
        }
        return slot;
    }

private:
    std::size_t find(const Vec3& p) const {
        std::uint64_t hash = 0, bits;
        for (int a = 0; a < 3; a++) {
            const double c = p[a];
            std::memcpy(&bits, &c, sizeof bits);
            hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        std::size_t i = hash & (slots_.size() - 1);
        while (slots_[i] != kNone && !(points_[slots_[i]] == p)) i = (i + 1) & (slots_.size() - 1);
        return i;
    }
    void grow() {
        slots_.assign(2 * slots_.size(), kNone);
        for (std::size_t v = 0; v < points_.size(); v++) slots_[find(points_[v])] = static_cast<Index>(v);
    }

    std::vector<Vec3>& points_;
    std::vector<Index> slots_;   // size is a power of two
};

constexpr std::size_t kStlHead = 84, kStlFacet = 50;

template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t u = 0;
    for (int i = 0; i < 4; i++) u |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    T value;
    static_assert(sizeof value == sizeof u);
    std::memcpy(&value, &u, sizeof u);
    return value;
}

MeshData read_binary_stl(std::string_view bytes, const std::string& name) {
    MeshData data;
    Welder welder(data.points);
    for (std::size_t at = kStlHead; at < bytes.size(); at += kStlFacet) {
        for (std::size_t k = 0; k < 3; k++) {
            Vec3 p;
            for (std::size_t a = 0; a < 3; a++) p[static_cast<int>(a)] = little_endian<float>(bytes, at + 12 + 12 * k + 4 * a);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                throw InputError(name, 0,
                                 "facet " + std::to_string((at - kStlHead) / kStlFacet) + ": expected finite coordinates");
            data.triangles.push_back(welder.vertex(p));
        }
    }
    return data;
}

MeshData read_ascii_stl(std::string_view text, const std::string& name) {
    MeshData data;
    Welder welder(data.points);
    Scanner in(text, name);
    const auto expect = [&](const char* word) {
        const std::string_view token = in.token();
        if (token != word) in.fail(std::string("'") + word + "'", token);
    };
    bool open = true;   // a solid is begun and not ended
    for (std::string_view token = in.token(); !token.empty() || open; token = in.token()) {
        if (token == "solid" || token == "endsolid") {
            open = token == "solid";
            while (!in.token_in_line().empty()) {}   // the name
        } else if (token == "facet") {
            expect("normal");
            for (int a = 0; a < 3; a++)
                if (in.token().empty()) in.fail("a normal", "");   // some programs write nan here; it is not used
            expect("outer");
            expect("loop");
            for (int k = 0; k < 3; k++) {
                expect("vertex");
                data.triangles.push_back(welder.vertex(read_point(in)));
            }
            expect("endloop");
            expect("endfacet");
        } else {
            in.fail("'facet' or 'endsolid'", token);
        }
    }
    return data;
}

// ---- VTK

constexpr int kVtkVertex = 1, kVtkLine = 3, kVtkTriangle = 5, kVtkTet = 10, kVtkHex = 12;

class VtkReader {
public:
    VtkReader(std::string_view text, const std::string& name) : in_(text, name) {
        if (text.rfind("# vtk DataFile Version ", 0) != 0) throw InputError(name, 1, "expected '# vtk DataFile Version 2.0'");
    }

    MeshData read() {
        in_.next_line();   // the head is a comment to the scanner; then comes a title
        in_.next_line();
        expect("ASCII");
        expect("DATASET");
        expect("UNSTRUCTURED_GRID");
        std::string_view keyword = in_.token();
        for (; !keyword.empty() && keyword != "CELL_DATA" && keyword != "POINT_DATA"; keyword = in_.token()) {
            if (keyword == "POINTS")
                read_points();
            else if (keyword == "CELLS")
                read_cells();
            else if (keyword == "CELL_TYPES")
                read_types();
            else
                in_.fail("'POINTS', 'CELLS', 'CELL_TYPES', 'CELL_DATA' or 'POINT_DATA'", keyword);
        }
        if (first_.size() != types_.size() + 1)
            in_.fail("CELL_TYPES for " + std::to_string(first_.size() - 1) + " cells", std::to_string(types_.size()) + " types");
        for (std::size_t c = 0; c < types_.size(); c++) add_cell(c);
        return std::move(data_);
    }

private:
    void expect(const char* word) {
        const std::string_view token = in_.token();
        if (token != word) in_.fail(std::string("'") + word + "'", token);
    }
    Index read_count() {
        const Index count = in_.integer("a count");
        if (count < 0 || count > kLargestCount)
            in_.fail("a count from 0 to " + std::to_string(kLargestCount), std::to_string(count));
        return count;
    }
    void read_points() {
        const Index count = read_count();
        in_.token();   // double or float
        data_.points.clear();
        for (Index i = 0; i < count; i++) data_.points.push_back(read_point(in_));
    }
    void read_cells() {
        const Index count = read_count();
        in_.integer("a count");   // of all numbers in the block
        first_ = {0};
        vertices_.clear();
        lines_.clear();
        for (Index c = 0; c < count; c++) {
            const std::string_view token = in_.token();
            if (token == "OFFSETS") in_.fail("cells as in versions 2 to 4", token);
            const Index n = in_.to_integer(token, "the number of vertices of a cell");
            if (n < 1 || n > 8) in_.fail("a cell of 1 to 8 vertices", token);
            for (Index k = 0; k < n; k++) vertices_.push_back(in_.integer("a vertex index"));
            first_.push_back(static_cast<Index>(vertices_.size()));
            lines_.push_back(in_.line());
        }
    }
    void read_types() {
        const Index count = read_count();
        types_.clear();
        for (Index c = 0; c < count; c++) types_.push_back(in_.integer("a cell type"));
    }
    void add_cell(std::size_t c) {
        const auto add = [&](std::vector<Index>& elements, Index n) {
            if (first_[c + 1] - first_[c] != n)
                throw InputError(in_.file(), lines_[c],
                                 "expected " + std::to_string(n) + " vertices for a cell of type " + std::to_string(types_[c]) +
                                     ", found " + std::to_string(first_[c + 1] - first_[c]));
            elements.insert(elements.end(), vertices_.begin() + first_[c], vertices_.begin() + first_[c + 1]);
        };
        const Index last = static_cast<Index>(data_.points.size()) - 1;
        for (Index i = first_[c]; i < first_[c + 1]; i++)
            if (vertices_[i] < 0 || vertices_[i] > last)
                throw InputError(
                    in_.file(), lines_[c],
                    "expected a vertex index from 0 to " + std::to_string(last) + ", found " + std::to_string(vertices_[i]));
        switch (types_[c]) {
            case kVtkVertex: break;
            case kVtkLine: add(data_.edges, 2); break;
            case kVtkTriangle: add(data_.triangles, 3); break;
            case kVtkTet: add(data_.tets, 4); break;
            case kVtkHex: add(data_.hexes, 8); break;
            default:
                throw InputError(
                    in_.file(), lines_[c],
                    "expected a vertex, line, triangle, tetrahedron or hexahedron (cell type 1, 3, 5, 10 or 12), found " +
                        std::to_string(types_[c]));
        }
    }

    Scanner in_;
    MeshData data_;
    std::vector<Index> first_ = {0}, vertices_, lines_, types_;   // cell -> first of its vertices; its line; its type
};

}   // namespace

bool has_extension(const std::string& path, const char* extension) {
    const std::size_t n = std::strlen(extension);
    if (path.size() < n) return false;
    return std::equal(extension, extension + n, path.end() - static_cast<std::ptrdiff_t>(n),
                      [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

MeshData read_vtk(std::string_view text, const std::string& name) { return VtkReader(text, name).read(); }

MeshData read_obj(std::string_view text, const std::string& name) { return ObjReader(text, name).read(); }

MeshData read_medit(std::string_view text, const std::string& name) { return MeditReader(text, name).read(); }

// A binary file is known by its size, since some of them begin with `solid` too.
MeshData read_stl(std::string_view bytes, const std::string& name) {
    if (bytes.size() >= kStlHead && bytes.size() == kStlHead + kStlFacet * std::size_t{little_endian<std::uint32_t>(bytes, 80)})
        return read_binary_stl(bytes, name);
    const std::string_view start = bytes.substr(0, std::min<std::size_t>(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    if (bytes.substr(start.size(), 5) == "solid") return read_ascii_stl(bytes, name);
    throw InputError(name, 0, "expected an STL file, found neither 'solid' nor a binary file of the right size");
}

MeshData read_mesh(const std::string& path) {
    if (has_extension(path, ".obj")) return read_obj(read_file(path), path);
    if (has_extension(path, ".mesh")) return read_medit(read_file(path), path);
    if (has_extension(path, ".stl")) return read_stl(read_file(path), path);
    if (has_extension(path, ".vtk")) return read_vtk(read_file(path), path);
    throw InputError(path, 0, "expected a file name in .obj, .mesh, .stl or .vtk");
}

void weld(MeshData& data) {
    std::vector<Vec3> places;
    std::vector<Index> first, same(data.points.size());   // place -> its first vertex; vertex -> the one that stands for it
    Welder welder(places);
    for (std::size_t v = 0; v < data.points.size(); v++) {
        const Index place = welder.vertex(data.points[v]);
        if (place == static_cast<Index>(first.size())) first.push_back(static_cast<Index>(v));
        same[v] = first[place];
    }
    for (std::vector<Index>* list : {&data.edges, &data.triangles, &data.tets, &data.hexes})
        for (Index& v : *list) v = same[v];
}

std::string obj_text(const MeshData& data) {
    std::string out;
    for (const Vec3& p : data.points) {
        out += "v ";
        append_point(out, p);
        out += '\n';
    }
    append_elements(out, "f ", data.triangles, 3, "\n");
    append_elements(out, "l ", data.edges, 2, "\n");
    return out;
}

std::string medit_text(const MeshData& data) {
    std::string out = "MeshVersionFormatted 2\nDimension\n3\nVertices\n";
    append(out, static_cast<Index>(data.points.size()));
    out += '\n';
    for (const Vec3& p : data.points) {
        append_point(out, p);
        out += " 0\n";
    }
    for (const MeditBlock& block : kMeditBlocks) {
        const std::vector<Index>& elements = data.*block.elements;
        if (elements.empty()) continue;
        out += block.keyword;
        out += '\n';
        append(out, static_cast<Index>(elements.size()) / block.vertices);
        out += '\n';
        append_elements(out, "", elements, block.vertices, " 0\n");
    }
    return out + "End\n";
}

std::string mesh_text(const std::string& path, const MeshData& data) {
    if (has_extension(path, ".obj")) return obj_text(data);
    if (has_extension(path, ".mesh")) return medit_text(data);
    throw InputError(path, 0, "expected a file name in .obj or .mesh");
}

void write_mesh(const std::string& path, const MeshData& data) { write_file(path, mesh_text(path, data)); }

MeshData mesh_data(const TriMesh& mesh) {
    MeshData data;
    data.points = mesh.points;
    data.triangles = mesh.origin;
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.feature[h] && h < mesh.opposite[h]) data.edges.insert(data.edges.end(), {mesh.from(h), mesh.to(h)});
    return data;
}

Labeling read_labels_text(std::string_view text, const std::string& name, Index facets, bool allow_free) {
    const char* what = allow_free ? "a label from -1 to 5" : "a label from 0 to 5";
    Labeling labels;
    labels.reserve(std::min<std::size_t>(facets, text.size() / 2 + 1));
    Scanner in(text, name);
    for (std::string_view token = in.token(); !token.empty(); token = in.token()) {
        const Index l = in.to_integer(token, what);
        if (l < (allow_free ? kNoLabel : 0) || l >= kLabels) in.fail(what, token);
        if (static_cast<Index>(labels.size()) == facets)
            throw InputError(name, in.line(), "expected " + std::to_string(facets) + " labels, one per facet, found more");
        labels.push_back(static_cast<Label>(l));
    }
    if (static_cast<Index>(labels.size()) < facets)
        throw InputError(name, 0,
                         "expected " + std::to_string(facets) + " labels, one per facet, found " + std::to_string(labels.size()));
    return labels;
}

Labeling read_labels(const std::string& path, Index facets, bool allow_free) {
    return read_labels_text(read_file(path), path, facets, allow_free);
}

std::string labels_text(const Labeling& labels) {
    std::string out;
    out.reserve(3 * labels.size());   // of volume labels most are -1
    for (const Label l : labels) {
        if (l >= 0 && l <= 9)
            out += static_cast<char>('0' + l);
        else
            append(out, Index{l});
        out += '\n';
    }
    return out;
}

}   // namespace polylab

// What is said about a labeling: explanations, hints, differences, and the JSON writer under them.
#include "polylab/explain.h"

#include "polylab/diff.h"
#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;
using shapes::prism;

namespace {

constexpr Label kX = 0, kNegX = 1, kY = 2, kNegY = 3, kZ = 4, kNegZ = 5;

using Lines = std::vector<std::string>;

Lines lines(const TriMesh& mesh, const Labeling& labels, bool allow_opposite = true) {
    Lines result;
    for (const Problem& p : explain(mesh, build_graph(mesh, labels, allow_opposite))) result.push_back(p.text);
    return result;
}

// Random labels, then `steps` facets that take over the label of a random neighbour: patches with jagged borders.
Labeling patchy(const TriMesh& mesh, Index steps, Lcg& random) {
    Labeling labels;
    for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(random.below(kLabels)));
    for (Index i = 0; i < steps; i++) {
        const Index h = random.below(mesh.halfedges());
        labels[facet(h)] = labels[mesh.right(h)];
    }
    return labels;
}

// M-shaped prism of height 3: ridges between +X and -X at vertices 1 and 4, a valley between them at vertex 0.
TriMesh m_shape() { return build_mesh(prism({{2, 1, 0}, {1, 2, 0}, {0, 0, 0}, {4, 0, 0}, {3, 2, 0}}, 3)); }
const Labeling kMLabels = {kX, kX, kNegX, kNegX, kNegY, kNegY, kX, kX, kNegX, kNegX, kNegZ, kNegZ, kNegZ, kZ, kZ, kZ};

Index vertex_at(const TriMesh& mesh, const Vec3& p) {
    return static_cast<Index>(std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin());
}

// Whether a text is one JSON value, by the grammar of RFC 8259.
class JsonChecker {
public:
    explicit JsonChecker(std::string_view text) : text_(text) {}

    bool document() { return value() && (blanks(), at_ == text_.size()); }

private:
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void blanks() {
        while (peek() == ' ' || peek() == '\n') at_++;
    }
    bool take(std::string_view word) {
        const bool there = text_.substr(at_, word.size()) == word;
        if (there) at_ += word.size();
        return there;
    }
    bool digits() {
        const std::size_t start = at_;
        while (peek() >= '0' && peek() <= '9') at_++;
        return at_ > start;
    }
    bool number() {
        take("-");
        if (!take("0") && !digits()) return false;
        if (take(".") && !digits()) return false;
        if (!take("e") && !take("E")) return true;
        if (!take("+")) take("-");
        return digits();
    }
    bool string() {
        if (!take("\"")) return false;
        while (peek() != '"') {
            if (static_cast<unsigned char>(peek()) < 32) return false;
            if (take("\\u")) {
                for (int i = 0; i < 4; i++)
                    if (std::string_view("0123456789abcdefABCDEF").find(text_[at_++]) == std::string_view::npos) return false;
            } else if (take("\\")) {
                if (std::string_view("\"\\/bfnrt").find(text_[at_++]) == std::string_view::npos) return false;
            } else {
                at_++;
            }
        }
        return take("\"");
    }
    bool members(char close, bool named) {
        at_++;
        blanks();
        if (peek() == close) return at_++, true;
        do {
            blanks();
            if (named && !(string() && take(": "))) return false;
            if (!value()) return false;
            blanks();
        } while (take(","));
        return take(std::string_view(&close, 1));
    }
    bool value() {
        blanks();
        if (peek() == '{') return members('}', true);
        if (peek() == '[') return members(']', false);
        if (peek() == '"') return string();
        return take("true") || take("false") || take("null") || number();
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

bool is_json(std::string_view text) { return JsonChecker(text).document(); }

// Runs of blanks as one.
std::string squeezed(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (c != ' ' || (!result.empty() && result.back() != ' ' && result.back() != '\n')) result += c;
    return result;
}

}   // namespace

// ---- explanations ----

TEST_CASE("explain: an invalid chart, with its neighbours") {
    const TriMesh mesh = build_mesh(cube(3));
    Labeling labels = naive_labeling(mesh);
    CHECK(lines(mesh, labels).empty());
    labels[80] = labels[81] = kX;   // the middle of the upper face; charts before it: five faces
    const std::vector<Problem> problems = explain(mesh, build_graph(mesh, labels));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].kind == Problem::Kind::chart);
    CHECK(problems[0].element == 5);
    CHECK(problems[0].vertex == kNone);
    CHECK(problems[0].size == 1);
    CHECK(problems[0].text == "chart 5 (+X, 2 facets near 1.5 1.5 3): 1 boundary, needs at least 4; neighbours 4 (+Z)");
    // Across the edge between +X and +Z: the middle of both squares is inside of the cube.
    labels = naive_labeling(mesh);
    labels[82] = labels[83] = labels[14] = labels[15] = kY;
    CHECK(lines(mesh, labels) ==
          Lines{"chart 1 (+Y, 4 facets near 2.75 1.5 2.75): 2 boundaries, needs at least 4; neighbours 0 (+X), 5 (+Z)"});
    CHECK(lines(mesh, Labeling(108, kNegY)) == Lines{"chart 0 (-Y, 108 facets near 1.5 1.5 1.5): no boundary, needs at least 4"});
    labels = Labeling(108, kNegY);
    labels[0] = kX;   // (3,0,0) (3,1,0) (3,1,1)
    CHECK(lines(mesh, labels)[1] ==
          "chart 0 (+X, 1 facet near 3 0.6667 0.3333): 1 boundary, needs at least 4; neighbours 1 (-Y)");
}

TEST_CASE("explain: invalid boundaries") {
    // Half-edge 1 is the first ridge, from vertex 1 upward; the other one is the twelfth boundary.
    const TriMesh mesh = m_shape();
    const std::string ridge = " meet at less than 180 degrees along 1 edge";
    CHECK(lines(mesh, kMLabels) == Lines{"boundary 1 (1 edge near 1 2 0): opposite labels of charts 0 (+X) and 1 (-X)" + ridge,
                                         "boundary 11 (1 edge near 3 2 0): opposite labels of charts 3 (+X) and 4 (-X)" + ridge});
    // Not allowed: the valley as well (half-edge 5, downward, the fourth boundary), and both ends of each. Rings start with the
    // smallest half-edge: at vertex 0 that is along the base, then comes the valley, then the base again.
    const Lines strict = lines(mesh, kMLabels, false);
    REQUIRE(strict.size() == 3 + 6);
    CHECK(strict[1] ==
          "boundary 3 (1 edge near 2 1 3): opposite labels of charts 0 (+X) and 4 (-X) meet, which this run does not allow");
    CHECK(strict[3] == "corner at vertex 0 (2 1 0): Y - Y, neither pairs of one axis nor a trio X Y Z");
}

TEST_CASE("explain: how many edges of a boundary are convex") {
    // Half of the upper face of box(2,2,1) is -X, at the edge to +X: two convex edges there, a flat boundary to the rest.
    const TriMesh mesh = build_mesh(shapes::box(2, 2, 1));
    Labeling labels = naive_labeling(mesh);
    const Index upper = 4 + 4 + 4 + 4;   // facets of the sides before it; squares (0,0) (1,0) (0,1) (1,1)
    for (const Index f : {upper + 2, upper + 3, upper + 6, upper + 7}) labels[f] = kNegX;
    const std::vector<Problem> problems = explain(mesh, build_graph(mesh, labels));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].kind == Problem::Kind::boundary);
    CHECK(problems[0].size == 2);
    CHECK(problems[0].position == Vec3{2, 1, 1});
    CHECK(problems[0].text.find("(2 edges near 2 1 1): opposite labels of charts 0 (+X) and 5 (-X) meet at less than 180 degrees "
                                "along 2 edges") != std::string::npos);
}

TEST_CASE("explain: invalid corners, with the axes of their rings") {
    const TriMesh mesh = build_mesh(shapes::pyramid(4));
    const std::vector<Problem> problems = explain(mesh, build_graph(mesh, {kX, kY, kNegX, kNegY, kNegZ, kNegZ}));
    REQUIRE(problems.size() == 5);   // the four sides have three boundaries
    CHECK(problems[4].kind == Problem::Kind::corner);
    CHECK(problems[4].vertex == 4);
    CHECK(problems[4].position == Vec3{0, 0, 1000});
    CHECK(problems[4].text == "corner at vertex 4 (0 0 1000): Z Z Z Z, neither pairs of one axis nor a trio X Y Z");
    // Two fans: those that are wrong, +X and +Y in turn around (1,1,1) in the lower cube, +X and +Z in the upper one.
    const TriMesh cubes = build_mesh(shapes::two_cubes_at_a_vertex());
    Labeling labels = naive_labeling(cubes);
    const Index vertex = vertex_at(cubes, {1, 1, 1});
    const auto corner_line = [&] {
        for (const Problem& p : explain(cubes, build_graph(cubes, labels)))
            if (p.vertex == vertex && p.kind == Problem::Kind::corner) return p.text;
        return std::string();
    };
    CHECK(corner_line().empty());
    const std::string start = "corner at vertex " + std::to_string(vertex) + " (1 1 1): ";
    const std::string end = ", neither pairs of one axis nor a trio X Y Z";
    for (const Index first : {0, 12}) {
        Index h = 3 * first;
        while (cubes.from(h) != vertex) h++;
        for (int i = 0; i < 6; i++, h = cubes.ccw(h)) labels[facet(h)] = i % 2 == 0 ? kX : first == 0 ? kY : kZ;
        CHECK(corner_line() == start + "Z Z Z Z Z Z" + (first == 0 ? "" : " and Y Y Y Y Y Y") + end);
    }
}

TEST_CASE("explain: turning-points of a valid labeling") {
    // cube(6), +X reaches over the upper edge in squares (5,4) and (4,4), and back in (4,3) (4,2) (4,1): the boundary turns at
    // one end of the edges (6,4)-(5,4) and (4,1)-(5,1), the ones that were numbered first. Facets of +X come row by row from
    // below: its boundaries with -Z, -Y and +Y have smaller half-edges, and this one is number 3.
    const TriMesh mesh = build_mesh(cube(6));
    Labeling labels = naive_labeling(mesh);
    const Index squares[][2] = {{5, 4}, {4, 4}, {4, 3}, {4, 2}, {4, 1}};
    for (const auto& [x, y] : squares) labels[288 + 2 * (6 * y + x)] = labels[289 + 2 * (6 * y + x)] = kX;
    const LabelingGraph graph = build_graph(mesh, labels);
    CHECK(graph.valid());
    const Index p = vertex_at(mesh, {6, 4, 6}), q = vertex_at(mesh, {4, 1, 6});
    const auto line = [&](Index v, const std::string& place) {
        return "turning-point at vertex " + std::to_string(v) + " (" + place +
               ") on boundary 3 (axis Y) between charts 0 (+X) and 4 (+Z)";
    };
    Lines found = lines(mesh, labels), expected = {line(p, "6 4 6"), line(q, "4 1 6")};
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    CHECK(found == expected);
    const Problem problem = explain(mesh, graph)[0];
    CHECK(problem.kind == Problem::Kind::turning_point);
    CHECK(graph.boundaries[problem.element].axis == 1);
    CHECK(mesh.points[problem.vertex] == problem.position);
}

TEST_CASE("explain: every problem of random labelings, worst first") {
    Lcg random(5);
    for (const MeshData& shape : {cube(4), shapes::refined(shapes::two_cubes_at_a_vertex()), shapes::stair(3)}) {
        const TriMesh mesh = build_mesh(shape);
        for (Index steps = 0; steps < 20; steps++) {
            const Labeling labels = patchy(mesh, steps * mesh.facets(), random);
            const LabelingGraph graph = build_graph(mesh, labels);
            const std::vector<Problem> problems = explain(mesh, graph);
            const TurningPoints turning = find_turning_points(mesh, graph);
            CAPTURE(steps);
            Index found[4] = {0, 0, 0, 0};
            for (const Problem& p : problems) {
                const auto element = static_cast<std::size_t>(p.element);
                if (p.kind == Problem::Kind::chart) CHECK_FALSE(graph.charts[element].valid);
                if (p.kind == Problem::Kind::boundary) CHECK_FALSE(graph.boundaries[element].valid);
                if (p.kind == Problem::Kind::corner) CHECK_FALSE(graph.corners[element].valid);
                if (p.vertex != kNone) CHECK(p.position == mesh.points[p.vertex]);
                CHECK(p.text.find('\n') == std::string::npos);
                found[static_cast<int>(p.kind)]++;
            }
            CHECK(found[0] == graph.invalid_charts);
            CHECK(found[1] == graph.invalid_boundaries);
            CHECK(found[2] == graph.invalid_corners);
            CHECK(found[3] == static_cast<Index>(turning.points.size()));
            CHECK(problems.empty() == (graph.valid() && turning.points.empty()));
            // Charts by area, boundaries by length; equal ones and corners by number, turning-points in their order.
            const auto before = [](const Problem& a, const Problem& b) {
                return std::tuple(a.kind, -a.size, a.element) < std::tuple(b.kind, -b.size, b.element);
            };
            CHECK(std::is_sorted(problems.begin(), problems.end(), before));
            CHECK(is_json(statistics_json(statistics(mesh, labels, graph), problems)));
        }
    }
}

// ---- hints ----

TEST_CASE("explain: a hint where the part itself is turned") {
    CHECK(hint(build_mesh(cube(2))).empty());
    CHECK(hint(build_mesh(shapes::stair(3))).empty());
    const std::string rest =
        " % of the part's area is more than 20 degrees from every axis: try --align, or turn the part so that its main faces lie along X, Y and "
        "Z";
    // Turned by 45 degrees around Z: four sides of sqrt(2) x 1 of a total of 4 sqrt(2) + 2 * 2.
    const std::vector<Vec3> diamond = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    CHECK(hint(build_mesh(prism(diamond, 1))) == "59" + rest);
    // Twice as wide: 8 sqrt(2) of 8 sqrt(2) + 16, less than half.
    std::vector<Vec3> wide = diamond;
    for (Vec3& p : wide) p = p * 2;
    CHECK(hint(build_mesh(prism(wide, 1))).empty());
    // Around (1,1,1) by 60 degrees: normals like (2,2,-1)/3, 48 degrees from the next axis.
    MeshData odd = cube(1);
    for (Vec3& p : odd.points) p = {2 * p.x - p.y + 2 * p.z, 2 * p.x + 2 * p.y - p.z, -p.x + 2 * p.y + 2 * p.z};
    CHECK(hint(build_mesh(odd)) == "100" + rest);
    // Turned by atan(1/3) = 18.4 degrees, and by atan(2/5) = 21.8: four sides of 10 sqrt(29), 215.4 of 273.4.
    const auto turned = [](double a, double b) { return prism({{0, 0, 0}, {a, b, 0}, {a - b, a + b, 0}, {-b, a, 0}}, 10); };
    CHECK(hint(build_mesh(turned(3, 1))).empty());
    CHECK(hint(build_mesh(turned(5, 2))) == "79" + rest);
}

// ---- differences ----

TEST_CASE("diff: patches of one change, largest first") {
    const TriMesh mesh = build_mesh(cube(2));
    const Labeling a = naive_labeling(mesh);
    CHECK(changed_patches(mesh, a, a).empty());
    Labeling b = a;
    b[47] = kX;                                // one facet of -Z
    b[32] = kX;                                // of +Z: (0,0,2) (1,0,2) (1,1,2)
    b[34] = b[35] = kY;                        // the square beside it, another change
    for (Index f = 0; f < 8; f++) b[f] = kY;   // all of +X
    b[8] = kNegZ;                              // of -X
    const std::vector<ChangedPatch> patches = changed_patches(mesh, a, b);
    REQUIRE(patches.size() == 5);
    const auto check = [&](std::size_t i, Label before, Label after, std::vector<Index> facets) {
        CAPTURE(i);
        CHECK(patches[i].before == before);
        CHECK(patches[i].after == after);
        std::vector<Index> found = patches[i].facets;
        CHECK(found[0] == facets[0]);   // the smallest is the first
        std::sort(found.begin(), found.end());
        CHECK(found == facets);
    };
    check(0, kX, kY, {0, 1, 2, 3, 4, 5, 6, 7});
    check(1, kZ, kY, {34, 35});
    check(2, kNegX, kNegZ, {8});
    check(3, kZ, kX, {32});
    check(4, kNegZ, kX, {47});
}

TEST_CASE("diff: neighbours with the same new label but another old one are two patches") {
    const TriMesh mesh = build_mesh(cube(1));
    const std::vector<ChangedPatch> patches = changed_patches(mesh, naive_labeling(mesh), Labeling(12, kX));
    REQUIRE(patches.size() == 5);   // every face but +X, in the order of labels
    for (Index i = 0; i < 5; i++) CHECK(patches[i].before == i + 1);
}

TEST_CASE("diff: text") {
    const TriMesh mesh = build_mesh(shapes::creased(cube(3)));
    const Labeling a = naive_labeling(mesh);
    CHECK(diff_text(mesh, a, a) == "0 of 108 facets differ, in 0 patches\n");
    // A square in the middle of the upper face: 90 degrees off, fidelity 1/2 for 2 of 108.
    Labeling b = a;
    b[80] = b[81] = kX;
    CHECK(squeezed(diff_text(mesh, a, b)) ==
          "2 of 108 facets differ, in 1 patches\n"
          "charts 6 -> 7\n"
          "invalid charts 0 -> 1\n"
          "boundaries 12 -> 13\n"
          "fidelity, average 1.00000 -> 0.99074\n"
          "2 facets +Z -> +X, from facet 80 near 1 1 3\n");
    CHECK(squeezed(diff_text(mesh, b, a)).find("\nboundaries 13 -> 12\n") != std::string::npos);
    // All one label: every feature edge is lost (12 edges of three parts). Opposite labels are allowed, as in statistics.
    const std::string all = squeezed(diff_text(mesh, a, Labeling(108, kZ)));
    CHECK(all.find("90 of 108 facets differ, in 5 patches\n"
                   "charts 6 -> 1\ninvalid charts 0 -> 1\nboundaries 12 -> 0\ncorners 8 -> 0\nfeature edges lost 0 -> 36\n") ==
          0);
    CHECK(all.find("\n18 facets -X -> +Z, from facet 18 near 0 0 0\n") != std::string::npos);
}

// ---- JSON ----

TEST_CASE("json: objects, arrays and values, one entry per line") {
    JsonWriter json;
    json.open_object();
    json.value("i", Index{-3});
    json.value("text", "a");
    json.value("view", std::string_view("b"));
    json.value("yes", true);
    json.open_array("list");
    json.value("", 0.5);
    json.value("", false);
    json.open_object();
    json.close_object();
    json.close_array();
    json.open_array("none");
    json.close_array();
    json.open_object("inner");
    json.value("x", Index{1});
    json.close_object();
    json.close_object();
    CHECK(json.text() == R"({
    "i": -3,
    "text": "a",
    "view": "b",
    "yes": true,
    "list": [
        0.5,
        false,
        {}
    ],
    "none": [],
    "inner": {
        "x": 1
    }
})");
    CHECK(is_json(json.text()));
}

TEST_CASE("json: numbers keep their value and their kind") {
    const auto written = [](double x) {
        JsonWriter json;
        json.value("", x);
        return json.text();
    };
    CHECK(written(1) == "1.0");
    CHECK(written(0) == "0.0");
    CHECK(written(-2) == "-2.0");
    CHECK(written(0.1) == "0.1");
    CHECK(written(1.0 / 3) == "0.3333333333333333");
    for (const double x : {1e22, 1e-7, 2.2250738585072014e-308, 1.7976931348623157e308, -0.0, 123456789.0, 1e15, 1e17}) {
        const std::string text = written(x);
        CAPTURE(text);
        CHECK(std::stod(text) == x);
        CHECK(is_json(text));
        CHECK(text.find_first_of(".e") != std::string::npos);   // a double in every reader
    }
}

TEST_CASE("json: texts are quoted") {
    const auto written = [](std::string_view text) {
        JsonWriter json;
        json.value("", text);
        return json.text();
    };
    CHECK(written("") == R"("")");
    CHECK(written("a \"b\" \\ /") == R"("a \"b\" \\ /")");
    CHECK(written("\n\t\x1f\x7f") == "\"\\u000a\\u0009\\u001f\x7f\"");
    CHECK(written(std::string_view("\0", 1)) == R"("\u0000")");
    CHECK(written("\xc3\xa9 \xe2\x80\xa6") == "\"\xc3\xa9 \xe2\x80\xa6\"");   // UTF-8 as it is
    for (char c = 0; c < 127; c++) CHECK(is_json(written({&c, 1})));
    JsonWriter json;
    json.open_object();
    json.value("a\"b", Index{1});
    json.close_object();
    CHECK(json.text() == "{\n    \"a\\\"b\": 1\n}");
}

TEST_CASE("json: problems among the statistics") {
    const std::vector<Problem> problems = {{Problem::Kind::chart, 3, kNone, {0.5, 1, -2}, 4, "said \"so\""},
                                           {Problem::Kind::boundary, 4, kNone, {}, 1, "b"},
                                           {Problem::Kind::corner, 5, 7, {}, 0, "c"},
                                           {Problem::Kind::turning_point, 6, 8, {}, 0, "t"}};
    const std::string text = statistics_json({}, problems);
    CHECK(is_json(text));
    CHECK(text.find(R"(
    "problems": [
        {
            "element": 3,
            "kind": "chart",
            "position": [
                0.5,
                1.0,
                -2.0
            ],
            "text": "said \"so\""
        },
)") != std::string::npos);
    CHECK(text.find(R"("kind": "boundary")") != std::string::npos);
    CHECK(text.find(R"("element": 5,
            "kind": "corner")") != std::string::npos);
    CHECK(text.find(R"("text": "c",
            "vertex": 7)") != std::string::npos);
    CHECK(text.find(R"("boundary": 6,
            "kind": "turning-point")") != std::string::npos);
    CHECK(text.find(R"("vertex": 8
        }
    ],
    "turning-points": {)") != std::string::npos);
}

// The README's table of troubles: each row is run, and says which exit status and message it ends with.

#include "scratch.h"

#include <csignal>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <vector>

using namespace polylab;
using shapes::box;
using shapes::cube;
namespace fs = std::filesystem;

namespace {

struct Row {
    std::string trouble, status, message;   // as the README has them; of the message what is between backticks
};

std::vector<Row> readme_rows() {
    std::ifstream readme(POLYLAB_SOURCE_DIR "/README.md");
    std::vector<Row> rows;
    bool inside = false;
    for (std::string line; std::getline(readme, line);) {
        const bool head = line.rfind("| trouble |", 0) == 0;
        if (inside && line.rfind("| ", 0) == 0) {
            std::vector<std::string> cells;
            for (std::size_t at = 2, end; (end = line.find(" |", at)) != std::string::npos; at = std::min(end + 3, line.size()))
                cells.push_back(line.substr(at, end - at));
            REQUIRE(cells.size() == 3);
            std::string message = cells[2];
            if (message.size() > 1) message = message.substr(1, message.size() - 2);
            rows.push_back({cells[0], cells[1], message});
        }
        inside = head || (inside && line.rfind("|", 0) == 0);
    }
    return rows;
}

// Prepares the trouble and returns the program's arguments.
using Trouble = std::function<std::string(const Scratch&)>;

const char* const kLabel = "label in.obj -o l.txt";

Trouble text(const std::string& name, const std::string& content) {
    return [=](const Scratch& s) {
        s.write(name, content);
        return "label " + name + " -o l.txt";
    };
}
Trouble part(const MeshData& data) { return text("in.obj", obj_text(data)); }
Trouble command(const std::string& arguments) {
    return [=](const Scratch&) { return arguments; };
}
Trouble labels(const std::string& content) {
    return [=](const Scratch& s) {
        s.write("labels.txt", content);
        return std::string("label cube.obj --init labels.txt -o l.txt");
    };
}

MeshData with_vertex(MeshData d, Index v, const Vec3& p) {
    d.points[v] = p;
    return d;
}

MeshData without_last_facet(MeshData d) {
    d.triangles.resize(d.triangles.size() - 3);
    return d;
}

// Two cubes with an edge in common.
MeshData four_at_an_edge() {
    MeshData d = cube(1), other = shapes::moved(cube(1), {1, 1, 0});
    shapes::append(d, other);
    weld(d);
    return d;
}

MeshData duplicate_facet() {
    MeshData d = cube(1);
    d.triangles.insert(d.triangles.end(), d.triangles.begin(), d.triangles.begin() + 3);
    return d;
}

// Each facet with vertices of its own.
MeshData torn(const MeshData& d) {
    MeshData out;
    for (const Index v : d.triangles) {
        out.triangles.push_back(static_cast<Index>(out.points.size()));
        out.points.push_back(d.points[v]);
    }
    return out;
}

MeshData many_boxes(int n) {
    MeshData d;
    for (int i = 0; i < n; i++) shapes::append(d, shapes::moved(cube(1), {2.0 * i, 0, 0}));
    return d;
}

MeshData with_edges(MeshData d, const std::vector<Index>& edges) {
    d.edges.insert(d.edges.end(), edges.begin(), edges.end());
    return d;
}

MeshData all_edges(MeshData d) {
    for (Index h = 0; h < static_cast<Index>(d.triangles.size()); h++)
        d.edges.insert(d.edges.end(), {d.triangles[h], d.triangles[next(h)]});
    return d;
}

std::string replaced(std::string s, const std::string& from, const std::string& to) {
    REQUIRE(s.find(from) != std::string::npos);
    return s.replace(s.find(from), from.size(), to);
}

std::map<std::string, Trouble> troubles() {
    const std::string obj = obj_text(cube(1)), medit = medit_text(cube(1));
    std::string noise;
    shapes::Lcg random(3);
    for (int i = 0; i < 3000; i++) noise += static_cast<char>(random.below(256));
    const MeshData flattened = [] {
        MeshData d = cube(1);
        for (Vec3& p : d.points) p.z = 0;
        return d;
    }();
    MeshData isolated = cube(1);
    isolated.points.push_back({9, 9, 9});
    return {
        {"empty file", text("in.obj", "")},
        {"directory in the place of a file", [](const Scratch& s) { return fs::create_directory(s.path("in.obj")), kLabel; }},
        {"no such file", command(kLabel)},
        {"output in a folder that is not there", command("label cube.obj -o missing/l.txt")},
        {"full disk", command("label cube.obj -o /dev/full")},
        {"file without permission to read",
         [](const Scratch& s) {
             s.write("in.obj", obj_text(cube(1)));
             fs::permissions(s.path("in.obj"), fs::perms::none);
             return std::string(kLabel);
         }},
        {"folder without permission to write",
         [](const Scratch& s) {
             fs::create_directory(s.path("closed"));
             fs::permissions(s.path("closed"), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
             return std::string("label cube.obj -o closed/l.txt");
         }},
        {"other kind of file", text("in.step", "ISO-10303-21;\n")},
        {"binary garbage", text("in.mesh", noise)},
        {"truncated file", text("in.mesh", medit.substr(0, medit.size() - 30))},
        {"huge count with nothing behind it", text("in.mesh", "MeshVersionFormatted 2 Dimension 3 Vertices 250000000\n")},
        {"index of no vertex", text("in.obj", obj + "f 1 2 9\n")},
        {"coordinate that is no number", text("in.obj", replaced(obj, "v 0 0 0", "v 0 nan 0"))},
        {"infinite coordinate", text("in.obj", replaced(obj, "v 0 0 0", "v 0 inf 0"))},
        {"huge coordinate", part(with_vertex(cube(1), 0, {1e76, 0, 0}))},
        {"polygon", text("in.obj", obj + "f 1 2 3 4\n")},
        {"duplicate facet", part(duplicate_facet())},
        {"edge with four facets", part(four_at_an_edge())},
        {"vertex with two fans", part(shapes::two_cubes_at_a_vertex())},
        {"component that touches itself at a vertex", part(shapes::pinched_ring())},
        {"open border", part(without_last_facet(cube(1)))},
        {"Möbius strip", part(shapes::mobius_strip(5))},
        {"closed surface with one side", part(shapes::projective_plane())},
        {"component that faces inward", part(shapes::joined(cube(1), shapes::moved(shapes::turned(cube(1)), {5, 0, 0})))},
        {"cavity", part(shapes::hollow_box())},
        {"thousands of components", part(many_boxes(2000))},
        {"component of two facets", part(shapes::joined(cube(1), shapes::moved(shapes::pillow(), {5, 0, 0})))},
        {"facet without area", part(shapes::tetrahedron_with_flat_facet())},
        {"slivers", part(with_vertex(box(2, 1, 1), 0, {1e-12, 1e-12, 0}))},
        {"all facets in one plane", part(flattened)},
        {"vertex without facet", part(isolated)},
        {"every facet with its own vertices", part(torn(cube(1)))},
        {"the same with --weld",
         [](const Scratch& s) {
             s.write("in.obj", obj_text(torn(cube(1))));
             return std::string(kLabel) + " --weld";
         }},
        {"labels of another part", labels("0 0 1 1")},
        {"label out of range", labels("0 0 1 1 2 2 3 3 4 4 5 6")},
        {"feature edge off the surface", part(with_edges(cube(1), {0, 7}))},
        {"feature edges everywhere", part(all_edges(cube(2)))},
        {"surface map of more tetrahedra than memory has room for",
         [](const Scratch& s) {
             s.write("map.txt", "1 triangles\n500000000 tetrahedra\n7\n");
             s.write("labels.txt", "0\n");
             return std::string("volume-labels labels.txt map.txt -o v.txt");
         }},
        {"too little memory",
         [](const Scratch& s) {
             MeshData d = cube(8);
             for (int i = 0; i < 4; i++) d = shapes::refined(d);
             s.write("in.obj", obj_text(d));
             return std::string(kLabel);
         }},
    };
}

// What goes in front of the program in the rows that need it: little memory, or (for root) a user with fewer permissions.
std::string before(const std::string& trouble) {
    const bool memory = trouble.find("memory") != std::string::npos, permission = trouble.find("permission") != std::string::npos;
    if (permission && ::geteuid() == 0) return "setpriv --reuid=65534 --clear-groups ";
    return memory ? "ulimit -v 30000; " : "";
}

// Not everywhere: sanitizers reserve terabytes of addresses, another user may not come near the program.
bool starts(const Scratch& scratch, const std::string& after) {
    return after.empty() || scratch.run("--version", after).status == 0;
}

}   // namespace

TEST_CASE("trouble: each row of the README's table ends as it says, and no trouble is without a row") {
    const std::map<std::string, Trouble> all = troubles();
    std::set<std::string> seen;
    for (const Row& row : readme_rows()) {
        CAPTURE(row.trouble);
        CHECK(seen.insert(row.trouble).second);
        const auto trouble = all.find(row.trouble);
        REQUIRE(trouble != all.end());
        const Scratch scratch;
        const std::string arguments = trouble->second(scratch);
        const std::size_t entries = scratch.entries();
        if (!starts(scratch, before(row.trouble))) continue;
        const Result r = scratch.run(arguments, before(row.trouble));
        CAPTURE(r.err);
        CHECK(std::to_string(r.status) == row.status);
        CHECK(r.err.find(row.message) != std::string::npos);
        CHECK(std::count(r.err.begin(), r.err.end(), '\n') == (row.message.empty() ? 0 : 1));
        CHECK(scratch.entries() == entries + (r.status == 2 ? 0 : 1));
    }
    for (const auto& [row, trouble] : all) {
        const std::string& name = row;   // what C++17's lambdas can capture
        CAPTURE(name);
        CHECK(seen.count(name) == 1);
    }
}

TEST_CASE("trouble: a file system without space gets no half of a file") {
    if (::geteuid() != 0) return;   // only root may mount
    const Scratch scratch;
    fs::create_directory(scratch.path("small"));
    if (std::system(("mount -t tmpfs -o size=8k none '" + scratch.path("small") + "' 2>/dev/null").c_str()) != 0) return;
    MeshData d = cube(8);
    d = shapes::refined(shapes::refined(d));
    scratch.write("big.obj", obj_text(d));
    scratch.write("small/l.txt", "old");
    check_refused(scratch, "label big.obj -o small/l.txt", "small/l.txt: can't be written: No space left on device");
    CHECK(scratch.read("small/l.txt") == "old");
    CHECK(std::distance(fs::directory_iterator(scratch.path("small")), {}) == 1);
    CHECK(std::system(("umount '" + scratch.path("small") + "'").c_str()) == 0);
}

TEST_CASE("trouble: a run that is killed while it writes leaves the old file") {
    const Scratch scratch;
    scratch.write("big.obj", obj_text(shapes::refined(cube(8))));
    const std::string whole = check_done(scratch, "label big.obj --method naive").out;
    // In the middle of a file: the system ends a program that writes more than one block to it.
    scratch.write("l.txt", "old");
    Result r = scratch.run("label big.obj --method naive -o l.txt", "ulimit -c 0; ulimit -f 1; ");
    CHECK(r.status == 128 + SIGXFSZ);
    CHECK(scratch.read("l.txt") == "old");
    const std::string half = scratch.read("l.txt.part0");
    CHECK(half.size() > 0);
    CHECK(half.size() < whole.size());
    // Between two files: nobody reads the pipe.
    r = scratch.run(
        "label big.obj --method naive -o l.txt --stats pipe & pid=$!\n"
        "until grep -q 'State:.S' /proc/$pid/status && test -e l.txt.part1; do kill -0 $pid || exit; done; echo asleep\n"
        "kill -KILL $pid; wait $pid",
        "mkfifo pipe; ");
    CHECK(r.out == "asleep\n");
    CHECK(r.status == 128 + SIGKILL);
    CHECK(scratch.read("l.txt") == "old");
    CHECK(scratch.read("l.txt.part1") == whole);
    check_done(scratch, "label big.obj --method naive -o l.txt");   // what is left over is in nobody's way
    CHECK(scratch.read("l.txt") == whole);
}

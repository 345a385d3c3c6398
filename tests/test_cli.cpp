// The command line: the program as a child process, its files, messages and exit status; and the parser of arguments.
#include "polylab/cli.h"

#include "polylab/polylab.h"
#include "polylab/tet_surface.h"
#include "scratch.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>

using namespace polylab;
using shapes::cube;
namespace fs = std::filesystem;

namespace {

const std::string kNaive = "0\n0\n1\n1\n2\n2\n3\n3\n4\n4\n5\n5\n";   // labels of cube(1), one per line
const std::vector<std::string> kCommands = {"label", "stats", "explain", "diff", "surface", "volume-labels", "polycube"};

// Two tetrahedra on one facet: with a corner at the origin, and beyond.
MeshData two_tets() {
    MeshData d;
    d.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 2, 2}};
    d.tets = {0, 1, 2, 3, 1, 2, 3, 4};
    return d;
}

Command sample() {
    Command command;
    command.name = "sample";
    command.operands = {"IN", "OUT"};
    command.about = "Does it.\n\nSlowly.\n\nAnd well.";
    command.options = {{"-o", "FILE", "where to"}, {"--size", "N", "how\nlarge"}, {"--fast", "", "soon"}};
    return command;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

}   // namespace

// ---- the parser ----

TEST_CASE("cli: options and operands in any order") {
    using Words = std::vector<std::string>;
    Arguments a = parse_arguments(sample(), {"x", "--fast", "-o", "file", "y", "--size=3"});
    CHECK(a.operands == Words{"x", "y"});
    CHECK(a.has("--fast"));
    CHECK(a.get("-o") == "file");
    CHECK(a.get("--size") == "3");
    a = parse_arguments(sample(), {"--size", "-1", "-", "--", "-o"});
    CHECK(a.operands == Words{"-", "-o"});
    CHECK(a.get("--size") == "-1");
    CHECK_FALSE(a.has("-o"));
    CHECK(a.get("-o", "otherwise") == "otherwise");
    CHECK(parse_arguments(sample(), {"x", "y", "--size=a=b"}).get("--size") == "a=b");
    CHECK(parse_arguments(sample(), {"x", "y", "--size="}).get("--size").empty());
    CHECK(parse_arguments(sample(), {"x", "--", "--"}).operands == Words{"x", "--"});
}

TEST_CASE("cli: wrong options and operands") {
    const auto wrong = [](const std::vector<std::string>& words) {
        try {
            parse_arguments(sample(), words);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    CHECK(wrong({"x", "y"}) == "accepted");
    CHECK(wrong({}) == "missing IN");
    CHECK(wrong({"x"}) == "missing OUT");
    CHECK(wrong({"x", "y", "z"}) == "unexpected 'z'");
    CHECK(wrong({"x", "y", "-p"}) == "unknown option -p");
    CHECK(wrong({"x", "y", "--siz=1"}) == "unknown option --siz");
    CHECK(wrong({"x", "y", "--fast", "--fast"}) == "option --fast is given twice");
    CHECK(wrong({"x", "y", "--fast=1"}) == "option --fast takes no value");
    CHECK(wrong({"x", "y", "-o"}) == "option -o needs a value: FILE");
    CHECK(wrong({"x", "y", "-ofile"}) == "unknown option -ofile");
    CHECK(wrong({"x", "y", "-o=file"}) == "unknown option -o=file");
}

TEST_CASE("cli: numbers within their range") {
    Arguments a;
    CHECK(a.integer("--n", 7, 0, 9) == 7);
    CHECK(a.number("--x", 0.5, 0, 1) == 0.5);
    const auto integer = [&](const std::string& text) {
        a.options["--n"] = text;
        return refusal([&] { a.integer("--n", 7, 0, 9); });
    };
    for (const char* good : {"0", "9", "+3", "007"}) CHECK(integer(good) == "accepted");
    for (const char* bad : {"10", "-1", "3.0", "x", "", "3x", "99999999999"})
        CHECK(integer(bad).find("--n: expected an integer from 0 to 9, found") == 0);
    const auto number = [&](const std::string& text) {
        a.options["--x"] = text;
        return refusal([&] { a.number("--x", 0, -0.5, 1); });
    };
    for (const char* good : {"-0.5", "1", "1e-9", "+.5"}) CHECK(number(good) == "accepted");
    for (const char* bad : {"-0.50001", "1.1", "nan", "inf", "x", "", "0,5", "1e999"})
        CHECK(number(bad).find("--x: expected a number from -0.5 to 1, found") == 0);
}

TEST_CASE("cli: help is made of the table") {
    Command command = sample();
    const std::string page =
        "NAME\n"
        "    prog sample: Does it.\n"
        "\n"
        "SYNOPSIS\n"
        "    prog sample IN OUT [options]\n"
        "\n"
        "DESCRIPTION\n"
        "    Slowly.\n"
        "\n"
        "    And well.\n"
        "\n"
        "OPTIONS\n"
        "    -o FILE   where to\n"
        "    --size N  how\n"
        "              large\n"
        "    --fast    soon\n";
    CHECK(help("prog", command) == page);
    command.status = "0 done\n2 not";
    command.examples = "prog sample a b";
    CHECK(help("prog", command) == page + "\nEXIT STATUS\n    0 done\n    2 not\n\nEXAMPLES\n    prog sample a b\n");
    command.options.clear();
    command.about = "Does it.";
    CHECK(help("prog", command).find("NAME\n    prog sample: Does it.\n\nSYNOPSIS\n    prog sample IN OUT\n\nEXIT STATUS\n") ==
          0);
}

// ---- help and wrong use ----

TEST_CASE("cli: help and version go to standard output") {
    const Scratch scratch;
    const std::string overview = check_done(scratch, "--help").out;
    CHECK(check_done(scratch, "-h").out == overview);
    CHECK(check_done(scratch, "help").out == overview);
    for (const std::string& command : kCommands) {
        CHECK(overview.find("\n  " + command + " ") != std::string::npos);
        const std::string text = check_done(scratch, command + " --help").out;
        CHECK(text.find("NAME\n    polylab " + command + ": ") == 0);
        for (const char* title : {"SYNOPSIS", "OPTIONS", "EXIT STATUS", "FILES", "EXAMPLES"})
            CHECK(text.find(std::string("\n\n") + title + "\n    ") != std::string::npos);
        CHECK(check_done(scratch, "help " + command).out == text);
        CHECK(text.find("\n    -o FILE ") != std::string::npos);
        CHECK(check_done(scratch, command + " x --nonsense -h").out == text);   // help wins
    }
    const std::string label = check_done(scratch, "label --help").out;
    for (const char* option :
         {"--init LABELS", "--lock LABELS", "--method METHOD", "--routine NAME", "--trace FILE", "--stats JSON",
          "--compactness N", "--fidelity N", "--sensitivity X", "--angle RAD", "--features SOURCE", "--quiet", "--verbose"})
        CHECK(label.find("\n    " + std::string(option) + " ") != std::string::npos);
    CHECK(check_done(scratch, "--version").out.find(std::string("polylab ") + kVersion + " ") == 0);
    CHECK(scratch.entries() == 2);
}

TEST_CASE("cli: wrong use") {
    const Scratch scratch;
    check_refused(scratch, "", "missing command");
    check_refused(scratch, "lable cube.obj", "unknown command 'lable' (see polylab --help)");
    check_refused(scratch, "help lable", "unknown command 'lable' (see polylab --help)");
    check_refused(scratch, "label", "polylab label: missing PART (see polylab label --help)");
    check_refused(scratch, "label -o l.txt", "missing PART");
    check_refused(scratch, "label cube.obj cube.obj -o l.txt", "unexpected 'cube.obj'");
    check_refused(scratch, "label cube.obj -o", "option -o needs a value: FILE");
    check_refused(scratch, "label cube.obj --fast -o l.txt", "unknown option --fast");
    check_refused(scratch, "label cube.obj --method best -o l.txt",
                  "--method: expected 'full', 'graphcut' or 'naive', found 'best'");
    check_refused(scratch, "label cube.obj --method= -o l.txt", "found ''");
    for (const char* only_full : {"--init naive.txt", "--routine both", "--trace t.txt"})
        check_refused(scratch, std::string("label cube.obj -o l.txt --method naive ") + only_full,
                      "only goes with --method full");
    check_refused(scratch, "label cube.obj --routine best -o l.txt",
                  "--routine: expected 'validity', 'monotonicity' or 'both', found 'best'");
    check_refused(scratch, "label cube.obj --compactness 1001 -o l.txt",
                  "--compactness: expected an integer from 0 to 1000, found '1001'");
    check_refused(scratch, "label cube.obj --fidelity -1 -o l.txt", "--fidelity: expected an integer from 0 to 1000, found '-1'");
    check_refused(scratch, "label cube.obj --sensitivity x -o l.txt", "--sensitivity: expected a number from 0 to 1, found 'x'");
    check_refused(scratch, "label cube.obj --angle 1.5 -o l.txt", "--angle: expected a number from -1 to 1, found '1.5'");
    for (const char* bad : {"detec", "detect=", "detect=x", "detect=-1", "detect=3.2", "file=1", ""})
        check_refused(scratch, std::string("label cube.obj -o l.txt --features '") + bad + "'", "--features");
    check_refused(scratch, "label -o l.txt -- --help", "--help: expected a file name");
    check_refused(scratch, "stats cube.obj", "polylab stats: missing LABELS (see polylab stats --help)");
    check_refused(scratch, "explain", "missing PART");
    check_refused(scratch, "diff cube.obj naive.txt", "missing B");
    check_refused(scratch, "surface cube.obj", "missing -o");
    check_refused(scratch, "volume-labels naive.txt", "missing MAP");
}

// ---- label ----

TEST_CASE("cli: labels to a file or to standard output") {
    const Scratch scratch;
    for (const char* method : {"naive", "graphcut", "full"}) {   // faces along the axes leave no choice
        const std::string label = std::string("label cube.obj --method ") + method;
        CHECK(check_done(scratch, label).out == kNaive);
        CHECK(check_done(scratch, label + " -o -").out == kNaive);
        CHECK(check_done(scratch, label + " -o l.txt").out.empty());
        CHECK(scratch.read("l.txt") == kNaive);
        fs::remove(scratch.path("l.txt"));
    }
    CHECK(check_done(scratch, "label cube.obj").out == kNaive);
    CHECK(check_done(scratch, "label --method=naive -o l.txt -- cube.obj").out.empty());
    scratch.write("-x.obj", scratch.read("cube.obj"));
    CHECK(check_done(scratch, "label -- -x.obj").out == kNaive);
    CHECK(scratch.entries() == 4);
}

TEST_CASE("cli: the statistics of the result") {
    const Scratch scratch;
    check_done(scratch, "label cube.obj -o l.txt --stats s.json");
    const std::string json = scratch.read("s.json");
    CHECK(json.find(R"("class": "valid_monotone")") != std::string::npos);
    CHECK(json.find(R"("nb": 12,)") != std::string::npos);
    CHECK(check_done(scratch, "stats cube.obj l.txt").out == json);
    CHECK(check_done(scratch, "stats cube.obj l.txt -o again.json").out.empty());
    CHECK(scratch.read("again.json") == json);
}

TEST_CASE("cli: from given labels") {
    const Scratch scratch;
    CHECK(check_done(scratch, "label cube.obj --init naive.txt").out == kNaive);
    scratch.write("short.txt", "0 0 1 1");
    scratch.write("wrong.txt", "0 0 1 1 2 2 3 3 4 4 5 6");
    scratch.write("free.txt", "0 0 1 1 2 2 3 3 4 4 5 -1");
    check_refused(scratch, "label cube.obj --init short.txt -o l.txt", "short.txt");
    check_refused(scratch, "label cube.obj --init wrong.txt -o l.txt", "wrong.txt:1: ");
    check_refused(scratch, "label cube.obj --init free.txt -o l.txt", "free.txt:1: ");
    check_refused(scratch, "label cube.obj --init missing.txt -o l.txt", "missing.txt: ");
}

TEST_CASE("cli: locked facets keep their labels") {
    const Scratch scratch;
    scratch.write("lock.txt", "-1 -1 -1 -1 -1 -1 -1 -1 -1 -1 -1 3");   // of the last facet, whose normal is -Z
    for (const char* method : {"naive", "graphcut", "full"}) {
        const Result r = scratch.run(std::string("label cube.obj --lock lock.txt --method ") + method);
        CHECK(r.status < 2);
        CHECK(r.err.empty());
        CHECK(r.out.substr(22) == "3\n");
    }
    scratch.write("short.txt", "-1 -1");
    check_refused(scratch, "label cube.obj --lock short.txt -o l.txt", "short.txt");
    scratch.write("wrong.txt", "-2 -1 -1 -1 -1 -1 -1 -1 -1 -1 -1 -1");
    check_refused(scratch, "label cube.obj --lock wrong.txt -o l.txt", "wrong.txt:1: ");
}

TEST_CASE("cli: the status of full says whether the result is valid, initial labelings are just done") {
    // A tetrahedron: whatever the labels, some chart has less than four boundaries.
    const Scratch scratch;
    scratch.write("t.obj", obj_text(shapes::tetrahedron()));
    check_done(scratch, "label t.obj --method naive -o l.txt");
    check_done(scratch, "label t.obj --method graphcut -o l.txt");
    check_done(scratch, "stats t.obj l.txt", 1);
    check_done(scratch, "label t.obj -o l.txt --stats s.json", 1);
    CHECK(scratch.read("l.txt").size() == 8);   // written all the same
    CHECK(scratch.read("s.json").find(R"("class": "invalid")") != std::string::npos);
    CHECK(check_done(scratch, "explain t.obj l.txt", 1).out.find("needs at least 4") != std::string::npos);
}

TEST_CASE("cli: a CAD model") {
    const Scratch scratch;
    const std::string bracket = "'" POLYLAB_SOURCE_DIR "/golden/cases/bracket/bracket.mesh'";
    const TriMesh mesh = read_surface(POLYLAB_SOURCE_DIR "/golden/cases/bracket/bracket.mesh");
    check_done(scratch, "label " + bracket + " --method naive -o naive.txt");
    CHECK(scratch.read("naive.txt") == labels_text(naive_labeling(mesh)));
    check_done(scratch, "label " + bracket + " --method graphcut -o graphcut.txt --stats s.json");
    CHECK(scratch.read("graphcut.txt") == labels_text(graphcut_labeling(mesh)));
    const int status = scratch.run("stats " + bracket + " graphcut.txt -o again.json").status;
    CHECK(scratch.read("again.json") == scratch.read("s.json"));
    CHECK(status == (scratch.read("s.json").find(R"("class": "invalid")") == std::string::npos ? 0 : 1));
    // Another weight gives other labels; without any weight on borders each facet has its own.
    check_done(scratch, "label " + bracket + " --method graphcut --compactness 0 -o free.txt");
    CHECK(scratch.read("free.txt") != scratch.read("graphcut.txt"));
    InitialOptions options;
    options.compactness = 5;
    options.fidelity = 2;
    options.sensitivity = 0.5;
    options.angle = -0.1;
    CHECK(
        check_done(scratch, "label " + bracket + " --method graphcut --compactness 5 --fidelity 2 --sensitivity 0.5 --angle -0.1")
            .out == labels_text(graphcut_labeling(mesh, options)));
    const Result full = scratch.run("label " + bracket + " -o full.txt");
    CHECK(full.err.empty());
    CHECK(full.status == scratch.run("stats " + bracket + " full.txt").status);
}

// ---- messages ----

TEST_CASE("cli: warnings, and silence") {
    const Scratch scratch;
    scratch.write("inward.obj", obj_text(shapes::turned(cube(1))));
    Result r = scratch.run("label inward.obj --method naive");
    CHECK(r.status == 0);
    CHECK(r.out == kNaive);
    CHECK(r.err.find("inward.obj: ") == 0);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK(check_done(scratch, "label inward.obj --method naive --quiet").out == kNaive);
    // Errors are said all the same.
    r = scratch.run("label missing.obj --quiet");
    CHECK(r.status == 2);
    CHECK(r.err.find("missing.obj: ") == 0);
}

TEST_CASE("cli: verbose says what was read and what came out") {
    const Scratch scratch;
    const Result r = scratch.run("label cube.obj --method naive --verbose -o l.txt");
    CHECK(r.status == 0);
    CHECK(r.out.empty());
    CHECK(r.err.find("cube.obj: 12 facets, 8 vertices, 0 feature edges\n") == 0);
    CHECK(r.err.find("valid, all monotone: 6 charts (0 invalid), 12 boundaries (0 invalid), 8 corners") != std::string::npos);
    CHECK(r.err.find("labels written to l.txt") != std::string::npos);
    CHECK(scratch.run("stats cube.obj naive.txt --verbose").err.find("valid, all monotone") != std::string::npos);
    CHECK(check_done(scratch, "label cube.obj --method naive --verbose --quiet").out == kNaive);   // quiet wins
}

TEST_CASE("cli: --effort is a number from 0 to 3, of the full method with both routines") {
    Scratch scratch;
    for (const char* effort : {"0", "1", "2", "3"})
        CHECK(scratch.run(std::string("label cube.obj -o l.txt --effort ") + effort).status == 0);
    CHECK(scratch.run("label cube.obj --effort 4").err.find("--effort: expected an integer from 0 to 3, found '4'") !=
          std::string::npos);
    CHECK(scratch.run("label cube.obj --effort 1 --routine validity").status == 2);
    CHECK(scratch.run("label cube.obj --effort 1 --method naive").status == 2);
}

TEST_CASE("cli: --align turns the part, says how, and the statistics of the labels agree") {
    Scratch scratch;
    MeshData data = cube(2);
    for (Vec3& p : data.points) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    scratch.write("turned.obj", obj_text(data));
    const Result result = scratch.run("label turned.obj --align --verbose -o l.txt --stats s.json");
    CHECK(result.status == 0);
    CHECK(result.err.find("turned.obj: turned by (0.") != std::string::npos);
    const std::string json = scratch.read("s.json");
    CHECK(json.find("\"rotation\": [") != std::string::npos);
    CHECK(json.find("\"min\": 1.0") != std::string::npos);
    CHECK(check_done(scratch, "stats turned.obj l.txt --align").out == json);
    CHECK(check_done(scratch, "stats turned.obj l.txt").out.find("rotation") == std::string::npos);
}

TEST_CASE("cli: a hint for a part that is turned") {
    const Scratch scratch;
    const std::vector<Vec3> diamond = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    scratch.write("d.obj", obj_text(shapes::prism(diamond, 3)));
    scratch.write("l.txt", "0 0 0 0 1 1 1 1 5 5 4 4");   // +X twice, -X twice: ridges, and ends with two boundaries
    CHECK(check_done(scratch, "explain d.obj l.txt", 1).out.find("\nhint: ") != std::string::npos);
    scratch.write("valid.txt", "0 0 2 2 1 1 3 3 5 5 4 4");
    CHECK(check_done(scratch, "explain d.obj valid.txt").out == "valid, and every boundary is monotone\n");
    CHECK(scratch.run("label d.obj --method naive --verbose -o m.txt").err.find("\nhint: ") != std::string::npos);
}

// ---- explain, diff ----

TEST_CASE("cli: explain") {
    const Scratch scratch;
    CHECK(check_done(scratch, "explain cube.obj naive.txt").out == "valid, and every boundary is monotone\n");
    scratch.write("all.txt", "2 2 2 2 2 2 2 2 2 2 2 2");
    const std::string text = "chart 0 (+Y, 12 facets near 0.5 0.5 0.5): no boundary, needs at least 4\n";
    CHECK(check_done(scratch, "explain cube.obj all.txt", 1).out == text);
    check_done(scratch, "explain cube.obj all.txt -o e.txt", 1);
    CHECK(scratch.read("e.txt") == text);
}

TEST_CASE("cli: a report and a picture are written with the rest, or not at all") {
    const Scratch scratch;
    check_done(scratch, "label cube.obj -o l.txt --report r.html --picture p.png");
    CHECK(scratch.read("r.html").find("<title>cube.obj - polylab</title>") != std::string::npos);
    CHECK(scratch.read("p.png").substr(1, 3) == "PNG");
    check_done(scratch, "stats cube.obj l.txt -o s.json --report r2.html --picture p2.png");
    CHECK(scratch.read("p2.png") == scratch.read("p.png"));
    check_done(scratch, "explain cube.obj l.txt -o e.txt --report r3.html");
    CHECK(scratch.read("r3.html").find("\"name\": \"given\"") != std::string::npos);
    check_refused(scratch, "label cube.obj -o n.txt --report none/r.html", "none/r.html");
}

TEST_CASE("cli: the two files of a coloured surface are written together, or not at all") {
    const Scratch scratch;
    check_done(scratch, "export cube.obj naive.txt -o out.obj");
    CHECK(scratch.read("out.obj").find("mtllib out.mtl\n") == 0);
    CHECK(scratch.read("out.mtl").find("newmtl red\n") == 0);
    check_done(scratch, "label cube.obj -o labeled.obj");
    CHECK(scratch.read("labeled.mtl") == scratch.read("out.mtl"));
    fs::create_directory(scratch.path("b.mtl"));
    check_refused(scratch, "export cube.obj naive.txt -o b.obj", "b.mtl: can't be written");
}

TEST_CASE("cli: diff") {
    const Scratch scratch;
    scratch.write("b.txt", "0 0 1 1 2 2 3 3 4 4 5 0");
    CHECK(check_done(scratch, "diff cube.obj naive.txt naive.txt").out == "0 of 12 facets differ, in 0 patches\n");
    const std::string text = check_done(scratch, "diff cube.obj naive.txt b.txt", 1).out;
    CHECK(text.find("1 of 12 facets differ, in 1 patches\n") == 0);
    CHECK(text.find("1 facets -Z -> +X, from facet 11 near 0 0 0\n") != std::string::npos);
}

// ---- feature edges ----

TEST_CASE("cli: feature edges of the file, or detected") {
    const Scratch scratch;
    MeshData creased = shapes::creased(cube(1));
    creased.edges.resize(10);   // five of the twelve
    scratch.write("c.obj", obj_text(creased));
    const auto preserved = [&](const std::string& options) {
        const std::string json = check_done(scratch, "stats c.obj naive.txt " + options).out, key = "\"preserved\": ";
        return std::stoi(json.substr(json.find(key) + key.size()));
    };
    CHECK(preserved("") == 5);
    CHECK(preserved("--features file") == 5);
    CHECK(preserved("--features detect") == 12);
    CHECK(preserved("--features detect=0.7") == 12);
    CHECK(preserved("--features=detect=1.5") == 12);   // normals differ by pi/2 = 1.5708
    CHECK(preserved("--features detect=1.6") == 0);
    const std::string label = scratch.run("label c.obj --features detect --method naive --stats s.json --verbose").err;
    CHECK(label.find("12 feature edges") != std::string::npos);
    CHECK(scratch.read("s.json").find("\"preserved\": 12") != std::string::npos);
}

// ---- input and output ----

TEST_CASE("cli: input that can't be used is one line, and no file") {
    const Scratch scratch;
    MeshData open = cube(1);
    open.triangles.resize(33);
    scratch.write("open.obj", obj_text(open));
    scratch.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 x\nf 1 2 3\n");
    scratch.write("empty.obj", "");
    fs::create_directory(scratch.path("directory.obj"));
    scratch.write("cube.xyz", scratch.read("cube.obj"));
    scratch.write("short.txt", "0 0");
    for (const char* command : {"label ", "stats --quiet "}) {
        const std::string rest = std::string(command) == "label " ? " -o l.txt --stats s.json" : " naive.txt -o s.json";
        check_refused(scratch, command + ("missing.obj" + rest), "missing.obj: ");
        check_refused(scratch, command + ("open.obj" + rest), "open.obj: ");
        check_refused(scratch, command + ("bad.obj" + rest), "bad.obj:3: expected ");
        check_refused(scratch, command + ("empty.obj" + rest), "empty.obj: ");
        check_refused(scratch, command + ("cube.xyz" + rest), "cube.xyz: ");
        check_refused(scratch, command + ("directory.obj" + rest), "directory.obj: expected a file, found a directory");
    }
    check_refused(scratch, "stats cube.obj short.txt -o s.json", "short.txt: ");
    check_refused(scratch, "explain cube.obj short.txt -o s.txt", "short.txt: ");
    check_refused(scratch, "diff cube.obj naive.txt short.txt -o s.txt", "short.txt: ");
    check_refused(scratch, "surface cube.obj -o s.obj --map m.txt", "cube.obj: expected tetrahedra");
    check_refused(scratch, "volume-labels naive.txt short.txt -o v.txt", "short.txt:1: ");
}

TEST_CASE("cli: output that can't be written is status 2") {
    const Scratch scratch;
    check_refused(scratch, "label cube.obj -o missing/l.txt", "missing/l.txt: can't be written: ");
    check_refused(scratch, "label cube.obj -o .", ".: can't be written: it is a directory");
    check_refused(scratch, "label cube.obj -o l.txt --stats missing/s.json", "missing/s.json: can't be written: ");
    check_refused(scratch, "stats cube.obj naive.txt -o missing/s.json", "missing/s.json: can't be written: ");
    scratch.write("tets.mesh", medit_text(two_tets()));
    check_refused(scratch, "surface tets.mesh -o missing/s.obj", "missing/s.obj: can't be written: ");
    // Where one of two files can't be written, the other is not left alone.
    check_refused(scratch, "label cube.obj -o missing/l.txt --stats s.json", "missing/l.txt: can't be written: ");
    check_refused(scratch, "surface tets.mesh -o s.stl --map m.txt", "s.stl: expected a file name in .obj or .mesh");
    if (!fs::exists("/dev/full")) return;
    check_refused(scratch, "label cube.obj -o /dev/full", "/dev/full: can't be written: ");
    check_refused(scratch, "surface tets.mesh -o s.obj --map /dev/full", "/dev/full: can't be written: ");
    for (const char* command :
         {"label cube.obj", "stats cube.obj naive.txt", "explain cube.obj naive.txt", "--help", "label --help", "--version"})
        check_refused(scratch, std::string(command) + " >/dev/full", "-: can't be written: ");
    // What is not a regular file is written through.
    CHECK(check_done(scratch, "label cube.obj -o /dev/null").out.empty());
}

TEST_CASE("cli: /dev/stdout is written through where it is a pipe") {
    if (!fs::exists("/dev/stdout")) return;
    const Scratch scratch;
    const Result r = scratch.run("label cube.obj -o /dev/stdout | cat");
    CHECK(r.out == kNaive);
    CHECK(r.err.empty());
}

TEST_CASE("cli: an output takes neither the place of the part nor that of another output") {
    const Scratch scratch;
    const std::string part = scratch.read("cube.obj");
    fs::create_symlink("cube.obj", scratch.path("link.obj"));
    check_refused(scratch, "label cube.obj -o cube.obj", "cube.obj: can't be written: it is read as cube.obj");
    check_refused(scratch, "label cube.obj -o l.txt --stats link.obj", "link.obj: can't be written: it is read as cube.obj");
    CHECK(scratch.read("cube.obj") == part);
    check_refused(scratch, "label cube.obj -o x --stats x", "x: can't be written: it is the place of another output too");
    check_refused(scratch, "label cube.obj -o x --stats ./x", "./x: can't be written: it is the place of another output too");
    scratch.write("l.txt", "old");
    check_refused(scratch, "label cube.obj -o l.txt --stats l.txt", "l.txt: can't be written: it is the place of");
    CHECK(scratch.read("l.txt") == "old");
    check_done(scratch, "label cube.obj -o /dev/null --stats /dev/null");
    check_done(scratch, "label cube.obj --init naive.txt -o naive.txt");   // labels may be replaced
}

TEST_CASE("cli: a result replaces an older file as a whole") {
    const Scratch scratch;
    scratch.write("l.txt", std::string(1000, '7'));
    check_refused(scratch, "label missing.obj -o l.txt", "missing.obj");
    CHECK(scratch.read("l.txt") == std::string(1000, '7'));
    check_done(scratch, "label cube.obj -o l.txt");
    CHECK(scratch.read("l.txt") == kNaive);
}

TEST_CASE("cli: an interrupted run writes its best labels whole, with status 1") {
    // Noise on 24576 facets keeps the routines busy for long; the line that --verbose says before them is waited for.
    const Scratch scratch;
    MeshData part = cube(8);
    for (int i = 0; i < 3; i++) part = shapes::refined(part);
    const Index facets = static_cast<Index>(part.triangles.size() / 3);
    scratch.write("part.obj", obj_text(part));
    shapes::Lcg random(1);
    std::string noise;
    for (Index f = 0; f < facets; f++) noise += std::to_string(random.below(kLabels)) + " ";
    scratch.write("noise.txt", noise);
    const std::string start = " --verbose & pid=$!; until grep -q 'initial labeling' ../err.$PPID; do sleep 0.01; done; ";
    const Result r = scratch.run("label part.obj --init noise.txt -o l.txt" + start + "kill -TERM $pid; wait $pid");
    CHECK(r.status == 1);
    CHECK(r.err.find("interrupted: these are the best labels so far\n") != std::string::npos);
    CHECK(read_labels(scratch.path("l.txt"), facets).size() == static_cast<std::size_t>(facets));
    CHECK(scratch.entries() == 5);   // with cube.obj and naive.txt

    // A second one ends the program at once, and leaves what was there. The first one is done with once the program sleeps:
    // nobody reads the pipe that it wants to write to.
    scratch.write("s.json", "old");
    const Result second = scratch.run(
        "label part.obj --init noise.txt -o pipe --stats s.json" + start +
            "kill -TERM $pid; until grep -q 'State:.S' /proc/$pid/status; do kill -0 $pid || exit; done; echo asleep\n"
            "kill -TERM $pid; for i in $(seq 100); do grep -q 'State:.Z' /proc/$pid/status && break; sleep 0.1; done\n"
            "kill -KILL $pid; wait $pid",
        "mkfifo pipe; ");
    CHECK(second.out == "asleep\n");
    CHECK(second.status == 128 + SIGTERM);
    CHECK(second.err.find("interrupted") == std::string::npos);
    CHECK(scratch.read("s.json") == "old");
}

// ---- tetrahedra ----

TEST_CASE("cli: a tet mesh, its surface, and labels for its tetrahedra") {
    const Scratch scratch;
    scratch.write("tets.mesh", medit_text(two_tets()));
    const std::string labels = check_done(scratch, "label tets.mesh --method naive").out;
    // Of the first -X -Y -Z; of the second the normals (-1,1,1) (1,-1,1) (1,1,-1), where the first of equals counts.
    CHECK(labels == "1\n3\n5\n1\n0\n0\n");
    scratch.write("l.txt", labels);
    for (const char* surface : {"s.obj", "s.mesh"}) {
        check_done(scratch, std::string("surface tets.mesh -o ") + surface + " --map m.txt");
        CHECK(check_done(scratch, std::string("label --method naive ") + surface).out == labels);
        const MeshData data = read_mesh(scratch.path(surface));
        CHECK(data.triangles.size() == 18);
        CHECK(data.points.size() == 5);
        CHECK(data.tets.empty());
    }
    const SurfaceMap map = read_surface_map(scratch.path("m.txt"));
    CHECK(map.tets == 2);
    CHECK(map.tet_facet == extract_surface(two_tets()).map.tet_facet);
    // The facet between the two has no label: facet 0 of the first, facet 3 (without vertex 4) of the second.
    const std::string volume = check_done(scratch, "volume-labels l.txt m.txt").out;
    CHECK(volume == "-1\n1\n3\n5\n1\n0\n0\n-1\n");
    check_done(scratch, "volume-labels l.txt m.txt -o v.txt");
    CHECK(scratch.read("v.txt") == volume);
    check_refused(scratch, "volume-labels naive.txt m.txt", "naive.txt");   // of another mesh
    CHECK(scratch.run("surface tets.mesh -o s.obj --verbose").err.find("2 tetrahedra, 6 triangles on the surface") !=
          std::string::npos);
}

TEST_CASE("cli: polycube") {
    const Scratch scratch;
    const std::string cube_text = obj_text(cube(1));   // its own polycube
    CHECK(check_done(scratch, "polycube cube.obj naive.txt").out == cube_text);
    check_done(scratch, "polycube cube.obj naive.txt -o p.obj --stats p.json");
    CHECK(scratch.read("p.obj") == cube_text);
    const std::string json = scratch.read("p.json"), plain = check_done(scratch, "stats cube.obj naive.txt").out;
    CHECK(
        json.find(
            "        \"distortion\": {\n            \"angle\": 1.0,\n            \"area\": 1.0,\n            \"collapsed\": 0,\n"
            "            \"isometric\": 1.0,\n            \"stretch\": 1.0,\n            \"turned\": 0\n        },\n") !=
        std::string::npos);
    CHECK(plain.find("distortion") == std::string::npos);
    CHECK(read_medit((check_done(scratch, "polycube cube.obj naive.txt -o p.mesh"), scratch.read("p.mesh")), "p.mesh").points ==
          cube(1).points);
    CHECK(scratch.run("polycube cube.obj naive.txt -o p.obj --verbose").err.find("distortion: stretch 1.000, ") !=
          std::string::npos);
    scratch.write("short.txt", "0 0\n");
    check_refused(scratch, "polycube cube.obj short.txt", "short.txt");
    check_refused(scratch, "polycube cube.obj naive.txt -o p.txt", "p.txt");
}

TEST_CASE("cli: labels of a part that was welded or turned go on to its polycube and to other programs") {
    const Scratch scratch;
    MeshData loose = cube(1);   // every facet with vertices of its own
    std::vector<Vec3> points;
    for (Index& v : loose.triangles) {
        points.push_back(loose.points[v]);
        v = static_cast<Index>(points.size()) - 1;
    }
    loose.points = points;
    scratch.write("loose.obj", obj_text(loose));
    check_refused(scratch, "export loose.obj naive.txt -o l.vtk", "--weld makes them one");
    check_refused(scratch, "polycube loose.obj naive.txt -o p.obj", "--weld makes them one");
    CHECK(scratch.run("export loose.obj naive.txt -o l.vtk --weld").status == 0);
    CHECK(scratch.run("polycube loose.obj naive.txt -o p.obj --weld").status == 0);
    CHECK(read_vtk(scratch.read("l.vtk"), "l.vtk").triangles.size() == 36);

    MeshData turned = cube(1);   // by the angle of a 3-4-5 triangle
    for (Vec3& p : turned.points) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    scratch.write("turned.obj", obj_text(turned));
    CHECK(scratch.run("polycube turned.obj naive.txt -o p.obj --align --stats p.json").status == 0);
    CHECK(scratch.read("p.json").find("\"rotation\"") != std::string::npos);
    const TriMesh straight = build_mesh(read_obj(scratch.read("p.obj"), "p.obj"));
    for (const Vec3& n : straight.normal) CHECK(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) == doctest::Approx(1));
}

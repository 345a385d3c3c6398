// Turning-points: the chain solvers against enumeration, and boundaries on a cube whose answer is plain.
#include "polylab/turning_points.h"

#include "polylab/initial_labeling.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

using namespace polylab;
using shapes::cube;
using shapes::Lcg;

namespace {

constexpr Label kX = 0, kY = 2, kZ = 4;

// ---- chains ----

// Directions of all edges as bits: 1 along +axis; the last edge is the highest bit.
using Along = unsigned;

bool turns_at(Along along, Index i, Index n) { return ((along >> i) & 1) != ((along >> (i > 0 ? i - 1 : n - 1)) & 1); }

std::vector<Index> turns(Along along, Index n, bool closed) {
    std::vector<Index> positions;
    for (Index i = closed ? 0 : 1; i < n; i++)
        if (turns_at(along, i, n)) positions.push_back(i);
    return positions;
}

using Price = std::tuple<int, Index, Index>;   // energy, turning-points, sum of their vertices

Price price(const Chain& chain, Along along, bool closed) {
    const Index n = chain.size();
    Price p = {0, 0, 0};
    for (Index i = 0; i < n; i++) std::get<0>(p) += chain.cost[(along >> i) & 1][i];
    for (const Index i : turns(along, n, closed)) {
        std::get<0>(p) += chain.change[i > 0 ? i - 1 : n - 1];
        std::get<1>(p)++;
        std::get<2>(p) += chain.vertex[i];
    }
    return p;
}

Along all_plus(Index n) { return (1u << n) - 1; }

std::vector<Along> optima(const Chain& chain, bool closed) {
    std::vector<Along> best = {0};
    for (Along along = 1; along <= all_plus(chain.size()); along++) {
        const Price p = price(chain, along, closed), least = price(chain, best[0], closed);
        if (p < least) best.clear();
        if (p <= least) best.push_back(along);
    }
    return best;
}

// The answer is one of least price, and of those one whose last edge goes along +axis if there is any.
bool chain_turns_right(const Chain& chain, bool closed) {
    const Index n = chain.size();
    const std::vector<Along> best = optima(chain, closed);
    const bool plus = ((best.back() >> (n - 1)) & 1) == 1;   // the largest one
    const std::vector<Index> found = chain_turns(chain, closed);
    return std::any_of(best.begin(), best.end(),
                       [&](Along along) { return turns(along, n, closed) == found && (!plus || ((along >> (n - 1)) & 1) == 1); });
}

// The published rule: solved as an open chain; all -axis if that is as good as any, else +axis wherever there is a choice,
// from the end backwards: the largest number.
std::vector<Index> published_by_enumeration(const Chain& chain, bool closed) {
    const Index n = chain.size();
    const auto energy = [&](Along along) { return std::get<0>(price(chain, along, false)); };
    Along best = 0;
    for (Along along = 1; along <= all_plus(n); along++)
        if (energy(along) < energy(best) || (best > 0 && energy(along) == energy(best))) best = along;
    std::vector<Index> positions = turns(best, n, false);
    if (closed && turns_at(best, 0, n)) positions.push_back(0);
    return positions;
}

Chain random_chain(Index n, int costs, Lcg& random) {
    Chain chain;
    for (Index i = 0; i < n; i++) {
        for (auto& cost : chain.cost) cost.push_back(random.below(costs));
        chain.change.push_back(random.below(costs));
    }
    chain.vertex = random.permutation(n);
    return chain;
}

// Its vertices numbered 1, 2, 4, 8 …: sums of different sets differ, so that the set of turning-points is unique.
Chain with_unique_sums(Chain chain) {
    for (Index& v : chain.vertex) v = 1 << v;
    return chain;
}

// The same boundary, traversed the other way.
Chain reversed(Chain chain) {
    std::swap(chain.cost[0], chain.cost[1]);
    for (auto& cost : chain.cost) std::reverse(cost.begin(), cost.end());
    std::reverse(chain.change.begin(), chain.change.end() - 1);   // the last is between the last edge and the first
    std::reverse(chain.vertex.begin() + 1, chain.vertex.end());   // the first edge starts at vertex 0, or at the open end
    return chain;
}

// The same closed boundary from its edge `first` on.
Chain started_at(Chain chain, Index first) {
    for (auto* list : {&chain.cost[0], &chain.cost[1], &chain.change, &chain.vertex})
        std::rotate(list->begin(), list->begin() + first, list->end());
    return chain;
}

std::set<Index> vertices(const Chain& chain, bool closed) {
    std::set<Index> found;
    for (const Index i : chain_turns(chain, closed)) found.insert(chain.vertex[i]);
    return found;
}

// Edges in a plane: A along +axis, V against it, > and < across. Vertices are numbered along the chain.
Chain drawn(const std::string& edges) {
    const std::string around = "A>V<";   // clockwise
    Chain chain;
    for (std::size_t i = 0; i < edges.size(); i++) {
        const std::size_t turn = (around.find(edges[(i + 1) % edges.size()]) + 4 - around.find(edges[i])) % 4;
        chain.cost[0].push_back(edges[i] == 'A' ? 46 : 0);   // 100 (1 - exp(-1 / 1.62)) = 46.06
        chain.cost[1].push_back(edges[i] == 'V' ? 46 : 0);
        chain.change.push_back(turn == 0 ? 100 : turn == 2 ? 13 : 60);   // 100 exp(-1/2) = 60.7, 100 exp(-2) = 13.5
        chain.vertex.push_back(static_cast<Index>(i));
    }
    return chain;
}

using Positions = std::vector<Index>;

// ---- shapes ----

Index vertex_at(const TriMesh& mesh, const Vec3& p) {
    return static_cast<Index>(std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin());
}

// cube(n) by its normals, but squares [x,x+1] x [y,y+1] of its upper face have another label.
Labeling with_squares(Index n, const std::vector<std::array<Index, 2>>& squares, Label label) {
    Labeling labels = naive_labeling(build_mesh(cube(n)));
    for (const auto& [x, y] : squares) {
        const Index f = 8 * n * n + 2 * (n * y + x);
        labels[f] = labels[f + 1] = label;
    }
    return labels;
}

// The boundary between +X and +Z of cube(6) leaves its edge at y = 4, comes back to y = 4 - length, and goes on:
//
//    y  5 +---+---+  the squares of the upper face that are +X, for length 3;
//       4 |   +---+  that chart goes on beyond x = 6
//         |   |
//       1 +---+
//         4   5   6 x
Labeling hooked(Index length) {
    std::vector<std::array<Index, 2>> squares = {{5, 4}};
    for (Index y = 4 - length; y <= 4; y++) squares.push_back({4, y});
    return with_squares(6, squares, kX);
}

// A bay of +Y in the upper face +Z of cube(5), open to the face +X: its boundary goes along -X, +Y, +X.
Labeling with_bay(Index depth) {
    std::vector<std::array<Index, 2>> squares;
    for (Index x = 5 - depth; x < 5; x++) squares.push_back({x, 2});
    return with_squares(5, squares, kY);
}

std::set<Index> turning_vertices(const TurningPoints& found) {
    std::set<Index> result;
    for (const TurningPoint& t : found.points) result.insert(t.vertex);
    return result;
}

Index halfedge_between(const TriMesh& mesh, const Vec3& p, const Vec3& q) {
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (mesh.points[mesh.from(h)] == p && mesh.points[mesh.to(h)] == q) return h;
    return kNone;
}

// Angles at the left and at the right of position i of a boundary, in radians.
std::array<double, 2> angles(const TriMesh& mesh, const LabelingGraph& graph, const TurningPoint& t) {
    const Range run = graph.boundaries[t.boundary].halfedges;
    const Index out = graph.halfedges[run.first + t.position];
    const Index in = graph.halfedges[run.first + (t.position + run.size() - 1) % run.size()];
    std::array<double, 2> sums = {0, 0};
    Index side = 0, h = out;
    do {
        const Vec3 a = mesh.vector(h), b = -mesh.vector(prev(h));
        sums[side] += std::acos(dot(a, b) / (norm(a) * norm(b)));
        h = mesh.ccw(h);
        if (h == mesh.opposite[in]) side = 1;
    } while (h != out);
    return sums;
}

}   // namespace

// ---- chains ----

TEST_CASE("turning-points: costs of edges and changes") {
    // 100 (1 - exp(-(d / 0.9)^2 / 2)) against the direction: 46.06 for d = 1, 26.6 at 45 degrees, 0 across.
    // 100 exp(-(c - 1)^2 / 2) for a change: 60.7 at 90 degrees, 23.3 at 135, 95.8 at 45, 13.5 at 180, 100 straight on.
    const TriMesh mesh = build_mesh(cube(1));   // facet 0: vertices (1,0,0) (1,1,0) (1,1,1)
    const Chain y = make_chain(mesh, {0, 1, 2}, 1);
    CHECK(y.cost[0] == std::vector<int>{46, 0, 0});
    CHECK(y.cost[1] == std::vector<int>{0, 0, 26});
    CHECK(y.change == std::vector<int>{60, 23, 23});
    CHECK(y.vertex == std::vector<Index>{0, 1, 2});
    const Chain z = make_chain(mesh, {0, 1, 2}, 2);
    CHECK(z.cost[0] == std::vector<int>{0, 46, 0});
    CHECK(z.cost[1] == std::vector<int>{0, 0, 26});
    CHECK(make_chain(mesh, {0, mesh.opposite[0], 3, 3}, 0).change == std::vector<int>{13, 23, 100, 95});   // 3 is the diagonal
    // (-3, 4) / 5: 19.9 for d = 0.6, 32.6 for d = 0.8
    const TriMesh prism = build_mesh(shapes::triangular_prism(3, 4, 1));
    CHECK(make_chain(prism, {6}, 0).cost[1] == std::vector<int>{19});
    CHECK(make_chain(prism, {6}, 1).cost[0] == std::vector<int>{32});
}

TEST_CASE("turning-points: chains that can be seen at a glance") {
    CHECK(chain_turns(drawn("AAAA"), false).empty());
    CHECK(chain_turns(drawn("VVVV"), false).empty());
    CHECK(chain_turns(drawn(">>>>"), false).empty());
    CHECK(chain_turns(drawn("A>A>A<A<A"), false).empty());         // jagged, but never back
    CHECK(chain_turns(drawn("AAV>AA"), false).empty());            // 46 back, or 13 + 60 to turn twice
    CHECK(chain_turns(drawn("A>V"), false).empty());               // 46, or 60 to turn
    CHECK(chain_turns(drawn("AA>VV"), false) == Positions{2});     // 92, or 60 at one end of the edge across: the smaller
    CHECK(chain_turns(drawn("AA>>>VV"), false) == Positions{2});   // 100 in the middle of the edges across
    CHECK(chain_turns(drawn("AAAVVV"), false) == Positions{3});
    CHECK(chain_turns(drawn("AAAA>VV>AAAA"), false).empty());               // 92, or 120
    CHECK(chain_turns(drawn("AAAA>VVV>AAAA"), false) == Positions{4, 8});   // 138, or 120
    // Closed: sides of two edges cost 92 against, two turns cost 120; sides of three edges 138.
    CHECK(chain_turns(drawn("AA>>VV<<"), true).empty());
    CHECK(chain_turns(drawn("AAA>>>VVV<<<"), true) == Positions{0, 3});
    CHECK(chain_turns(drawn("A>>>VVV<<<AA"), true) == Positions{1, 7});
}

TEST_CASE("turning-points: the published count of a closed boundary depends on its start") {
    // Solved as an open chain, one turn is free where the ends meet: 60 against 92.
    CHECK(published_chain_turns(drawn("AA>>VV<<"), true) == Positions{4, 0});
    CHECK(published_chain_turns(drawn("VV<<AA>>"), true) == Positions{2, 0});
    // From the middle of a side: two turns, 120, or one and an edge against its direction, 106.
    CHECK(published_chain_turns(drawn("A>>VV<<A"), true).empty());
}

TEST_CASE("turning-points: published ties go to +axis from the end backwards, but first to all -axis") {
    CHECK(published_chain_turns(drawn("AAA>VVV"), false) == Positions{4});   // the edge across goes along with those before it
    CHECK(published_chain_turns(drawn("VVV>AAA"), false) == Positions{3});   // … or after it
    // Energies of -- and +- are 1, of -+ and ++ at least 5.
    CHECK(published_chain_turns({{{1, 0}, {0, 5}}, {1, 0}, {0, 1}}, false).empty());
    CHECK(published_chain_turns({{{2, 0}, {0, 5}}, {1, 0}, {0, 1}}, false) == Positions{1});
}

TEST_CASE("turning-points: the chain solver equals enumeration, ties included") {
    const auto check = [](const Chain& chain) {
        REQUIRE(chain_turns_right(chain, false));
        REQUIRE(chain_turns_right(chain, true));
        REQUIRE(published_chain_turns(chain, false) == published_by_enumeration(chain, false));
        REQUIRE(published_chain_turns(chain, true) == published_by_enumeration(chain, true));
    };
    // All chains of up to four edges with costs 0 and 1.
    for (Index n = 1; n <= 4; n++) {
        Lcg random(n);
        Chain chain = random_chain(n, 1, random);
        for (int code = 0; code < 1 << (3 * n); code++) {
            for (Index i = 0; i < n; i++) {
                chain.cost[0][i] = (code >> (3 * i)) & 1;
                chain.cost[1][i] = (code >> (3 * i + 1)) & 1;
                chain.change[i] = (code >> (3 * i + 2)) & 1;
            }
            CAPTURE(n);
            CAPTURE(code);
            check(chain);
        }
    }
    // Random ones; in every third all vertices have one number, so that their sum decides nothing.
    Lcg random(8);
    for (int i = 0; i < 3000; i++) {
        Chain chain = random_chain(1 + i % 8, 2 + i % 3, random);
        if (i % 3 == 0) std::fill(chain.vertex.begin(), chain.vertex.end(), 5);
        CAPTURE(i);
        check(chain);
    }
}

TEST_CASE("turning-points: neither the direction nor the start of a boundary matters") {
    Lcg random(9);
    Index with_turns = 0, number_differs = 0;
    for (int i = 0; i < 2000; i++) {
        const Index n = 1 + i % 8;
        const Chain tied = random_chain(n, 4, random), chain = with_unique_sums(tied);
        CAPTURE(i);
        for (const bool closed : {false, true}) {
            const std::set<Index> expected = vertices(chain, closed);
            CHECK(vertices(reversed(chain), closed) == expected);
            // Where different sets have one sum their number is still the same.
            CHECK(vertices(reversed(tied), closed).size() == vertices(tied, closed).size());
            with_turns += !expected.empty();
            number_differs +=
                published_chain_turns(chain, closed).size() != published_chain_turns(reversed(chain), closed).size();
        }
        for (Index first = 1; first < n; first++) CHECK(vertices(started_at(chain, first), true) == vertices(chain, true));
    }
    CHECK(with_turns > 1000);
    CHECK(number_differs > 100);   // the published rules have no such promise
}

// ---- shapes ----

TEST_CASE("turning-points: a hook of three edges turns twice, one of two does not") {
    const TriMesh mesh = build_mesh(cube(6));
    for (const Index length : {1, 2}) {
        const LabelingGraph graph = build_graph(mesh, hooked(length));
        CHECK(find_turning_points(mesh, graph).points.empty());
        CHECK(published_turning_points(mesh, graph).points.empty());
    }
    const LabelingGraph graph = build_graph(mesh, hooked(3));
    CHECK(graph.valid());
    const TurningPoints found = find_turning_points(mesh, graph);
    CHECK(found.points.size() == 2);
    CHECK(found.vertices == 2);
    CHECK(found.non_monotone_boundaries == 1);
    // At one end of each edge across, the one with the smaller number.
    const auto smaller = [&](const Vec3& p, const Vec3& q) { return std::min(vertex_at(mesh, p), vertex_at(mesh, q)); };
    CHECK(turning_vertices(found) == std::set<Index>{smaller({6, 4, 6}, {5, 4, 6}), smaller({5, 1, 6}, {4, 1, 6})});
    const TurningPoints published = published_turning_points(mesh, graph);
    CHECK(published.vertices == 2);
    CHECK(published.non_monotone_boundaries == 1);
}

TEST_CASE("turning-points: a bay turns once") {
    const TriMesh mesh = build_mesh(cube(5));
    CHECK(find_turning_points(mesh, build_graph(mesh, with_bay(1))).points.empty());
    for (const Index depth : {2, 3}) {
        const LabelingGraph graph = build_graph(mesh, with_bay(depth));
        const TurningPoints found = find_turning_points(mesh, graph);
        const Vec3 p = {5.0 - depth, 2, 5}, q = {5.0 - depth, 3, 5};
        REQUIRE(found.points.size() == 1);
        const TurningPoint& t = found.points[0];
        CHECK(t.vertex == std::min(vertex_at(mesh, p), vertex_at(mesh, q)));
        CHECK(t.boundary == graph.boundary[halfedge_between(mesh, p, q)]);
        CHECK(graph.boundaries[t.boundary].axis == 0);
        CHECK(mesh.from(graph.halfedges[graph.boundaries[t.boundary].halfedges.first + t.position]) == t.vertex);
        CHECK(published_turning_points(mesh, graph).vertices == 1);
    }
}

TEST_CASE("turning-points: stairs and a comb are jagged, but turn only along their axis") {
    const TriMesh mesh = build_mesh(cube(6));
    std::vector<std::array<Index, 2>> stairs, comb;
    const Index height[] = {0, 1, 2, 4, 3, 2};   // at y = 0 … 5, squares from the edge x = 6 inward
    for (Index y = 0; y < 6; y++)
        for (Index i = 0; i < height[y]; i++) stairs.push_back({5 - i, y});
    for (const Index y : {1, 3})
        for (Index x = 3; x < 6; x++) comb.push_back({x, y});
    // With +X beyond the edge one boundary, along Y, which it never goes back.
    CHECK(find_turning_points(mesh, build_graph(mesh, with_squares(6, stairs, kX))).points.empty());
    CHECK(find_turning_points(mesh, build_graph(mesh, with_squares(6, comb, kX))).points.empty());
    // With +Y the teeth are two bays, along X.
    const TurningPoints found = find_turning_points(mesh, build_graph(mesh, with_squares(6, comb, kY)));
    CHECK(found.vertices == 2);
    CHECK(found.non_monotone_boundaries == 2);
}

TEST_CASE("turning-points: published boundaries run as a depth-first search finds them") {
    // Nothing but the bay, the rest of the upper face and +X elsewhere: corners A = (5,2,5) and B = (5,3,5). Facets of +X come
    // first, and A in them. Around A, counter-clockwise from there: towards B, into the bay, along the upper edge. The last is
    // taken from the stack first and ends in B, from where the edge to A and then the bay are taken: the bay is
    // traversed from B. Of the two ends of the edge across, both along +X or -X from there, ties choose the one met first.
    const TriMesh mesh = build_mesh(cube(5));
    Labeling labels = with_bay(2);
    for (Index f = 0; f < 300; f++)
        if (f < 200 || f >= 250) labels[f] = kX;
    const LabelingGraph graph = build_graph(mesh, labels);
    CHECK(graph.corners.size() == 2);
    const Index bay = graph.boundary[halfedge_between(mesh, {3, 2, 5}, {3, 3, 5})];
    const auto in_bay = [&](const TurningPoints& found) {
        std::vector<Index> result;
        for (const TurningPoint& t : found.points)
            if (t.boundary == bay) result.push_back(t.vertex);
        return result;
    };
    CHECK(in_bay(published_turning_points(mesh, graph)) == std::vector<Index>{vertex_at(mesh, {3, 3, 5})});
    CHECK(in_bay(find_turning_points(mesh, graph)) == std::vector<Index>{vertex_at(mesh, {3, 2, 5})});
}

TEST_CASE("turning-points: a closed boundary") {
    const TriMesh mesh = build_mesh(cube(5));
    const auto patch = [&](Index size) {
        std::vector<std::array<Index, 2>> squares;
        for (Index i = 0; i < size * size; i++) squares.push_back({1 + i % size, 1 + i / size});
        return build_graph(mesh, with_squares(5, squares, kX));
    };
    CHECK(find_turning_points(mesh, patch(2)).points.empty());
    const LabelingGraph graph = patch(3);
    const TurningPoints found = find_turning_points(mesh, graph);
    const auto smaller = [&](const Vec3& p, const Vec3& q) { return std::min(vertex_at(mesh, p), vertex_at(mesh, q)); };
    CHECK(turning_vertices(found) == std::set<Index>{smaller({1, 1, 5}, {4, 1, 5}), smaller({1, 4, 5}, {4, 4, 5})});
    CHECK(found.non_monotone_boundaries == 1);
    for (const TurningPoint& t : found.points) {
        CHECK(graph.boundaries[t.boundary].closed());
        CHECK(closest_corner(mesh, graph, t) == kNone);
        // 90 degrees of the patch, 270 degrees around it.
        CHECK(leans_left(mesh, graph, t) == (graph.charts[graph.boundaries[t.boundary].left].label == kZ));
    }
}

TEST_CASE("turning-points: none on boundaries between opposite labels") {
    // As the patch of three by three, but -Z in +Z.
    const TriMesh mesh = build_mesh(cube(5));
    std::vector<std::array<Index, 2>> squares;
    for (Index i = 0; i < 9; i++) squares.push_back({1 + i % 3, 1 + i / 3});
    const LabelingGraph graph = build_graph(mesh, with_squares(5, squares, opposite(kZ)));
    CHECK(find_turning_points(mesh, graph).points.empty());
    CHECK(published_turning_points(mesh, graph).points.empty());
}

TEST_CASE("turning-points: on random labelings they are what the chains say") {
    const TriMesh mesh = build_mesh(cube(6));
    Lcg random(3);
    Index enumerated = 0, loops = 0, at_corners = 0, several = 0;
    for (int round = 0; round < 60; round++) {
        Labeling labels;
        for (Index f = 0; f < mesh.facets(); f++) labels.push_back(static_cast<Label>(2 * random.below(3)));
        for (Index i = 0; i < (round % 12) * mesh.facets(); i++) {   // patches: facets take over a neighbour's label
            const Index h = random.below(mesh.halfedges());
            labels[facet(h)] = labels[mesh.right(h)];
        }
        const LabelingGraph graph = build_graph(mesh, labels);
        const TurningPoints found = find_turning_points(mesh, graph);
        std::map<Index, Positions> by_boundary;
        for (const TurningPoint& t : found.points) {
            CHECK(t.vertex == mesh.from(graph.halfedges[graph.boundaries[t.boundary].halfedges.first + t.position]));
            by_boundary[t.boundary].push_back(t.position);
            at_corners += graph.corner[t.vertex] != kNone;
        }
        CHECK(found.vertices == static_cast<Index>(turning_vertices(found).size()));
        CHECK(found.non_monotone_boundaries == static_cast<Index>(by_boundary.size()));
        CHECK(std::is_sorted(found.points.begin(), found.points.end(), [](const TurningPoint& a, const TurningPoint& b) {
            return std::tie(a.boundary, a.position) < std::tie(b.boundary, b.position);
        }));
        for (std::size_t b = 0; b < graph.boundaries.size(); b++) {
            const Boundary& boundary = graph.boundaries[b];
            const auto first = graph.halfedges.begin();
            const std::vector<Index> run(first + boundary.halfedges.first, first + boundary.halfedges.last);
            const Positions positions = by_boundary[static_cast<Index>(b)];
            if (run.size() == 1) CHECK(positions.empty());
            several += positions.size() > 1;
            if (run.size() == 1 || run.size() > 12) continue;   // too long to enumerate
            enumerated += !positions.empty();
            loops += boundary.closed();
            const Chain chain = make_chain(mesh, run, boundary.axis);
            const std::vector<Along> best = optima(chain, boundary.closed());
            CHECK(std::any_of(best.begin(), best.end(),
                              [&](Along a) { return turns(a, chain.size(), boundary.closed()) == positions; }));
        }
    }
    CHECK(enumerated > 100);   // that the interesting cases occur
    CHECK(loops > 100);
    CHECK(at_corners > 0);
    CHECK(several > 10);
}

TEST_CASE("turning-points: lean to the side with the larger angle, to the left if there is none") {
    const TriMesh mesh = build_mesh(cube(6));
    Labeling labels = hooked(3);
    labels[402] = labels[403] = kX;   // a square in the middle of the lower face, facets 360..431
    const LabelingGraph graph = build_graph(mesh, labels);
    Index ties = 0, lefts = 0, rights = 0;
    for (Index b = 0; b < static_cast<Index>(graph.boundaries.size()); b++) {
        const Boundary& boundary = graph.boundaries[b];
        for (Index i = boundary.closed() ? 0 : 1; i < boundary.halfedges.size(); i++) {
            const TurningPoint t = {b, i, mesh.from(graph.halfedges[boundary.halfedges.first + i])};
            const auto [left, right] = angles(mesh, graph, t);
            const bool tie = std::abs(left - right) < 1e-9;   // multiples of 45 degrees
            CHECK(leans_left(mesh, graph, t) == (tie || left > right));
            (tie ? ties : left > right ? lefts : rights)++;
        }
    }
    CHECK(ties == 11 * 5 + 15 - 6);   // straight on: but for the hook, with 6 bends on 16 edges
    CHECK(lefts + rights == 6 + 4);   // its bends, and those of the square
    CHECK(std::abs(lefts - rights) == 4);
}

TEST_CASE("turning-points: the closest corner along the boundary") {
    // 16 edges of length 1 between the corners (6,0,6) and (6,6,6).
    const TriMesh mesh = build_mesh(cube(6));
    const LabelingGraph graph = build_graph(mesh, hooked(3));
    const Index b = graph.boundary[halfedge_between(mesh, {5, 4, 6}, {5, 3, 6})];
    const Boundary& boundary = graph.boundaries[b];
    REQUIRE(boundary.halfedges.size() == 16);
    for (Index i = 1; i < 16; i++) CHECK(closest_corner(mesh, graph, {b, i, kNone}) == (i < 8 ? boundary.start : boundary.end));
    // Two edges of length 1 and 5: in the middle by number, not by length.
    const TriMesh prism = build_mesh(shapes::prism({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {4, 6, 0}, {0, 6, 0}}, 2));
    const LabelingGraph sides = build_graph(prism, naive_labeling(prism));
    for (const double z : {0, 2}) {
        const Index along = sides.boundary[halfedge_between(prism, {4, 0, z}, {4, 1, z})];
        REQUIRE(sides.boundaries[along].halfedges.size() == 2);
        CHECK(closest_corner(prism, sides, {along, 1, kNone}) == sides.corner[vertex_at(prism, {4, 0, z})]);
    }
    // Closed through one corner: that one.
    const TriMesh octahedron = build_mesh(shapes::octahedron());
    const LabelingGraph loops = build_graph(octahedron, {kY, kX, kY, kX, kX, kX, kX, kX});
    for (Index i = 0; i < 3; i++) CHECK(closest_corner(octahedron, loops, {0, i, kNone}) == 0);
}

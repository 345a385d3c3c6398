#include "polylab/maxflow.h"

#include "polylab/mesh.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace polylab;
using shapes::Lcg;

namespace {

struct Graph {
    Index nodes = 0;
    std::vector<Index> ends;                   // 2 per edge
    std::vector<Index> there, back;            // capacities of the edges
    std::vector<Index> from_source, to_sink;   // capacities of the nodes' terminals

    Index edges() const { return static_cast<Index>(ends.size() / 2); }
};

struct Cut {
    std::int64_t flow = 0;
    std::vector<char> on_source_side;

    bool operator==(const Cut& c) const { return flow == c.flow && on_source_side == c.on_source_side; }
};

// Edmonds-Karp on a matrix; then the nodes that can't reach the sink any more.
Cut naive_cut(const Graph& graph) {
    const Index n = graph.nodes, source = n, sink = n + 1;
    std::vector<std::vector<std::int64_t>> residual(n + 2, std::vector<std::int64_t>(n + 2, 0));
    for (Index e = 0; e < graph.edges(); e++) {
        residual[graph.ends[2 * e]][graph.ends[2 * e + 1]] += graph.there[e];
        residual[graph.ends[2 * e + 1]][graph.ends[2 * e]] += graph.back[e];
    }
    for (Index i = 0; i < n; i++) {
        residual[source][i] = graph.from_source[i];
        residual[i][sink] = graph.to_sink[i];
    }
    Cut cut;
    while (true) {
        std::vector<Index> parent(n + 2, kNone), queue = {source};
        parent[source] = source;
        for (std::size_t i = 0; i < queue.size(); i++)
            for (Index j = 0; j < n + 2; j++)
                if (parent[j] == kNone && residual[queue[i]][j] > 0) {
                    parent[j] = queue[i];
                    queue.push_back(j);
                }
        if (parent[sink] == kNone) break;
        std::int64_t amount = std::numeric_limits<std::int64_t>::max();
        for (Index j = sink; j != source; j = parent[j]) amount = std::min(amount, residual[parent[j]][j]);
        for (Index j = sink; j != source; j = parent[j]) {
            residual[parent[j]][j] -= amount;
            residual[j][parent[j]] += amount;
        }
        cut.flow += amount;
    }
    std::vector<char> reaches_sink(n + 2, 0);
    std::vector<Index> queue = {sink};
    reaches_sink[sink] = 1;
    for (std::size_t i = 0; i < queue.size(); i++)
        for (Index j = 0; j < n + 2; j++)
            if (!reaches_sink[j] && residual[j][queue[i]] > 0) {
                reaches_sink[j] = 1;
                queue.push_back(j);
            }
    for (Index i = 0; i < n; i++) cut.on_source_side.push_back(!reaches_sink[i]);
    return cut;
}

// Sets up the graph in a network, whatever was there, and solves.
Cut solved(MaxFlow& network, const Graph& graph) {
    network.reset(graph.nodes);
    for (Index e = 0; e < graph.edges(); e++)
        network.connect(graph.ends[2 * e], graph.ends[2 * e + 1], graph.there[e], graph.back[e]);
    for (Index i = 0; i < graph.nodes; i++) network.add_terminals(i, graph.from_source[i], graph.to_sink[i]);
    Cut cut;
    cut.flow = network.solve();
    for (Index i = 0; i < graph.nodes; i++) cut.on_source_side.push_back(network.on_source_side(i));
    return cut;
}

Cut solved(const Graph& graph) {
    MaxFlow network;
    return solved(network, graph);
}

// The capacity of the arcs from one side to the other: of a minimum cut it is the flow.
std::int64_t cut_capacity(const Graph& graph, const std::vector<char>& on_source_side) {
    std::int64_t sum = 0;
    for (Index i = 0; i < graph.nodes; i++) sum += on_source_side[i] ? graph.to_sink[i] : graph.from_source[i];
    for (Index e = 0; e < graph.edges(); e++) {
        const bool a = on_source_side[graph.ends[2 * e]], b = on_source_side[graph.ends[2 * e + 1]];
        if (a && !b) sum += graph.there[e];
        if (b && !a) sum += graph.back[e];
    }
    return sum;
}

// Capacities 0..largest; terminals on about `terminals` of 10 nodes, often on both sides of one.
void set_capacities(Graph& graph, Lcg& random, Index largest, Index terminals) {
    const auto draw = [&](std::vector<Index>& capacities, Index count) {
        capacities.clear();
        for (Index i = 0; i < count; i++) capacities.push_back(random.below(largest + 1));
    };
    draw(graph.there, graph.edges());
    draw(graph.back, graph.edges());
    draw(graph.from_source, graph.nodes);
    draw(graph.to_sink, graph.nodes);
    for (Index& c : graph.from_source) c = random.below(10) < terminals ? c : 0;
    for (Index& c : graph.to_sink) c = random.below(10) < terminals ? c : 0;
}

Graph random_graph(Lcg& random, Index nodes, Index edges, Index largest) {
    Graph graph;
    graph.nodes = nodes;
    std::vector<Index> degree(nodes, 0);
    for (Index e = 0; e < edges && nodes > 1; e++) {   // some find no free place
        const Index a = random.below(nodes), b = (a + 1 + random.below(nodes - 1)) % nodes;
        if (degree[a] == 3 || degree[b] == 3) continue;
        degree[a]++;
        degree[b]++;
        graph.ends.insert(graph.ends.end(), {a, b});   // the same two may come again, in either order
    }
    set_capacities(graph, random, largest, 1 + random.below(10));
    return graph;
}

// One node per facet, one edge per mesh edge: degree 3, as the networks of labelings.
Graph facet_graph(const MeshData& data) {
    const TriMesh mesh = build_mesh(data);
    Graph graph;
    graph.nodes = mesh.facets();
    for (Index h = 0; h < mesh.halfedges(); h++)
        if (h == mesh.edge(h)) graph.ends.insert(graph.ends.end(), {mesh.left(h), mesh.right(h)});
    return graph;
}

}   // namespace

TEST_CASE("maxflow: two parallel paths, drawn") {
    //               3
    //        5   0 ---> 1   9
    //       .--->|      |--->.         through 0-1: 3, through 2-3: 4, over 0-3: min(5 - 3, 1) = 1; in total 8.
    //  source    | 1    |    sink      What arcs are full: 0->1, 0->3, source->2. So 0 is cut off from the sink, and 2
    //       '--->2 ---> 3--->'         can still reach it: 2->3 has 2 left, 3->sink 4 left.
    //        4      6        9
    Graph graph;
    graph.nodes = 4;
    graph.ends = {0, 1, 2, 3, 0, 3};
    graph.there = {3, 6, 1};
    graph.back = {0, 0, 0};
    graph.from_source = {5, 0, 4, 0};
    graph.to_sink = {0, 9, 0, 9};
    const Cut cut = solved(graph);
    CHECK(cut.flow == 8);
    CHECK(cut.on_source_side == std::vector<char>{1, 0, 0, 0});
}

TEST_CASE("maxflow: of several minimum cuts the one with the largest source side is told") {
    // source -2-> 0 -2-> 1 -2-> sink: three cuts of 2, the last one is after node 1.
    Graph chain;
    chain.nodes = 2;
    chain.ends = {0, 1};
    chain.there = {2};
    chain.back = {0};
    chain.from_source = {2, 0};
    chain.to_sink = {0, 2};
    CHECK(solved(chain) == Cut{2, {1, 1}});
    chain.to_sink[1] = 3;   // two are left, the last one is before node 1
    CHECK(solved(chain) == Cut{2, {1, 0}});
    chain.there[0] = 3;   // and now before node 0
    CHECK(solved(chain) == Cut{2, {0, 0}});
    // Nodes without any capacity, or as much to the sink as from the source, fit both sides.
    Graph idle;
    idle.nodes = 3;
    idle.from_source = {0, 7, 7};
    idle.to_sink = {0, 7, 8};
    CHECK(solved(idle) == Cut{14, {1, 1, 0}});
}

TEST_CASE("maxflow: capacities add up") {
    MaxFlow network(2);
    CHECK(network.nodes() == 2);
    network.connect(0, 1, 1, 5);
    network.connect(1, 0, 0, 3);   // 4 there, 5 back
    network.add_terminals(0, 6, 0);
    network.add_terminals(0, 3, 2);   // 9 from the source, 2 to the sink
    network.add_terminals(1, 0, 3);
    network.add_terminals(1, 1, 0);
    network.add_terminals(1, 0, 4);        // 1 from the source, 7 to the sink
    CHECK(network.solve() == 2 + 4 + 1);   // straight through 0, over the edge, straight through 1
    CHECK(network.on_source_side(0));
    CHECK_FALSE(network.on_source_side(1));
}

TEST_CASE("maxflow: nothing to do") {
    MaxFlow empty;
    CHECK(empty.nodes() == 0);
    CHECK(empty.solve() == 0);
    MaxFlow idle(3);
    idle.connect(0, 1, 0, 0);
    idle.connect(1, 2, 0, 0);
    CHECK(idle.solve() == 0);
    for (Index i = 0; i < 3; i++) CHECK(idle.on_source_side(i));
}

TEST_CASE("maxflow: the flow may exceed 32 bits") {
    // Ten nodes in a ring, each with 10^9 from the source and to the sink.
    Graph graph;
    graph.nodes = 10;
    for (Index i = 0; i < 10; i++) graph.ends.insert(graph.ends.end(), {i, (i + 1) % 10});
    graph.there.assign(10, 1);
    graph.back.assign(10, 1);
    graph.from_source.assign(10, 1000000000);
    graph.to_sink.assign(10, 1000000000);
    CHECK(solved(graph).flow == 10000000000);
    // Sources and sinks in turn: only the edges carry, 2 per source.
    for (Index i = 0; i < 10; i++) (i % 2 == 0 ? graph.to_sink : graph.from_source)[i] = 0;
    CHECK(solved(graph).flow == 10);
}

TEST_CASE("maxflow: flow and cut are those of a naive algorithm on random graphs") {
    Lcg random(5);
    int failures = 0;
    for (int round = 0; round < 6000 && failures < 3; round++) {
        const Index nodes = 1 + random.below(round % 4 == 0 ? 25 : 9);
        const Index edges = random.below(1 + 3 * nodes);   // from none to three per node
        const Graph graph = random_graph(random, nodes, edges, round % 2 == 0 ? 3 : 100);
        const Cut cut = solved(graph), expected = naive_cut(graph);
        const bool same = cut == expected && cut_capacity(graph, cut.on_source_side) == cut.flow;
        failures += !same;
        CAPTURE(round);
        CHECK(cut.flow == expected.flow);
        CHECK(cut.on_source_side == expected.on_source_side);
        CHECK(same);
    }
}

TEST_CASE("maxflow: a network that was used before gives the same as a new one") {
    Lcg random(6);
    MaxFlow network;
    for (int round = 0; round < 500; round++) {
        const Graph graph = random_graph(random, 2 + random.below(20), random.below(60), round % 5 == 2 ? 100 : 3);
        CHECK(solved(network, graph) == naive_cut(graph));
    }
    network.reset(7);
    CHECK(network.solve() == 0);   // nothing is left of what was there
    for (Index i = 0; i < 7; i++) CHECK(network.on_source_side(i));
}

TEST_CASE("maxflow: flow and cut are those of a naive algorithm on surfaces") {
    Lcg random(7);
    for (const MeshData& data : {shapes::cube(3), shapes::refined(shapes::frame()), shapes::pyramid(40)}) {
        Graph graph = facet_graph(data);
        for (int round = 0; round < 8; round++) {
            // Few terminals: long paths, large trees, many orphans.
            set_capacities(graph, random, round % 2 == 0 ? 3 : 100, 1 + round / 2);
            CHECK(solved(graph) == naive_cut(graph));
        }
    }
}

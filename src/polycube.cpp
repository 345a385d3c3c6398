#include "polylab/polycube.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polylab {

namespace {

constexpr double kLeastWeight = 1e-6;   // of a facet, in squared mean edges: one without area still holds its vertices
constexpr double kTolerance = 1e-20;    // of the squared residual, relative to the energy of a surface shrunk to a point
constexpr int kMostIterations = 10000;
constexpr double kCollapsed = 1e-6;

// Disjoint sets of vertices; the smallest vertex stands for its set.
class Groups {
public:
    explicit Groups(Index vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0); }

    Index find(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join_facet(const TriMesh& mesh, Index f) {
        for (Index h = 3 * f; h < 3 * f + 2; h++) {
            const Index a = find(mesh.from(h)), b = find(mesh.to(h));
            parent_[std::max(a, b)] = std::min(a, b);
        }
    }
    // For each vertex the number that stands for its group.
    std::vector<Index> numbers() {
        for (Index v = 0; v < static_cast<Index>(parent_.size()); v++) parent_[v] = find(v);
        return parent_;
    }

private:
    std::vector<Index> parent_;
};

// For each vertex the mean of its group.
void average(const std::vector<Index>& group, std::vector<double>& x) {
    std::vector<double> sum(x.size(), 0);
    std::vector<Index> count(x.size(), 0);
    for (std::size_t v = 0; v < x.size(); v++) {
        sum[group[v]] += x[v];
        count[group[v]]++;
    }
    for (std::size_t v = 0; v < x.size(); v++) x[v] = sum[group[v]] / count[group[v]];
}

// An edge that wants x[b] - x[a] = length.
struct Spring {
    Index a, b;
    double weight, length;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;   // port: in this order; a parallel or blocked sum gives other last bits
    for (std::size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
    return sum;
}

// Minimises the sum of weight * (x[b] - x[a] - length)^2 from the given x: conjugate gradients with the diagonal as
// preconditioner, until the squared residual (in the preconditioner's norm) is at most `enough`. The matrix has the constants
// in its kernel; the right-hand side is orthogonal to them, so this does no harm.
void relax(const std::vector<Spring>& springs, double enough, std::vector<double>& x) {
    std::vector<double> diagonal(x.size(), 0), residual(x.size(), 0);
    for (const Spring& s : springs) {
        const double force = s.weight * (s.length - (x[s.b] - x[s.a]));
        residual[s.b] += force;
        residual[s.a] -= force;
        diagonal[s.b] += s.weight;
        diagonal[s.a] += s.weight;
    }
    std::vector<double> z(x.size(), 0), step(x.size(), 0), image(x.size());
    double before = 0;
    for (int i = 0; i < kMostIterations; i++) {
        for (std::size_t v = 0; v < x.size(); v++)
            if (diagonal[v] > 0) z[v] = residual[v] / diagonal[v];
        const double now = dot(residual, z);
        if (!(now > enough)) return;
        const double keep = i == 0 ? 0 : now / before;
        for (std::size_t v = 0; v < x.size(); v++) step[v] = z[v] + keep * step[v];
        std::fill(image.begin(), image.end(), 0.0);
        for (const Spring& s : springs) {
            const double force = s.weight * (step[s.b] - step[s.a]);
            image[s.b] += force;
            image[s.a] -= force;
        }
        const double curvature = dot(step, image);
        if (!(curvature > 0)) return;   // only rounding is left
        for (std::size_t v = 0; v < x.size(); v++) {
            x[v] += now / curvature * step[v];
            residual[v] -= now / curvature * image[v];
        }
        before = now;
    }
}

// Coordinate `a` of all vertices in the polycube.
std::vector<double> coordinate(const TriMesh& mesh, const Labeling& labels, const std::vector<double>& weight, double enough,
                               int a) {
    Groups charts(mesh.vertices());
    for (Index f = 0; f < mesh.facets(); f++)
        if (axis(labels[f]) == a) charts.join_facet(mesh, f);
    const std::vector<Index> group = charts.numbers();
    std::vector<Spring> springs;
    springs.reserve(mesh.halfedges() / 2);
    for (Index h = 0; h < mesh.halfedges(); h++) {
        const Index from = group[mesh.from(h)], to = group[mesh.to(h)], l = mesh.left(h), r = mesh.right(h);
        if (h > mesh.opposite[h] || from == to) continue;
        const double w = (axis(labels[l]) != a ? weight[l] : 0) + (axis(labels[r]) != a ? weight[r] : 0);
        springs.push_back({from, to, w, mesh.vector(h)[a]});
    }
    std::vector<double> x(mesh.points.size());
    for (std::size_t v = 0; v < x.size(); v++) x[v] = mesh.points[v][a];
    average(group, x);
    relax(springs, enough, x);
    for (std::size_t v = 0; v < x.size(); v++) x[v] = x[group[v]];
    return x;
}

}   // namespace

std::vector<Vec3> surface_polycube(const TriMesh& mesh, const Labeling& labels) {
    if (!(mesh.mean_edge > 0)) return mesh.points;
    std::vector<double> weight(mesh.facets());
    double energy = 0;
    Groups pieces(mesh.vertices());
    for (Index f = 0; f < mesh.facets(); f++) {
        weight[f] = std::max(norm(mesh.area_vector(f)) / mesh.mean_edge / mesh.mean_edge, kLeastWeight);
        for (Index h = 3 * f; h < 3 * f + 3; h++) energy += weight[f] * dot(mesh.vector(h), mesh.vector(h));
        pieces.join_facet(mesh, f);
    }
    const std::vector<Index> piece = pieces.numbers();
    std::vector<Vec3> points = mesh.points;
    for (int a = 0; a < 3; a++) {
        const std::vector<double> x = coordinate(mesh, labels, weight, kTolerance * energy, a);
        // The mean of each piece goes back to where it was.
        std::vector<double> shift(x.size());
        for (std::size_t v = 0; v < x.size(); v++) shift[v] = mesh.points[v][a] - x[v];
        average(piece, shift);
        for (std::size_t v = 0; v < x.size(); v++) points[v][a] = x[v] + shift[v];
    }
    return points;
}

Distortion distortion(const TriMesh& mesh, const std::vector<Vec3>& polycube) {
    const auto image = [&](Index h) { return polycube[mesh.to(h)] - polycube[mesh.from(h)]; };
    double surface = 0, mapped = 0;
    for (Index f = 0; f < mesh.facets(); f++) {
        if (mesh.normal[f] == Vec3{}) continue;
        surface += norm(mesh.area_vector(f));
        mapped += norm(cross(image(3 * f), image(3 * f + 1)));
    }
    Distortion d;
    const double scale = mapped > 0 ? surface / mapped : 0;   // of areas, and of squared lengths
    double stretch = 0, counted = 0;
    for (Index f = 0; f < mesh.facets(); f++) {
        if (mesh.normal[f] == Vec3{}) continue;
        const Vec3 p = mesh.vector(3 * f), q = mesh.vector(3 * f + 1), mp = image(3 * f), mq = image(3 * f + 1);
        const Vec3 normal = cross(mp, mq);
        const double area = norm(mesh.area_vector(f));
        // From the scalar products of the edges: s1^2 + s2^2 is the trace of the map's square, s1 s2 its change of area.
        const double trace =
            scale / area / area * (dot(mp, mp) * dot(q, q) - 2 * dot(mp, mq) * dot(p, q) + dot(mq, mq) * dot(p, p));
        const double product = scale * norm(normal) / area;
        const double sum = std::sqrt(std::max(0.0, trace + 2 * product)),
                     difference = std::sqrt(std::max(0.0, trace - 2 * product));
        const double s1 = (sum + difference) / 2, s2 = s1 > 0 ? product / s1 : 0;
        stretch += area * trace / 2;
        if (dot(normal, mesh.normal[f]) < 0) d.turned++;
        if (!(s2 >= kCollapsed)) {
            d.collapsed++;
            continue;
        }
        counted += area;
        d.area += area * (product + 1 / product) / 2;
        d.angle += area * (s1 / s2 + s2 / s1) / 2;
        d.isometric += area * std::max(s1, 1 / s2);
    }
    if (stretch > 0) d.stretch = surface / stretch * (surface / stretch);   // differs: exponent 2 as published; usually it is 1
    for (double* mean : {&d.area, &d.angle, &d.isometric})
        if (counted > 0) *mean /= counted;
    return d;
}

}   // namespace polylab

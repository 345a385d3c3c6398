#include "polylab/align.h"

#include "polylab/costs.h"

#include <algorithm>
#include <array>
#include <map>

namespace polylab {

namespace {

constexpr int kCells = 32;                                 // per unit, of the grid in which normals are grouped
constexpr std::size_t kDirections = 32;                    // the heaviest directions, from which frames are made
constexpr double kSame = 0.99939;                          // cos 2 degrees: normals of one direction
constexpr double kSkew = 0.5;                              // cosine beyond which two directions span no frame
constexpr std::int64_t kLeastGain = (1 << 30) / 1000000;   // in steps

// Sum of the area vectors of facets with similar normals, those in one half of the sphere turned around.
using DirectionSums = std::vector<Vec3>;

DirectionSums grouped(const TriMesh& mesh) {
    std::map<std::array<std::int64_t, 3>, Vec3> cells;
    for (Index f = 0; f < mesh.facets(); f++) {
        Vec3 n = mesh.normal[f], area = mesh.area_vector(f);
        std::array<std::int64_t, 3> cell;
        for (int a = 0; a < 3; a++) cell[a] = static_cast<std::int64_t>(std::floor(n[a] * kCells + 0.5));
        std::array<std::int64_t, 3> turned = {-cell[0], -cell[1], -cell[2]};
        const bool turn = cell < turned;
        cells[turn ? turned : cell] += turn ? -area : area;
    }
    DirectionSums groups;
    for (const auto& [cell, sum] : cells) groups.push_back(sum);
    return groups;
}

// The mean of all groups within 2 degrees, wherever the grid has cut.
Vec3 direction_at(const DirectionSums& groups, const Vec3& start) {
    Vec3 sum;
    for (const Vec3& g : groups) {
        const double c = dot(unit(g), start);
        if (std::abs(c) > kSame) sum += c < 0 ? -g : g;
    }
    return sum;
}

std::vector<Vec3> heaviest_directions(const DirectionSums& groups) {
    std::vector<Vec3> directions;
    DirectionSums left = groups;
    while (directions.size() < kDirections) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < left.size(); i++)
            if (dot(left[i], left[i]) > dot(left[best], left[best]) * (1 + 1e-9)) best = i;   // tie: first cell
        if (left.empty() || dot(left[best], left[best]) == 0) break;
        const Vec3 d = unit(direction_at(groups, unit(left[best])));
        directions.push_back(d);
        left[best] = {};
        for (Vec3& g : left)
            if (std::abs(dot(unit(g), d)) > kSame) g = {};
    }
    return directions;
}

std::int64_t quality(const DirectionSums& groups, const Rotation& frame) {
    double sum = 0, area = 0;
    for (const Vec3& g : groups) {
        const Vec3 n = frame(unit(g));
        const double c = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), c2 = c * c, c4 = c2 * c2;
        area += norm(g);
        sum += norm(g) * c4 * c4;
    }
    return area > 0 ? steps(sum / area) : 0;
}

// The 24 ways to call the three axes X, Y and Z; the one with the largest trace.   tie: the first
Rotation closest_to_none(const Rotation& frame) {
    constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    Rotation best;
    std::int64_t best_trace = steps(-4);
    for (int order = 0; order < 6; order++) {
        for (int signs = 0; signs < 4; signs++) {
            Rotation r;
            for (int a = 0; a < 2; a++) {
                const Vec3& axis = frame.row[kOrders[order][a]];
                r.row[a] = signs >> a & 1 ? -axis : axis;
            }
            r.row[2] = cross(r.row[0], r.row[1]);
            const std::int64_t trace = steps(r.row[0].x + r.row[1].y + r.row[2].z);
            if (trace <= best_trace) continue;
            best_trace = trace;
            best = r;
        }
    }
    return best;
}

}   // namespace

Rotation own_frame(const TriMesh& mesh) {
    const DirectionSums groups = grouped(mesh);
    const std::vector<Vec3> directions = heaviest_directions(groups);
    Rotation best;
    std::int64_t best_quality = quality(groups, best) + kLeastGain;
    for (std::size_t i = 0; i < directions.size(); i++) {
        for (std::size_t j = i + 1; j < directions.size(); j++) {
            const Vec3 &u = directions[i], &v = directions[j];
            if (std::abs(dot(u, v)) > kSkew) continue;
            Rotation frame;
            frame.row[0] = u;
            frame.row[1] = unit(v - u * dot(u, v));
            frame.row[2] = cross(frame.row[0], frame.row[1]);
            const std::int64_t q = quality(groups, frame);
            if (q <= best_quality) continue;   // tie: the heavier directions
            best_quality = q;
            best = closest_to_none(frame);
        }
    }
    return best;
}

void rotate(TriMesh& mesh, const Rotation& rotation) {
    for (Vec3& p : mesh.points) p = rotation(p);
    for (Index f = 0; f < mesh.facets(); f++) mesh.normal[f] = unit(mesh.area_vector(f));
}

}   // namespace polylab

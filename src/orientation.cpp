#include "polylab/orientation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polylab {

namespace {

struct Box {
    Vec3 low, high;

    void add(const Vec3& p) {
        for (int a = 0; a < 3; a++) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    bool inside(const Box& b) const {
        for (int a = 0; a < 3; a++)
            if (low[a] < b.low[a] || high[a] > b.high[a]) return false;
        return true;
    }
};

struct Components {
    std::vector<Index> facets;   // all facets, component by component
    std::vector<Index> first;    // component -> its first entry of `facets`; one more at the end
    std::vector<char> turned;    // facet -> 1 where it disagrees with the first facet of its component
    std::vector<double>
        volume;   // component -> six times the volume that it encloses, positive if turned like this it faces outward

    Index count() const { return static_cast<Index>(first.size()) - 1; }
};

Index next_in_facet(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }

// Breadth-first from the smallest facet of each component; neighbours must run through their edge in opposite directions.
// Volumes are taken about the component's first vertex, so that a part far from the origin loses no digits.
Components find_components(const std::vector<Vec3>& points, const std::vector<Index>& origin,
                           const std::vector<Index>& opposite) {
    constexpr char kUnseen = 2;
    const Index n = static_cast<Index>(origin.size() / 3);
    Components c;
    c.turned.assign(n, kUnseen);
    c.facets.reserve(n);
    for (Index seed = 0; seed < n; seed++) {
        if (c.turned[seed] != kUnseen) continue;
        c.first.push_back(static_cast<Index>(c.facets.size()));
        c.turned[seed] = 0;
        c.facets.push_back(seed);
        const Vec3 about = points[origin[3 * seed]];
        double volume = 0;
        for (std::size_t i = c.facets.size() - 1; i < c.facets.size(); i++) {
            const Index f = c.facets[i];
            const char own = c.turned[f];
            for (Index h = 3 * f; h < 3 * f + 3; h++) {
                const Index g = opposite[h] / 3;
                const bool agrees = origin[h] == origin[next_in_facet(opposite[h])];
                const char turned = static_cast<char>(agrees ? own : !own);
                if (c.turned[g] == kUnseen) {
                    c.turned[g] = turned;
                    c.facets.push_back(g);
                } else if (c.turned[g] != turned) {
                    throw InputError("facets " + std::to_string(std::min(f, g)) + " and " + std::to_string(std::max(f, g)) +
                                     ": expected a surface with two sides, found one that can't be oriented (a Möbius strip)");
                }
            }
            const Vec3 p = points[origin[3 * f]] - about, q = points[origin[3 * f + 1]] - about,
                       r = points[origin[3 * f + 2]] - about;
            const double v = dot(p, cross(q, r));
            volume += own ? -v : v;
        }
        c.volume.push_back(volume);
    }
    c.first.push_back(n);
    return c;
}

// The line along x through (y, z) = (p.y + 0, p.z): an edge is crossed where its ends lie at different sides of p.y, vertices
// on p.y being below. Each edge is evaluated from its smaller vertex, so that its two facets agree.
// tie: p on the edge is above
bool edge_above(const std::vector<Vec3>& points, Index a, Index b, const Vec3& p) {
    if (a > b) std::swap(a, b);
    const Vec3 &q = points[a], &r = points[b];
    return q.z + (r.z - q.z) * ((p.y - q.y) / (r.y - q.y)) > p.z;
}

bool meets_line(const std::vector<Vec3>& points, const Index* facet, const Vec3& p) {
    bool meets = false;
    for (int k = 0; k < 3; k++) {
        const Index a = facet[k], b = facet[(k + 1) % 3];
        if ((points[a].y > p.y) != (points[b].y > p.y) && edge_above(points, a, b, p)) meets = !meets;
    }
    return meets;
}

Vec3 area_vector(const std::vector<Vec3>& points, const Index* facet) {
    return cross(points[facet[1]] - points[facet[0]], points[facet[2]] - points[facet[0]]);
}

// A point well inside the component: the middle of the longest piece that it cuts out of the line along x through the
// centre of the facet that shows most of itself along x. Its surface may touch other components, this point does not.
Vec3 inner_point(const std::vector<Vec3>& points, const std::vector<Index>& origin, const Components& c, Index component) {
    const Index begin = c.first[component], end = c.first[component + 1];
    Index widest = begin;
    double width = -1;
    for (Index i = begin; i < end; i++) {
        const double w = std::abs(area_vector(points, &origin[3 * c.facets[i]]).x);
        if (w > width) {   // tie: the first one
            widest = i;
            width = w;
        }
    }
    const Index* v = &origin[3 * c.facets[widest]];
    Vec3 p = (points[v[0]] + points[v[1]] + points[v[2]]) * (1.0 / 3);
    std::vector<double> crossings;
    for (Index i = begin; i < end; i++) {
        const Index* facet = &origin[3 * c.facets[i]];
        const Vec3 n = area_vector(points, facet), q = points[facet[0]];
        if (n.x != 0 && meets_line(points, facet, p)) crossings.push_back(q.x - (n.y * (p.y - q.y) + n.z * (p.z - q.z)) / n.x);
    }
    std::sort(crossings.begin(), crossings.end());
    double longest = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        if (crossings[i + 1] - crossings[i] > longest) {
            longest = crossings[i + 1] - crossings[i];
            p.x = (crossings[i] + crossings[i + 1]) / 2;
        }
    return p;
}

// Tells whether points lie inside one component: counts the facets that a ray along +x crosses. The facets are sorted
// into a grid over (y, z), so that a query looks at one cell.
class Locator {
public:
    Locator(const std::vector<Vec3>& points, const std::vector<Index>& origin, const Components& c, Index component,
            const Box& box)
        : points_(points), origin_(origin), box_(box) {
        const Index begin = c.first[component], end = c.first[component + 1];
        while (side_ < 1024 && static_cast<Index>(side_) * side_ < end - begin) side_ *= 2;
        std::vector<std::vector<Index>> cells(static_cast<std::size_t>(side_) * side_);
        for (Index i = begin; i < end; i++) {
            const Index f = c.facets[i];
            Box b{points[origin[3 * f]], points[origin[3 * f]]};
            b.add(points[origin[3 * f + 1]]);
            b.add(points[origin[3 * f + 2]]);
            for (int y = cell(b.low.y, 1); y <= cell(b.high.y, 1); y++)
                for (int z = cell(b.low.z, 2); z <= cell(b.high.z, 2); z++) cells[y * side_ + z].push_back(f);
        }
        cells_ = std::move(cells);
    }

    bool contains(const Vec3& p) const {
        bool inside = false;
        for (const Index f : cells_[cell(p.y, 1) * side_ + cell(p.z, 2)])
            if (crosses(f, p)) inside = !inside;
        return inside;
    }

private:
    int cell(double x, int axis) const {
        const double width = box_.high[axis] - box_.low[axis];
        const double t = width > 0 ? (x - box_.low[axis]) / width * side_ : 0;
        return std::clamp(static_cast<int>(t), 0, side_ - 1);
    }

    bool crosses(Index f, const Vec3& p) const {
        const Index* v = &origin_[3 * f];
        if (!meets_line(points_, v, p)) return false;
        const Vec3 n = area_vector(points_, v);
        // The facet's plane at (p.y, p.z) lies beyond p.x; n.x is not zero, or the projection would be empty.
        const double above = dot(n, p - points_[v[0]]);
        return n.x > 0 ? above < 0 : above > 0;
    }

    const std::vector<Vec3>& points_;
    const std::vector<Index>& origin_;
    Box box_;
    int side_ = 1;
    std::vector<std::vector<Index>> cells_;
};

// component -> how many others contain it. Boxes first (sorted along x), then volumes, then point location.
std::vector<int> nesting_depth(const std::vector<Vec3>& points, const std::vector<Index>& origin, const Components& c) {
    constexpr double kLess = 1 - 1e-9;   // rounding leaves equal volumes closer than this
    const Index n = c.count();
    std::vector<int> depth(n, 0);
    if (n == 1) return depth;
    std::vector<Box> box(n);
    for (Index i = 0; i < n; i++) {
        box[i].low = box[i].high = points[origin[3 * c.facets[c.first[i]]]];
        for (Index j = c.first[i]; j < c.first[i + 1]; j++)
            for (int k = 0; k < 3; k++) box[i].add(points[origin[3 * c.facets[j] + k]]);
    }
    std::vector<Index> by_x(n);
    std::iota(by_x.begin(), by_x.end(), 0);
    std::sort(by_x.begin(), by_x.end(), [&](Index a, Index b) {   // tie: by index
        return box[a].low.x < box[b].low.x || (box[a].low.x == box[b].low.x && a < b);
    });
    for (Index i = 0; i < n; i++) {
        const Index outer = by_x[i];
        std::vector<Index> candidates;
        // An equal low.x may come before `outer` in the order: step back over those.
        Index first = i;
        while (first > 0 && box[by_x[first - 1]].low.x == box[outer].low.x) first--;
        for (Index j = first; j < n && box[by_x[j]].low.x <= box[outer].high.x; j++)
            if (by_x[j] != outer && box[by_x[j]].inside(box[outer])) candidates.push_back(by_x[j]);
        if (candidates.empty()) continue;
        const Locator locator(points, origin, c, outer, box[outer]);
        // Two components on the same place do not contain each other: the inner one has less volume.
        for (const Index inner : candidates)
            if (std::abs(c.volume[inner]) <= kLess * std::abs(c.volume[outer]) &&
                locator.contains(inner_point(points, origin, c, inner)))
                depth[inner]++;
    }
    return depth;
}

}   // namespace

Orientation orient(const std::vector<Vec3>& points, const std::vector<Index>& origin, const std::vector<Index>& opposite) {
    Components c = find_components(points, origin, opposite);
    const std::vector<int> depth = nesting_depth(points, origin, c);
    Orientation result;
    result.components = c.count();
    for (Index i = 0; i < c.count(); i++) {
        const bool cavity = depth[i] % 2 == 1;
        result.cavities += cavity;
        if (cavity ? c.volume[i] > 0 : c.volume[i] < 0)
            for (Index j = c.first[i]; j < c.first[i + 1]; j++) c.turned[c.facets[j]] ^= 1;
        bool all = true;
        for (Index j = c.first[i]; j < c.first[i + 1] && all; j++) all = c.turned[c.facets[j]];
        result.turned_components += all;
    }
    result.turn = std::move(c.turned);
    return result;
}

}   // namespace polylab

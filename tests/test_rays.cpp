// Rays against the solid, as an oracle that shares nothing with the code it judges: which way components face and how they are
// nested, which edges are convex, whether labels point out of the solid. Over the golden cases, and over all surfaces below the
// folder that POLYLAB_CORPUS names. Needs Embree 3 (make test EMBREE=1).
//
// A point is inside where a ray from it crosses an odd number of facets; five rays have to agree. Embree computes in single
// precision: what is too small, too thin or too flat for it is skipped, and counted. Components that cross themselves or others
// have no inside, and are skipped as a whole.

#include "polylab/polylab.h"
#include "shapes.h"

#include <doctest/doctest.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

using namespace polylab;
namespace fs = std::filesystem;

namespace {

constexpr double kLeastOffset = 2e-5;   // from a surface, of a part of size 1: far above the noise of single precision
constexpr double kLeastSine = 1e-3;     // of an edge's angle, and of the angle between a label and its facet

// The hits of one ray: a filter notes each facet and lets the ray go on.
struct Probe {
    RTCIntersectContext context;   // first, so that the filter finds the rest
    std::vector<Index> facets;
};

void note_hit(const RTCFilterFunctionNArguments* arguments) {
    Probe* const probe = reinterpret_cast<Probe*>(arguments->context);
    probe->facets.push_back(static_cast<Index>(RTCHitN_primID(arguments->hit, arguments->N, 0)));
    arguments->valid[0] = 0;
}

class Solid {
public:
    explicit Solid(const TriMesh& mesh) : mesh_(mesh), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        Vec3 low = mesh.points[mesh.origin[0]], high = low;
        for (const Index v : mesh.origin)
            for (int a = 0; a < 3; a++) {
                low[a] = std::min(low[a], mesh.points[v][a]);
                high[a] = std::max(high[a], mesh.points[v][a]);
            }
        const Vec3 centre = (low + high) * 0.5;
        const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        for (const Vec3& p : mesh.points) points_.push_back((p - centre) * (1 / size));
        build_scene();
        find_components();
        find_crossings();
    }
    ~Solid() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;

    const TriMesh& mesh() const { return mesh_; }
    const Vec3& point(Index v) const { return points_[v]; }
    Vec3 centre(Index f) const {
        return (points_[mesh_.origin[3 * f]] + points_[mesh_.origin[3 * f + 1]] + points_[mesh_.origin[3 * f + 2]]) * (1.0 / 3);
    }
    double area(Index f) const {
        const Vec3& p = points_[mesh_.origin[3 * f]];
        return norm(cross(points_[mesh_.origin[3 * f + 1]] - p, points_[mesh_.origin[3 * f + 2]] - p)) / 2;
    }
    Index component(Index f) const { return component_[f]; }
    Index components() const { return static_cast<Index>(crossed_.size()); }
    bool crossed(Index f) const { return crossed_[component_[f]] != 0; }

    // The facets that the segment meets, once each.
    std::vector<Index> between(const Vec3& a, const Vec3& b) const { return hits(a, b - a, 1); }

    // Whether the point is inside the solid, or (with a component) inside this component; empty where rays disagree.
    std::optional<bool> inside(const Vec3& p, Index component = kNone) const {
        // Directions along which CAD parts have no edges.
        constexpr double kDirections[][3] = {
            {0.62, 0.35, 0.71}, {-0.47, 0.81, 0.33}, {0.29, -0.55, 0.78}, {-0.53, -0.44, -0.72}, {0.83, 0.21, -0.51}};
        std::optional<bool> result;
        for (const auto& d : kDirections) {
            bool odd = false;
            for (const Index f : hits(p, {d[0], d[1], d[2]}, 10)) odd ^= component == kNone || component_[f] == component;
            if (result && *result != odd) return {};
            result = odd;
        }
        return result;
    }

private:
    void build_scene() {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        float* const xyz = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points_.size()));
        for (std::size_t v = 0; v < points_.size(); v++)
            for (int a = 0; a < 3; a++) xyz[3 * v + a] = static_cast<float>(points_[v][a]);
        unsigned* const corners =
            static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                           3 * sizeof(unsigned), static_cast<std::size_t>(mesh_.facets())));
        for (Index h = 0; h < mesh_.halfedges(); h++) corners[h] = static_cast<unsigned>(mesh_.origin[h]);
        rtcSetGeometryIntersectFilterFunction(geometry, note_hit);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }

    std::vector<Index> hits(const Vec3& from, const Vec3& direction, double end) const {
        Probe probe;
        rtcInitIntersectContext(&probe.context);
        RTCRayHit ray = {};
        ray.ray.org_x = static_cast<float>(from.x);
        ray.ray.org_y = static_cast<float>(from.y);
        ray.ray.org_z = static_cast<float>(from.z);
        ray.ray.dir_x = static_cast<float>(direction.x);
        ray.ray.dir_y = static_cast<float>(direction.y);
        ray.ray.dir_z = static_cast<float>(direction.z);
        ray.ray.tfar = static_cast<float>(end);
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &probe.context, &ray);
        std::sort(probe.facets.begin(), probe.facets.end());   // Embree may show a facet twice
        probe.facets.erase(std::unique(probe.facets.begin(), probe.facets.end()), probe.facets.end());
        return probe.facets;
    }

    void find_components() {
        component_.assign(mesh_.facets(), kNone);
        for (Index seed = 0; seed < mesh_.facets(); seed++) {
            if (component_[seed] != kNone) continue;
            std::vector<Index> stack = {seed};
            component_[seed] = static_cast<Index>(crossed_.size());
            while (!stack.empty()) {
                const Index f = stack.back();
                stack.pop_back();
                for (Index h = 3 * f; h < 3 * f + 3; h++) {
                    const Index g = mesh_.right(h);
                    if (component_[g] != kNone) continue;
                    component_[g] = component_[f];
                    stack.push_back(g);
                }
            }
            crossed_.push_back(0);
        }
    }

    // Edges that pass through a facet somewhere in their middle.
    void find_crossings() {
        for (Index h = 0; h < mesh_.halfedges(); h++) {
            if (mesh_.edge(h) != h) continue;
            const Vec3 a = points_[mesh_.from(h)], b = points_[mesh_.to(h)], margin = (b - a) * 0.01;
            for (const Index f : between(a + margin, b - margin)) {
                bool apart = true;
                for (Index k = 3 * f; k < 3 * f + 3; k++)
                    apart = apart && !(points_[mesh_.from(k)] == a) && !(points_[mesh_.from(k)] == b);
                // Not where the edge only lies on the facet.
                const Vec3 p = points_[mesh_.origin[3 * f]], n = mesh_.normal[f];
                const double above = dot(a + margin - p, n), below = dot(b - margin - p, n);
                if (!apart || above * below >= 0 || std::min(std::abs(above), std::abs(below)) < kLeastOffset) continue;
                crossed_[component_[f]] = crossed_[component_[facet(h)]] = 1;
            }
        }
    }

    const TriMesh& mesh_;
    RTCDevice device_;
    RTCScene scene_;
    std::vector<Vec3> points_;
    std::vector<Index> component_;   // facet -> component
    std::vector<char> crossed_;      // component -> 1 where it crosses itself or another one
};

struct Count {
    long checked = 0, skipped = 0, wrong = 0;

    void add(std::optional<bool> right) {
        checked += right.has_value();
        skipped += !right;
        wrong += right && !*right;
    }
    void say(const char* what) const {
        std::printf("  rays: %s: %ld checked, %ld skipped, %ld wrong\n", what, checked, skipped, wrong);
    }
};

// Two points before and behind a facet's centre along `direction`, with nothing but the facet between them; false where there
// are none.
bool both_sides(const Solid& solid, Index f, const Vec3& direction, Vec3& before, Vec3& behind) {
    const double sine = std::abs(dot(solid.mesh().normal[f], direction));
    const double offset = std::min(0.05 * std::sqrt(solid.area(f)), 1e-3);
    if (sine < kLeastSine || offset * sine < kLeastOffset) return false;
    before = solid.centre(f) + direction * offset;
    behind = solid.centre(f) - direction * offset;
    return solid.between(before, behind) == std::vector<Index>{f};
}

// Whether the step from a facet's centre along `direction` leaves the solid; empty where rays can't tell.
std::optional<bool> leaves(const Solid& solid, Index f, const Vec3& direction) {
    Vec3 before, behind;
    if (solid.crossed(f) || !both_sides(solid, f, direction, before, behind)) return {};
    const std::optional<bool> out = solid.inside(before), in = solid.inside(behind);
    if (!out || !in || *out == *in) return {};
    return *in;
}

Count orientation_of(const Solid& solid) {
    Count count;
    for (Index f = 0; f < solid.mesh().facets(); f++) count.add(leaves(solid, f, solid.mesh().normal[f]));
    return count;
}

// Components that lie in an odd number of others, each judged from the first of its facets at which rays agree.
Count cavities_of(const Solid& solid) {
    Count count;
    if (solid.components() > 200) return count;   // the square of it would take long
    std::vector<std::optional<bool>> cavity(solid.components());
    for (Index f = 0; f < solid.mesh().facets(); f++) {
        std::optional<bool>& known = cavity[solid.component(f)];
        Vec3 before, behind;
        if (known || solid.crossed(f) || !both_sides(solid, f, solid.mesh().normal[f], before, behind)) continue;
        known = false;
        for (Index c = 0; c < solid.components() && known; c++) {
            const std::optional<bool> in = solid.inside(before, c);
            if (c == solid.component(f)) continue;
            known = in ? std::optional<bool>(*known != *in) : std::nullopt;
        }
    }
    Index cavities = 0;
    for (const std::optional<bool>& c : cavity) cavities += c.value_or(false);
    const bool all = std::all_of(cavity.begin(), cavity.end(), [](const auto& c) { return c.has_value(); });
    count.add(all ? std::optional<bool>(cavities == solid.mesh().cavities) : std::nullopt);
    return count;
}

// The middle between two points beside an edge, one on each of its facets, lies inside where the edge is convex.
std::optional<bool> convexity_is_right(const Solid& solid, Index h) {
    const TriMesh& mesh = solid.mesh();
    const Index o = mesh.opposite[h];
    if (solid.crossed(facet(h)) || mesh.normal[facet(h)] == Vec3{} || mesh.normal[facet(o)] == Vec3{}) return {};
    if (norm(cross(mesh.normal[facet(h)], mesh.normal[facet(o)])) < kLeastSine) return {};   // flat, or folded back
    const Vec3 middle = (solid.point(mesh.from(h)) + solid.point(mesh.to(h))) * 0.5, e = unit(mesh.vector(h));
    const auto beside = [&](Index side) {   // a tenth of the way to the far vertex, across the edge
        const Vec3 way = solid.point(mesh.from(prev(side))) - middle;
        return way - e * dot(way, e);
    };
    const Vec3 left = beside(h), right = beside(o);
    const double step = 0.1 * std::min(norm(left), norm(right));
    const Vec3 a = middle + unit(left) * step, b = middle + unit(right) * step, p = (a + b) * 0.5;
    // Far enough from both facets, and nothing else in the wedge.
    const auto height = [&](Index f) { return std::abs(dot(p - middle, mesh.normal[f])); };
    if (std::min(height(facet(h)), height(facet(o))) < kLeastOffset) return {};
    for (const Vec3& end : {a, b, middle})
        if (!solid.between(p, p + (end - p) * 0.99).empty()) return {};
    const std::optional<bool> in = solid.inside(p);
    if (!in) return {};
    return *in == is_convex(mesh, h);
}

Count convexity_of(const Solid& solid) {
    Count count;
    for (Index h = 0; h < solid.mesh().halfedges(); h++)
        if (solid.mesh().edge(h) == h) count.add(convexity_is_right(solid, h));
    return count;
}

// The direction of a label leaves the solid exactly where it is within 90 degrees of the normal.
Count labels_of(const Solid& solid, const Labeling& labels) {
    Count count;
    for (Index f = 0; f < solid.mesh().facets(); f++) {
        const std::optional<bool> out = leaves(solid, f, direction(labels[f]));
        count.add(out ? std::optional<bool>(*out == (along(solid.mesh().normal[f], labels[f]) > 0)) : std::nullopt);
    }
    return count;
}

struct Part {
    fs::path surface, labels;   // `labels` is empty where none come with it
};

std::vector<Part> parts() {
    std::vector<Part> result;
    for (const auto& entry : fs::directory_iterator(POLYLAB_SOURCE_DIR "/golden/cases"))
        for (const auto& file : fs::directory_iterator(entry.path()))
            if (file.path().extension() == ".obj" || file.path().extension() == ".mesh")
                result.push_back({file.path(), entry.path() / "09-labels.txt"});
    if (const char* corpus = std::getenv("POLYLAB_CORPUS"))
        for (const auto& file : fs::recursive_directory_iterator(corpus))
            if (file.path().extension() == ".obj" || file.path().extension() == ".stl") result.push_back({file.path(), {}});
    std::sort(result.begin(), result.end(), [](const Part& a, const Part& b) { return a.surface < b.surface; });
    return result;
}

// Adds up what `check` finds on all parts that can be built.
template <class Check>
Count over_all_parts(const char* what, const Check& check) {
    Count total;
    for (const Part& part : parts()) {
        CAPTURE(part.surface.string());
        TriMesh mesh;
        try {
            mesh = read_surface(part.surface.string());
        } catch (const InputError&) {
            continue;
        }
        const Count count = check(Solid(mesh), part);
        CHECK(count.wrong == 0);
        total.checked += count.checked;
        total.skipped += count.skipped;
        total.wrong += count.wrong;
    }
    total.say(what);
    return total;
}

}   // namespace

TEST_CASE("rays: they see a facet, a cavity, an edge and a label that are wrong") {
    const MeshData data = shapes::hollow_box();
    TriMesh mesh = build_mesh(data);
    Labeling labels = naive_labeling(mesh);
    {
        const Solid solid(mesh);
        for (const Count& count : {orientation_of(solid), cavities_of(solid), convexity_of(solid), labels_of(solid, labels)}) {
            CHECK(count.checked > 0);
            CHECK(count.wrong == 0);
        }
        CHECK(orientation_of(solid).checked == mesh.facets());
        labels[5] = opposite(labels[5]);
        CHECK(labels_of(solid, labels).wrong == 0);   // it points inward, and its normal says so too
    }
    for (Vec3& n : mesh.normal) n = -n;
    CHECK(orientation_of(Solid(mesh)).wrong == mesh.facets());
    mesh.cavities = 0;
    CHECK(cavities_of(Solid(mesh)).wrong == 1);
    // Inside out: what was convex is hollow.
    TriMesh turned = build_mesh(data);
    for (Index f = 0; f < turned.facets(); f++) {
        std::swap(turned.origin[3 * f + 1], turned.origin[3 * f + 2]);
        std::swap(turned.opposite[3 * f], turned.opposite[3 * f + 2]);
    }
    for (Index& o : turned.opposite) o = 3 * facet(o) + 2 - o % 3;
    const Count edges = convexity_of(Solid(turned));
    CHECK(edges.checked > 0);
    CHECK(edges.wrong == edges.checked);
    // Two boxes that cross have no inside.
    const TriMesh crossing = build_mesh(shapes::joined(shapes::cube(3), shapes::moved(shapes::cube(3), {1.5, 1.5, 1.5})));
    CHECK(orientation_of(Solid(crossing)).checked == 0);
}

TEST_CASE("rays: every facet faces outward") {
    CHECK(over_all_parts("facets outward", [](const Solid& s, const Part&) { return orientation_of(s); }).checked > 0);
}

TEST_CASE("rays: components are nested as they were found to be") {
    CHECK(over_all_parts("nesting of parts", [](const Solid& s, const Part&) { return cavities_of(s); }).checked > 0);
}

TEST_CASE("rays: edges are convex or not") {
    CHECK(over_all_parts("convex edges", [](const Solid& s, const Part&) { return convexity_of(s); }).checked > 0);
}

TEST_CASE("rays: labels leave the solid where they are within 90 degrees of the normal") {
    const auto check = [](const Solid& s, const Part& part) {
        return labels_of(
            s, part.labels.empty() ? graphcut_labeling(s.mesh()) : read_labels(part.labels.string(), s.mesh().facets()));
    };
    CHECK(over_all_parts("labels", check).checked > 0);
}

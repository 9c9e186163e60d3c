#include "segment/simplify/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/error.h"
#include "segment/cut/cut.h"
#include "segment/mesh/distance.h"
#include "segment/mesh/edges.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SimplifyOptions within(double mm) {
    SimplifyOptions options;
    options.tolerance = mm;
    return options;
}

SimplifyOptions at_most(std::size_t faces) {
    SimplifyOptions options;
    options.most_faces = faces;
    return options;
}

using Corners = std::array<Vec3, 3>;

// A second implementation, in another way than closest_on_triangle: the nearest of the interior and the three sides.
double distance(Vec3 p, const Corners& c) {
    const Vec3 n = cross(c[1] - c[0], c[2] - c[0]);
    bool is_above = dot(n, n) > 0;
    for (std::size_t k = 0; k < 3; ++k) is_above = is_above && dot(cross(c[(k + 1) % 3] - c[k], p - c[k]), n) >= 0;
    if (is_above) return std::abs(dot(p - c[0], n)) / norm(n);
    double best = INFINITY;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 along = c[(k + 1) % 3] - c[k];
        const double length = dot(along, along);
        const double at = length > 0 ? std::clamp(dot(p - c[k], along) / length, 0.0, 1.0) : 0;
        best = std::min(best, norm(p - c[k] - at * along));
    }
    return best;
}

// Every triangle for every point: slow, and independent of any tree.
double farthest_by_force(const TriangleMesh& from, const TriangleMesh& to, std::size_t step) {
    double farthest = 0;
    for (std::size_t t = 0; t < from.triangles.size(); t += step) {
        const Corners c = corners_of(from, t);
        for (const Vec3 p : {c[0], 0.5 * (c[0] + c[1]), 0.2 * c[0] + 0.3 * c[1] + 0.5 * c[2]}) {
            double nearest = INFINITY;
            for (std::size_t k = 0; k < to.triangles.size(); ++k)
                nearest = std::min(nearest, distance(p, corners_of(to, k)));
            farthest = std::max(farthest, nearest);
        }
    }
    return farthest;
}

// Caps as sets of corners of any orientation, by the cut that made them.
std::map<std::int32_t, std::multiset<std::vector<std::array<double, 3>>>> caps(const TriangleMesh& mesh) {
    std::map<std::int32_t, std::multiset<std::vector<std::array<double, 3>>>> all;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap) continue;
        std::vector<std::array<double, 3>> corners;
        for (const Vec3& p : corners_of(mesh, t)) corners.push_back({p.x, p.y, p.z});
        std::sort(corners.begin(), corners.end());
        all[cap_of(mesh, t)].insert(corners);
    }
    return all;
}

TriangleMesh some_bone() {
    SampleOptions options;
    options.faces = 8000;
    return sample(Specimen::vertebra, options);
}

void expect_sound(const TriangleMesh& mesh, const TriangleMesh& before, const std::string& name) {
    EXPECT_TRUE(edges(mesh).faults.is_closed()) << name;
    EXPECT_GT(volume_mm3(mesh), 0.5 * volume_mm3(before)) << name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(norm(area_vector(mesh, t)), 0) << name << t;
}

TEST(Simplify, EveryShapeStaysClosedAndWithinTheTolerance) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const double size = norm(bounds(shape.mesh).size());
        for (const double share : {0.001, 0.02}) {
            TriangleMesh mesh = shape.mesh;
            const SimplifyReport report = simplify(mesh, within(share * size));
            EXPECT_LE(report.deviation(), share * size) << shape.name;
            EXPECT_LE(farthest_by_force(shape.mesh, mesh, 3), share * size) << shape.name;
            EXPECT_LE(farthest_by_force(mesh, shape.mesh, 1), share * size) << shape.name;
            EXPECT_EQ(report.faces_after, mesh.triangles.size());
            expect_sound(mesh, shape.mesh, shape.name);
        }
    }
}

TEST(Simplify, FlatSidesOfABoxNeedFewFaces) {
    TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30}, 8);
    const double volume = volume_mm3(box);
    const SimplifyReport report = simplify(box, within(1e-6));
    EXPECT_LT(box.triangles.size(), 60U);
    EXPECT_LT(report.deviation(), 1e-6);
    EXPECT_NEAR(volume_mm3(box), volume, 1e-6);
}

TEST(Simplify, ABoneLosesMostOfItsFacesAndKeepsItsShape) {
    const TriangleMesh bone = some_bone();
    TriangleMesh fewer = bone;
    const SimplifyReport report = simplify(fewer, within(5));
    EXPECT_LT(report.faces_after, bone.triangles.size() * 3 / 4);
    EXPECT_LE(farthest_by_force(bone, fewer, 5), 5);
    EXPECT_LE(farthest_by_force(fewer, bone, 5), 5);
    EXPECT_NEAR(volume_mm3(fewer), volume_mm3(bone), 0.02 * volume_mm3(bone));
    expect_sound(fewer, bone, "bone");
}

TEST(Simplify, TheStatedDeviationIsThatOfABruteForce) {
    const TriangleMesh bone = some_bone();
    TriangleMesh fewer = bone;
    const SimplifyReport report = simplify(fewer, at_most(1500));
    EXPECT_LE(fewer.triangles.size(), 1500U);
    EXPECT_FALSE(report.has_too_many_faces);
    // samples of the one need not be samples of the other; corners are
    EXPECT_LE(farthest_by_force(bone, fewer, 4), 1.1 * report.from_piece);
    EXPECT_GE(farthest_by_force(bone, fewer, 1), 0.7 * report.from_piece);
    EXPECT_LE(farthest_by_force(fewer, bone, 1), 1.1 * report.from_result);
}

TEST(Simplify, PointsThatStayDoNotMove) {
    const TriangleMesh bone = some_bone();
    TriangleMesh fewer = bone;
    simplify(fewer, at_most(2000));
    std::set<std::array<double, 3>> points;
    for (const Vec3& p : bone.points) points.insert({p.x, p.y, p.z});
    for (const Vec3& p : fewer.points) EXPECT_TRUE(points.contains({p.x, p.y, p.z}));
}

TEST(Simplify, MatingCapsStayTheSameWhateverTheOptions) {
    const TriangleMesh bone = some_bone();
    const double middle = bounds(bone).centre().z + 0.123;
    const std::optional<CutHalves> halves = cut(bone, {{0, 0, 1}, middle}, 7);
    ASSERT_TRUE(halves);
    const auto matching = caps(halves->above.mesh);
    ASSERT_EQ(matching, caps(halves->below.mesh));
    ASSERT_GT(matching.at(7).size(), 10U);
    TriangleMesh above = halves->above.mesh;
    TriangleMesh below = halves->below.mesh;
    simplify(above, within(1));
    simplify(below, at_most(1500));
    EXPECT_LT(above.triangles.size(), halves->above.mesh.triangles.size());
    EXPECT_EQ(caps(above), matching);
    EXPECT_EQ(caps(below), matching);
    for (const Vec3& p : above.points) EXPECT_GE(p.z, middle - 1e-9);
    for (const Vec3& p : below.points) EXPECT_LE(p.z, middle + 1e-9);
    expect_sound(above, halves->above.mesh, "above");
    expect_sound(below, halves->below.mesh, "below");
}

TEST(Simplify, FewerFacesThanTheCapsHaveAreReported) {
    const std::optional<CutHalves> halves = cut(shapes::ball({0, 0, 0}, 50, 40), {{0, 0, 1}, 0.7}, 1);
    ASSERT_TRUE(halves);
    TriangleMesh half = halves->above.mesh;
    const SimplifyReport report = simplify(half, at_most(20));
    EXPECT_TRUE(report.has_too_many_faces);
    EXPECT_GT(report.cap_faces, 20U);
    EXPECT_EQ(report.faces_after, half.triangles.size());
    EXPECT_EQ(caps(half), caps(halves->above.mesh));
}

TEST(Simplify, TwiceToACountIsOnce) {
    TriangleMesh mesh = some_bone();
    simplify(mesh, at_most(3000));
    const TriangleMesh once = mesh;
    EXPECT_EQ(simplify(mesh, at_most(3000)).deviation(), 0);
    EXPECT_EQ(mesh, once);
}

TEST(Simplify, SameInputSameBytes) {
    TriangleMesh a = some_bone();
    TriangleMesh b = a;
    simplify(a, within(1));
    simplify(b, within(1));
    EXPECT_EQ(a, b);
}

TEST(Simplify, ACountThatIsMetAlreadyChangesNothing) {
    const TriangleMesh bone = some_bone();
    TriangleMesh same = bone;
    EXPECT_EQ(simplify(same, at_most(8000)).deviation(), 0);
    EXPECT_EQ(same, bone);
}

TEST(Simplify, OptionsThatMakeNoSenseAndOpenMeshesAreRefused) {
    TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1}, 3);
    EXPECT_THROW(simplify(box, {}), InputError);
    EXPECT_THROW(simplify(box, within(0)), InputError);
    EXPECT_THROW(simplify(box, within(NAN)), InputError);
    EXPECT_THROW(simplify(box, at_most(3)), InputError);
    box.triangles.pop_back();
    EXPECT_THROW(simplify(box, within(1)), InputError);
}

TEST(Simplify, CancelledItLeavesTheMeshUnchanged) {
    const TriangleMesh bone = some_bone();
    TriangleMesh mesh = bone;
    const std::atomic<bool> stop{true};
    Context context;
    context.cancelled = &stop;
    EXPECT_THROW(simplify(mesh, within(1), context), Cancelled);
    EXPECT_EQ(mesh, bone);
}

}  // namespace
}  // namespace qchopper

#include "segment/simplify/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/cut/cut.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/sample/sample.h"
#include "segment/simplify/collapse.h"
#include "segment/simplify/collapse_passes.h"
#include "segment/simplify/sampled_deviation.h"
#include "segment/simplify/sound_face.h"
#include "tests/reference/segment/mesh/non_manifold_vertices.h"
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
    options.max_faces = faces;
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

// Made once for all tests: it takes seconds.
const TriangleMesh& specimen(Specimen which, std::size_t faces) {
    static std::map<std::pair<Specimen, std::size_t>, TriangleMesh> made;
    const auto [it, is_new] = made.try_emplace({which, faces});
    SampleOptions options;
    options.faces = faces;
    if (is_new) it->second = sample(which, options);
    return it->second;
}

const TriangleMesh& some_bone() {
    return specimen(Specimen::vertebra, 8000);
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

// A ball with a wall of 0.3 mm whose inside has other points than its outside.
TriangleMesh thin_walled_ball() {
    const TriangleMesh inside = shapes::rotated(shapes::ball({0, 0, 0}, 19.7, 24), {1, 2, 3}, 0.7);
    return shapes::joined({shapes::ball({0, 0, 0}, 20, 24), shapes::turned_inside_out(inside)});
}

TEST(Simplify, WithinAToleranceThinWallsDoNotRunThroughEachOther) {
    TriangleMesh mesh = thin_walled_ball();
    ASSERT_TRUE(self_intersections(mesh).is_free());
    const SimplifyReport report = simplify(mesh, within(1));
    EXPECT_EQ(report.crossings, 0U);
    EXPECT_TRUE(self_intersections(mesh).is_free());
    EXPECT_LT(report.faces_after, report.faces_before);
}

TEST(Simplify, ToACountFacesThatRunThroughEachOtherAreReported) {
    TriangleMesh mesh = thin_walled_ball();
    const SimplifyReport report = simplify(mesh, at_most(200));
    EXPECT_GT(report.crossings, 0U);
    EXPECT_EQ(report.crossings, self_intersections(mesh).pairs.size());
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
    const TriangleMesh& bone = some_bone();
    TriangleMesh fewer = bone;
    const SimplifyReport report = simplify(fewer, within(5));
    EXPECT_LT(report.faces_after, bone.triangles.size() * 3 / 4);
    EXPECT_LE(farthest_by_force(bone, fewer, 5), 5);
    EXPECT_LE(farthest_by_force(fewer, bone, 5), 5);
    EXPECT_NEAR(volume_mm3(fewer), volume_mm3(bone), 0.02 * volume_mm3(bone));
    expect_sound(fewer, bone, "bone");
}

TEST(Simplify, TheStatedDeviationIsThatOfABruteForce) {
    const TriangleMesh& bone = some_bone();
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
    const TriangleMesh& bone = some_bone();
    TriangleMesh fewer = bone;
    simplify(fewer, at_most(2000));
    std::set<std::array<double, 3>> points;
    for (const Vec3& p : bone.points) points.insert({p.x, p.y, p.z});
    for (const Vec3& p : fewer.points) EXPECT_TRUE(points.contains({p.x, p.y, p.z}));
}

TEST(Simplify, MatingCapsStayTheSameWhateverTheOptions) {
    const TriangleMesh& bone = some_bone();
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

TEST(Simplify, QuicklyCapsStayAndTheQueueIsNotTaken) {
    const std::optional<CutHalves> halves = cut(shapes::ball({0, 0, 0}, 50, 40), {{0, 0, 1}, 0.7}, 1);
    ASSERT_TRUE(halves);
    const TriangleMesh& piece = halves->above.mesh;
    TriangleMesh slowly = piece;
    ASSERT_TRUE(simplify(slowly, at_most(20)).is_by_queue) << "else both ways would be the same";
    SimplifyOptions options = at_most(20);
    options.is_quick = true;
    TriangleMesh half = piece;
    const SimplifyReport report = simplify(half, options);
    EXPECT_FALSE(report.is_by_queue);
    EXPECT_TRUE(report.has_too_many_faces);
    EXPECT_LT(report.faces_after, report.faces_before / 2);
    EXPECT_EQ(caps(half), caps(piece));
    EXPECT_EQ(report.from_piece, farthest_sample(piece, half));
    EXPECT_EQ(report.from_result, farthest_sample(half, piece));
    expect_sound(half, piece, "quickly");
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
    const TriangleMesh& bone = some_bone();
    TriangleMesh same = bone;
    EXPECT_EQ(simplify(same, at_most(8000)).deviation(), 0);
    EXPECT_EQ(same, bone);
}

std::vector<shapes::Named> shapes_and_samples() {
    std::vector<shapes::Named> all = shapes::all_closed();
    all.push_back({"vertebra", some_bone()});
    all.push_back({"femur", specimen(Specimen::femur, 60000)});
    all.push_back({"skull", specimen(Specimen::skull, 60000)});
    return all;
}

double min_squared_roundness(const TriangleMesh& mesh) {
    double least = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        least = std::min(least, squared_roundness(shape_of(corners_of(mesh, t))));
    }
    return least;
}

void expect_manifold(const TriangleMesh& mesh, const std::string& name) {
    const Edges found = edges(mesh);
    EXPECT_EQ(found.faults, EdgeFaults{}) << name;
    EXPECT_EQ(count_non_manifold_vertices(mesh, found), 0U) << name;
    std::set<std::set<std::uint32_t>> triangles;
    for (const Triangle& t : mesh.triangles) triangles.insert({t[0], t[1], t[2]});
    EXPECT_EQ(triangles.size(), mesh.triangles.size()) << name;
}

TEST(Simplify, InPassesEveryShapeStaysManifoldAndKeepsItsPoints) {
    for (const shapes::Named& shape : shapes_and_samples()) {
        std::set<std::array<double, 3>> points;
        for (const Vec3& p : shape.mesh.points) points.insert({p.x, p.y, p.z});
        for (const std::size_t part : {2, 5, 20, 100000}) {
            const std::size_t most = std::max<std::size_t>(4, shape.mesh.triangles.size() / part);
            const TriangleMesh fewer = collapse_in_passes(shape.mesh, {}, most);
            const std::string name = shape.name + " to " + std::to_string(most);
            EXPECT_TRUE(is_consistent(fewer)) << name;
            EXPECT_LE(fewer.triangles.size(), shape.mesh.triangles.size()) << name;
            EXPECT_GE(fewer.triangles.size() + 1, most) << name;  // not fewer than asked for
            expect_manifold(fewer, name);
            for (const Vec3& p : fewer.points) EXPECT_TRUE(points.contains({p.x, p.y, p.z})) << name;
            EXPECT_GE(min_squared_roundness(fewer), std::min(9e-4, min_squared_roundness(shape.mesh))) << name;
        }
    }
}

TEST(Simplify, TheNumberOfFacesIsReachedInPasses) {
    for (const shapes::Named& shape : shapes_and_samples()) {
        if (shape.mesh.triangles.size() < 4000) continue;
        TriangleMesh mesh = shape.mesh;
        const SimplifyReport report = simplify(mesh, at_most(shape.mesh.triangles.size() / 10));
        EXPECT_LE(mesh.triangles.size(), shape.mesh.triangles.size() / 10) << shape.name;
        EXPECT_FALSE(report.is_by_queue || report.has_too_many_faces) << shape.name;
        expect_sound(mesh, shape.mesh, shape.name);
    }
}

TEST(Simplify, LockedPointsAndTheirFacesStay) {
    const TriangleMesh& bone = some_bone();
    std::vector<std::uint8_t> is_locked(bone.points.size(), 0);
    std::set<std::array<double, 3>> locked;
    for (std::size_t i = 0; i < bone.points.size(); ++i) {
        if (bone.points[i].x > 20 || i % 50 == 0) is_locked[i] = 1;
        if (is_locked[i] != 0) locked.insert({bone.points[i].x, bone.points[i].y, bone.points[i].z});
    }
    const TriangleMesh fewer = collapse_in_passes(bone, is_locked, 10);
    ASSERT_LT(fewer.triangles.size(), bone.triangles.size());
    for (const Vec3& p : fewer.points) locked.erase({p.x, p.y, p.z});
    EXPECT_TRUE(locked.empty());
}

TEST(Simplify, APieceThatThePassesDoNotBringToTheNumberIsNamed) {
    std::size_t named = 0;
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const SimplifyReport report = simplify(mesh, at_most(4));
        const std::size_t in_passes = collapse_in_passes(shape.mesh, {}, 4).triangles.size();
        EXPECT_EQ(report.is_by_queue, in_passes > 4) << shape.name;
        EXPECT_EQ(report.has_too_many_faces, mesh.triangles.size() > 4) << shape.name;
        expect_manifold(mesh, shape.name);
        named += report.is_by_queue ? 1 : 0;
    }
    EXPECT_GT(named, 0U);
}

TEST(Simplify, NoFaceTurnsOver60DegreesOrBecomesANeedle) {
    const auto turned = [](double degrees) -> std::array<Vec3, 3> {
        const double angle = degrees * 3.14159265358979323846 / 180;
        return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, std::cos(angle), std::sin(angle)}};
    };
    const auto flat = [](double height) -> std::array<Vec3, 3> {
        return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, height, 0}};
    };
    for (const double degrees : {0.0, 30.0, 59.9, -59.9}) EXPECT_TRUE(is_sound_change(turned(0), turned(degrees)));
    for (const double degrees : {60.1, 90.0, 120.0, 180.0, -60.1}) {
        EXPECT_FALSE(is_sound_change(turned(0), turned(degrees))) << degrees;
    }
    EXPECT_TRUE(is_sound_change(flat(1), flat(0.02)));    // roundness 0.046
    EXPECT_FALSE(is_sound_change(flat(1), flat(0.005)));  // 0.012
    EXPECT_FALSE(is_sound_change(flat(1), flat(0)));
    EXPECT_TRUE(is_sound_change(flat(0.004), flat(0.005)));  // a needle that becomes rounder
    EXPECT_TRUE(is_sound_change(flat(0), flat(0.005)));
    EXPECT_FALSE(is_sound_change(flat(0.005), flat(0.004)));
}

TEST(Simplify, InPassesItDeviatesHardlyMoreThanByTheQueue) {
    for (const Specimen which : {Specimen::skull, Specimen::femur, Specimen::vertebra}) {
        const TriangleMesh& bone = specimen(which, 60000);
        TriangleMesh in_passes = bone;
        const SimplifyReport report = simplify(in_passes, at_most(6000));
        EXPECT_FALSE(report.is_by_queue);
        TriangleMesh by_queue = bone;
        CollapseLimits limits;
        limits.max_faces = 6000;
        ASSERT_TRUE(collapse_edges(by_queue, {}, limits));
        EXPECT_EQ(in_passes.triangles.size(), by_queue.triangles.size());
        const double of_queue = std::max(farthest_sample(bone, by_queue), farthest_sample(by_queue, bone));
        EXPECT_LE(report.deviation(), 1.3 * of_queue) << static_cast<int>(which);
    }
}

TEST(Simplify, AnyNumberOfThreadsGivesTheSameBytes) {
    const TriangleMesh& bone = some_bone();
    TriangleMesh by_all = bone;
    const SimplifyReport all = simplify(by_all, at_most(1000));
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        TriangleMesh mesh = bone;
        const SimplifyReport report = simplify(mesh, at_most(1000));
        EXPECT_EQ(mesh, by_all);
        EXPECT_EQ(report.from_piece, all.from_piece);
        EXPECT_EQ(report.from_result, all.from_result);
    }
}

// The samples that sampled_deviation.h states, each compared with every triangle.
TEST(Simplify, TheDeviationIsThatOfAllSamples) {
    const auto longest = [](const Corners& c) {
        return std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    };
    const auto by_force = [&](const TriangleMesh& from, const TriangleMesh& to) {
        double spacing = 0;
        for (std::size_t t = 0; t < to.triangles.size(); ++t) spacing += longest(corners_of(to, t));
        spacing /= static_cast<double>(to.triangles.size());
        double farthest = 0;
        const auto add = [&](Vec3 p) {
            double nearest = INFINITY;
            for (std::size_t t = 0; t < to.triangles.size(); ++t) {
                nearest = std::min(nearest, norm(closest_on_triangle(p, corners_of(to, t)) - p));
            }
            farthest = std::max(farthest, nearest);
        };
        for (std::size_t t = 0; t < from.triangles.size(); ++t) {
            const Corners c = corners_of(from, t);
            const auto steps = [&](double length) {
                return std::clamp(static_cast<int>(std::ceil(length / spacing)), 1, 200);
            };
            add((1.0 / 3) * (c[0] + c[1] + c[2]));
            const Triangle& v = from.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) {
                add(c[k]);
                const bool is_ahead = v[k] < v[(k + 1) % 3];
                const Vec3 a = c[is_ahead ? k : (k + 1) % 3];
                const Vec3 b = c[is_ahead ? (k + 1) % 3 : k];
                const int n = steps(norm(b - a));
                for (int i = 1; i < n; ++i) add(a + (static_cast<double>(i) / n) * (b - a));
            }
            const int n = steps(longest(c));
            const Vec3 u = (1.0 / n) * (c[1] - c[0]);
            const Vec3 w = (1.0 / n) * (c[2] - c[0]);
            for (int i = 0; n > 1 && i < n; ++i) {
                for (int k = 0; i + k < n; ++k) {
                    const Vec3 at = c[0] + static_cast<double>(i) * u + static_cast<double>(k) * w;
                    add(at + (1.0 / 3) * (u + w));
                    if (i > 0 && k > 0) add(at);
                }
            }
        }
        return farthest;
    };
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (const std::size_t part : {3, 40}) {
            const std::size_t most = shape.mesh.triangles.size() / part;
            const TriangleMesh fewer = collapse_in_passes(shape.mesh, {}, most);
            EXPECT_EQ(farthest_sample(shape.mesh, fewer), by_force(shape.mesh, fewer)) << shape.name << part;
            EXPECT_EQ(farthest_sample(fewer, shape.mesh), by_force(fewer, shape.mesh)) << shape.name << part;
        }
    }
}

TEST(Simplify, CancelledInAPassItLeavesTheMeshUnchanged) {
    const TriangleMesh& bone = some_bone();
    TriangleMesh mesh = bone;
    std::atomic<bool> stop{false};
    std::size_t reports = 0;
    Context context;
    context.cancelled = &stop;
    context.on_progress = [&](const Progress& progress) {
        EXPECT_LE(progress.done, progress.total);
        stop = ++reports == 3;
    };
    EXPECT_THROW(simplify(mesh, at_most(500), context), Cancelled);
    EXPECT_EQ(reports, 3U);
    EXPECT_EQ(mesh, bone);
}

TEST(Simplify, OptionsThatMakeNoSenseAndOpenMeshesAreRefused) {
    TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1}, 3);
    EXPECT_THROW(simplify(box, {}), InputError);
    EXPECT_THROW(simplify(box, within(0)), InputError);
    EXPECT_THROW(simplify(box, within(NAN)), InputError);
    EXPECT_THROW(simplify(box, at_most(3)), InputError);
    TriangleMesh folded = box;
    folded.triangles.push_back({0, 1, 1});
    EXPECT_THROW(simplify(folded, at_most(10)), InputError);
    box.triangles.pop_back();
    EXPECT_THROW(simplify(box, within(1)), InputError);
}

TEST(Simplify, CancelledItLeavesTheMeshUnchanged) {
    const TriangleMesh& bone = some_bone();
    TriangleMesh mesh = bone;
    const std::atomic<bool> stop{true};
    Context context;
    context.cancelled = &stop;
    EXPECT_THROW(simplify(mesh, within(1), context), Cancelled);
    EXPECT_EQ(mesh, bone);
}

}  // namespace
}  // namespace qchopper

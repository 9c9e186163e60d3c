#include "segment/joint/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "segment/cut/cap.h"
#include "segment/joint/in_front.h"
#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/plane_frame.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A polygon in x and z, counter-clockwise, along y from 0 to `depth`.
TriangleMesh extruded(const std::vector<Point2>& outline, double depth) {
    const auto count = static_cast<std::uint32_t>(outline.size());
    TriangleMesh mesh;
    for (const double y : {0.0, depth}) {
        for (const Point2& p : outline) mesh.points.push_back({p.x, y, p.y});
    }
    Loop loop;
    for (std::uint32_t i = 0; i < count; ++i) loop.push_back(i);
    const std::vector<Loop> loops{loop};
    for (const auto& t : triangulate_regions(outline, loops, nest_polygons(outline, loops)).triangles) {
        mesh.triangles.push_back({t[0], t[1], t[2]});
        mesh.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t k = (i + 1) % count;
        mesh.triangles.push_back({k, i, i + count});
        mesh.triangles.push_back({k, i + count, k + count});
    }
    return mesh;
}

Vec3 random_on(const TriangleMesh& mesh, std::mt19937& random) {
    std::uniform_real_distribution<double> one(0.02, 0.98);
    for (int i = 0; i < 20; ++i) {
        const std::size_t t = random() % mesh.triangles.size();
        const Vec3 area = area_vector(mesh, t);
        if (norm(area) < 1e-6) continue;
        double a = one(random);
        double b = one(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const auto c = corners_of(mesh, t);
        return c[0] + a * (c[1] - c[0]) + b * (c[2] - c[0]) - 1e-3 * normalized(area);
    }
    return mesh.points[0];
}

bool is_in_hole(const PieceJoint& joint, Vec3 p) {
    return std::any_of(joint.dowels.begin(), joint.dowels.end(), [&](const Dowel& dowel) {
        const Vec3 d = p - dowel.point;
        const double along = dot(joint.plane.normal, d);
        return std::abs(along) <= dowel.size.depth + 1e-6 &&
               norm(d - along * joint.plane.normal) <= dowel.size.radius() + 1e-6;
    });
}

// How many of many points of what moves are at some moment inside of what stands, or the other way round, or points of
// a dowel in foam. Apart from how steps are found: by counting crossings of a line, point by point.
int collisions(const Segmentation& s, const std::vector<PieceJoint>& joints, const AssemblyStep& step,
               std::mt19937& random) {
    int found = 0;
    const auto ask = [&](std::size_t from, std::size_t into, Vec3 way) {
        for (int i = 0; i < 40; ++i) {
            const Vec3 p = random_on(*s.pieces[from].mesh, random);
            for (const double share : {0.01, 0.05, 0.2, 0.45, 0.7, 0.9}) {
                found += is_inside(*s.pieces[into].mesh, p + share * step.distance_mm * way) ? 1 : 0;
            }
        }
    };
    for (const std::size_t m : step.moved) {
        for (const std::size_t p : step.standing) {
            ask(m, p, -step.direction);
            ask(p, m, step.direction);
        }
        for (const std::size_t j : step.joints) {
            for (const Dowel& dowel : joints[j].dowels) {
                const PlaneFrame frame = frame_across(step.direction);
                for (int i = 0; i < 24; ++i) {
                    const Vec3 at = dowel.point - (0.99 * (i % 6) / 5 * dowel.size.depth) * step.direction +
                                    0.48 * dowel.size.diameter * (std::cos(i) * frame.u + std::sin(i) * frame.v);
                    for (const double share : {0.0, 0.02, 0.1, 0.5}) {
                        const Vec3 p = at + share * step.distance_mm * step.direction;
                        found += is_inside(*s.pieces[m].mesh, p) && !is_in_hole(joints[j], p) ? 1 : 0;
                    }
                }
            }
        }
    }
    return found;
}

// Every piece is joined once and for all, every step is clear, and the last one joins everything.
Assembly expect_sound(const Segmentation& s, const std::string& what) {
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
    const Assembly assembly = assembly_of(s, joints);
    std::mt19937 random(7);
    std::set<std::size_t> closed;
    for (const AssemblyStep& step : assembly.steps) {
        EXPECT_TRUE(step.is_clear) << what << ", cut " << step.cut;
        EXPECT_EQ(collisions(s, joints, step, random), 0) << what << ", cut " << step.cut;
        for (const std::size_t j : step.joints) EXPECT_TRUE(closed.insert(j).second) << what;
    }
    EXPECT_EQ(closed.size(), joints.size()) << what;
    if (!assembly.steps.empty()) {
        const AssemblyStep& last = assembly.steps.back();
        EXPECT_LE(last.moved.size() + last.standing.size(), s.pieces.size()) << what;
    }
    return assembly;
}

TEST(Assembly, StepsOfRandomCutsAreClear) {
    std::mt19937 random(4);
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Segmentation s = cut_randomly(shape.mesh, 7, random);
        expect_sound(s, shape.name);
    }
}

TEST(Assembly, InterlockedHooksMoveTogether) {
    const TriangleMesh hooks = extruded(
        {{-20, -30}, {120, -30}, {120, 0}, {100, 0}, {100, 130}, {20, 130}, {20, 110}, {90, 110}, {90, 30}, {20, 30},
         {20, 20},   {90, 20},   {90, 0},  {10, 0},  {10, 80},   {60, 80},  {60, 100}, {0, 100},  {0, 0},   {-20, 0}},
        40);
    ASSERT_TRUE(edges(hooks).faults.is_closed());
    Segmentation s = uncut(hooks, 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 10}));
    ASSERT_EQ(s.pieces.size(), 3u);
    const Assembly assembly = expect_sound(s, "hooks");
    ASSERT_EQ(assembly.steps.size(), 1u);
    EXPECT_EQ(assembly.steps[0].solids, 2u);
    EXPECT_EQ(assembly.steps[0].moved.size() + assembly.steps[0].standing.size(), 3u);
}

TEST(Assembly, TheNearerOfTwoNestedHooksGoesFirst) {
    // an arch over a lower arch, both on one base
    const TriangleMesh arches = extruded({{-20, -30},
                                          {120, -30},
                                          {120, 0},
                                          {110, 0},
                                          {110, 90},
                                          {-10, 90},
                                          {-10, 80},
                                          {100, 80},
                                          {100, 0},
                                          {60, 0},
                                          {60, 50},
                                          {20, 50},
                                          {20, 40},
                                          {50, 40},
                                          {50, 0},
                                          {-20, 0}},
                                         40);
    ASSERT_TRUE(edges(arches).faults.is_closed());
    Segmentation s = uncut(arches, 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 10}));
    ASSERT_EQ(s.pieces.size(), 3u);
    const Assembly assembly = expect_sound(s, "arches");
    ASSERT_EQ(assembly.steps.size(), 2u);
    const auto top = [&](std::size_t step) { return bounds(*s.pieces[assembly.steps[step].moved.front()].mesh).max.z; };
    EXPECT_NEAR(top(0), 50, 1e-9);
    EXPECT_NEAR(top(1), 90, 1e-9);
}

TEST(Assembly, OneCutThroughThirtySolids) {
    std::vector<Point2> zigzag;  // a band up and down: 15 arches above the cut, 16 legs below
    const int bends = 31;
    for (int i = 0; i < bends; ++i) zigzag.push_back({30.0 * i, i % 2 == 0 ? 0.0 : 100.0});
    for (int i = bends; i-- > 0;) zigzag.push_back({30.0 * i, i % 2 == 0 ? 40.0 : 140.0});
    const TriangleMesh band = extruded(zigzag, 50);
    ASSERT_TRUE(edges(band).faults.is_closed());
    Segmentation s = uncut(band, 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 70}));
    ASSERT_EQ(s.pieces.size(), 31u);
    const Assembly assembly = expect_sound(s, "zigzag");
    EXPECT_EQ(assembly.steps.size(), 30u);
    // every step is joined to what stands: nothing has to be held in the air
    for (const AssemblyStep& step : assembly.steps) EXPECT_FALSE(step.joints.empty());
}

TEST(Assembly, RingsAreJoinedPartByPart) {
    std::mt19937 random(8);
    for (int round = 0; round < 6; ++round) {
        Segmentation s = uncut(shapes::torus({0, 0, 0}, 120, 40, 24), 0);
        ASSERT_TRUE(cut_at(s, "A", {normalized({1, 0.1 * round, 0.2}), 1}));
        for (int i = 0; i < 5; ++i) {
            const Piece& piece = s.pieces[random() % s.pieces.size()];
            const Vec3 normal = random_normal(random);
            const Extent range = extent(*piece.mesh, normal);
            cut_at(s, piece.name, {normal, 0.5 * (range.low + range.high)});
        }
        expect_sound(s, "ring " + std::to_string(round));
    }
}

TEST(Assembly, TheAnimationEndsInPlaceAndMovesEachStepInItsSecond) {
    std::mt19937 random(6);
    const Segmentation s = cut_randomly(shapes::box({0, 0, 0}, {300, 200, 150}, 3), 5, random);
    const Assembly assembly = assembly_of(s, piece_joints(s.pieces, {}));
    const auto keys = assembly_keys(assembly, s.pieces.size());
    const auto shift_at = [&](std::size_t piece, double time) {
        const std::vector<AssemblyKey>& of = keys[piece];
        if (of.empty() || time >= of.back().time_s) return Vec3{};
        for (std::size_t k = 0; k + 1 < of.size(); ++k) {
            if (time > of[k + 1].time_s) continue;
            const double share = (time - of[k].time_s) / (of[k + 1].time_s - of[k].time_s);
            return of[k].shift + share * (of[k + 1].shift - of[k].shift);
        }
        return Vec3{};
    };
    for (std::size_t i = 0; i < assembly.steps.size(); ++i) {
        const AssemblyStep& step = assembly.steps[i];
        const double time = static_cast<double>(i);
        for (std::size_t p = 0; p < s.pieces.size(); ++p) {
            const Vec3 moved = shift_at(p, time + 1) - shift_at(p, time);
            const bool moves = std::find(step.moved.begin(), step.moved.end(), p) != step.moved.end();
            EXPECT_NEAR(norm(moved - (moves ? step.distance_mm : 0) * step.direction), 0, 1e-6) << i << " " << p;
        }
    }
    for (const auto& of_piece : keys) {
        if (!of_piece.empty()) {
            EXPECT_NEAR(norm(of_piece.back().shift), 0, 1e-9);
        }
    }
}

TEST(InFront, KnowsWhichOfTwoSolidsComesFirst) {
    const TriangleMesh low = shapes::box({0, 0, 0}, {10, 10, 10});
    const TriangleMesh high = shapes::box({5, 5, 20}, {15, 15, 30});
    const TriangleMesh beside = shapes::box({10, 0, 20}, {20, 4, 30});
    const auto turned = [](const TriangleMesh& mesh, Vec3 along) {
        const std::vector<const TriangleMesh*> meshes{&mesh};
        return TurnedSolid(meshes, along);
    };
    const InFront up = in_front(turned(low, {0, 0, 1}), turned(high, {0, 0, 1}));
    EXPECT_FALSE(up.first);
    EXPECT_TRUE(up.second);
    const InFront down = in_front(turned(low, {0, 0, -1}), turned(high, {0, 0, -1}));
    EXPECT_TRUE(down.first);
    EXPECT_FALSE(down.second);
    const InFront none = in_front(turned(low, {0, 0, 1}), turned(beside, {0, 0, 1}));
    EXPECT_FALSE(none.first || none.second);
}

}  // namespace
}  // namespace qchopper

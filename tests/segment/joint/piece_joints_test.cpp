#include "segment/joint/piece_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "segment/joint/dowel_sites.h"
#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/plane_frame.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/segment/joint/turned_pattern.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Vec3& p : mesh.points) p = factor * p;
    return mesh;
}

// Points of the hole's cylinder and of the wall around and below it must lie in the piece. Apart from how sites are
// judged: by counting crossings of a line, point by point.
int points_outside(const Piece& piece, const Dowel& dowel, Vec3 into) {
    const PlaneFrame frame = frame_across(into);
    const double reach = dowel.size.clearance() * (1 - 1e-9);
    int outside = 0;
    const auto ask = [&](double depth, double radius, int count) {
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.37) / count;
            const Vec3 p =
                dowel.point + depth * into + radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
            outside += is_inside(*piece.mesh, p) ? 0 : 1;
        }
    };
    for (const double share : {0.001, 0.3, 0.7, 1.0}) ask(share * dowel.size.depth, reach, 10);
    for (const double angle : {0.4, 0.9, 1.4}) {
        ask(dowel.size.depth + reach * std::sin(angle), reach * std::cos(angle), 6);
    }
    ask(dowel.size.depth / 2, 0.5 * reach, 4);
    return outside;
}

DowelPattern pattern_of(const PieceJoint& joint, const std::vector<DowelSize>& sizes) {
    DowelPattern pattern;
    for (const Dowel& dowel : joint.dowels) {
        const auto size = std::find(sizes.begin(), sizes.end(), dowel.size);
        pattern.push_back({static_cast<std::size_t>(size - sizes.begin()), on_plane(joint.plane, dowel.point)});
    }
    return pattern;
}

TEST(PieceJoints, HolesOfTenThousandRandomSectionsAreClear) {
    std::mt19937 random(11);
    const std::vector<shapes::Named> all = shapes::all_closed();
    JointSettings settings;
    settings.sites = 60;
    settings.min_mm2 = 50;
    int sections = 0;
    int holes = 0;
    for (int round = 0; sections < 10'000; ++round) {
        const shapes::Named& shape = all[static_cast<std::size_t>(round) % all.size()];
        const double size = norm(bounds(shape.mesh).size());
        const Segmentation s = cut_randomly(scaled(shape.mesh, 150 / size), 6, random);
        for (const PieceJoint& joint : piece_joints(s.pieces, settings)) {
            ++sections;
            for (const Dowel& dowel : joint.dowels) {
                ++holes;
                EXPECT_EQ(points_outside(s.pieces[joint.above], dowel, joint.plane.normal), 0) << shape.name;
                EXPECT_EQ(points_outside(s.pieces[joint.below], dowel, -joint.plane.normal), 0) << shape.name;
            }
        }
    }
    EXPECT_GT(holes, 3'000);
}

// Blocks of several sizes: many joints with much room and little.
Segmentation many_joints() {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {400, 300, 200}, 4), 0);
    EXPECT_TRUE(cut_at(s, "A", {{0, 0, 1}, 90}));
    std::mt19937 random(5);
    for (int tries = 0; tries < 200 && s.pieces.size() < 14; ++tries) {
        const Piece& piece = s.pieces[random() % s.pieces.size()];
        const Vec3 normal = random_normal(random);
        const Extent range = extent(*piece.mesh, normal);
        cut_at(s, piece.name, {normal, 0.5 * (range.low + range.high)});
    }
    return s;
}

TEST(PieceJoints, NoPatternFitsTurnedAndNoTwoFitEachOther) {
    const Segmentation s = many_joints();
    const JointSettings settings;
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, settings);
    const double tolerance = pattern_tolerance(settings.play);
    std::size_t sound = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const DowelPattern pattern = pattern_of(joints[j], settings.sizes);
        EXPECT_FALSE(pattern.size() == 2 && pattern[0].size == pattern[1].size) << "two equal dowels alone";
        if (joints[j].fault != JointFault::none) {
            EXPECT_FALSE(describe_fault(joints[j], s.pieces, joints).empty());
            continue;
        }
        ++sound;
        ASSERT_GE(pattern.size(), 2u);
        // the dowels at the least distance turn by 15 degrees before one of them is off by more than the tolerance
        EXPECT_GT(min_error(pattern, pattern, {.from_deg = 16}), tolerance) << joint_name(joints[j], s.pieces);
        for (std::size_t k = 0; k < j; ++k) {
            if (joints[k].fault != JointFault::none) continue;
            const DowelPattern other = pattern_of(joints[k], settings.sizes);
            EXPECT_GT(min_error_of_rotations(pattern, other), tolerance)
                << joint_name(joints[j], s.pieces) << " and " << joint_name(joints[k], s.pieces);
        }
    }
    EXPECT_GT(joints.size(), 15u);
    EXPECT_GT(sound, joints.size() * 3 / 4);
}

// A dowel that stands in one piece meets foam of the other where that is turned by half a turn.
TEST(PieceJoints, HalfTurnedMatesCollideWithADowel) {
    const Segmentation s = many_joints();
    for (const PieceJoint& joint : piece_joints(s.pieces, {})) {
        if (joint.fault != JointFault::none) continue;
        Point2 middle;
        const double count = static_cast<double>(joint.dowels.size());
        for (const Dowel& dowel : joint.dowels) {
            const Point2 p = on_plane(joint.plane, dowel.point);
            middle = {middle.x + p.x / count, middle.y + p.y / count};
        }
        bool collides = false;
        for (const Dowel& dowel : joint.dowels) {
            const Point2 p = on_plane(joint.plane, dowel.point);
            const Point2 turned{2 * middle.x - p.x, 2 * middle.y - p.y};
            bool fits = false;
            for (const Dowel& hole : joint.dowels) {
                const Point2 h = on_plane(joint.plane, hole.point);
                const double off = std::hypot(h.x - turned.x, h.y - turned.y);
                const double room = (hole.size.diameter - (dowel.size.diameter - default_dowel_play)) / 2;
                fits = fits || (off <= room + 1e-9 && hole.size.diameter <= dowel.size.diameter);
            }
            collides = collides || !fits;
        }
        EXPECT_TRUE(collides) << joint_name(joint, s.pieces);
    }
}

TEST(PieceJoints, DoNotDependOnTheNumberOfThreads) {
    const Segmentation s = many_joints();
    const auto dowels = [&] {
        std::vector<std::vector<Dowel>> all;
        for (const PieceJoint& joint : piece_joints(s.pieces, {})) all.push_back(joint.dowels);
        return all;
    };
    const std::vector<std::vector<Dowel>> many = dowels();
    const ThreadLimit one(1);
    EXPECT_EQ(dowels(), many);
}

TEST(PieceJoints, HolesOfOnePieceKeepApart) {
    const Segmentation s = many_joints();
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
    struct Hole {
        Axis axis;
        DowelSize size;
    };
    for (std::size_t p = 0; p < s.pieces.size(); ++p) {
        std::vector<Hole> holes;
        for (const PieceJoint& joint : joints) {
            if (joint.below != p && joint.above != p) continue;
            const double side = joint.above == p ? 1 : -1;
            for (const Dowel& d : joint.dowels) {
                holes.push_back({{d.point, d.point + side * d.size.depth * joint.plane.normal}, d.size});
            }
        }
        for (std::size_t i = 0; i < holes.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                const double wall = std::max(holes[i].size.wall, holes[k].size.wall);
                EXPECT_GE(distance_between(holes[i].axis, holes[k].axis),
                          holes[i].size.radius() + holes[k].size.radius() + wall - 1e-9);
            }
        }
    }
}

TEST(PieceJoints, WithOneSizeThreeDowelsHoldAndASmallFaceHasOne) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {120, 90, 100}, 2), 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 50}));
    JointSettings settings;
    settings.sizes = {{8, 22, 6}};
    std::vector<PieceJoint> joints = piece_joints(s.pieces, settings);
    ASSERT_EQ(joints.size(), 1u);
    EXPECT_EQ(joints[0].dowels.size(), 3u);
    EXPECT_EQ(joints[0].fault, JointFault::none);
    Segmentation rod = uncut(shapes::box({0, 0, 0}, {24, 24, 100}, 2), 0);
    ASSERT_TRUE(cut_at(rod, "A", {{0, 0, 1}, 50}));
    joints = piece_joints(rod.pieces, settings);
    ASSERT_EQ(joints.size(), 1u);
    EXPECT_EQ(joints[0].dowels.size(), 1u);
    EXPECT_EQ(joints[0].fault, JointFault::can_be_turned);
    settings.sizes = {{20, 22, 6}};
    joints = piece_joints(rod.pieces, settings);
    EXPECT_EQ(joints[0].fault, JointFault::no_dowel);
    EXPECT_NE(describe_fault(joints[0], rod.pieces, joints).find("5.8 cm2"), std::string::npos);
}

}  // namespace
}  // namespace qchopper

#include <gtest/gtest.h>

#include <cmath>

#include "segment/joint/piece_joints.h"
#include "segment/mesh/measure.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double cap_area(const Piece& piece, std::int32_t cut) {
    double area = 0;
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        if (cap_of(*piece.mesh, t) == cut) area += norm(area_vector(*piece.mesh, t));
    }
    return area;
}

TEST(Contact, AreasOfAllJointsOfACapAddUpToTheCap) {
    std::mt19937 random(2);
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (int round = 0; round < 10; ++round) {
            const Segmentation s = cut_randomly(shape.mesh, 6, random);
            const std::vector<PieceJoint> joints = contacts_of(s.pieces, 0);
            for (std::size_t p = 0; p < s.pieces.size(); ++p) {
                for (const HalfSpace& half_space : s.pieces[p].half_spaces) {
                    double touching = 0;
                    for (const PieceJoint& joint : joints) {
                        const bool is_of = joint.cut == half_space.cut && (joint.below == p || joint.above == p);
                        if (is_of) touching += joint.contact.area_mm2;
                    }
                    const double area = cap_area(s.pieces[p], half_space.cut);
                    EXPECT_NEAR(touching, area, 1e-6 * (1 + area)) << shape.name << ", round " << round << ", piece "
                                                                   << s.pieces[p].name << ", cut " << half_space.cut;
                }
            }
        }
    }
}

TEST(Contact, OfABoxCutTwiceIsAHalfOfTheCap) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {100, 60, 80}, 3), 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 40}));
    // the piece above is cut along x: two joints of half the cap each, and one between the halves
    const bool first_is_above = s.pieces[0].half_spaces[0].above;
    ASSERT_TRUE(cut_at(s, s.pieces[first_is_above ? 0 : 1].name, {{1, 0, 0}, 50}));
    const std::vector<PieceJoint> joints = contacts_of(s.pieces, 400);
    ASSERT_EQ(joints.size(), 3u);
    EXPECT_NEAR(joints[0].contact.area_mm2, 3000, 0.01);
    EXPECT_NEAR(joints[1].contact.area_mm2, 3000, 0.01);
    EXPECT_NEAR(joints[2].contact.area_mm2, 2400, 0.01);
    EXPECT_EQ(joints[0].contact.regions.size(), 1u);
}

TEST(Contact, PlaneCoordinatesComeBack) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const Plane plane{random_normal(random), i - 50.0};
        const Vec3 p = from_plane(plane, {12.5, -40});
        EXPECT_NEAR(dot(plane.normal, p), plane.offset, 1e-9);
        EXPECT_NEAR(on_plane(plane, p).x, 12.5, 1e-9);
        EXPECT_NEAR(on_plane(plane, p).y, -40, 1e-9);
    }
}

}  // namespace
}  // namespace qchopper

#include "segment/objectives/old_joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/objectives/sweep/connector_sweep.h"
#include "segment/objectives/sweep/sweep.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const ConnectorOptions small{ConnectorForm::spread, 4, 3, 1, 1.7};

double cap_area(const TriangleMesh& mesh, std::int32_t cut) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == cut) sum += norm(area_vector(mesh, t));
    }
    return sum;
}

TEST(OldJoints, PlacesAreWhereTheSolidIsDeepBehindTheCap) {
    const Piece box = piece_of(shapes::box({0, 0, 0}, {100, 60, 40}, 3));
    const auto made = cut_piece(box, {{0, 0, 1}, 20.01}, 1);
    for (const Piece& half : made->pieces) {
        const std::vector<OldJoint> joints = old_joints(half, small);
        ASSERT_EQ(joints.size(), 1U);
        EXPECT_GT(joints[0].places.size(), 800U);
        for (const OldJoint::Place& place : joints[0].places) {
            EXPECT_NEAR(place.point.z, 20.01, 1e-9);
            EXPECT_GT(place.point.x, 1.7);
            EXPECT_LT(place.point.x, 98.3);
        }
        const ConnectorOptions deep{ConnectorForm::spread, 4, 18, 2.1, 1.7};
        EXPECT_TRUE(old_joints(half, deep)[0].places.empty()) << "20 mm are not enough";
    }
}

TEST(OldJoints, ThePartsOfACapAreThoseOfReallyCutting) {
    std::mt19937 random(51);
    std::size_t parted_caps = 0;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Vec3 first = random_normal(random);
        const Extent range = extent(mesh, first);
        const auto at = nudge(piece_of(mesh), first, std::array{range.low + 0.45 * range.size()});
        const auto made = cut_piece(piece_of(mesh), {first, at[0]->offset}, 1);
        const Piece& piece = *std::find_if(made->pieces.begin(), made->pieces.end(),
                                           [](const Piece& p) { return cap_area(*p.mesh, 1) > 0; });
        const std::vector<OldJoint> joints = old_joints(piece, small);
        ASSERT_EQ(joints.size(), 1U) << name;
        const Vec3 n = random_normal(random);
        const Extent across = extent(*piece.mesh, n);
        std::vector<double> wanted;
        for (int k = 1; k < 14; ++k) wanted.push_back(across.low + across.size() * k / 14);
        std::vector<double> offsets;
        for (const auto& nudged : nudge(piece, n, wanted)) {
            if (nudged) offsets.push_back(nudged->offset);
        }
        const auto sides = parted(joints[0], n, offsets, small);
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            const auto halves = cut(*piece.mesh, {n, offsets[k]}, 2);
            if (!halves) continue;
            const double all = cap_area(*piece.mesh, 1);
            EXPECT_NEAR(sides[k][0].area_mm2, cap_area(halves->above.mesh, 1), 1e-9 * all) << name;
            EXPECT_NEAR(sides[k][1].area_mm2, cap_area(halves->below.mesh, 1), 1e-9 * all) << name;
            parted_caps += sides[k][0].area_mm2 > 0 && sides[k][1].area_mm2 > 0 ? 1 : 0;
            for (const bool above : {true, false}) {
                Extent16 extent;
                const TriangleMesh& half = above ? halves->above.mesh : halves->below.mesh;
                const Vec3 up = piece.half_spaces[0].up();
                const PlaneFrame frame = frame_across(up);
                for (std::size_t t = 0; t < half.triangles.size(); ++t) {
                    if (cap_of(half, t) != 1) continue;
                    for (const std::uint32_t v : half.triangles[t])
                        extent.include(flattened(frame, joints[0].triangles[0][0].point, half.points[v]));
                }
                const JointMeasure& side = sides[k][above ? 0 : 1];
                if (side.area_mm2 > 0) {
                    EXPECT_NEAR(side.diameter, extent.largest(), 1e-9 * across.size()) << name;
                }
                std::vector<Point2> left;  // all of them, row by row
                for (const OldJoint::Place& place : joints[0].places) {
                    const double h = height(n, place.point) - offsets[k];
                    if (above ? h >= small.clearance() : h <= -small.clearance()) left.push_back(place.flat);
                }
                const JointMeasure plain{1000, 1000, left};
                const JointMeasure fast{1000, 1000, side.places};
                EXPECT_NEAR(connector_of({&fast, 1}, small), connector_of({&plain, 1}, small), 1e-12) << name;
            }
        }
    }
    EXPECT_GT(parted_caps, 40U);
}

TEST(OldJoints, APlaneThroughAnOlderJointCostsMoreThanOneBesideIt) {
    const Piece beam = piece_of(shapes::box({0, 0, 0}, {300, 30, 120}, 3));
    const Piece lower = cut_piece(beam, {{0, 0, 1}, 60}, 1)->pieces.back();
    Objectives o;
    o.weights.connector = 1;
    const std::array offsets{40.0, 150.0};
    const auto evaluations = sweep(prepare(lower, o), {1, 0, 0}, offsets, o);
    EXPECT_GT(evaluations[0]->connector, 0);
    const PreparedPiece prepared = prepare(lower, o);
    ASSERT_EQ(prepared.old_joints.size(), 1U);
    const auto sides = parted(prepared.old_joints[0], {1, 0, 0}, offsets, o.connector);
    EXPECT_NEAR(sides[0][1].area_mm2, 40 * 30, 1e-6);
    EXPECT_EQ(connector_of({&sides[0][1], 1}, o.connector), 1) << "at most 20 mm by 10 are left of it";
    EXPECT_LT(connector_of({&sides[1][1], 1}, o.connector), 0.3);
}

}  // namespace
}  // namespace qchopper

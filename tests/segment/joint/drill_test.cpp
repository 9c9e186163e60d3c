#include "segment/joint/drill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Of a prism on a regular polygon.
double hole_volume_mm3(const DowelSize& size) {
    const auto sides = static_cast<double>(hole_sides);
    return size.depth * 0.5 * sides * size.radius() * size.radius() * std::sin(2 * std::numbers::pi / sides);
}

TEST(Drill, PiecesStayClosedAndLoseTheVolumeOfTheirHoles) {
    std::mt19937 random(9);
    int holes = 0;
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const double factor = 300 / norm(bounds(mesh).size());
        for (Vec3& p : mesh.points) p = factor * p;
        for (int round = 0; round < 5; ++round) {
            const Segmentation s = cut_randomly(mesh, 5, random);
            const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
            for (std::size_t p = 0; p < s.pieces.size(); ++p) {
                double removed = 0;
                for (const PieceJoint& joint : joints) {
                    if (joint.below != p && joint.above != p) continue;
                    for (const Dowel& dowel : joint.dowels) {
                        removed += hole_volume_mm3(dowel.size);
                        ++holes;
                    }
                }
                const TriangleMesh made = drilled(s.pieces[p], p, joints);
                const double whole = volume_mm3(*s.pieces[p].mesh);
                EXPECT_TRUE(edges(made).faults.is_closed()) << shape.name;
                EXPECT_NEAR(volume_mm3(made), whole - removed, 1e-9 * whole) << shape.name;
                EXPECT_TRUE(is_consistent(made)) << shape.name;
            }
        }
    }
    EXPECT_GT(holes, 100);
}

TEST(Drill, APieceWithoutDowelsStaysAsItIs) {
    const Segmentation s = uncut(shapes::stairs(), 0);
    EXPECT_EQ(drilled(s.pieces[0], 0, {}), *s.pieces[0].mesh);
}

}  // namespace
}  // namespace qchopper

#include "segment/cut/nudge.h"

#include <gtest/gtest.h>

#include "segment/cut/cut.h"
#include "segment/cut/cut_piece.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::optional<Nudged> nudge_one(const Piece& piece, Vec3 normal, double wanted) {
    return nudge(piece, normal, std::array{wanted}).front();
}

TEST(Nudge, StaysInTheWindowAndLeavesNoVertexOnThePlane) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
        for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            const Extent range = extent(mesh, normal);
            for (const Vec3& p : mesh.points) {
                const double wanted = height(normal, p);
                const auto nudged = nudge_one(piece, normal, wanted);
                const double window = 1e-7 * range.size();
                if (wanted <= range.low + window || wanted >= range.high - window) {
                    ASSERT_FALSE(nudged) << name;
                    continue;
                }
                ASSERT_TRUE(nudged) << name;
                ASSERT_LE(std::abs(nudged->offset - wanted), (nudged->is_widened ? 10 : 1) * window) << name;
                for (const Vec3& q : mesh.points) ASSERT_NE(height(normal, q), nudged->offset) << name;
            }
        }
    }
}

TEST(Nudge, AtAFlatRegionTheSmallerCapWins) {
    const Piece stairs = piece_of(shapes::stairs());
    // The treads at z = 10 and z = 20 face up: just above them the section is smaller.
    EXPECT_GT(nudge_one(stairs, {0, 0, 1}, 10)->offset, 10);
    EXPECT_GT(nudge_one(stairs, {0, 0, 1}, 20)->offset, 20);
    // Upside down they face down: just below them it is smaller.
    const Piece turned = piece_of(shapes::rotated(shapes::stairs(), {1, 0, 0}, 3.14159265358979323846));
    EXPECT_LT(nudge_one(turned, {0, 0, 1}, -10)->offset, -10 + 1e-9);
    // A riser faces towards -x: the section just before it is smaller.
    EXPECT_LT(nudge_one(stairs, {1, 0, 0}, 10)->offset, 10);
    const double at = nudge_one(stairs, {0, 0, 1}, 10)->offset;
    const auto halves = cut(*stairs.mesh, {{0, 0, 1}, at}, 1);
    EXPECT_NEAR(halves->cap_area_mm2, 20 * 30, 1e-6);
}

// An offset that was typed, or read as float32, lies a little beside the flat region intended. Beside the region
// by up to 1e-9 of the extent, on either side, in either orientation: the smaller cap wins as on the region itself.
TEST(Nudge, BesideAFlatRegionByABillionthOfTheExtentIsOnIt) {
    for (const bool is_turned : {false, true}) {
        for (const Vec3& far : {Vec3{0, 0, 0}, Vec3{300, -200, 1000}}) {
            TriangleMesh mesh = shapes::stairs();
            if (is_turned) mesh = shapes::rotated(mesh, {1, 0, 0}, 3.14159265358979323846);
            const Piece stairs = piece_of(shapes::moved(mesh, far));
            const double tread = far.z + (is_turned ? -10 : 10);
            const double on_it = nudge_one(stairs, {0, 0, 1}, tread)->offset;
            const double size = extent(*stairs.mesh, {0, 0, 1}).size();
            ASSERT_EQ(on_it < tread, is_turned);
            for (const double share : {1e-12, 1e-10, 4e-10, 6e-10, 9.9e-10}) {
                for (const double side : {-1, 1}) {
                    const double wanted = tread + side * share * size;
                    const auto nudged = nudge_one(stairs, {0, 0, 1}, wanted);
                    ASSERT_TRUE(nudged);
                    EXPECT_FALSE(nudged->is_widened);
                    EXPECT_EQ(nudged->offset < tread, is_turned) << share * side;
                    EXPECT_NEAR(nudged->offset, on_it, 1e-9 * size) << share * side;
                }
            }
            // Well beside it the wider gap wins, whatever the caps.
            const double wanted = tread + (is_turned ? 1 : -1) * 1e-8 * size;
            EXPECT_EQ(nudge_one(stairs, {0, 0, 1}, wanted)->offset < tread, !is_turned);
        }
    }
}

TEST(Nudge, ASingleVertexOnThePlaneGoesToTheLowerSide) {
    const Piece ball = piece_of(shapes::ball({0, 0, 0}, 10, 8));
    const Vec3 normal = normalized({1, 0.3, 0.2});
    const double wanted = height(normal, ball.mesh->points[20]);
    EXPECT_LT(nudge_one(ball, normal, wanted)->offset, wanted);
}

TEST(Nudge, EndsAndCapsAreMissed) {
    const Piece box = piece_of(shapes::box({0, 0, 0}, {10, 10, 10}, 2));
    EXPECT_FALSE(nudge_one(box, {0, 0, 1}, 0));
    EXPECT_FALSE(nudge_one(box, {0, 0, 1}, 10));
    EXPECT_FALSE(nudge_one(box, {0, 0, 1}, 1e-8));
    EXPECT_FALSE(nudge_one(box, {0, 0, 1}, -3));
    EXPECT_FALSE(nudge_one(box, {0, 0, 1}, std::nan("")));
    const auto made = cut_piece(box, {{0, 0, 1}, 3.3}, 1);
    for (const Piece& piece : made->pieces) EXPECT_FALSE(nudge_one(piece, {0, 0, 1}, 3.3));
}

TEST(Nudge, ManyOffsetsAtOnceGiveTheResultsOfEachAlone) {
    const Piece piece = piece_of(shapes::linked_tori());
    std::vector<double> wanted;
    for (int i = 40; i > 0; --i) wanted.push_back(-70 + 3.1 * i);
    const auto all = nudge(piece, {0, 0, 1}, wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto one = nudge_one(piece, {0, 0, 1}, wanted[i]);
        ASSERT_EQ(all[i].has_value(), one.has_value());
        EXPECT_TRUE(!one || all[i]->offset == one->offset);
    }
}

}  // namespace
}  // namespace qchopper

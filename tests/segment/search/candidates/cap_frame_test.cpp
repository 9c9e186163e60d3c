#include "segment/search/candidates/cap_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The part of a ball of 100 mm above all planes through its inside.
Piece cut_ball(const std::vector<Vec3>& inward) {
    Piece piece{"A", std::make_shared<TriangleMesh>(shapes::ball({0, 0, 0}, 100, 24)), {}};
    for (std::size_t i = 0; i < inward.size(); ++i) {
        const Vec3 normal = normalized(inward[i]);
        const auto made = cut_piece(piece, canonical({normal, -40.0123}), static_cast<std::int32_t>(i + 1));
        EXPECT_TRUE(made.has_value());
        if (!made) return piece;
        const auto larger = [](const Piece& a, const Piece& b) { return volume_mm3(*a.mesh) < volume_mm3(*b.mesh); };
        piece = *std::max_element(made->pieces.begin(), made->pieces.end(), larger);
    }
    return piece;
}

bool has(const std::vector<Vec3>& normals, Vec3 normal) {
    return std::any_of(normals.begin(), normals.end(),
                       [&](Vec3 n) { return norm(cross(n, normalized(normal))) < same_direction_rad; });
}

TEST(CapFrame, APieceWithoutCapsHasNone) {
    const Piece piece = cut_ball({});
    EXPECT_FALSE(box_along_caps(piece).has_value());
    EXPECT_TRUE(normals_along_caps(piece).empty());
    EXPECT_TRUE(is_along({0, 0.6, 0.8}, cap_normals(piece)));
}

TEST(CapFrame, OfACapFollowItsNormalAndTheSmallestRectangleAcrossIt) {
    const Piece piece = cut_ball({{0.2, 0.3, 0.9}});
    const std::vector<Vec3> normals = normals_along_caps(piece);
    ASSERT_EQ(normals.size(), 3U);
    EXPECT_TRUE(has(normals, {0.2, 0.3, 0.9}));
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = a + 1; b < 3; ++b) EXPECT_NEAR(dot(normals[a], normals[b]), 0, 1e-9);
    }
}

TEST(CapFrame, CrossProductsOfCapsThatAreNotParallelAreNormals) {
    const Piece piece = cut_ball({{1, 0, 0}, {0.5, 0.8, 0}, {0.1, 0.2, 1}});
    const std::vector<Vec3> normals = normals_along_caps(piece);
    EXPECT_TRUE(has(normals, {0, 0, 1}));
    EXPECT_TRUE(has(normals, cross(Vec3{1, 0, 0}, {0.1, 0.2, 1})));
    for (std::size_t a = 0; a < normals.size(); ++a) {
        for (std::size_t b = a + 1; b < normals.size(); ++b) {
            EXPECT_GT(norm(cross(normals[a], normals[b])), same_direction_rad) << "each once";
        }
    }
}

TEST(CapFrame, ItsBoxHoldsEveryPointAndIsRightHanded) {
    for (const std::vector<Vec3>& inward :
         std::vector<std::vector<Vec3>>{{{0.2, 0.3, 0.9}}, {{1, 0, 0}, {0, 0.6, 0.8}}, {{0.3, 1, 0}, {1, 0.2, 0}}}) {
        const Piece piece = cut_ball(inward);
        const std::optional<OrientedBox> box = box_along_caps(piece);
        ASSERT_TRUE(box.has_value());
        EXPECT_NEAR(dot(cross(box->axis[0], box->axis[1]), box->axis[2]), 1, 1e-9);
        EXPECT_GE(box->size().x, box->size().y);
        EXPECT_GE(box->size().y, box->size().z);
        for (const Vec3& p : piece.mesh->points) {
            for (int i = 0; i < 3; ++i) {
                const double along = dot(box->axis[static_cast<std::size_t>(i)], p);
                EXPECT_GE(along, box->min[i] - 1e-9);
                EXPECT_LE(along, box->max[i] + 1e-9);
            }
        }
        for (int i = 0; i < 3; ++i) EXPECT_LT(box->size()[i], 201);
    }
}

TEST(CapFrame, NormalsNearlyAlongACapAreSnapped) {
    const std::vector<Vec3> caps{{0, 0, 1}};
    EXPECT_EQ(snapped(normalized({5e-5, 0, 1}), caps), (Vec3{0, 0, 1}));
    EXPECT_EQ(snapped(normalized({1, 0, 5e-5}), caps).z, 0);
    const Vec3 leaning = normalized({1, 0, 5e-4});
    EXPECT_EQ(snapped(leaning, caps), leaning);
    EXPECT_FALSE(is_along(leaning, caps));
    EXPECT_TRUE(is_along({1, 0, 0}, caps));
}

}  // namespace
}  // namespace qchopper

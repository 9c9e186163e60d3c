#include "segment/sample/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "segment/sample/bones.h"

namespace qchopper {
namespace {

TEST(BoneField, PrimitivesMeasureDistance) {
    BoneField field;
    field.parts = {added(0, {cone({0, 0, 0}, 2, {10, 0, 0}, 2)})};
    EXPECT_NEAR(value_at(field, {5, 7, 0}), 5, 1e-12);
    EXPECT_NEAR(value_at(field, {-6, 0, 0}), 4, 1e-12);
    EXPECT_NEAR(value_at(field, {5, 0, 0}), -2, 1e-12);
    field.parts = {added(0, {plate({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 1)})};
    EXPECT_NEAR(value_at(field, {2, 2, 4}), 3, 1e-12);
    EXPECT_NEAR(value_at(field, {-3, 0, 4}), 4, 1e-12);
    field.parts = {added(0, {ellipsoid({1, 0, 0}, {4, 2, 3})})};
    EXPECT_NEAR(value_at(field, {7, 0, 0}), 2, 1e-12);
    EXPECT_NEAR(value_at(field, {1, 2, 0}), 0, 1e-12);
    EXPECT_NEAR(value_at(field, {1, 0, 0}), -2, 1e-12);
    field.parts = {added(0, {ball({0, 0, 0}, 5)}), carved(0, {ball({0, 0, 0}, 3)})};
    EXPECT_NEAR(value_at(field, {4, 0, 0}), -1, 1e-12);
    EXPECT_NEAR(value_at(field, {1, 0, 0}), 2, 1e-12);
}

TEST(BoneField, SmoothJointsOnlyAddMaterialAndOnlyNearTheJoint) {
    BoneField sharp;
    sharp.parts = {added(0, {ball({0, 0, 0}, 5)}), added(0, {ball({8, 0, 0}, 5)})};
    BoneField smooth = sharp;
    smooth.parts[1].blend = 3;
    EXPECT_LT(value_at(smooth, {4, 4, 0}), value_at(sharp, {4, 4, 0}));
    EXPECT_EQ(value_at(smooth, {-6, 0, 0}), value_at(sharp, {-6, 0, 0}));
}

// In a ball, the local field is the field, bit for bit, and its values keep within the bounds.
TEST(BoneField, LocalFieldGivesTheSameBits) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (const Bone& bone : {vertebra(), femur(), skull()}) {
        const double size = norm(bone.box.size());
        std::size_t parts_kept = 0;
        std::size_t parts_before = 0;
        for (int ball = 0; ball < 400; ++ball) {
            const Vec3 centre{between(bone.box.min.x, bone.box.max.x), between(bone.box.min.y, bone.box.max.y),
                              between(bone.box.min.z, bone.box.max.z)};
            const double radius = std::pow(10, between(-3, -1)) * size;
            BoneField local;
            const FieldRange range = range_in_ball(bone.field, centre, radius, local);
            if (radius < 0.01 * size) {
                parts_kept += local.parts.size();
                parts_before += bone.field.parts.size();
            }
            for (int i = 0; i < 30; ++i) {
                const Vec3 direction = normalized({between(-1, 1), between(-1, 1), between(-1, 1)});
                const Vec3 point = centre + between(0, 1) * radius * direction;
                const double value = value_at(bone.field, point);
                ASSERT_EQ(value_at(local, point), value);
                ASSERT_GE(value, range.low - 1e-9);
                ASSERT_LE(value, range.high + 1e-9);
            }
        }
        EXPECT_LT(2 * parts_kept, parts_before);  // else the selection would be useless
    }
}

TEST(BoneField, BonesAreAlikeOnBothSides) {
    const Bone bone = skull();
    BoneField even = bone.field;
    even.textures.clear();
    for (const Vec3 p : {Vec3{200, 0, 0}, Vec3{390, -400, 10}, Vec3{60, 900, -100}}) {
        EXPECT_DOUBLE_EQ(value_at(even, p), value_at(even, {-p.x, p.y, p.z}));
    }
}

}  // namespace
}  // namespace qchopper

#include "segment/sample/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "base/error.h"
#include "segment/sample/bones.h"
#include "segment/sample/isosurface.h"
#include "tests/segment/sample/invariants.h"
#include "tests/segment/sample/self_intersections.h"

namespace qchopper {
namespace {

constexpr Specimen all[] = {Specimen::vertebra, Specimen::femur, Specimen::skull};

// Below the base lattice, at it and above it, even and odd.
constexpr std::size_t face_counts[] = {2000, 6667, 100000};

TEST(Sample, IsOneValidSolidOfTheGivenNumberOfFaces) {
    for (const Specimen specimen : all) {
        for (const std::size_t faces : face_counts) {
            SCOPED_TRACE(testing::Message() << static_cast<int>(specimen) << " with " << faces);
            const TriangleMesh mesh = sample(specimen, {faces, 0});
            EXPECT_EQ(mesh.triangles.size(), faces / 2 * 2);
            expect_valid_solid(mesh);
        }
    }
}

TEST(Sample, NeverIntersectsItself) {
    for (const Specimen specimen : all) {
        for (const std::size_t faces : {2000U, 6000U, 30000U, 60000U, 120000U}) {
            EXPECT_EQ(count_self_intersections(sample(specimen, {faces, 0})), 0U)
                << static_cast<int>(specimen) << " with " << faces;
        }
    }
}

TEST(Sample, CoarserThanTheBaseLatticeHasPointsOfItsSurface) {
    const Bone bone = vertebra();
    const TriangleMesh base = isosurface(bone.field, bone.box, bone.base_spacing, {});
    EXPECT_EQ(sample(Specimen::vertebra, {base.triangles.size(), 0}), base);
    for (const Vec3& p : sample(Specimen::vertebra, {3000, 0}).points) {
        EXPECT_NE(std::find(base.points.begin(), base.points.end(), p), base.points.end());
    }
}

TEST(Sample, VertebraHasAForamenAndSkullTwoCheekArches) {
    for (const std::size_t faces : {std::size_t{2000}, std::size_t{100000}}) {
        EXPECT_EQ(genus(sample(Specimen::vertebra, {faces, 0})), 1);
        EXPECT_EQ(genus(sample(Specimen::femur, {faces, 0})), 0);
        EXPECT_EQ(genus(sample(Specimen::skull, {faces, 0})), 2);
    }
}

TEST(Sample, HasTheSameShapeForEveryNumberOfFaces) {
    for (const Specimen specimen : all) {
        const TriangleMesh fine = sample(specimen, {100000, 0});
        const TriangleMesh coarse = sample(specimen, {20000, 0});
        EXPECT_NEAR(volume_mm3(coarse) / volume_mm3(fine), 1, 0.01);
        EXPECT_NEAR(area_mm2(coarse) / area_mm2(fine), 1, 0.02);
        EXPECT_LT(norm(bounds(coarse).size() - bounds(fine).size()), 0.01 * norm(bounds(fine).size()));
    }
}

TEST(Sample, HasTheSizeOfItsBone) {
    const auto longest = [](Specimen specimen) {
        const Vec3 size = bounds(sample(specimen, {20000, 0})).size();
        return std::max({size.x, size.y, size.z});
    };
    EXPECT_NEAR(longest(Specimen::vertebra), 350, 20);
    EXPECT_NEAR(longest(Specimen::femur), 1200, 30);
    EXPECT_NEAR(longest(Specimen::skull), 2000, 60);
}

TEST(Sample, SkullIsHollowAndItsHollowIsOpen) {
    // one shell only, and yet much less volume than its outer surface encloses: the middle of the brain is outside
    const TriangleMesh skull = sample(Specimen::skull, {20000, 0});
    EXPECT_EQ(shells(skull).count(), 1U);
    const Vec3 brain{0, -560, 130};
    double turns = 0;  // solid angle of all triangles seen from there, in full spheres (Van Oosterom and Strackee)
    for (const Triangle& t : skull.triangles) {
        const Vec3 a = normalized(skull.points[t[0]] - brain);
        const Vec3 b = normalized(skull.points[t[1]] - brain);
        const Vec3 c = normalized(skull.points[t[2]] - brain);
        turns += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a)) / (4 * 3.141592653589793);
    }
    EXPECT_NEAR(turns, 0, 1e-6);
}

TEST(Sample, IsTheSameEveryTime) {
    for (const Specimen specimen : all) {
        EXPECT_EQ(sample(specimen, {9000, 3}), sample(specimen, {9000, 3}));
    }
    for (const std::size_t faces : {std::size_t{90002}, std::size_t{150000}}) {
        EXPECT_EQ(sample(Specimen::vertebra, {faces, 2}), sample(Specimen::vertebra, {faces, 2}));
    }
}

TEST(Sample, WithHolesHasThatManyHoles) {
    for (const Specimen specimen : all) {
        const long whole = 2 - 2 * genus(sample(specimen, {20000, 0}));
        for (const int holes : {1, 12}) {
            const TriangleMesh mesh = sample(specimen, {20000, holes});
            const Edges found = edges(mesh);
            EXPECT_GT(found.faults.open, 0U);
            EXPECT_EQ(found.faults.inconsistent + found.faults.non_manifold, 0U);
            EXPECT_LT(mesh.triangles.size(), 20000U);
            EXPECT_GT(mesh.triangles.size(), 15000U);
            // a closed surface of this genus loses one from its Euler characteristic for every disc removed
            const long edge_count =
                (3 * static_cast<long>(mesh.triangles.size()) + static_cast<long>(found.faults.open)) / 2;
            const long euler =
                static_cast<long>(mesh.points.size()) - edge_count + static_cast<long>(mesh.triangles.size());
            EXPECT_EQ(whole - euler, holes);
        }
    }
}

TEST(Sample, RefusesImpossibleNumbers) {
    for (const SampleOptions& options : {SampleOptions{0, 0}, SampleOptions{1999, 0}, SampleOptions{60'000'000, 0},
                                         SampleOptions{20000, -1}, SampleOptions{20000, 1000}}) {
        try {
            sample(Specimen::femur, options);
            FAIL() << options.faces << " faces, " << options.holes << " holes";
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::use);
        }
    }
}

TEST(Sample, StopsWhenCancelled) {
    const std::atomic<bool> stop = true;
    Context context;
    context.cancelled = &stop;
    EXPECT_THROW(sample(Specimen::skull, {2'000'000, 0}, context), Cancelled);
}

TEST(Sample, SpecimensHaveNames) {
    EXPECT_EQ(specimen_named("vertebra"), Specimen::vertebra);
    EXPECT_EQ(specimen_named("femur"), Specimen::femur);
    EXPECT_EQ(specimen_named("skull"), Specimen::skull);
    EXPECT_FALSE(specimen_named("Skull"));
    EXPECT_FALSE(specimen_named(""));
}

}  // namespace
}  // namespace qchopper

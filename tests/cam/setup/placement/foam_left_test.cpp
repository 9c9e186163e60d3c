// Where a flat end that comes from some orientations leaves foam.

#include "cam/setup/placement/foam_left.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// Two walls of 100 mm on a floor of 20 mm, with a gap between them, seen from above.
HeightField walls_with_gap(double gap) {
    const double half = 0.5 * gap;
    const TriangleMesh mesh = shapes::joined({shapes::box({-100, -60, 0}, {100, 60, 20}, 4),
                                              shapes::box({-100, -60, 20}, {-half, 60, 120}, 4),
                                              shapes::box({half, -60, 20}, {100, 60, 120}, 4)});
    HeightField surface = height_field(mesh, {0, 0, 1}, 2.5);
    for (float& height : surface.height) {
        if (height == HeightField::nothing) height = 0;  // beside the floor
    }
    return surface;
}

FoamLeft after(const HeightField& surface, double tool_radius, bool clears_beside = true) {
    FoamLeft foam({}, tool_radius);
    foam.remove_above(surface, clears_beside);
    return foam;
}

TEST(FoamLeft, StandsInAGapThatIsNarrowerThanTheTool) {
    for (const double gap : {30.0, 50.0}) {
        const HeightField surface = walls_with_gap(gap);
        EXPECT_FALSE(after(surface, 0).stands_at({0, 0, 30})) << "of a tool without radius";
        EXPECT_EQ(after(surface, 20).stands_at({0, 0, 30}), gap < 40) << gap;
        EXPECT_FALSE(after(surface, 20).stands_at({0, 0, 121})) << "above the walls";
        EXPECT_TRUE(after(surface, 0).stands_at({0, 0, 15})) << "below the surface";
    }
}

TEST(FoamLeft, IsNotBesideAWallThatTheToolGoesAlong) {
    const FoamLeft foam = after(walls_with_gap(50), 20);
    for (const double z : {21.0, 60.0, 119.0}) EXPECT_FALSE(foam.stands_at({-24, 0, z})) << z;
    // The outer sides of the walls are the borders of the map, to within a cell.
    for (const double x : {-104.0, 104.0}) EXPECT_FALSE(foam.stands_at({x, 0, 5})) << x;
}

TEST(FoamLeft, BesideTheMapStandsUnlessAllIsCleared) {
    const HeightField surface = walls_with_gap(50);
    EXPECT_FALSE(after(surface, 20, true).stands_at({-150, 0, 50}));
    EXPECT_TRUE(after(surface, 20, false).stands_at({-150, 0, 50}));
    EXPECT_FALSE(after(surface, 20, false).stands_at({0, 0, 50}));
}

TEST(FoamLeft, IsWhatNoOrientationRemoves) {
    FoamLeft foam({}, 20);
    EXPECT_TRUE(foam.stands_at({0, 0, 500})) << "nothing was milled yet";
    foam.remove_above(walls_with_gap(30), true);
    EXPECT_TRUE(foam.stands_at({0, 0, 110}));
    foam.remove_above(walls_with_gap(50), false);
    EXPECT_FALSE(foam.stands_at({0, 0, 110}));
    EXPECT_TRUE(foam.stands_at({0, 0, 15}));
}

TEST(FoamLeft, IsNotKnownToBeRemovedWhereTheMapShowsNothing) {
    HeightField surface = walls_with_gap(50);
    std::fill(surface.height.begin(), surface.height.end(), HeightField::nothing);
    EXPECT_TRUE(after(surface, 20).stands_at({0, 0, 500}));
}

}  // namespace
}  // namespace qchopper

#include "segment/joint/seam.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Seam, OfABoxIsItsCircumferenceAndAllVisible) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {100, 60, 80}, 4), 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 37}));
    const SeamLength seam = seam_length(s.pieces);
    EXPECT_NEAR(seam.mm, 320, 1e-6);
    EXPECT_NEAR(seam.visible_mm, 320, 1e-6);
}

TEST(Seam, InACavityCountsInItsLengthOnly) {
    const TriangleMesh hollow = shapes::joined({shapes::box({0, 0, 0}, {100, 100, 100}, 4),
                                                shapes::turned_inside_out(shapes::box({20, 20, 20}, {80, 80, 80}, 4))});
    Segmentation s = uncut(hollow, 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 37}));
    const SeamLength seam = seam_length(s.pieces);
    EXPECT_NEAR(seam.mm, 400 + 240, 1e-6);
    EXPECT_NEAR(seam.visible_mm, 400, 1);
}

TEST(Seam, OfTwoCutsCountsEachOnce) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {100, 60, 80}, 4), 0);
    ASSERT_TRUE(cut_at(s, "A", {{0, 0, 1}, 37}));
    const std::string above = s.pieces[0].half_spaces[0].above ? s.pieces[0].name : s.pieces[1].name;
    ASSERT_TRUE(cut_at(s, above, {{1, 0, 0}, 51}));
    // the second cut is seen on three sides of what lies above
    EXPECT_NEAR(seam_length(s.pieces).mm, 320 + 60 + 2 * 43, 1e-6);
}

}  // namespace
}  // namespace qchopper

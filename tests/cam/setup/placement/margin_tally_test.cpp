#include "cam/setup/placement/margin_tally.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

// Two poses with margins of the block to the tool that differ by so much, in mm: which is the worst one?
std::size_t worse_of_two(double first_more_by) {
    MarginTally tally;
    tally.set_pose(0);
    tally.add(PoseCheck::tool_to_block, 123.456 + first_more_by);
    tally.set_pose(1);
    tally.add(PoseCheck::tool_to_block, 123.456);
    EXPECT_EQ(tally.of(PoseCheck::tool_to_block).pose, tally.worst_pose());
    return tally.worst_pose();
}

TEST(MarginTally, KeepsTheFirstOfPosesThatDifferInTheirLastDigits) {
    EXPECT_EQ(worse_of_two(0), 0U);
    EXPECT_EQ(worse_of_two(1e-11), 0U) << "by another order of a sum";
    EXPECT_EQ(worse_of_two(-1e-11), 0U);
    EXPECT_EQ(worse_of_two(1e-3), 1U);
}

TEST(MarginTally, OfPosesThatDifferInTheirLastDigitsHasOneScore) {
    const auto score = [](double measured) {
        MarginTally tally(false);
        tally.add(PoseCheck::tool_to_block, measured);
        return tally.score();
    };
    EXPECT_EQ(score(123.456), score(123.456 + 1e-11));
    EXPECT_LT(score(123.456), score(123.457));
}

}  // namespace
}  // namespace qchopper

// 2,000 random schedules of faults: no job lost, none started twice, none reported wrongly, none without end.
//
// The judge is what the cell's memory shows as started, counted across losses of that memory. Link faults, kills, power
// cuts and lost stores are counted too: without them a green test would say nothing.

#include "tests/schedules/schedule.h"

#include <gtest/gtest.h>

namespace qchopper::schedules {
namespace {

// In parts, so that ctest runs them side by side.
void expect_right(std::uint64_t first) {
    constexpr std::uint64_t count = 500;
    ScheduleEnd sum;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const ScheduleEnd end = run_schedule(seed);
        EXPECT_TRUE(end.is_right()) << "schedule " << seed << ": lost " << end.lost << ", double starts "
                                    << end.double_starts << ", wrong reports " << end.wrong_reports << ", hangs "
                                    << end.hangs << "\nall of it: scripts/schedules --replay " << seed;
        sum.add(end);
    }
    EXPECT_GT(sum.jobs, 500);
    EXPECT_GT(sum.link_faults, 2000);
    EXPECT_GT(sum.kills, 300);
    EXPECT_GT(sum.power_cuts, 100);
    EXPECT_GT(sum.stores_lost, 20);
    EXPECT_GT(sum.journals_set_back, 50);
    EXPECT_GT(sum.said_started, 300);
    EXPECT_GT(sum.said_not_started, 200);
    EXPECT_GT(sum.said_unknown, 2);
}

TEST(Schedules, Seeds0To499) {
    expect_right(0);
}
TEST(Schedules, Seeds500To999) {
    expect_right(500);
}
TEST(Schedules, Seeds1000To1499) {
    expect_right(1000);
}
TEST(Schedules, Seeds1500To1999) {
    expect_right(1500);
}

TEST(Schedules, TheSameSeedIsTheSameSchedule) {
    for (const std::uint64_t seed : {3U, 7U, 1657U}) EXPECT_EQ(run_schedule(seed).log, run_schedule(seed).log) << seed;
}

}  // namespace
}  // namespace qchopper::schedules

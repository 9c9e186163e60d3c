#include "base/timings.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <thread>

namespace qchopper {
namespace {

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Until the process has used so much CPU time.
void compute_ms(int ms) {
    const std::clock_t until = std::clock() + ms * (CLOCKS_PER_SEC / 1000);
    while (std::clock() < until) {
    }
}

Context timed_by(Timings& timings) {
    Context context;
    context.timings = &timings;
    return context;
}

TEST(Timings, AnInnerStageDoesNotCountInTheOuterOne) {
    Timings timings;
    const Context context = timed_by(timings);
    {
        StageTimer outer(context, "search");
        sleep_ms(10);
        {
            const StageTimer inner(context, "planes evaluated");
            sleep_ms(100);
        }
        outer.next("pieces written");
        sleep_ms(20);
    }
    sleep_ms(10);
    const RunTimes times = timings.so_far();
    ASSERT_EQ(times.stages.size(), 3U);
    EXPECT_EQ(times.stages[0].name, "search");
    EXPECT_EQ(times.stages[1].name, "planes evaluated");
    EXPECT_EQ(times.stages[2].name, "pieces written");
    EXPECT_GE(times.stages[0].spent.wall_s, 0.009);
    EXPECT_GE(times.stages[1].spent.wall_s, 0.099);
    EXPECT_GE(times.stages[2].spent.wall_s, 0.019);
    double sum = 0;
    for (const StageTime& stage : times.stages) sum += stage.spent.wall_s;
    EXPECT_LE(sum, times.whole.wall_s - 0.009) << "what is in no stage counts in the whole only";
}

// Two threads were busy for 3 s and 1 s together, whatever the clocks say here.
TEST(Timings, WorkOfSeveralThreadsDividesTheStageByTheTimeThatTheyWereBusy) {
    Timings timings;
    const Context context = timed_by(timings);
    {
        StageTimer outer(context, "jobs written");
        sleep_ms(80);
        RunTimes one;
        one.stages = {{"toolpaths made", {1, 0}}, {"programs replayed", {1, 0}}};
        one.whole = {3, 0};
        RunTimes two;
        two.stages = {{"toolpaths made", {1, 0}}};
        two.whole = {1, 0};
        outer.divide({one, two});
        outer.next("pictures drawn");
    }
    const RunTimes times = timings.so_far();
    ASSERT_EQ(times.stages.size(), 4U);
    const auto wall = [&](const std::string& name) {
        for (const StageTime& stage : times.stages) {
            if (stage.name == name) return stage.spent.wall_s;
        }
        return -1.0;
    };
    EXPECT_GE(wall("toolpaths made"), 0.039);
    EXPECT_NEAR(wall("toolpaths made"), 2 * wall("programs replayed"), 1e-9);
    EXPECT_NEAR(wall("jobs written"), wall("programs replayed"), 0.02) << "what was in no stage of theirs";
    double sum = 0;
    for (const StageTime& stage : times.stages) sum += stage.spent.wall_s;
    EXPECT_LE(sum, times.whole.wall_s + 1e-9);
}

TEST(Timings, AStageThatComesAgainGoesOn) {
    Timings timings;
    const Context context = timed_by(timings);
    for (int i = 0; i < 3; ++i) {
        const StageTimer stage(context, "cuts made");
        sleep_ms(10);
        const StageTimer same(context, "cuts made");
        sleep_ms(10);
    }
    const RunTimes times = timings.so_far();
    ASSERT_EQ(times.stages.size(), 1U);
    EXPECT_GE(times.stages[0].spent.wall_s, 0.059);
    EXPECT_LE(times.stages[0].spent.wall_s, times.whole.wall_s);
}

TEST(Timings, CpuTimeIsThatOfAllThreads) {
    Timings timings;
    const Context context = timed_by(timings);
    {
        const StageTimer stage(context, "slept");
        sleep_ms(100);
    }
    {
        const StageTimer stage(context, "computed");
        std::thread other([] { compute_ms(100); });
        other.join();
    }
    const RunTimes times = timings.so_far();
    EXPECT_LT(times.stages.at(0).spent.cpu_s, 0.05);
    EXPECT_GE(times.stages.at(1).spent.cpu_s, 0.09);
    EXPECT_GE(times.whole.cpu_s, times.stages[0].spent.cpu_s + times.stages[1].spent.cpu_s - 1e-9);
    EXPECT_GT(times.peak_memory_bytes, 100'000U);
}

TEST(Timings, AStageThatIsNotEndedCountsUpToNow) {
    Timings timings;
    const StageTimer stage(&timings, "scan read");
    sleep_ms(20);
    const double first = timings.so_far().stages.at(0).spent.wall_s;
    EXPECT_GE(first, 0.019);
    sleep_ms(20);
    EXPECT_GE(timings.so_far().stages.at(0).spent.wall_s, first + 0.019);
}

TEST(Timings, AnExceptionEndsTheStage) {
    Timings timings;
    try {
        const StageTimer stage(&timings, "scan read");
        throw std::runtime_error("no scan");
    } catch (const std::runtime_error&) {
        sleep_ms(50);
    }
    EXPECT_LT(timings.so_far().stages.at(0).spent.wall_s, 0.04);
}

TEST(Timings, NothingIsMeasuredWithoutThem) {
    const Context context;
    StageTimer stage(context, "scan read");
    stage.next("scan repaired");
    EXPECT_EQ(context.timings, nullptr);
}

}  // namespace
}  // namespace qchopper

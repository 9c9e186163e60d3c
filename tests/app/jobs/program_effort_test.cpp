// The order in which programs are made, and the time that is left.

#include "app/jobs/program_effort.h"

#include <gtest/gtest.h>

#include <string>

namespace qchopper {
namespace {

using Clock = ProgramProgress::Clock;

Setup setup_of(Vec3 block, double area_mm2, std::size_t orientations) {
    Setup setup;
    setup.block.size = block;
    setup.access.area_mm2 = area_mm2;
    setup.access.orientations.resize(orientations);
    return setup;
}

TEST(ProgramEffort, GrowsWithBlockSurfaceAndOrientations) {
    const double effort = program_effort(setup_of({100, 100, 200}, 20'000, 3));
    EXPECT_GT(program_effort(setup_of({100, 100, 300}, 20'000, 3)), effort);
    EXPECT_GT(program_effort(setup_of({100, 100, 200}, 30'000, 3)), effort);
    EXPECT_GT(program_effort(setup_of({100, 100, 200}, 20'000, 4)), effort);
    EXPECT_GT(program_effort(setup_of({10, 10, 10}, 0, 1)), 0) << "it is divided by";
}

// What pieces of a vertebra, a femur, igea at 1 m and a bunny at 1.5 m took, of CPU time beside other work: toolpath,
// program, proof.
TEST(ProgramEffort, IsWithinAFactorOfTwoOfWhatWasMeasured) {
    struct Measured {
        double litres, dm2;
        std::size_t orientations;
        double cpu_s;
    };
    for (const Measured& m :
         {Measured{1.3, 3.0, 4, 5.1}, {6.8, 8.5, 5, 28.6},    {3.3, 3.5, 4, 10.0},    {2.3, 2.5, 4, 7.4},
          {11.8, 16.6, 5, 33.1},      {16.2, 18.7, 4, 24.5},  {8.6, 10.3, 2, 6.2},    {12.3, 13.0, 4, 35.1},
          {175.7, 66.1, 3, 60.3},     {89.0, 45.4, 3, 66.0},  {196.0, 71.8, 3, 58.1}, {121.0, 54.9, 3, 41.6},
          {134.2, 49.2, 4, 93.8},     {134.5, 43.9, 3, 87.6}, {125.5, 56.8, 3, 40.4}, {167.9, 45.2, 2, 25.6},
          {130.2, 55.4, 3, 75.4},     {89.6, 44.7, 3, 34.7},  {99.2, 40.1, 2, 26.8},  {84.5, 24.5, 3, 32.5},
          {120.0, 34.4, 2, 22.0}}) {
        const double effort = program_effort(setup_of({100, 100, 100 * m.litres}, 1e4 * m.dm2, m.orientations));
        EXPECT_GT(effort, 0.5 * m.cpu_s) << m.litres;
        EXPECT_LT(effort, 2 * m.cpu_s) << m.litres;
    }
}

TEST(ProgramEffort, IsToldInShares) {
    EXPECT_EQ(describe({{"E", 3}, {"F", 1}}),
              "programs to make, the largest first: E (estimated at 75 % of the work), F (25 %)");
    EXPECT_EQ(describe({{"E", 3}}), "program to make: E");
    EXPECT_TRUE(describe(std::vector<PlannedProgram>(9, {"A", 1})).ends_with("A (11 %) and 3 more"));
}

TEST(ProgramEffort, TheRestEndsWithTheWorkerThatIsDoneLast) {
    EXPECT_EQ(rest_of_work({5, 1}, {}), 5);
    EXPECT_EQ(rest_of_work({5, 1}, {2, 1}), 5) << "the second worker takes both";
    EXPECT_EQ(rest_of_work({5, 1}, {6}), 7);
    EXPECT_EQ(rest_of_work({}, {2, 3}), 5);
}

// What a caller that counts per cent evenly finds.
double seconds_left(double share, double elapsed_s) {
    return elapsed_s * (1 - share) / share;
}

TEST(ProgramProgress, FindsTheTimeLeftFromTheStepsOfThoseUnderWay) {
    Context context;
    std::size_t percent = 0;
    std::string what;
    context.on_progress = [&](const Progress& step) {
        EXPECT_GE(step.done, percent);
        EXPECT_EQ(step.total, 100U);
        percent = step.done;
        what = step.what;
    };
    ProgramProgress progress(context, {{"E", 60}, {"F", 30}, {"D", 30}});
    EXPECT_EQ(what, "% of the time for 3 programs");
    const Context first = progress.of(0, context);
    const Context second = progress.of(1, context);
    const Clock::time_point start = Clock::now();
    first.progress("operations of the toolpath", 97, 97);
    second.progress("operations of the toolpath", 97, 97);
    second.progress("bytes of the program read", 1000, 1000);
    second.progress("moves carved", 0, 10);
    second.progress("a step that nobody knows", 9, 10);
    // 0.97 of 0.5 of 60, and 0.5 and a hundredth of 0.5 of 30 are done in twice 10 s. One worker has the rest of E,
    // the other one that of F and then D.
    const double done = 0.97 * 0.5 * 60 + (0.5 + 0.01 * 0.5) * 30;
    const double rate = done / 20;
    const double share = progress.share(start + std::chrono::seconds(10));
    EXPECT_NEAR(seconds_left(share, 10), std::max(60 * (1 - 0.97 * 0.5), 30 * (1 - 0.5 - 0.01 * 0.5) + 30) / rate, 0.1);
    // Two parts, of which the first is nearly all.
    first.progress("bytes of the program read", 900, 1000);
    first.progress("rows of the volume measured", 10, 10);
    const double more = progress.share(start + std::chrono::seconds(10));
    EXPECT_GT(more, share);
    first.progress("bytes of the program read", 1000, 1000);
    EXPECT_EQ(progress.share(start + std::chrono::seconds(10)), more) << "as much is done";
    first.progress("rows of the volume measured", 10, 10);
    EXPECT_GT(progress.share(start + std::chrono::seconds(10)), more);
    first.progress("operations of the toolpath", 0, 97);  // made again at another place: not less is done
    progress.finish(0);
    progress.finish(1);
    EXPECT_LT(progress.share(Clock::now()), 1) << "D is not begun";
    progress.of(2, context);
    progress.finish(2);
    EXPECT_EQ(progress.share(Clock::now()), 1);
    EXPECT_EQ(percent, 100U);
}

// Toolpaths are made of all pieces first, and then programs along them.
TEST(ProgramProgress, OfSomeStepsGoesToTheEndWithThem) {
    Context context;
    std::string what;
    context.on_progress = [&](const Progress& step) { what = step.what; };
    const auto share_after = [&](ProgramSteps steps, const char* step) {
        ProgramProgress progress(context, {{"E", 10}}, steps);
        const Context own = progress.of(0, context);
        const Clock::time_point start = Clock::now();
        own.progress("operations of the toolpath", 90, 90);
        if (steps != ProgramSteps::toolpath) own.progress(step, 500, 1000);
        return progress.share(start + std::chrono::seconds(10));
    };
    EXPECT_NEAR(share_after(ProgramSteps::toolpath, ""), 0.97, 0.01);
    EXPECT_EQ(what, "% of the time for 1 toolpath");
    EXPECT_NEAR(share_after(ProgramSteps::all, "bytes of the program read"), 0.5, 0.01);
    EXPECT_EQ(share_after(ProgramSteps::after_toolpath, "a step that nobody knows"), 0);
    EXPECT_EQ(what, "% of the time for 1 program");
}

TEST(ProgramProgress, OfNothingReportsNothing) {
    Context context;
    context.on_progress = [](const Progress&) { FAIL(); };
    ProgramProgress progress(context, {});
    EXPECT_EQ(progress.share(Clock::now()), 1);
}

}  // namespace
}  // namespace qchopper

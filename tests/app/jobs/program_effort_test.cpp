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

TEST(ProgramEffort, IsThatOfFoamAndSurfaceAlongEachOrientation) {
    EXPECT_NEAR(program_effort(setup_of({100, 100, 200}, 20'000, 3), 500'000), 3 * (1.45 * 1.5 + 0.97 * 2), 1e-9);
    EXPECT_GT(program_effort(setup_of({10, 10, 10}, 0, 1), 1000), 0) << "it is divided by";
}

// What four pieces of a vertebra at 1 m took, of CPU time: toolpath, program and proof.
TEST(ProgramEffort, IsInProportionToWhatWasMeasured) {
    struct Measured {
        double litres, dm2;
        std::size_t orientations;
        double cpu_s;
    };
    for (const Measured& m :
         {Measured{0.694, 2.40, 4, 13.5}, {6.25, 7.64, 4, 63.6}, {3.37, 4.99, 5, 46.1}, {1.76, 2.16, 5, 25.5}}) {
        const double effort = program_effort(setup_of({100, 100, 100 * m.litres}, 1e4 * m.dm2, m.orientations), 0);
        EXPECT_NEAR(effort / m.cpu_s, 1, 0.1) << m.litres;
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

TEST(ProgramProgress, OfNothingReportsNothing) {
    Context context;
    context.on_progress = [](const Progress&) { FAIL(); };
    ProgramProgress progress(context, {});
    EXPECT_EQ(progress.share(Clock::now()), 1);
}

}  // namespace
}  // namespace qchopper

// The picture of the machine at the tightest pose, and the solids that it is drawn of.

#include "cam/job/sheet/envelope_picture.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/parallel.h"
#include "cam/job/sheet/envelope_section.h"
#include "cam/job/sheet/setup_sheet.h"
#include "cam/job/sheet/sheet_details.h"
#include "cam/job/sheet/solid_shapes.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

Bytes drawn(const JobInput& input) {
    return envelope_picture(input, apply(input.setup.piece_in_setup, *input.piece.mesh));
}

TEST(SolidShapes, HaveTheVolumeOfTheSolids) {
    const double pi = std::numbers::pi;
    const Vec3 from{1, 2, 3};
    const Vec3 to{31, 42, 3};  // 50 long
    EXPECT_NEAR(volume_mm3(cylinder_mesh({from, to, 10})), 50 * pi * 100, 0.01 * 50 * pi * 100);
    const double capsule = 50 * pi * 100 + 4.0 / 3 * pi * 1000;
    EXPECT_NEAR(volume_mm3(capsule_mesh({from, to, 10})), capsule, 0.03 * capsule);
    EXPECT_LE(volume_mm3(capsule_mesh({from, to, 10})), capsule) << "its corners lie on the surface";
    EXPECT_NEAR(volume_mm3(capsule_mesh({from, from, 10})), 4.0 / 3 * pi * 1000, 0.06 * 4200) << "a ball";
    const PlacedBox box{{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}, from}, {5, 10, 15}};
    EXPECT_NEAR(volume_mm3(box_mesh(box)), 10 * 20 * 30, 1e-6);
    EXPECT_NEAR(bounds(box_mesh(box)).size().x, 20, 1e-9);
}

TEST(EnvelopePicture, IsTheSameForAnyNumberOfThreads) {
    const JobInput input = placed_job();
    const auto with = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        return drawn(input);
    };
    const Bytes one = with(1);
    EXPECT_EQ(one, with(4));
    EXPECT_GT(one.size(), 10'000U);
}

TEST(EnvelopePicture, ShowsThePose) {
    JobInput input = placed_job();
    const Bytes before = drawn(input);
    auto& margins = input.machine_reachability.margins;
    const auto tightest = std::find_if(margins.begin(), margins.end(), [&](const ReachabilityMargin& m) {
        return m == input.machine_reachability.tightest();
    });
    ASSERT_TRUE(tightest->pose.joints);
    (*tightest->pose.joints)[0] += 0.2;
    EXPECT_NE(drawn(input), before);
    tightest->pose.joints.reset();
    EXPECT_NE(drawn(input), before) << "without the arm";
}

TEST(EnvelopeSection, HasARowForEveryCheckAndThePicture) {
    const JobInput input = placed_job();
    const std::string html = envelope_section(input);
    for (const ReachabilityMargin& margin : input.machine_reachability.margins) {
        EXPECT_NE(html.find(std::string("<td>") + rule_of(margin.check).name + "</td>"), std::string::npos);
    }
    EXPECT_NE(html.find("<img src=\"envelope.png\""), std::string::npos);
    EXPECT_NE(html.find("Joints of the arm there"), std::string::npos);
    EXPECT_EQ(envelope_section(some_job(3)).find("envelope.png"), std::string::npos);
    EXPECT_NE(sheet_details(input).find(html), std::string::npos);
}

TEST(EnvelopeSection, AJobThatIsNotHeldMustNotStart) {
    JobInput input = placed_job();
    input.machine_reachability.margins.back().relative = -0.5;
    input.machine_reachability.margins.back().margin = -25;
    const std::string sheet = setup_sheet(input, 60);
    EXPECT_NE(sheet.find("DO NOT START: piece AB cannot be carved"), std::string::npos);
    EXPECT_EQ(setup_sheet(placed_job(), 60).find("DO NOT START"), std::string::npos);
}

TEST(SetupSheet, TellsWhereTheBlockStands) {
    const JobInput input = placed_job();
    const std::string sheet = setup_sheet(input, 60);
    EXPECT_EQ(sheet.find("in the middle of the table"), std::string::npos);
    EXPECT_NE(sheet.find("from the middle of the table"), std::string::npos);
}

}  // namespace
}  // namespace qchopper

#include "app/jobs/project_joints.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/report/joint_report.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(ProjectJoints, AreShownAsRowsStepsAndJson) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {200, 100, 80}, 3), 0);
    ASSERT_TRUE(cut_at(s, "A", {{1, 0, 0}, 110}));
    ASSERT_TRUE(cut_at(s, s.pieces[0].name, {{0, 1, 0}, 40}));
    const ProjectJoints joints = project_joints(s, nullptr, {});
    ASSERT_EQ(joints.joints.size(), 3u);
    ASSERT_EQ(joints.assembly.steps.size(), 2u);
    std::string text;
    for (const std::string& line : joint_lines(joints)) text += line + "\n";
    EXPECT_NE(text.find("3 of 3 joints can neither be turned nor swapped"), std::string::npos) << text;
    EXPECT_NE(text.find("8 + 6"), std::string::npos) << text;
    EXPECT_NE(text.find("Assembly in 2 steps:"), std::string::npos) << text;
    EXPECT_NE(text.find("1. Move "), std::string::npos) << text;
    EXPECT_EQ(text.find("IN THE WAY"), std::string::npos) << text;
    const nlohmann::ordered_json json = joints_json(joints);
    EXPECT_EQ(json["joints"].size(), 3u);
    EXPECT_EQ(json["joints"][0]["dowels"].size(), 2u);
    EXPECT_EQ(json["joints"][0]["fault"], "none");
    EXPECT_GT(json["visible_seam_mm"].get<double>(), 360);
    const nlohmann::ordered_json steps = assembly_json(joints);
    EXPECT_EQ(steps.size(), 2u);
    EXPECT_TRUE(steps[1]["clear"].get<bool>());
    EXPECT_EQ(steps[1]["moved"].size() + steps[1]["standing"].size(), 3u);
}

TEST(ProjectJoints, WithoutRoomTheJointIsNamedWithItsArea) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {200, 21, 21}, 3), 0);
    ASSERT_TRUE(cut_at(s, "A", {{1, 0, 0}, 110}));
    Cell cell;
    cell.dowels = {{12, 30, 10}};
    const ProjectJoints joints = project_joints(s, &cell, {});
    ASSERT_EQ(joints.joints.size(), 1u);
    EXPECT_EQ(joints.joints[0].fault, JointFault::no_dowel);
    EXPECT_NE(joints.faults[0].find("4.4 cm2"), std::string::npos) << joints.faults[0];
    cell.dowels.clear();
    EXPECT_EQ(project_joints(s, &cell, {}).joints[0].fault, JointFault::no_dowel);
}

}  // namespace
}  // namespace qchopper

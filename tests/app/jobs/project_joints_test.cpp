#include "app/jobs/project_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/report/joint_report.h"
#include "segment/mesh/measure.h"
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
    EXPECT_NE(text.find("Longest chain of joints: 1, "), std::string::npos) << text;
    EXPECT_EQ(text.find("sawn-"), std::string::npos) << "setups are not known" << text;
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

using PieceSetup = qchopper::Setup;  // gtest has a Setup of its own

PieceSetup with_sawn(std::optional<std::int32_t> base, const std::vector<std::int32_t>& flush) {
    PieceSetup setup;
    setup.base = base;
    for (const std::int32_t cut : flush) setup.flush_caps.push_back({cut, BlockFace::plus_x, 100});
    return setup;
}

TEST(ProjectJoints, AFaceIsSawnIfItIsABaseOrAFaceOfTheBlock) {
    PieceJoint joint;
    joint.cut = 3;
    const PieceSetup milled = with_sawn(1, {2});
    const PieceSetup parted = with_sawn(3, {});
    const PieceSetup flush = with_sawn(1, {2, 3});
    const PieceSetup without_base = with_sawn(std::nullopt, {});
    EXPECT_EQ(joint_faces(joint, parted, flush), JointFaces::sawn_sawn);
    EXPECT_EQ(joint_faces(joint, parted, parted), JointFaces::sawn_sawn);
    EXPECT_EQ(joint_faces(joint, milled, flush), JointFaces::sawn_milled);
    EXPECT_EQ(joint_faces(joint, parted, without_base), JointFaces::sawn_milled);
    EXPECT_EQ(joint_faces(joint, milled, without_base), JointFaces::milled_milled);
}

TEST(ProjectJoints, TellTheirFacesAndTheLongestChain) {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {400, 100, 80}, 3), 0);
    for (const double offset : {100.0, 200.0, 300.0}) {
        std::string right;
        for (const Piece& piece : s.pieces) {
            if (bounds(*piece.mesh).max.x > 399) right = piece.name;
        }
        ASSERT_TRUE(cut_at(s, right, {{1, 0, 0}, offset}));
    }
    Cell cell;
    cell.saw.accuracy = 0.4;
    ProjectJoints joints = project_joints(s, &cell, {});
    ASSERT_EQ(joints.joints.size(), 3u);
    joints.faces = {JointFaces::sawn_sawn, JointFaces::sawn_milled, JointFaces::sawn_sawn};
    std::string text;
    for (const std::string& line : joint_lines(joints)) text += line + "\n";
    EXPECT_NE(text.find("Joints: 2 sawn-sawn, 1 sawn-milled, 0 milled-milled"), std::string::npos) << text;
    EXPECT_NE(text.find("off by 1.2 mm at most, usually 0.7 mm, where each joint is off by 0.4 mm"), std::string::npos)
        << text;
    const nlohmann::ordered_json json = joints_json(joints);
    EXPECT_EQ(json["joints"][1]["made_by"], "sawn-milled");
    EXPECT_EQ(json["longest_chain"]["chain_joints"], 3);
    EXPECT_EQ(json["longest_chain"]["way"].size(), 4u);
    EXPECT_NEAR(json["longest_chain"]["usual_mm"].get<double>(), 0.4 * std::sqrt(3.0), 1e-12);
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

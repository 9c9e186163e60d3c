// What `cells robots` and `cells new` show, and the poses of an arm to compare with the controller's display: lines for
// people and documents for programs (docs/user/cell-file.md). O(arms).

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/report/document.h"
#include "cam/cell/known_arms.h"
#include "cam/cell/taught_poses.h"

namespace qchopper {

// A cell file that was made.
struct MadeCell {
    std::string file;
    std::string drawing;
    const KnownArm& arm;
};

std::vector<std::string> lines(std::span<const KnownArm> arms);
Document document(std::span<const KnownArm> arms);
std::vector<std::string> lines(const MadeCell& made);
Document document(const MadeCell& made);

// Five sets of joints (comparison_joints) with the pose of the flange in the robot's base.
std::vector<std::string> pose_lines(const ArmGeometry& arm);
nlohmann::ordered_json pose_json(const ArmGeometry& arm);

// How far taught poses are from those of the arm, and which value explains them.
std::vector<std::string> lines(const TaughtPoseCheck& check);
nlohmann::ordered_json json_of(const TaughtPoseCheck& check);

}  // namespace qchopper

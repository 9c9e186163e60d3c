// Joints, seams and the steps of the assembly as text and JSON.
//
// Tests: tests/app/jobs/project_joints_test.cpp.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/jobs/project_joints.h"

namespace qchopper {

// A row per joint, the length of the seams, the longest chain, and a line per step.
std::vector<std::string> joint_lines(const ProjectJoints& joints);

// {joints, seam_mm, visible_seam_mm, longest_chain}
nlohmann::ordered_json joints_json(const ProjectJoints& joints);
// A list of steps, and its key.
constexpr const char* assembly_key = "assembly";
nlohmann::ordered_json assembly_json(const ProjectJoints& joints);

}  // namespace qchopper

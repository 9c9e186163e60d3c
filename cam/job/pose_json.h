// Poses in the JSON of a job file: {rows, shift}, checked to be rotations.
//
// What is read is what was written (tests/cam/job/job_file_test.cpp).

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/pose.h"

namespace qchopper {

nlohmann::ordered_json from_pose(const Pose& pose);

// Throws std::runtime_error that names the key.
Pose to_pose(const nlohmann::ordered_json& json, const std::string& key);

}  // namespace qchopper

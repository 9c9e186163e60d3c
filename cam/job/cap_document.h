// The caps in the manifest of a job file, as JSON.
//
// What is read is what was written (tests/cam/job/job_caps_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "cam/job/job_cap.h"

namespace qchopper {

// Precondition: all numbers are finite.
nlohmann::ordered_json from_caps(const std::vector<JobCap>& caps);

// The inverse. Throws std::runtime_error that names the key and the reason: also where the point or the axis of a hole
// in setup coordinates is not that of its cap by more than 1e-6.
std::vector<JobCap> to_caps(const nlohmann::ordered_json& json, const Pose& piece_in_setup);

// Why the templates of a job do not belong to its caps: one that is missing, or one of no cap. Empty: they do.
std::string fault_of_templates(const std::vector<JobCap>& caps, const std::map<std::string, Bytes>& files);

}  // namespace qchopper

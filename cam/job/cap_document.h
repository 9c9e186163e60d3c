// The caps in the manifest of a job file, as JSON.
//
// What is read is what was written (tests/cam/job/job_caps_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "cam/job/job_cap.h"

namespace qchopper {

// Precondition: all numbers are finite.
void put(nlohmann::ordered_json& at, const JobCap& cap);

// The inverse. Throws std::runtime_error that names the key and the reason.
void take(const nlohmann::ordered_json& json, const std::string& key, JobCap& cap);

void put_schema(nlohmann::ordered_json& at, const JobCap& cap);

// Throws the same unless caps and holes are in order, and point and axis of each hole in setup coordinates are those of
// its cap, to 1e-6.
void check_caps(const std::vector<JobCap>& caps, const Pose& piece_in_setup);

// Why the templates of a job do not belong to its caps: one that is missing, or one of no cap. Empty: they do.
std::string fault_of_templates(const std::vector<JobCap>& caps, const std::map<std::string, Bytes>& files);

}  // namespace qchopper

// What holds a piece, in the JSON of a job file and of reports (docs/developer/formats/job-folder.md).
//
// What is read is what was written (tests/cam/job/job_file_test.cpp).

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cam/setup/workholding.h"

namespace qchopper {

nlohmann::ordered_json from_workholding(const Workholding& check);

// Throws std::runtime_error that names the key.
Workholding to_workholding(const nlohmann::ordered_json& json);

}  // namespace qchopper

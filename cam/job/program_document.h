// The programs in the manifest of a job file, as JSON.
//
// What is read is what was written (tests/cam/job/job_program_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/files/file.h"
#include "cam/job/job_cap.h"
#include "cam/job/job_program.h"

namespace qchopper {

// Precondition: all numbers are finite.
void put(nlohmann::ordered_json& at, const JobProgram& program);

// The inverse. Throws std::runtime_error that names the key and the reason.
void take(const nlohmann::ordered_json& json, const std::string& key, JobProgram& program);

void put_schema(nlohmann::ordered_json& at, const JobProgram& program);

// The same as a text of its own. What is read back is the same program; not of exactly such a text: throws
// std::runtime_error.
std::string to_json(const JobProgram& program);
JobProgram job_program_from_json(std::string_view text);

// Why the files of a job do not belong to its program: a file that is missing, or a program file that the program does
// not name. Empty: they do.
std::string fault_of_program_files(const std::optional<JobProgram>& program, const std::map<std::string, Bytes>& files);

// Why the tools of a program are not those that the operator allows; none: all are. Empty: they are.
std::string fault_of_tools(const std::optional<JobProgram>& program, const std::vector<std::uint16_t>& allowed);

// Why the holes that a program drills are not those of the caps that are the robot's: of a part of several, or of a
// restart, each must be one of them, otherwise they are the same. Empty: they are.
std::string fault_of_holes(const std::optional<JobProgram>& program, const std::vector<JobCap>& caps);

}  // namespace qchopper

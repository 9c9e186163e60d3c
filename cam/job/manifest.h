// The manifest of a job file: what the job is and the SHA-256 of every other file in it.
//
// Forth and back is identity (tests/cam/job/job_file_test.cpp). The grammar is in docs/job-folder.md.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cam/job/job.h"

namespace qchopper {

// `entries` are the other files, sorted by name.
std::string to_manifest(const JobInput& input, const std::vector<JobEntry>& entries);

// Fills all of ReadJob but ticket, files, file_size and file_sha256. Throws InputError (mesh) naming `source`.
ReadJob from_manifest(std::string_view text, const std::string& source);

}  // namespace qchopper

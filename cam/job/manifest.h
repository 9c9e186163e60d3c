// Writes and reads the manifest of a job file: what the job is, and the SHA-256 of every other file in it.
//
// What is read is what was written (tests/cam/job/job_file_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cam/job/job.h"

namespace qchopper {

// What the manifest and the setup sheet tell of the other ways to lay the piece.
std::vector<Alternative> alternatives_of(const JobInput& input);

// JSON text. `entries` are the other files, sorted by name. Precondition: all numbers are finite.
std::string to_manifest(const JobInput& input, std::vector<JobEntry> entries);
// The same of a job that was read, with its own entries.
std::string to_manifest(const ReadJob& job);

// Fills all of ReadJob but ticket, files, file_size and file_sha256. Throws InputError (mesh) naming `source` and the
// key if a value is missing, of another kind or out of range, or if the text is not in the form that to_manifest
// writes.
ReadJob from_manifest(std::string_view text, const std::string& source);

}  // namespace qchopper

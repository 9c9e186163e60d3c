// The verdict on a job: what reading its program back and replaying it found, bound to the bytes of the job file and of
// the cell file.
//
// It stands beside the job, as NAME.verdict.json for NAME.qjob. What is read is what was written
// (tests/app/jobs/job_verdict_test.cpp). docs/developer/formats/verdict.md holds the grammar.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/sha256.h"
#include "cam/job/job_program.h"

namespace qchopper {

// The result of a proof, bound to a job file and a cell file.
struct JobVerdict : ProofResult {
    std::string piece;
    std::string job;  // name of the job file
    Sha256 job_sha256;
    std::string cell;  // its name
    Sha256 cell_sha256;
    std::string program_version;  // of qchopper
    // Whether the job was proven: it holds a program, and nothing was found.
    bool is_positive = false;
    bool operator==(const JobVerdict&) const = default;
};

// JSON text. Precondition: all numbers are finite, at most max_listed_findings findings.
std::string to_json(const JobVerdict& verdict);
// The inverse. Throws InputError (mesh) naming `source`.
JobVerdict job_verdict_from_json(std::string_view text, const std::string& source);

// jobs/B.verdict.json for jobs/B.qjob.
std::filesystem::path verdict_file(const std::filesystem::path& job);

// Throws what write_file throws.
void write_verdict(const std::filesystem::path& job, const JobVerdict& verdict);
// Nothing if there is no such file. Throws InputError (mesh) if it is none.
std::optional<JobVerdict> read_verdict(const std::filesystem::path& job);

}  // namespace qchopper

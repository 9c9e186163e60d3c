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

// What speaks against a job.
struct VerdictFinding {
    std::string kind;      // "rapid_in_foam"
    std::string file;      // of the program; empty: of no file
    std::size_t line = 0;  // from 1; 0: of the whole file
    std::string text;      // one sentence without a full stop
    bool operator==(const VerdictFinding&) const = default;
};

struct JobVerdict {
    std::string piece;
    std::string job;  // name of the job file
    Sha256 job_sha256;
    std::string cell;  // its name
    Sha256 cell_sha256;
    std::string program_version;       // of qchopper
    std::vector<ProofFigure> figures;  // of the replay; none where there was nothing to replay
    std::vector<VerdictFinding> findings;
    std::size_t findings_left_out = 0;  // beyond those listed
    std::vector<std::string> notes;     // what is to be known and speaks not against it: as findings, one sentence each
    // Whether the job was proven: it holds a program, and nothing was found.
    bool is_positive = false;
    bool operator==(const JobVerdict&) const = default;
};

constexpr std::size_t max_listed_findings = 100;

// "qc_1_002.src line 17: the tip moves at 150 mm/s while it cuts, more than 120".
std::string describe(const VerdictFinding& finding);

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

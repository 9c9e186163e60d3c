// Checks that a job file is the one that the project ordered, before it is sent.
//
// prepare writes each job's SHA-256, piece and project id into project.json (written_job); check_ordered compares the
// file with them, with the decisions and with the cell (tests/app/cli/ordered_job_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/store/project.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"

namespace qchopper {

// First 16 bytes of a SHA-256 over the scan and the decisions: the same cuts of the same scan have the same id.
Uuid project_id(const Project& project);

// The record of a job file for project.json. O(bytes).
WrittenJob written_job(const std::string& piece, const Bytes& file, const Uuid& project_id, std::uint16_t part = 1);

// The jobs that the project has on record for a piece, in the order of its parts.
std::vector<WrittenJob> written_jobs_of(const Project& project, const std::string& piece);

// The job files of restarts of a part of a piece in the folder of a project, by their chunks.
std::vector<std::filesystem::path> restart_files(const std::filesystem::path& folder, const std::string& piece,
                                                 std::uint16_t part);

// WrittenJob::place by piece, of those that have one.
std::map<std::string, BlockPlacement> recorded_places(const Project& project);

// The references must outlive the order.
struct JobOrder {
    const Project& project;
    const std::string& piece;
    const WrittenJob& written;
    const Cell& cell;
    std::filesystem::path folder;  // of the project
    std::filesystem::path file;
};

// Throws InputError (mesh) with the first difference, if the job is not the one that was ordered.
void check_ordered(const ReadJob& job, const JobOrder& order);

// Throws InputError (mesh): there is a job file, but no record to compare it with.
[[noreturn]] void refuse_unrecorded(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace qchopper

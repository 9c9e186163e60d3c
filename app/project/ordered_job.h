// Whether a job file is the one that the project ordered: what dry-run and dispatch ask before anything is sent.
//
// prepare writes each job's SHA-256, piece and project id into project.json (written_job); check_ordered holds the file
// that is about to be sent against them, against the decisions and against the cell (tests/app/cli/hand_over_test.cpp).

#pragma once

#include <filesystem>
#include <string>

#include "app/project/project.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"

namespace qchopper {

// First 16 bytes of a SHA-256 over the scan and the decisions: the same cuts of the same scan, the same id.
Uuid project_id(const Project& project);

// What the project keeps of a job file.
WrittenJob written_job(const std::string& piece, const Bytes& file, const Uuid& project_id);

// Nothing if the project has no record of a job for that piece.
const WrittenJob* written_job_of(const Project& project, const std::string& piece);

struct JobOrder {
    const Project& project;
    const std::string& piece;
    const Cell& cell;
    std::filesystem::path folder;  // of the project
    std::filesystem::path file;
};

// Throws InputError (mesh) that says in which way the job is not the one that was ordered.
void check_ordered(const ReadJob& job, const JobOrder& order);

// Throws InputError (mesh): there is a job file, but nothing to hold it against.
[[noreturn]] void refuse_unrecorded(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace qchopper

// The restart of a job that was stopped: the job that goes on with it is made, proven, and put in the place of the
// jobs of its piece.
//
// Nothing is asked of the cell here, and nothing moves. The file stays in the project, "jobs/B.r5.qjob", with its
// verdict; the same chunk of the same job gives the same bytes, so that the hand-off knows it again
// (tests/app/cli/restart_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"
#include "app/store/project_context.h"
#include "base/sentence.h"

namespace qchopper {

// Chunks count from 1 over all parts of the piece, as in the names of their files.
struct MadeRestart {
    std::uint32_t ordered_chunk = 0;
    std::uint32_t from_chunk = 0;   // with which it begins: not after the one that was ordered
    std::string chunk_file;         // of that chunk
    std::string job;                // name of its job file
    Sha256 of;                      // of the job file that it goes on with
    std::vector<Sentence> refused;  // why it is not handed over; empty: it may be
};

// Makes it from the job of the piece that holds the chunk. Where it is not refused `ordered` holds it alone.
// Precondition: `ordered` holds all jobs of one piece, with their verdicts. Throws InputError: (use) the piece has no
// such chunk, and what make_restart() (app/dispatch/restart_job.h) throws; (busy) another program writes the project;
// what write_file throws. Throws Cancelled.
MadeRestart put_restart_in_place(ProjectJobs& ordered, std::uint32_t chunk, const std::string& program_version,
                                 const ProjectContext& context);

}  // namespace qchopper

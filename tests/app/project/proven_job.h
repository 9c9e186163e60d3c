// Jobs of one small piece with the programs that the post writes for it in a ready cell, made once per process.

#pragma once

#include <map>
#include <string>

#include "app/project/verify_jobs.h"

namespace qchopper {

struct ProvenJob {
    CellFile cell;
    ReadJob job;         // as read back from its bytes
    JobVerdict verdict;  // as prepare writes it, but for the version
};

// Of the piece of tests/app/ball_cap.h. `cell_name` as in cells/NAME.toml.
const ProvenJob& proven_job(const std::string& cell_name);

// What verify says of a job in that cell, which has passed parse_job.
JobVerdict judged(const ReadJob& job, const CellFile& cell);

}  // namespace qchopper

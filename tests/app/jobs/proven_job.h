// Jobs of one small piece with the programs that the post writes for it in a ready cell, made once per process.

#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/dispatch/verify_jobs.h"
#include "app/jobs/piece_program.h"
#include "tests/sim/replay/mutations.h"

namespace qchopper {

struct ProvenJob {
    CellFile cell;
    JobInput input;      // from which the job was written
    ReadJob job;         // as read back from its bytes
    JobVerdict verdict;  // as prepare writes it, but for the version
};

// The caps of a piece that lies in a setup.
using CapsOf = std::function<std::vector<DrawnCap>(const Setup&)>;

// `change` changes the ready cell before.
ProvenJob made_and_proven(const std::string& cell_name, const Piece& piece, const CapsOf& caps = {},
                          FineTools fine = FineTools::worthwhile, const std::function<void(Cell&)>& change = {});

// Of the piece of tests/app/ball_cap.h. `cell_name` as in cells/NAME.toml.
const ProvenJob& proven_job(const std::string& cell_name);

// The texts of its program.
ProgramFiles texts_of(const ReadJob& job);

// The job with these texts in place of its program's: names, sizes and hashes are made again, and what the manifest
// says of each chunk is taken from the texts.
ReadJob remade(const ProvenJob& proven, const ProgramFiles& files);

// What verify says of a job in that cell, which has passed parse_job.
JobVerdict judged(const ReadJob& job, const CellFile& cell);

}  // namespace qchopper

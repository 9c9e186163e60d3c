// A job that goes on where another one was stopped, from one of its chunks.
//
// The chunk in which the machine stood may be carved in part. It is carved once more, and in the model none of its foam
// is missing: what the proof finds to be free of foam is free, and rapids meet rather less foam than it knows of. The
// chunks are those of the first job, byte for byte; stock.bin is what those before them leave
// (tests/app/dispatch/restart_job_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/jobs/job_proof.h"
#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"

namespace qchopper {

// A chunk of a job that parse_job took and that holds a program. All outlive the order.
struct RestartOrder {
    const ReadJob& first;             // the job that was stopped
    const std::string& source;        // its file, for messages
    const Cell& cell;                 // with a machine
    std::size_t chunk = 0;            // index in first.program->chunks: where the machine stood
    std::uint32_t chunks_before = 0;  // of the parts before that of the job
};

struct RestartJob {
    Bytes file;             // the job file
    std::string name;       // of it: "B.r5.qjob"
    std::size_t chunk = 0;  // index in first.program->chunks with which it begins
    JobProof proof;
};

// Begins with the chunk that is ordered if that may be started from home, else with the last one before it that may:
// the first chunk of an operation always may. The same order gives the same bytes. Throws InputError: (use) the job has
// no such chunk, it would begin with the first one, or a tool of it is not in the cell file; (mesh) naming the source,
// its program or its stock cannot be read; and what post_restart() (cam/post/post.h) throws. Throws Cancelled. Costs
// the replay of the chunks before the first one, and the proof of the others.
RestartJob make_restart(const RestartOrder& order, const Context& context = {});

// What of a restart does not follow from the first job: other bytes of it, another manifest, other chunks, another
// stock. None: all of it does. Precondition: the program of the restart has a `restart`. Throws Cancelled. Costs the
// replay of the chunks that are not carved again.
std::vector<ProofFinding> faults_of_restart(const ReadJob& restart, const ReadJob& first, const std::string& source,
                                            const Cell& cell, const Context& context = {});

}  // namespace qchopper

// The proof that the program of a job mills its piece: the texts are read back and replayed in a block of foam.
//
// Nothing but what stands in the job file and in the cell file is used; reading and replay are those of sim, which
// knows neither the toolpath nor the post (tests/architecture/includes.py).

#pragma once

#include <string>
#include <vector>

#include "app/jobs/job_scene.h"
#include "base/context.h"
#include "base/files/file.h"
#include "cam/job/job_program.h"

namespace qchopper {

struct JobProof : ProofResult {     // at most max_listed_findings
    std::vector<JobChunk> chunks;   // as read back; none if the texts cannot be read
    std::vector<float> deviation;   // mm, per triangle: positive where foam stays, negative where it is cut into
    std::vector<bool> is_given_up;  // per triangle; empty before the last part
    double time_s = 0;
    double length_mm = 0;
    Bytes stock_left;  // stock.bin for the next part, if there is one and the program could be replayed
};

// Throws Cancelled. Faults of the program are findings.
JobProof prove(const ProofInput& input, const Context& context = {});

}  // namespace qchopper

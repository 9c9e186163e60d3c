// Which jobs may be sent to which cell, by their programs and verdicts.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"

namespace qchopper {

// Per reason for which jobs may not be sent one sentence without a full stop: which jobs, why, what to do. To any cell
// goes no job whose verdict is negative, or is that of other bytes of the job or of the cell file; to a real one none
// either that has no verdict or no program.
std::vector<std::string> unproven_jobs(const ProjectJobs& jobs, bool is_real);

// The same for jobs that go to a simulated cell only, because they have no program or no verdict.
std::vector<std::string> simulated_only_jobs(const ProjectJobs& jobs);

// The same for jobs whose signature file is wrong, and for those without one where the cell file requires one. A wrong
// signature is refused under any policy: somebody meant it to be checked.
std::vector<std::string> wrongly_signed_jobs(const ProjectJobs& jobs, const TrustedKeys& trusted, std::uint64_t now_ms);

}  // namespace qchopper

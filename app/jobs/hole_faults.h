// The holes that a job lists against those that the joints of its project give the piece.
//
// mm. Faults are findings (docs/developer/formats/verdict.md): `other_joint` for a joint too many or missing,
// `other_hole` for a hole that is missing, too many, shifted, or of another diameter, depth or mate. A hole of the job
// is held against the nearest one of the same cap. tests/app/jobs/hole_faults_test.cpp.

#pragma once

#include <string>
#include <vector>

#include "app/jobs/job_verdict.h"
#include "cam/job/job_cap.h"

namespace qchopper {

// Who drills a hole is not compared: that follows from the program. Precondition: both stand in the same setup.
// O(holes squared).
std::vector<ProofFinding> hole_faults(const std::string& piece, const std::vector<JobCap>& job,
                                      const std::vector<JobCap>& project);

}  // namespace qchopper

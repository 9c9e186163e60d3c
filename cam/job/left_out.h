// What a program leaves out, in sentences for people.
//
// Without a full stop; the setup sheet, the verdict and the reports say the same (tests/cam/job/job_program_test.cpp).

#pragma once

#include <string>

#include "cam/job/job_program.h"

namespace qchopper {

// "no hold of the arm carries 6 mm of its cuts: ...". Empty if none is left out.
std::string describe(const MovesLeftOut& moves);

}  // namespace qchopper

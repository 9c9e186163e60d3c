// The block on the table of the simulated cell, as a job has carved it so far.
//
// PNG, seen from above at an angle. The stock is that of the replay with cells of 1 mm and rounded corners; a part but
// the first begins with what the part before leaves. Same input, same bytes, whatever the number of threads
// (tests/app/jobs/executed_program_test.cpp).

#pragma once

#include <string>

#include "base/context.h"
#include "base/files/file.h"
#include "cam/cell/cell.h"

namespace qchopper {

// After so many seconds of the program: a line that is not finished is left out. Throws InputError: what parse_job and
// the reader of programs throw, (use) a job without a program; Cancelled. Precondition: the cell has a machine.
Bytes block_picture(const Bytes& job_file, const std::string& name, const Cell& cell, double run_s,
                    const Context& context = {});

}  // namespace qchopper

// What the simulated cell executes: the program of a job file, read back from its text and followed on the machine of
// the cell file.
//
// Reading, way and times are those of the proof (sim/program, sim/replay): a run takes the time that the proof states.
// mm in the frame of the setup, seconds. O(bytes) and O(moves) (tests/app/jobs/executed_program_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "cam/cell/cell.h"
#include "sim/cell/program_run.h"

namespace qchopper {

// Nothing where the job holds no program. A file that is no job, a program in another language than the cell file says,
// and a line that the reader refuses are faults, told with file and line. Precondition: the cell has a machine.
ReceivedProgram executed_program(const Bytes& job_file, const std::string& name, const Cell& cell);

// The same for a simulated cell with this cell file; empty where it describes no machine: then no program can be
// followed.
ProgramReader program_reader(const Cell& cell);

}  // namespace qchopper

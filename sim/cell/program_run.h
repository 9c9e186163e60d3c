// The program of a job as the simulated cell executes it: which line is executed when, with which tool, and where the
// tip is then.
//
// Plain values, made once when the job file has come; what reads programs is handed in by the caller (ProgramReader).
// Seconds of the job's time since the program began; mm in the base frame of the program. Each question is answered by
// a binary search, O(log steps) and O(steps of the line) (tests/sim/cell/program_run_test.cpp).

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/vec3.h"

namespace qchopper {

// What the tip does until `end_s`: it goes straight from where the step before it ended.
struct RunStep {
    double end_s = 0;         // not below that of the step before
    std::uint32_t block = 0;  // devices/wire/program_block.h
    std::uint16_t tool = 0;   // number of the tool in the spindle
    Vec3 tip;                 // at its end
};

// A line at which the program waits for an input.
struct RunWait {
    double at_s = 0;
    std::uint32_t input = 0;  // its number; 0: it has a name
    std::uint32_t block = 0;
};

// Preconditions of all functions below: at least one step.
struct JobRun {
    std::vector<RunStep> steps;
    std::vector<RunWait> waits;
    double seconds = 0;  // the end of the last step
};

// During the step in which a moment lies; after the end that of the last one.
struct RunPlace {
    std::uint32_t block = 0;
    std::uint16_t tool = 0;
    Vec3 tip;
};
RunPlace place_at(const JobRun& run, double at_s);

// When the line ends that is executed at a moment: the next moment at which a Hold may stop. A moment between two lines
// is one.
double line_end(const JobRun& run, double at_s);

// When, not before `from_s`, the first line begins whose block is this one or a later line of the same file. Nothing:
// none follows.
std::optional<double> begin_of_block(const JobRun& run, std::uint32_t block, double from_s);

// What was found in a job file. Neither a run nor a fault: the job holds no program.
struct ReceivedProgram {
    std::shared_ptr<const JobRun> run;
    std::string fault;             // why the program cannot be executed, with its file and line; empty: it can
    std::uint32_t fault_line = 0;  // in its file; 0: the fault is of no line
};

// Reads a job file whose bytes are those of its ticket. Called in a thread of the cell that nothing waits for but
// VERIFY; it throws nothing.
using ProgramReader = std::function<ReceivedProgram(const Bytes& job_file, const std::string& name)>;

}  // namespace qchopper

// Runs the steps of a specimen with one or two programs by turns, each in a folder of its own.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/child.h"
#include "bench/command_steps.h"

namespace qchopper::bench {

struct TimedStage {
    std::string name;
    double wall_s = 0;
};

// The least of all runs of a step, each figure by itself.
struct StepFigures {
    bool has_run = false;  // false: it was not run, or failed
    double wall_s = 0;
    double cpu_s = 0;
    double peak_bytes = 0;
    std::vector<TimedStage> stages;  // of the run with the least wall time; empty if the program does not time them
};

// A program that is measured. Projects that its steps keep lie in its folder.
class MeasuredProgram {
 public:
    // Makes the folder. Throws std::filesystem::filesystem_error.
    MeasuredProgram(std::filesystem::path program, std::filesystem::path folder);

    // Runs the step and adds it to the figures. A step has failed if its exit code is neither 0 nor 1 (a demand is not
    // met); what it said is then shown on stderr.
    void run(const CommandStep& step, StepFigures& figures) const;
    // Forgets the kept projects.
    void clear() const;

 private:
    std::vector<std::string> command(const CommandStep& step) const;
    ChildStreams streams() const;

    std::filesystem::path program_;
    std::filesystem::path folder_;
    bool knows_timings_ = false;
};

}  // namespace qchopper::bench

// Wall and CPU time of the stages of a run, for those who want to know where the time goes (--timings).
//
// Times in seconds, memory in bytes. A stage inside another one counts by itself and not in the outer one, so that the
// times of all stages add up to at most those of the run (tests/base/timings_test.cpp). Stages begin and end on one
// thread; CPU time is that of all threads of the process.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/context.h"

namespace qchopper {

struct SpentTime {
    double wall_s = 0;
    double cpu_s = 0;  // may exceed wall_s: all threads
};

struct StageTime {
    std::string name;  // "scan read"
    SpentTime spent;
};

struct RunTimes {
    std::vector<StageTime> stages;      // in the order of their first begin; each name once
    SpentTime whole;                    // from the start of the measurement
    std::size_t peak_memory_bytes = 0;  // resident, of the process so far
};

// Measures from its construction on.
class Timings {
 public:
    Timings();

    // A name that was begun before goes on. Every begin() needs an end(), the last begun first.
    void begin(const std::string& name);
    // Precondition: a stage is begun.
    void end();
    // Gives the time of the innermost stage so far to the stages of work that several threads did in it, each with
    // timings of its own: as shares of the wall time that the threads were busy. What was in none of their stages
    // stays. Precondition: a stage is begun.
    void divide(const std::vector<RunTimes>& work);
    // Those that are not ended count up to now.
    RunTimes so_far() const;

 private:
    SpentTime since_start() const;
    // Adds the time since the last change to the innermost stage.
    void add_up();
    // Index of the stage of that name, which is made if there is none.
    std::size_t stage_named(const std::string& name);

    SpentTime start_;
    SpentTime changed_;  // when a stage began or ended last, from start_
    std::vector<StageTime> stages_;
    std::vector<std::size_t> begun_;  // indices in stages_, the innermost last
};

// Begins a stage, and ends it when it goes out of scope. Measures nothing where there are no timings.
class StageTimer {
 public:
    StageTimer(Timings* timings, const std::string& name);  // `timings` outlives this object, or is null
    StageTimer(const Context& context, const std::string& name) : StageTimer(context.timings, name) {}
    ~StageTimer();
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

    // Ends the stage and begins another.
    void next(const std::string& name);
    // Timings::divide() of this stage.
    void divide(const std::vector<RunTimes>& work);

 private:
    Timings* timings_;
};

}  // namespace qchopper

// One schedule of faults, drawn from its seed: link faults, kills of a dispatcher, power cuts, stores lost, journals
// set back, two PCs. With every odd seed the cell requires signed tickets, and the dispatchers sign them.
//
// After some minutes of virtual time the faults end, and the dispatchers go on until each has a last word for each of
// its jobs. The judge is World.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace qchopper::schedules {

struct ScheduleEnd {
    int jobs = 0;  // that were ordered
    int lost = 0;  // of them never started, without the word UNKNOWN
    int double_starts = 0;
    int wrong_reports = 0;
    int hangs = 0;
    // What happened, to see that the schedules are no empty exercise.
    int link_faults = 0;
    int kills = 0;
    int power_cuts = 0;
    int stores_lost = 0;
    int journals_set_back = 0;
    int said_started = 0;
    int said_not_started = 0;
    int said_unknown = 0;
    std::vector<std::string> log;

    bool is_right() const { return lost + double_starts + wrong_reports + hangs == 0; }
    void add(const ScheduleEnd& other);  // without the log
};

// `on_line` is told each line of the log at once; it may be empty.
ScheduleEnd run_schedule(std::uint64_t seed, const std::function<void(const std::string&)>& on_line = {});

}  // namespace qchopper::schedules

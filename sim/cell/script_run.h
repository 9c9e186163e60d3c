// Performs the lines of a script on a simulated cell, one after the other, each when its time has come.
//
// tests/sim/cell/script_test.cpp

#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "sim/cell/cell_sim.h"
#include "sim/cell/script.h"

namespace qchopper {

class ScriptRun {
 public:
    // `show` prints what the command show asks for. Once `is_stopped` says so, step() does no more, also in the middle
    // of a wait on a virtual clock; it may be empty.
    ScriptRun(CellSim& cell, std::function<void(const std::string&)> show, std::function<bool()> is_stopped = {})
        : cell_(cell), show_(std::move(show)), is_stopped_(std::move(is_stopped)) {}
    void add(const ScriptLine& line) { lines_.push_back(line); }
    void add(const std::vector<ScriptLine>& lines) { lines_.insert(lines_.end(), lines.begin(), lines.end()); }
    bool is_idle() const { return lines_.empty(); }

    // Performs what is due; to be called again and again, every 20 ms. A line that waits lets the next ones wait. False
    // after quit.
    bool step();

 private:
    bool is_done(const ScriptLine& line);

    CellSim& cell_;
    std::function<void(const std::string&)> show_;
    std::function<bool()> is_stopped_;
    std::deque<ScriptLine> lines_;
    std::int64_t waits_until_ms_ = -1;  // of the cell's clock; below 0: the first line has not begun to wait
};

}  // namespace qchopper

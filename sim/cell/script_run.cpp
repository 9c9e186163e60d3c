// A queue whose first line is tried until it is done. O(lines that are due).

#include "sim/cell/script_run.h"

#include <cmath>

namespace qchopper {
namespace {

constexpr double patience_step_s = 0.1;  // by which a virtual clock goes on while a line waits for something

std::string line_about(const Status& s) {
    return std::string(name(s.state)) + ", job " + name(s.job_state) + ", progress " +
           std::to_string(s.progress / 100) + " %, boot " + std::to_string(s.boot_count) + ", epoch " +
           std::to_string(s.epoch_held) + ", starts " + std::to_string(s.starts_total);
}

}  // namespace

// A script waits on the cell's clock: on a virtual one by letting it go on.
bool ScriptRun::is_done(const ScriptLine& line) {
    switch (line.act) {
        case Act::show:
            show_(line_about(cell_.status()));
            return true;
        case Act::wait: {
            if (cell_.is_clock_virtual()) {
                cell_.pass(line.number, is_stopped_);
                return true;
            }
            const std::int64_t now_ms = cell_.steady_ms();
            if (waits_until_ms_ < 0) waits_until_ms_ = now_ms + std::llround(1000 * line.number);
            return now_ms >= waits_until_ms_;
        }
        case Act::wait_for:
            if (cell_.holds(line.choice)) return true;
            if (cell_.is_clock_virtual()) cell_.pass(patience_step_s);
            return false;
        default:
            return cell_.perform(line);
    }
}

bool ScriptRun::step() {
    while (!lines_.empty() && !(is_stopped_ && is_stopped_())) {
        const ScriptLine line = lines_.front();
        if (line.act == Act::quit) return false;
        if (!is_done(line)) return true;
        waits_until_ms_ = -1;
        lines_.pop_front();
    }
    return true;
}

}  // namespace qchopper

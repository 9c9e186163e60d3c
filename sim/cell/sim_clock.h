// The clock of a simulated cell: that of the computer, or one that goes on only when it is told to.
//
// It never goes back, also where it is changed from one kind to the other. Not thread-safe.

#pragma once

#include <chrono>

#include "sim/cell/cell_state.h"

namespace qchopper {

class SimClock {
 public:
    CellTime now() const {
        if (is_virtual_) return shown_;
        const CellTime real = read();
        return {real.steady_ms + ahead_ms_, real.unix_ms + static_cast<std::uint64_t>(ahead_ms_)};
    }
    bool is_virtual() const { return is_virtual_; }
    void set_virtual(bool is_virtual) {
        shown_ = now();
        is_virtual_ = is_virtual;
        ahead_ms_ = shown_.steady_ms - read().steady_ms;
    }
    // Precondition: the clock is virtual.
    void pass(std::int64_t ms) {
        shown_.steady_ms += ms;
        shown_.unix_ms += static_cast<std::uint64_t>(ms);
    }

 private:
    static CellTime read() {
        using namespace std::chrono;
        const auto steady = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
        const auto unix_time = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
        return {steady, static_cast<std::uint64_t>(unix_time)};
    }

    bool is_virtual_ = false;
    CellTime shown_;             // of the virtual clock
    std::int64_t ahead_ms_ = 0;  // of the computer's clock
};

}  // namespace qchopper

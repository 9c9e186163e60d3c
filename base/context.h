// What a long computation needs from its caller: where to report progress, whether to stop, and whether to be timed.
//
// Passed by reference and copied freely; what `cancelled` and `timings` point to must outlive all copies.

#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace qchopper {

// A count of work items: "37 of 120 planes evaluated". Of items that cost very different times it is per cent of the
// time of all, as estimated. Work that may take long reports 0 when it begins.
struct Progress {
    std::string what;  // "planes evaluated"
    std::size_t done = 0;
    std::size_t total = 0;  // 0: unknown
};

// Thrown by check_cancelled(); the caller keeps what was finished before.
struct Cancelled : std::runtime_error {
    Cancelled() : std::runtime_error("stopped") {}
};

class Timings;

struct Context {
    std::function<void(const Progress&)> on_progress;    // may be empty; called from one thread at a time
    std::function<void(const std::string&)> on_message;  // one line for the operator; may be empty
    const std::atomic<bool>* cancelled = nullptr;        // nullptr: cannot be cancelled
    Timings* timings = nullptr;                          // base/timings.h; nullptr: nothing is measured

    void progress(const std::string& what, std::size_t done, std::size_t total) const {
        if (on_progress) on_progress({what, done, total});
    }
    void message(const std::string& line) const {
        if (on_message) on_message(line);
    }
    // Throws Cancelled once the flag is set.
    void check_cancelled() const {
        if (cancelled != nullptr && cancelled->load()) throw Cancelled();
    }
};

}  // namespace qchopper

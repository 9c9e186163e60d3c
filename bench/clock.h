// Time: of this thread's processor, and of the wall.

#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace qchopper::bench {

// Seconds that this thread has computed. With one thread in all it does not count what other programs take.
inline double cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Least time of several runs. What a run returns is destroyed after the clock has stopped.
template <class Clock, class Work>
double best_of(int runs, Clock clock, const Work& work) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < runs; ++i) {
        const double started = clock();
        const auto result = work();
        best = std::min(best, clock() - started);
        static_cast<void>(result);
    }
    return best;
}

}  // namespace qchopper::bench

// Clocks: CPU time of this thread, CPU time of all threads, and wall time.

#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace qchopper::bench {

// CPU seconds of this thread: time that other programs and threads take is not counted.
inline double cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// CPU seconds of the whole process, for work that runs on threads of a library.
inline double process_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Least time of several runs; infinity for none. The result of a run is destroyed after its time is taken.
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

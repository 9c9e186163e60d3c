// Loops whose ranges run on several threads.
//
// Computations use threads only through these functions: parallel_tbb.cpp runs the loops on TBB; parallel_threads.cpp
// runs them on std::thread for the build under the thread sanitizer, which sees no synchronisation inside TBB. Which
// range runs on which thread, and in which order, is unspecified: work must not depend on it
// (tests/base/parallel_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>

namespace qchopper {

// Calls work(first, end) for disjoint half-open ranges that cover [begin, end); only the last may be shorter than half
// of `grain`, which is at least 1. Returns when all calls have ended. If calls throw, ranges not yet begun may be left
// out, and one of the exceptions is thrown again. Loops inside `work` are allowed.
void parallel_ranges(std::size_t begin, std::size_t end, std::size_t grain,
                     const std::function<void(std::size_t first, std::size_t end)>& work);

// Calls work(i) once for each i of [begin, end). Exceptions as in parallel_ranges.
template <class Work>
void parallel_for(std::size_t begin, std::size_t end, const Work& work) {
    parallel_ranges(begin, end, 1, [&work](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) work(i);
    });
}

// Calls each function once. Exceptions as in parallel_ranges.
inline void parallel_invoke(std::initializer_list<std::function<void()>> functions) {
    parallel_for(0, functions.size(), [&](std::size_t i) { functions.begin()[i](); });
}

// During its lifetime loops of the whole program use at most `count` threads (at least 1); of several limits the least
// holds.
class ThreadLimit {
 public:
    explicit ThreadLimit(std::size_t count);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace qchopper

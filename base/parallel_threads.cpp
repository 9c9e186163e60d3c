// On std::thread, for the build under the thread sanitizer: it sees every synchronisation. Each loop starts new
// threads, and a loop inside a range of another one starts none: slower than TBB, which does not matter in that build.

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace qchopper {
namespace {

// Not the number of cores: the more the threads interleave, the more the sanitizer finds.
constexpr std::size_t usual_threads = 4;
constexpr std::size_t ranges_per_thread = 4;

std::mutex limits_mutex;
std::multiset<std::size_t> limits;
thread_local bool is_inside_a_loop = false;

std::size_t thread_count() {
    const std::lock_guard lock(limits_mutex);
    return limits.empty() ? usual_threads : std::min(usual_threads, *limits.begin());
}

}  // namespace

void parallel_ranges(std::size_t begin, std::size_t end, std::size_t grain,
                     const std::function<void(std::size_t first, std::size_t end)>& work) {
    if (begin >= end) return;
    const std::size_t count = end - begin;
    const std::size_t threads = std::min(thread_count(), (count + grain - 1) / grain);
    if (threads <= 1 || is_inside_a_loop) {
        work(begin, end);
        return;
    }
    const std::size_t step = std::max(grain, count / (ranges_per_thread * threads));
    std::atomic<std::size_t> next = begin;
    std::atomic<bool> has_failed = false;
    std::mutex exception_mutex;
    std::exception_ptr exception;  // the first of any thread
    const auto run = [&] {
        is_inside_a_loop = true;
        try {
            for (std::size_t first = next.fetch_add(step); first < end && !has_failed; first = next.fetch_add(step)) {
                work(first, std::min(end, first + step));
            }
        } catch (...) {
            const std::lock_guard lock(exception_mutex);
            if (!exception) exception = std::current_exception();
            has_failed = true;
        }
        is_inside_a_loop = false;
    };
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back(run);
    run();
    for (std::thread& other : others) other.join();
    if (exception) std::rethrow_exception(exception);
}

struct ThreadLimit::State {
    std::multiset<std::size_t>::iterator place;
};

ThreadLimit::ThreadLimit(std::size_t count) : state_(new State) {
    const std::lock_guard lock(limits_mutex);
    state_->place = limits.insert(count);
}

ThreadLimit::~ThreadLimit() {
    const std::lock_guard lock(limits_mutex);
    limits.erase(state_->place);
}

}  // namespace qchopper

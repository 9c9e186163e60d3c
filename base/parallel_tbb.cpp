// On TBB, which shares its threads among nested loops. One indirect call per range, none per index.

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "base/parallel.h"

namespace qchopper {

void parallel_ranges(std::size_t begin, std::size_t end, std::size_t grain,
                     const std::function<void(std::size_t first, std::size_t end)>& work) {
    if (begin >= end) return;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) { work(range.begin(), range.end()); });
}

struct ThreadLimit::State {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t count)
    : state_(new State{{tbb::global_control::max_allowed_parallelism, count}}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace qchopper

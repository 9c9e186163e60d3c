// Built twice: once with the loops on TBB, once with those on std::thread.

#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace qchopper {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
    for (const std::size_t begin : {0U, 7U}) {
        for (const std::size_t count : {0U, 1U, 2U, 3U, 16U, 17U, 1000U, 4097U}) {
            std::vector<std::atomic<int>> visits(begin + count);
            parallel_for(begin, begin + count, [&](std::size_t i) { ++visits[i]; });
            for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], i < begin ? 0 : 1) << i;
        }
    }
}

TEST(Parallel, RangesAreDisjointAndNotSmallerThanHalfTheGrain) {
    constexpr std::size_t grain = 64;
    std::mutex mutex;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    parallel_ranges(10, 5000, grain, [&](std::size_t first, std::size_t end) {
        const std::lock_guard lock(mutex);
        ranges.emplace_back(first, end);
    });
    std::sort(ranges.begin(), ranges.end());
    std::size_t at = 10;
    for (const auto& [first, end] : ranges) {
        EXPECT_EQ(first, at);
        if (end != 5000) {
            EXPECT_GE(end - first, grain / 2);  // TBB halves what is longer than a grain
        }
        at = end;
    }
    EXPECT_EQ(at, 5000U);
}

TEST(Parallel, ALoopInsideALoopVisitsEveryPairOnce) {
    std::vector<std::atomic<int>> visits(30 * 40);
    parallel_for(0, 30, [&](std::size_t i) { parallel_for(0, 40, [&, i](std::size_t j) { ++visits[40 * i + j]; }); });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
}

TEST(Parallel, AnExceptionComesOutOfTheLoop) {
    const auto fail_at_500 = [](std::size_t i) {
        if (i == 500) throw std::runtime_error("at 500");
    };
    EXPECT_THROW(parallel_for(0, 1000, fail_at_500), std::runtime_error);
    std::atomic<int> visits = 0;
    parallel_for(0, 100, [&](std::size_t) { ++visits; });
    EXPECT_EQ(visits, 100) << "the loop after one that failed";
}

TEST(Parallel, ALimitOfOneUsesTheCallingThreadAlone) {
    const auto threads_of_a_loop = [] {
        std::mutex mutex;
        std::set<std::thread::id> threads;
        parallel_for(0, 64, [&](std::size_t) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            const std::lock_guard lock(mutex);
            threads.insert(std::this_thread::get_id());
        });
        return threads;
    };
    {
        const ThreadLimit one(1);
        const ThreadLimit three(3);  // the narrower limit counts
        EXPECT_EQ(threads_of_a_loop(), std::set<std::thread::id>{std::this_thread::get_id()});
    }
    if (std::thread::hardware_concurrency() > 1) {
        EXPECT_GT(threads_of_a_loop().size(), 1U);
    }
}

TEST(Parallel, InvokeCallsEachFunctionOnce) {
    int a = 0;
    int b = 0;
    int c = 0;
    parallel_invoke({[&] { a = 1; }, [&] { b = 2; }, [&] { c = 3; }});
    EXPECT_EQ(a + b + c, 6);
}

}  // namespace
}  // namespace qchopper

#include "app/engine/work_project.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace qchopper {
namespace {

const std::vector<double> efforts{9, 1, 25, 4, 4, 16, 1};

TEST(Shards, EveryItemIsInOneOfThem) {
    for (const std::size_t count : {1U, 2U, 3U, 7U, 9U}) {
        std::vector<std::size_t> all;
        for (std::size_t number = 0; number < count; ++number) {
            const std::vector<std::size_t> own = items_of({number, count}, efforts);
            all.insert(all.end(), own.begin(), own.end());
            EXPECT_EQ(own.empty(), number >= efforts.size());
        }
        std::sort(all.begin(), all.end());
        EXPECT_EQ(all, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << count;
    }
}

// Halves of 30 are the best that there are.
TEST(Shards, AreBalancedByEffortTheLargestFirst) {
    EXPECT_EQ(items_of({0, 2}, efforts), (std::vector<std::size_t>{2, 3, 1}));
    EXPECT_EQ(items_of({1, 2}, efforts), (std::vector<std::size_t>{5, 0, 4, 6}));
}

}  // namespace
}  // namespace qchopper

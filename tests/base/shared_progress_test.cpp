#include "base/shared_progress.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "base/parallel.h"

namespace qchopper {
namespace {

TEST(SharedProgress, CountsEachItemOnceWhateverThreadDidIt) {
    std::vector<Progress> told;
    Context context;
    context.on_progress = [&](const Progress& p) { told.push_back(p); };
    SharedProgress progress(context, "pieces", 200);
    parallel_for(0, 200, [&](std::size_t) { progress.add(1); });
    ASSERT_EQ(told.size(), 201U);
    for (std::size_t i = 0; i < told.size(); ++i) {
        EXPECT_EQ(told[i].done, i);
        EXPECT_EQ(told[i].total, 200U);
        EXPECT_EQ(told[i].what, "pieces");
    }
}

TEST(SharedProgress, AddsUpWhatPartsSayOfThemselvesAndCancelsThem) {
    std::size_t done = 0;
    std::atomic<bool> stop = false;
    Context context;
    context.cancelled = &stop;
    context.on_progress = [&](const Progress& p) {
        EXPECT_GE(p.done, done);
        done = p.done;
    };
    SharedProgress progress(context, "planes", 40 * 25);
    parallel_for(0, 40, [&](std::size_t) {
        const Context part = progress.of_part();
        for (std::size_t i = 0; i <= 25; i += 5) part.progress("planes", i, 25);
        EXPECT_NO_THROW(part.check_cancelled());
    });
    EXPECT_EQ(done, 40U * 25U);
    stop = true;
    EXPECT_THROW(progress.of_part().check_cancelled(), Cancelled);
}

}  // namespace
}  // namespace qchopper

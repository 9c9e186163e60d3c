#include "segment/search/end_reason.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(EndReason, HasItsFigureInTheSentence) {
    EXPECT_EQ(describe(EndReason::max_cuts, "500"), "the safety stop of 500 cuts is reached");
    EXPECT_EQ(describe(EndReason::time_limit, "0.5"), "the time limit of 0.5 s is reached");
}

}  // namespace
}  // namespace qchopper

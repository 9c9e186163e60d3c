#include "segment/search/end_reason.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(EndReason, IsFoundAgainInItsSentence) {
    for (const EndReason reason : {EndReason::rules_hold, EndReason::no_rule, EndReason::no_plane,
                                   EndReason::passed_over, EndReason::max_cuts, EndReason::time_limit}) {
        EXPECT_EQ(end_reason_of(describe(reason, "12")), reason) << describe(reason, "12");
        EXPECT_EQ(end_reason_of(describe(reason) + "; " + describe(EndReason::time_limit, "3")), reason);
    }
    EXPECT_EQ(end_reason_of(""), std::nullopt);
    EXPECT_EQ(end_reason_of("the stop rules"), std::nullopt);
}

TEST(EndReason, HasItsFigureInTheSentence) {
    EXPECT_EQ(describe(EndReason::max_cuts, "500"), "the safety stop of 500 cuts is reached");
    EXPECT_EQ(describe(EndReason::time_limit, "0.5"), "the time limit of 0.5 s is reached");
}

}  // namespace
}  // namespace qchopper

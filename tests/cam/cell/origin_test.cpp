#include "cam/cell/cell.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(Origin, AFileNamesTheFirstThreeAsTheyArePrinted) {
    for (const Origin origin : {Origin::data_sheet, Origin::measured, Origin::assumed}) {
        EXPECT_EQ(origin_of(to_word(origin)), origin);
    }
    for (const Origin origin : {Origin::unstated, Origin::by_default}) {
        EXPECT_FALSE(to_word(origin).empty());
        EXPECT_FALSE(origin_of(to_word(origin)));
    }
    EXPECT_FALSE(origin_of(""));
    EXPECT_FALSE(origin_of("Measured"));
}

}  // namespace
}  // namespace qchopper

#include <gtest/gtest.h>

#include "segment/picture/picture.h"
#include "tests/segment/picture/eyes.h"

namespace qchopper {
namespace {

TEST(Palette, TwelveColoursStayApartForEveryEye) {
    for (std::size_t i = 0; i < 12; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            EXPECT_GT(eyes::distance(piece_colour(i), piece_colour(k)), 20) << i << " and " << k;
        }
    }
}

TEST(Palette, BeginsAgainAfterTwelve) {
    EXPECT_EQ(piece_colour(12), piece_colour(0));
    EXPECT_EQ(piece_colour(31), piece_colour(7));
}

}  // namespace
}  // namespace qchopper

#include "cam/toolpath/packed_heights.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "segment/raster/height_field.h"

namespace qchopper {
namespace {

void expect_same_bits(const std::vector<float>& heights) {
    const std::vector<float> found = PackedHeights(heights).unpacked();
    ASSERT_EQ(found.size(), heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(found[i]), std::bit_cast<std::uint32_t>(heights[i])) << i;
    }
}

TEST(PackedHeights, AreTheSameToTheBit) {
    expect_same_bits({});
    expect_same_bits({1});
    expect_same_bits(std::vector<float>(1000, HeightField::nothing));
    std::vector<float> zeros(20, 0.0F);
    zeros.insert(zeros.end(), 20, -0.0F);
    zeros.insert(zeros.end(), 20, std::numeric_limits<float>::quiet_NaN());
    expect_same_bits(zeros);
    std::mt19937 random(1);
    for (int k = 0; k < 200; ++k) {
        std::vector<float> heights;
        while (heights.size() < 500) {
            const float value = static_cast<float>(random() % 5) - 2;
            heights.insert(heights.end(), 1 + random() % 20, value);
        }
        expect_same_bits(heights);
    }
}

TEST(PackedHeights, OfAMapThatIsEmptyButForOneTileTakeLittle) {
    std::vector<float> heights(1'000'000, HeightField::nothing);
    for (std::size_t row = 400; row < 416; ++row) {
        for (std::size_t column = 500; column < 516; ++column) {
            heights[1000 * row + column] = std::sin(static_cast<float>(row * column));
        }
    }
    EXPECT_LT(PackedHeights(heights).bytes(), 16 * 16 * sizeof(float) + 17 * 12 + 100);
    expect_same_bits(heights);
}

}  // namespace
}  // namespace qchopper

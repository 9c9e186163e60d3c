// Numbers in a buffer of glTF: their bounds, byte order and fractions.

#include "segment/io/formats/gltf_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace qchopper {
namespace {

constexpr std::array<std::uint8_t, 8> bytes{0x01, 0x02, 0xFF, 0x7F, 0x00, 0x80, 0xFF, 0xFF};

TEST(GltfNumbers, AreLittleEndianAtTheirStride) {
    const auto pairs = numbers_in({bytes, 0, 8, 4}, 0, GltfComponent::u16, 2, 2);
    ASSERT_TRUE(pairs);
    EXPECT_EQ(pairs->whole(0), 0x0201U);
    EXPECT_EQ(pairs->whole(0, 1), 0x7FFFU);
    EXPECT_EQ(pairs->whole(1), 0x8000U);
    EXPECT_EQ(pairs->whole(1, 1), 0xFFFFU);
}

TEST(GltfNumbers, AreFractionsWhereTheyAreNormalized) {
    const auto shorts = numbers_in({bytes, 2, 6, 0}, 0, GltfComponent::i16, 1, 3);
    ASSERT_TRUE(shorts);
    EXPECT_EQ(shorts->real(0, 0, false), 32767);
    EXPECT_EQ(shorts->real(0, 0, true), 1);
    EXPECT_EQ(shorts->real(1, 0, false), -32768);
    EXPECT_EQ(shorts->real(1, 0, true), -1) << "not below -1";
    EXPECT_EQ(shorts->real(2, 0, true), -1.0 / 32767);
}

TEST(GltfNumbers, EndWithTheirView) {
    for (const std::size_t offset : {0U, 1U, 2U}) {
        EXPECT_TRUE(numbers_in({bytes, 2, 6, 0}, offset, GltfComponent::u16, 1, (6 - offset) / 2)) << offset;
        EXPECT_FALSE(numbers_in({bytes, 2, 6, 0}, offset, GltfComponent::u16, 1, (6 - offset) / 2 + 1)) << offset;
    }
    EXPECT_TRUE(numbers_in({bytes, 0, 8, 3}, 0, GltfComponent::u16, 1, 3)) << "the last may end before its stride";
    EXPECT_FALSE(numbers_in({bytes, 0, 8, 7}, 0, GltfComponent::u16, 1, 2));
    EXPECT_FALSE(numbers_in({bytes, 2, 7, 0}, 0, GltfComponent::u8, 1, 1)) << "a view beyond its buffer";
    EXPECT_FALSE(numbers_in({bytes, 9, 0, 0}, 0, GltfComponent::u8, 1, 0));
}

TEST(GltfNumbers, HugeCountsDoNotOverflow) {
    constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
    EXPECT_FALSE(numbers_in({bytes, 0, 8, 0}, 0, GltfComponent::f32, 1, huge));
    EXPECT_FALSE(numbers_in({bytes, 0, 8, huge}, 0, GltfComponent::u8, 1, 2));
    EXPECT_FALSE(numbers_in({bytes, 4, huge, 0}, 0, GltfComponent::u8, 1, 1));
}

TEST(GltfNumbers, KnowTheCodesOfTheFormat) {
    for (const int code : {5120, 5121, 5122, 5123, 5125, 5126}) {
        ASSERT_TRUE(gltf_component(code));
        EXPECT_EQ(static_cast<int>(*gltf_component(code)), code);
    }
    for (const int code : {0, 5119, 5124, 5127}) EXPECT_FALSE(gltf_component(code)) << code;
}

}  // namespace
}  // namespace qchopper

#include "app/display/display_path.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"

namespace qchopper {
namespace {

DisplayPath some_path(std::size_t points) {
    std::mt19937 random(7);
    DisplayPath path;
    path.grid = {{-10, 2.5, 1e3}, 0.03};
    std::uint32_t ms = 0;
    for (std::size_t i = 0; i < points; ++i) {
        DisplayPoint point{};
        for (std::uint16_t& x : point) x = static_cast<std::uint16_t>(random() % (max_display_coordinate + 1U));
        path.points.push_back(point);
        ms += random() % (i % 7 == 0 ? 1'000'000 : 200);
        path.ms.push_back(ms);
        path.lines.push_back(random() % (i % 5 == 0 ? 2'000'000'000 : 300));
        path.kinds.push_back(static_cast<std::uint8_t>(random() % display_way_kinds));
    }
    return path;
}

TEST(DisplayPath, BytesGiveItBack) {
    for (const std::size_t points : {0U, 1U, 2U, 1000U}) {
        const DisplayPath path = some_path(points);
        ASSERT_TRUE(is_valid(path));
        const Bytes bytes = encode_display_path(path);
        EXPECT_EQ(decode_display_path(bytes), path);
        EXPECT_EQ(encode_display_path(path), bytes);
    }
}

TEST(DisplayPath, WhatIsCutOffOrLongerIsRefused) {
    const Bytes bytes = encode_display_path(some_path(20));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THROW(decode_display_path(std::span(bytes).first(size)), InputError) << size;
    }
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_THROW(decode_display_path(longer), InputError);
}

TEST(DisplayPath, ChangedBytesAreRefusedOrAnotherPath) {
    const Bytes bytes = encode_display_path(some_path(20));
    std::mt19937 random(11);
    std::size_t refused = 0;
    for (int i = 0; i < 5000; ++i) {
        Bytes changed = bytes;
        changed[random() % changed.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
        try {
            const DisplayPath path = decode_display_path(changed);
            EXPECT_TRUE(is_valid(path));
            EXPECT_EQ(encode_display_path(path), changed);
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
            ++refused;
        }
    }
    EXPECT_GT(refused, 500U);
}

TEST(DisplayPath, TimesThatGoBackAreNotValid) {
    DisplayPath path = some_path(3);
    path.ms = {5, 4, 6};
    EXPECT_FALSE(is_valid(path));
    path = some_path(3);
    path.kinds[1] = display_way_kinds;
    EXPECT_FALSE(is_valid(path));
    path = some_path(3);
    path.lines.pop_back();
    EXPECT_FALSE(is_valid(path));
}

}  // namespace
}  // namespace qchopper

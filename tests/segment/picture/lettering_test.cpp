#include "segment/picture/lettering.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

Pixels grey(int width, int height) {
    return {width, height,
            std::vector<Rgb>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {128, 128, 128})};
}

Rgb pixel(const Pixels& pixels, int x, int y) {
    return pixels
        .rows[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) + static_cast<std::size_t>(x)];
}

struct Extent2 {
    int left = 1 << 20;
    int right = -1;
    int top = 1 << 20;
    int bottom = -1;
};

Extent2 dark(const Pixels& pixels) {
    Extent2 found;
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            if (pixel(pixels, x, y).r > 80) continue;
            found = {std::min(found.left, x), std::max(found.right, x), std::min(found.top, y),
                     std::max(found.bottom, y)};
        }
    }
    return found;
}

TEST(Lettering, ACapitalIsAsHighAsAskedAndStandsUpright) {
    Pixels pixels = grey(200, 100);
    draw_text(pixels, 100, 50, "L", 40);
    const Extent2 found = dark(pixels);
    EXPECT_NEAR(found.bottom - found.top, 40, 7);
    EXPECT_NEAR(0.5 * (found.left + found.right), 100, 6);
    EXPECT_NEAR(0.5 * (found.top + found.bottom), 50, 4);
    // The foot of an L is at its bottom: its right end is dark there, and not at the top.
    const auto is_dark = [&](int x, int y) { return pixel(pixels, x, y).r < 80; };
    EXPECT_TRUE(is_dark(found.right - 3, found.bottom - 2));
    EXPECT_FALSE(is_dark(found.right - 3, found.top + 2));
}

TEST(Lettering, StaysInsideThePicture) {
    for (const double x : {-50.0, 0.0, 200.0, 1e9}) {
        Pixels pixels = grey(200, 100);
        draw_text(pixels, x, -20, "AB", 20);
        EXPECT_GE(dark(pixels).right, 0) << x;
    }
    Pixels tiny = grey(3, 2);
    draw_text(tiny, 1, 1, "A long name", 20);
    draw_scale_bar(tiny, 1);
}

TEST(Lettering, LengthsAreRoundAndHaveTheirUnit) {
    EXPECT_EQ(describe_length(5), "5 mm");
    EXPECT_EQ(describe_length(0.02), "0.02 mm");
    EXPECT_EQ(describe_length(20), "2 cm");
    EXPECT_EQ(describe_length(500), "50 cm");
    EXPECT_EQ(describe_length(2000), "2 m");
}

TEST(Lettering, TheScaleBarIsAsLongAsItSays) {
    Pixels pixels = grey(1200, 900);
    draw_scale_bar(pixels, 0.5);  // a sixth of the picture is 100 mm
    const Extent2 found = dark(pixels);
    EXPECT_NEAR(found.right - found.left, 200, 4);
}

}  // namespace
}  // namespace qchopper

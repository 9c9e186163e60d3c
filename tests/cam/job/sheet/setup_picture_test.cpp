#include "cam/job/sheet/setup_picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include "base/parallel.h"
#include "segment/mesh/transform.h"
#include "segment/picture/shade.h"
#include "tests/cam/job/some_job.h"
#include "tests/segment/picture/eyes.h"

namespace qchopper {
namespace {

using namespace test_pieces;

constexpr std::array states{SurfaceState::reached, SurfaceState::too_narrow, SurfaceState::steep, SurfaceState::holder,
                            SurfaceState::hidden};

SetupPictures drawn(const JobInput& input) {
    return setup_pictures(input, apply(input.setup.piece_in_setup, *input.piece.mesh));
}

std::vector<Rgb> decoded(const Bytes& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
    EXPECT_EQ(image.width, static_cast<unsigned>(setup_picture_width));
    EXPECT_EQ(image.height, static_cast<unsigned>(setup_picture_height));
    image.format = PNG_FORMAT_RGB;
    std::vector<Rgb> pixels(image.width * image.height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0) << image.message;
    return pixels;
}

// How many pixels of both pictures have the hue of a colour, lighter or darker.
std::size_t count_of(const SetupPictures& pictures, Rgb colour) {
    const Vec3 hue = normalized(to_linear(colour));
    std::size_t count = 0;
    for (const Bytes* picture : {&pictures.front, &pictures.back}) {
        for (const Rgb pixel : decoded(*picture)) {
            const Vec3 light = to_linear(pixel);
            if (norm(light) > 0.02 && dot(normalized(light), hue) > 0.998) ++count;
        }
    }
    return count;
}

TEST(SetupPicture, HasPixelsOfEveryColourThatOccurs) {
    const JobInput input = tilting_job();
    const SetupPictures pictures = drawn(input);
    for (const SurfaceState state : states) {
        EXPECT_GT(count_of(pictures, surface_colour(state, false)), 1000U) << static_cast<int>(state);
    }
    EXPECT_GT(count_of(pictures, base_colour), 200U) << "the base is seen from below";
}

TEST(SetupPicture, ShowsIgnoredSurfaceInAColourOfItsOwn) {
    JobInput input = tilting_job();
    input.states.assign(input.states.size(), SurfaceState::reached);
    const std::size_t before = count_of(drawn(input), surface_colour(SurfaceState::ignored, false));
    input.states.assign(input.states.size(), SurfaceState::ignored);
    const SetupPictures pictures = drawn(input);
    EXPECT_GT(count_of(pictures, surface_colour(SurfaceState::ignored, false)), before + 10'000U);
    EXPECT_EQ(count_of(pictures, surface_colour(SurfaceState::reached, false)), 0U);
}

TEST(SetupPicture, HasNoPixelsOfAColourThatDoesNotOccur) {
    JobInput input = tilting_job();
    input.states.assign(input.states.size(), SurfaceState::hidden);
    SetupPictures pictures = drawn(input);
    EXPECT_GT(count_of(pictures, surface_colour(SurfaceState::hidden, false)), 10'000U);
    for (const SurfaceState state : {SurfaceState::steep, SurfaceState::holder}) {
        EXPECT_EQ(count_of(pictures, surface_colour(state, false)), 0U) << static_cast<int>(state);
    }
    EXPECT_LT(count_of(pictures, surface_colour(SurfaceState::too_narrow, false)), 500U)
        << "a pale colour: edges mix it";
    input.states.clear();
    pictures = drawn(input);
    EXPECT_EQ(count_of(pictures, surface_colour(SurfaceState::hidden, false)), 0U);
    EXPECT_GT(count_of(pictures, surface_colour(SurfaceState::reached, false)), 10'000U);
}

TEST(SetupPicture, TheColoursDifferForEveryEye) {
    std::vector<Rgb> colours{base_colour, {255, 255, 255}};
    for (const SurfaceState state : states) colours.push_back(surface_colour(state, false));
    colours.push_back(surface_colour(SurfaceState::too_narrow, true));
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(eyes::distance(colours[i], colours[k]), 15) << i << " and " << k;
    }
}

TEST(SetupPicture, IsTheSameWithAnyNumberOfThreads) {
    const JobInput input = tilting_job();
    const SetupPictures many = drawn(input);
    const ThreadLimit one(1);
    const SetupPictures alone = drawn(input);
    EXPECT_EQ(many.front, alone.front);
    EXPECT_EQ(many.back, alone.back);
}

TEST(SetupPicture, AnArrowMoreIsSeen) {
    JobInput input = tilting_job();
    const SetupPictures two = drawn(input);
    input.setup.access.orientations.pop_back();
    const SetupPictures one = drawn(input);
    EXPECT_NE(two.front, one.front);
    EXPECT_NE(two.back, one.back);
}

TEST(SetupPicture, OfAPieceWithoutTrianglesTheBlockIsDrawn) {
    JobInput input = tilting_job();
    input.states.clear();
    EXPECT_GT(setup_pictures(input, {}).front.size(), 1000U);
}

}  // namespace
}  // namespace qchopper

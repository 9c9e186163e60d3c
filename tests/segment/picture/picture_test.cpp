#include "segment/picture/picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/picture/png.h"
#include "segment/picture/shade.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;
    Rgb at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

Picture decode(const Bytes& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
    image.format = PNG_FORMAT_RGB;
    Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    picture.pixels.resize(image.width * image.height);
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr), 0) << image.message;
    return picture;
}

PictureOptions small() {
    PictureOptions options;
    options.width = 160;
    options.height = 120;
    options.supersampling = 1;
    options.ambient_rays = 4;
    options.labels = false;
    return options;
}

int brightness(Rgb c) {
    return c.r + c.g + c.b;
}

const Rgb red{220, 40, 40};
const Rgb blue{40, 60, 220};

TEST(Picture, ABallIsADiscOfItsColourInTheMiddle) {
    const TriangleMesh ball = shapes::ball({1000, -2000, 500}, 70, 60);
    PictureOptions options = small();
    options.frame = 0.1;
    options.outline = 0;
    const std::vector<ColouredMesh> scene{{&ball, red, {}}};
    const Picture picture = decode(render_png(scene, options));
    ASSERT_EQ(picture.width, 160);
    ASSERT_EQ(picture.height, 120);
    const Rgb middle = picture.at(80, 60);
    EXPECT_GT(middle.r, 2 * middle.g);
    EXPECT_GT(middle.r, 2 * middle.b);
    for (const int x : {0, 159}) {
        for (const int y : {0, 119}) EXPECT_EQ(picture.at(x, y), options.background);
    }
    const double radius = 0.8 * 120 / 2;
    int drawn = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const bool is_ball = !(picture.at(x, y) == options.background);
            drawn += is_ball ? 1 : 0;
            const double from_middle = std::hypot(x + 0.5 - 80, y + 0.5 - 60);
            if (from_middle < 0.97 * radius) {
                EXPECT_TRUE(is_ball) << x << " " << y;
            }
            if (from_middle > 1.03 * radius) {
                EXPECT_FALSE(is_ball) << x << " " << y;
            }
        }
    }
    EXPECT_NEAR(drawn, std::numbers::pi * radius * radius, 0.03 * std::numbers::pi * radius * radius);
}

TEST(Picture, TheLightComesFromTheUpperLeft) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 60);
    const std::vector<ColouredMesh> scene{{&ball, bone_colour, {}}};
    const Picture picture = decode(render_png(scene, small()));
    EXPECT_GT(brightness(picture.at(80 - 25, 60 - 25)), brightness(picture.at(80 + 25, 60 + 25)) + 60);
}

TEST(Picture, EachMeshIsDrawnWhereItsShiftPutsIt) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 30);
    PictureOptions options = small();
    options.view = {0, 1, 0};  // x to the right, z up
    const std::vector<ColouredMesh> scene{{&ball, red, {-15, 0, 0}}, {&ball, blue, {15, 0, 0}}};
    const Picture picture = decode(render_png(scene, options));
    const Rgb left = picture.at(45, 60);
    const Rgb right = picture.at(115, 60);
    EXPECT_GT(left.r, 2 * left.b);
    EXPECT_GT(right.b, 2 * right.r);
    EXPECT_EQ(picture.at(80, 60), options.background);
}

TEST(Picture, WhatStandsInFrontHidesWhatIsBehind) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 30);
    PictureOptions options = small();
    options.view = {0, 1, 0};
    const std::vector<ColouredMesh> scene{{&ball, red, {0, 50, 0}}, {&ball, blue, {0, -50, 0}}};
    const Rgb middle = decode(render_png(scene, options)).at(80, 60);
    EXPECT_GT(middle.b, 2 * middle.r);
}

TEST(Picture, CapsAreLighterThanTheSkinInTheSameHue) {
    TriangleMesh plain = shapes::box({0, 0, 0}, {10, 10, 10});
    TriangleMesh capped = plain;
    capped.cap_of.assign(capped.triangles.size(), 0);
    PictureOptions options = small();
    options.view = {0, 1, 0};
    const Rgb skin = decode(render_png(std::vector<ColouredMesh>{{&plain, blue, {}}}, options)).at(80, 60);
    const Rgb cap = decode(render_png(std::vector<ColouredMesh>{{&capped, blue, {}}}, options)).at(80, 60);
    EXPECT_GT(brightness(cap), brightness(skin) + 30);
    EXPECT_GT(cap.b, cap.r);
    EXPECT_GT(cap.b, cap.g);
}

TEST(Picture, ADarkLineRunsAlongTheBorderOfAPiece) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10});
    PictureOptions options = small();
    options.view = {0, 1, 0};
    options.supersampling = 2;
    const std::vector<ColouredMesh> scene{{&box, red, {}}, {&box, red, {10, 0, 0}}};  // side by side, equal in colour
    const Picture with = decode(render_png(scene, options));
    EXPECT_LT(brightness(with.at(80, 60)), 0.85 * brightness(with.at(60, 60)));
    options.outline = 0;
    const Picture without = decode(render_png(scene, options));
    EXPECT_GT(brightness(without.at(80, 60)), 0.9 * brightness(without.at(60, 60)));
}

TEST(Picture, TrianglesMayHaveColoursOfTheirOwn) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    const std::array<Rgb, 3> palette{{{200, 30, 20}, {20, 160, 40}, {30, 60, 210}}};
    std::vector<std::uint8_t> colour_of(mesh.triangles.size(), 1);
    const ColouredMesh plain{&mesh, palette[1], {}};
    ColouredMesh of_triangles{&mesh, palette[2], {}};
    of_triangles.palette = palette;
    of_triangles.colour_of = colour_of;
    EXPECT_EQ(render_png({{of_triangles}}, small()), render_png({{plain}}, small())) << "all of the same colour";
    for (std::size_t t = 0; t < colour_of.size(); ++t) colour_of[t] = corners_of(mesh, t)[0].z > 1 ? 0 : 1;
    const Picture picture = decode(render_png({{of_triangles}}, small()));
    std::size_t reddish = 0;
    std::size_t greenish = 0;
    for (const Rgb pixel : picture.pixels) {
        reddish += pixel.r > pixel.g + 60 ? 1 : 0;
        greenish += pixel.g > pixel.r + 60 ? 1 : 0;
    }
    EXPECT_GT(reddish, 100U);
    EXPECT_GT(greenish, 100U);
}

TEST(Picture, WithoutAmbientLightNoRaysAreNeeded) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    const std::vector<ColouredMesh> meshes{{&mesh, bone_colour, {}}};
    PictureOptions options = small();
    options.ambient_rays = 0;
    const Scene scene(meshes, false);
    EXPECT_FALSE(scene.has_rays());
    EXPECT_EQ(render_png(scene, options), render_png(Scene(meshes), options));
}

TEST(Picture, SameBytesForAnyNumberOfThreads) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 20, 6, 48);
    const std::vector<ColouredMesh> scene{{&torus, red, {}}, {&torus, blue, {0, 0, 20}}};
    const Bytes many = render_png(scene, small());
    const ThreadLimit one(1);
    EXPECT_EQ(render_png(scene, small()), many);
}

TEST(Picture, NothingToDrawOrSenselessOptionsAreRefused) {
    const TriangleMesh empty;
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 1, 4);
    EXPECT_THROW(render_png({}), InputError);
    EXPECT_THROW(render_png(std::vector<ColouredMesh>{{&empty, red, {}}}), InputError);
    EXPECT_THROW(render_png(std::vector<ColouredMesh>{{nullptr, red, {}}}), InputError);
    const std::vector<ColouredMesh> scene{{&ball, red, {}}, {&empty, red, {}}, {nullptr, red, {}}};
    EXPECT_NO_THROW(render_png(scene, small()));
    const auto refused = [&](auto spoil) {
        PictureOptions options = small();
        spoil(options);
        EXPECT_THROW(render_png(scene, options), InputError);
    };
    refused([](PictureOptions& o) { o.width = 0; });
    refused([](PictureOptions& o) { o.height = 16385; });
    refused([](PictureOptions& o) { o.supersampling = 9; });
    refused([](PictureOptions& o) { o.width = o.height = 16000; });
    refused([](PictureOptions& o) { o.ambient_rays = -1; });
    refused([](PictureOptions& o) { o.view = {0, 0, 0}; });
    refused([](PictureOptions& o) { o.view.x = NAN; });
    refused([](PictureOptions& o) { o.up.x = INFINITY; });
    refused([](PictureOptions& o) { o.frame = 0.5; });
    refused([](PictureOptions& o) { o.outline = -1; });
}

TEST(Picture, LooksStraightDownAndAtAFlatThing) {
    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    flat.triangles = {{0, 1, 2}};
    PictureOptions options = small();
    for (const Vec3 view : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {
        options.view = view;
        EXPECT_FALSE(render_png(std::vector<ColouredMesh>{{&flat, red, {}}}, options).empty());
    }
}

TEST(Picture, CountsItsRowsAndStopsWhenCancelled) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 1, 8);
    const std::vector<ColouredMesh> scene{{&ball, red, {}}};
    std::size_t last = 0;
    std::atomic<bool> stop{false};
    Context context;
    context.on_progress = [&](const Progress& progress) {
        EXPECT_GT(progress.done, last);
        EXPECT_EQ(progress.total, 120U);
        last = progress.done;
    };
    context.cancelled = &stop;
    render_png(scene, small(), context);
    EXPECT_EQ(last, 120U);
    stop = true;
    EXPECT_THROW(render_png(scene, small(), context), Cancelled);
}

TEST(Png, PixelsComeBackAsTheyWent) {
    Pixels pixels{7, 5, {}};
    for (int i = 0; i < 35; ++i) {
        pixels.rows.push_back({static_cast<std::uint8_t>(7 * i), static_cast<std::uint8_t>(255 - i), 13});
    }
    const Picture picture = decode(to_png(pixels));
    EXPECT_EQ(picture.width, 7);
    EXPECT_EQ(picture.pixels, pixels.rows);
}

TEST(Shade, ColoursGoForthAndBack) {
    for (int value = 0; value < 256; ++value) {
        const Rgb grey{static_cast<std::uint8_t>(value), 0, static_cast<std::uint8_t>(255 - value)};
        EXPECT_EQ(to_rgb(to_linear(grey)), grey);
    }
}

}  // namespace
}  // namespace qchopper

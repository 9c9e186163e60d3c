#include "segment/picture/ambient.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/shapes.h"

namespace qchopper {
namespace {

PictureOptions small() {
    PictureOptions options;
    options.width = 400;
    options.height = 300;
    return options;
}

// Root mean square difference to the light by 256 rays at the same sample.
struct Difference {
    double mean = 0;
    std::size_t samples = 0;
};

Difference difference(std::span<const ColouredMesh> meshes) {
    const PictureOptions options = small();
    const Scene scene(meshes);
    const Camera camera = framed(scene.meshes(), options);
    const Film film = rasterised(scene.meshes(), camera, options);
    const AmbientLight light(scene, film, camera, options, [](std::size_t, std::size_t) {});
    Difference found;
    for (std::size_t y = 0; y < film.height; y += 7) {
        for (std::size_t x = 0; x < film.width; x += 7) {
            const std::uint64_t sample = film.at(x, y);
            if (sample == Film::nothing) continue;
            const Vec3 at = film.start(camera, x, y) + static_cast<double>(Film::depth(sample)) * camera.forward;
            const SurfacePoint point = scene.surface(Film::triangle(sample), at, camera.forward);
            double plain = 0;
            for (int i = 0; i < 8; ++i) {
                plain += sky_light(scene, point, camera.up, 32, {i / 8.0, std::fmod(0.37 * i, 1.0)}) / 8;
            }
            const double off = light.at(x, y, point) - plain;
            found.mean += off * off;
            ++found.samples;
        }
    }
    found.mean = std::sqrt(found.mean / static_cast<double>(found.samples));
    return found;
}

TEST(AmbientLight, IsNearThatOfManyRaysAtEveryPoint) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 20, 6, 64);
    const TriangleMesh box = shapes::box({-30, -30, -12}, {60, 60, 2});
    const std::vector<ColouredMesh> scene{{&torus, bone_colour, {}}, {&box, bone_colour, {}}};
    const Difference found = difference(scene);
    EXPECT_GT(found.samples, 1000U);
    EXPECT_LT(found.mean, 0.02);
}

TEST(AmbientLight, OfAnOpenSurfaceIsThatOfTheWholeSky) {
    TriangleMesh floor;
    floor.points = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    PictureOptions options = small();
    options.view = {0, 0, -1};
    options.up = {0, 1, 0};
    const Scene scene(std::vector<ColouredMesh>{{&floor, bone_colour, {}}});
    const Camera camera = framed(scene.meshes(), options);
    const Film film = rasterised(scene.meshes(), camera, options);
    const AmbientLight light(scene, film, camera, options, [](std::size_t, std::size_t) {});
    double least = 1;
    double most = 0;
    for (std::size_t y = 0; y < film.height; ++y) {
        for (std::size_t x = 0; x < film.width; ++x) {
            const std::uint64_t sample = film.at(x, y);
            if (sample == Film::nothing) continue;
            const Vec3 at = film.start(camera, x, y) + static_cast<double>(Film::depth(sample)) * camera.forward;
            const double here = light.at(x, y, scene.surface(Film::triangle(sample), at, camera.forward));
            least = std::min(least, here);
            most = std::max(most, here);
        }
    }
    // Seen from above, the directions along and against `up` weigh the same.
    EXPECT_NEAR(least, 0.72, 0.02);
    EXPECT_LT(most - least, 0.012) << "no pattern in an even surface";
}

}  // namespace
}  // namespace qchopper

// The film against a ray through every sample, one triangle after the other.

#include "segment/picture/film.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "segment/mesh/rays.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

PictureOptions small() {
    PictureOptions options;
    options.width = 120;
    options.height = 90;
    options.supersampling = 1;
    return options;
}

// Moved so that samples look at the middles of triangles rather than along their edges.
std::vector<ColouredMesh> two(const TriangleMesh& mesh) {
    return {{&mesh, bone_colour, {0.0123, 0.0456, 0.0789}}, {&mesh, bone_colour, {7.1, 3.3, 5.7}}};
}

TriangleMesh joined(std::span<const ColouredMesh> meshes) {
    TriangleMesh all;
    for (const ColouredMesh& one : meshes) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        for (const Vec3 p : one.mesh->points) all.points.push_back(p + one.shift);
        for (const Triangle& t : one.mesh->triangles)
            all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return all;
}

TEST(Film, SeesWhatARayThroughTheSampleMeets) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const std::vector<ColouredMesh> scene = two(shape.mesh);
        const Camera camera = framed(scene, small());
        const Film film = rasterised(scene, camera, small());
        const TriangleMesh all = joined(scene);
        const RayTree rays(all);
        std::size_t seen = 0;
        std::size_t different = 0;
        for (std::size_t y = 0; y < film.height; ++y) {
            for (std::size_t x = 0; x < film.width; ++x) {
                const std::uint64_t sample = film.at(x, y);
                const auto hit = rays.first_hit(film.start(camera, x, y), camera.forward);
                seen += hit.has_value() ? 1 : 0;
                const bool is_same = hit.has_value() == (sample != Film::nothing) &&
                                     (!hit || std::abs(hit->distance - Film::depth(sample)) < 1e-3 * hit->distance);
                different += is_same ? 0 : 1;
            }
        }
        EXPECT_GT(seen, 100U) << shape.name;
        // Silhouettes run through samples now and then, and rays are single precision.
        EXPECT_LE(different, seen / 200) << shape.name;
    }
}

TEST(Film, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 20, 6, 48);
    const std::vector<ColouredMesh> scene = two(torus);
    const Camera camera = framed(scene, small());
    const Film many = rasterised(scene, camera, small());
    const ThreadLimit one(1);
    EXPECT_EQ(rasterised(scene, camera, small()).seen, many.seen);
}

TEST(Film, ASliverAcrossThePictureIsSeenWhereItCoversSamples) {
    TriangleMesh sliver;
    sliver.points = {{0, 0, 0}, {1000, 0, 900}, {1000, 0, 910}};
    sliver.triangles = {{0, 1, 2}};
    PictureOptions options = small();
    options.view = {0, 1, 0};
    const std::vector<ColouredMesh> scene{{&sliver, bone_colour, {}}};
    const Camera camera = framed(scene, options);
    const Film film = rasterised(scene, camera, options);
    std::size_t seen = 0;
    for (const std::uint64_t sample : film.seen) seen += sample != Film::nothing ? 1 : 0;
    const double area_in_samples = 0.5 * 1000 * 10 / (film.mm_per_sample * film.mm_per_sample);
    EXPECT_NEAR(static_cast<double>(seen), area_in_samples, 0.35 * area_in_samples);
}

}  // namespace
}  // namespace qchopper

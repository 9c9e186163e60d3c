// One primary ray per sample and ambient rays where it hits; lines are drawn where neighbouring samples differ in piece
// or cap. O(samples * (1 + ambient_rays)) rays, in parallel by rows; memory for all samples.

#include "segment/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/picture/png.h"
#include "segment/picture/shade.h"

namespace qchopper {
namespace {

constexpr std::uint32_t no_piece = std::numeric_limits<std::uint32_t>::max();

// One ray of a pixel: what it hit and its linear colour.
struct PixelSample {
    std::uint32_t piece = no_piece;
    std::int32_t cap = no_cap;
    float r = 0;
    float g = 0;
    float b = 0;
};

// All samples of the picture, row by row from the top: `supersampling` times as many in each direction as pixels.
struct SampleImage {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<PixelSample> samples;
    const PixelSample& at(std::size_t x, std::size_t y) const { return samples[y * width + x]; }
};

void check(std::span<const ColouredMesh> meshes, const PictureOptions& options) {
    const auto refuse = [](const std::string& why) { throw InputError(InputFault::use, "no picture: " + why); };
    const bool any = std::any_of(meshes.begin(), meshes.end(), [](const ColouredMesh& one) {
        return one.mesh != nullptr && !one.mesh->triangles.empty();
    });
    if (!any) refuse("there is no triangle to draw");
    if (options.width < 1 || options.width > 16384 || options.height < 1 || options.height > 16384) {
        refuse("width and height must be 1 to 16384 pixels");
    }
    if (options.supersampling < 1 || options.supersampling > 8) refuse("supersampling must be 1 to 8");
    if (options.ambient_rays < 0 || options.ambient_rays > 4096) refuse("ambient rays must be 0 to 4096");
    const double rays =
        static_cast<double>(options.width) * options.height * options.supersampling * options.supersampling;
    if (rays > 1.5e8) refuse("width x height x supersampling squared must not exceed 150 million");
    if (!(norm(options.view) > 0) || !std::isfinite(norm(options.view))) refuse("the view must have a direction");
    if (!std::isfinite(norm(options.up))) refuse("up must be finite");
    if (!(options.frame >= 0 && options.frame < 0.5)) refuse("the frame must be 0 to 0.5");
    if (!(options.outline >= 0 && options.outline <= 20)) refuse("the outline must be 0 to 20 pixels");
}

// The camera that shows the whole mesh, with an empty border of options.frame.
Camera camera_for(const TriangleMesh& mesh, const PictureOptions& options) {
    Camera camera;
    camera.forward = normalized(options.view);
    camera.right = cross(camera.forward, options.up);
    if (norm(camera.right) < 1e-9) camera.right = cross(camera.forward, Vec3{0, 1, 0});  // straight from above
    if (norm(camera.right) < 1e-9) camera.right = Vec3{1, 0, 0};
    camera.right = normalized(camera.right);
    camera.up = cross(camera.right, camera.forward);
    const double most = std::numeric_limits<double>::max();
    Vec3 low{most, most, most};
    Vec3 high = -low;
    for (const Vec3& p : mesh.points) {
        const Vec3 in_camera{dot(camera.right, p), dot(camera.up, p), dot(camera.forward, p)};
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], in_camera[axis]);
            high[axis] = std::max(high[axis], in_camera[axis]);
        }
    }
    const Vec3 size = high - low;
    const double inner = 1 - 2 * options.frame;
    camera.mm_per_pixel = std::max(size.x / (options.width * inner), size.y / (options.height * inner));
    if (!(camera.mm_per_pixel > 0)) camera.mm_per_pixel = 1;
    const Vec3 middle = 0.5 * (low + high);
    const double nearest = low.z - 0.05 * norm(size) - 1;
    camera.origin = middle.x * camera.right + middle.y * camera.up + nearest * camera.forward;
    return camera;
}

PixelSample cast_sample(const Scene& scene, const Camera& camera, const PictureOptions& options, std::size_t x,
                        std::size_t y) {
    const double fine = options.supersampling;
    const double right = (static_cast<double>(x) + 0.5) / fine - options.width / 2.0;
    const double down = (static_cast<double>(y) + 0.5) / fine - options.height / 2.0;
    const Vec3 from =
        camera.origin + (camera.mm_per_pixel * right) * camera.right - (camera.mm_per_pixel * down) * camera.up;
    const std::optional<SurfaceHit> hit = scene.cast_ray(from, camera.forward);
    const auto number = static_cast<std::uint32_t>(y * 131071 + x);
    const Vec3 colour = hit ? shade(scene, *hit, camera, options.ambient_rays, number) : to_linear(options.background);
    PixelSample sample{no_piece, no_cap, static_cast<float>(colour.x), static_cast<float>(colour.y),
                       static_cast<float>(colour.z)};
    if (hit) {
        sample.piece = scene.piece_of(hit->triangle);
        sample.cap = scene.mesh().cap_of[hit->triangle];
    }
    return sample;
}

SampleImage cast_samples(const Scene& scene, const Camera& camera, const PictureOptions& options,
                         const Context& context) {
    SampleImage image;
    image.width = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.supersampling);
    image.height = static_cast<std::size_t>(options.height) * static_cast<std::size_t>(options.supersampling);
    image.samples.resize(image.width * image.height);
    constexpr std::size_t band = 64;  // rows between two checks for a cancel
    for (std::size_t top = 0; top < image.height; top += band) {
        context.check_cancelled();
        const std::size_t bottom = std::min(image.height, top + band);
        parallel_for(top, bottom, [&](std::size_t y) {
            for (std::size_t x = 0; x < image.width; ++x) {
                image.samples[y * image.width + x] = cast_sample(scene, camera, options, x, y);
            }
        });
        context.progress("rows drawn", bottom, image.height);
    }
    return image;
}

// The factor of the outline: 1 without a line, less where a border of the piece, or of a cap, is within `radius`
// samples.
double outline_factor(const SampleImage& image, std::size_t x, std::size_t y, int radius) {
    const PixelSample& here = image.at(x, y);
    double factor = 1;
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            if (dx * dx + dy * dy > radius * radius) continue;
            const auto nx = static_cast<std::ptrdiff_t>(x) + dx;
            const auto ny = static_cast<std::ptrdiff_t>(y) + dy;
            if (nx < 0 || ny < 0 || nx >= static_cast<std::ptrdiff_t>(image.width) ||
                ny >= static_cast<std::ptrdiff_t>(image.height)) {
                continue;
            }
            const PixelSample& there = image.at(static_cast<std::size_t>(nx), static_cast<std::size_t>(ny));
            if (there.piece != here.piece) return 0.16;
            if (there.cap != here.cap) factor = 0.42;
        }
    }
    return factor;
}

// The mean of the samples of a pixel.
Rgb pixel_colour(const SampleImage& image, const PictureOptions& options, std::size_t px, std::size_t py) {
    const auto fine = static_cast<std::size_t>(options.supersampling);
    const int radius = static_cast<int>(std::lround(options.outline * options.supersampling / 2));
    Vec3 sum;
    bool empty = true;
    for (std::size_t y = py * fine; y < (py + 1) * fine; ++y) {
        for (std::size_t x = px * fine; x < (px + 1) * fine; ++x) {
            const PixelSample& sample = image.at(x, y);
            const bool drawn = sample.piece != no_piece;
            const double line = drawn && radius > 0 ? outline_factor(image, x, y, radius) : 1;
            sum = sum + line * Vec3{sample.r, sample.g, sample.b};
            empty = empty && !drawn;
        }
    }
    return empty ? options.background : to_rgb(1.0 / static_cast<double>(fine * fine) * sum);
}

}  // namespace

Bytes render_png(std::span<const ColouredMesh> meshes, const PictureOptions& options, const Context& context) {
    check(meshes, options);
    std::vector<ColouredMesh> drawn;
    std::copy_if(meshes.begin(), meshes.end(), std::back_inserter(drawn),
                 [](const ColouredMesh& one) { return one.mesh != nullptr; });
    const Scene scene(drawn);
    const Camera camera = camera_for(scene.mesh(), options);
    const SampleImage image = cast_samples(scene, camera, options, context);
    const auto width = static_cast<std::size_t>(options.width);
    const auto height = static_cast<std::size_t>(options.height);
    std::vector<Rgb> pixels(width * height);
    parallel_for(0, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) pixels[y * width + x] = pixel_colour(image, options, x, y);
    });
    return to_png(pixels, options.width, options.height);
}

}  // namespace qchopper

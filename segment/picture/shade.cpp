// Diffuse light of two wide lights and the sky, and a faint highlight (Blinn, "Models of light reflection for computer
// synthesized pictures", 1977). O(1) a point.

#include "segment/picture/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace qchopper {
namespace {

double decoded(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// The least linear values that are rounded to 1, 2, ... 255.
std::array<double, 255> thresholds() {
    std::array<double, 255> least{};
    for (std::size_t i = 0; i < least.size(); ++i) least[i] = decoded((static_cast<double>(i) + 0.5) / 255);
    return least;
}

// A cut surface is lighter than the scanned one.
double lighter(double value) {
    return 0.12 + 0.88 * std::pow(value, 0.72);
}

Vec3 times(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

double to_the_24th(double x) {
    const double cube = x * x * x;
    const double to_the_6th = cube * cube;
    const double to_the_12th = to_the_6th * to_the_6th;
    return to_the_12th * to_the_12th;
}

}  // namespace

Vec3 to_linear(Rgb colour) {
    return {decoded(colour.r / 255.0), decoded(colour.g / 255.0), decoded(colour.b / 255.0)};
}

Rgb to_rgb(Vec3 linear) {
    static const std::array<double, 255> least = thresholds();
    const auto channel = [](double value) {
        return static_cast<std::uint8_t>(std::upper_bound(least.begin(), least.end(), value) - least.begin());
    };
    return {channel(linear.x), channel(linear.y), channel(linear.z)};
}

Shader::Shader(const Scene& scene, const Camera& camera)
    : key_(normalized(-0.55 * camera.right + 0.75 * camera.up - 0.65 * camera.forward)),
      fill_(normalized(0.9 * camera.right - 0.1 * camera.up - 0.5 * camera.forward)),
      half_(normalized(key_ - camera.forward)) {
    for (const ColouredMesh& one : scene.meshes()) {
        std::vector<Surface>& own = surfaces_.emplace_back();
        const std::span<const Rgb> colours = one.colour_of.empty() ? std::span(&one.colour, 1) : one.palette;
        for (const Rgb colour : colours) {
            const Vec3 scanned = to_linear(colour);
            own.push_back({scanned, {lighter(scanned.x), lighter(scanned.y), lighter(scanned.z)}});
        }
    }
}

Vec3 Shader::colour(const SurfacePoint& point, double sky) const {
    // The lights are wide, so a crevice that sees little of the sky sees little of them too.
    const double seen = std::min(1.0, 0.25 + sky);
    const double from_key = seen * std::max(0.0, (dot(point.normal, key_) + 0.25) / 1.25);
    const double from_fill = seen * std::max(0.0, dot(point.normal, fill_));
    const Vec3 light =
        sky * Vec3{0.50, 0.53, 0.60} + from_key * Vec3{0.66, 0.63, 0.57} + from_fill * Vec3{0.11, 0.12, 0.15};
    const double gloss = 0.05 * sky * to_the_24th(std::max(0.0, dot(point.normal, half_)));
    const Surface& surface = surfaces_[point.region.mesh][point.colour];
    return times(light, point.region.cap != no_cap ? surface.cap : surface.scanned) + Vec3{gloss, gloss, gloss};
}

}  // namespace qchopper

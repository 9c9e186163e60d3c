#include "segment/picture/shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace qchopper {
namespace {

// Spreads the bits of a number so that neighbours have nothing in common.
std::uint32_t scatter(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

double unit(std::uint32_t bits) {
    return bits / 4294967296.0;
}

double fraction(double x) {
    return x - std::floor(x);
}

std::array<Vec3, 2> around(Vec3 n) {
    const Vec3 aside = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 first = normalized(cross(n, aside));
    return {first, cross(n, first)};
}

// Share of the sky that the point sees, weighted with the cosine, brighter above. Directions follow Roberts' R2
// sequence, which fills the square evenly at every count.
double sky_light(const Scene& scene, const SeenPoint& point, Vec3 up, int rays, std::uint32_t pixel) {
    const double turn_a = unit(scatter(pixel));
    const double turn_b = unit(scatter(pixel + 0x9e3779b9u));
    const double far = 0.5 * scene.diagonal();
    const auto [first, second] = around(point.normal);
    double light = 0;
    double most = 0;
    for (int i = 0; i < rays; ++i) {
        const double a = fraction(turn_a + i * 0.7548776662466927);
        const double b = fraction(turn_b + i * 0.5698402909980532);
        const double angle = 2 * std::numbers::pi * a;
        const double out = std::sqrt(b);
        Vec3 direction = out * std::cos(angle) * first + out * std::sin(angle) * second +
                         std::sqrt(std::max(0.0, 1 - b)) * point.normal;
        const double under = dot(direction, point.face_normal);
        if (under < 0) direction = direction - 2 * under * point.face_normal;
        const double sky = 0.72 + 0.28 * dot(direction, up);
        const std::optional<double> distance = scene.blocked(point, direction);
        // What stands far off hides less; what stands near still throws some light back.
        const double open = distance ? std::sqrt(std::min(1.0, *distance / far)) : 1;
        light += sky * (0.12 + 0.88 * open);
        most += 1;
    }
    return light / most;
}

}  // namespace

Vec3 to_linear(Rgb colour) {
    const auto channel = [](std::uint8_t value) {
        const double s = value / 255.0;
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

Rgb to_rgb(Vec3 linear) {
    const auto channel = [](double value) {
        const double l = std::clamp(value, 0.0, 1.0);
        const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(255 * s));
    };
    return {channel(linear.x), channel(linear.y), channel(linear.z)};
}

namespace {

// The same hue, lighter: a cut surface is fresh.
Vec3 fresh(Vec3 colour) {
    const auto channel = [](double value) { return 0.12 + 0.88 * std::pow(value, 0.72); };
    return {channel(colour.x), channel(colour.y), channel(colour.z)};
}

Vec3 times(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}  // namespace

Vec3 shade(const Scene& scene, const SeenPoint& point, const Camera& camera, int ambient_rays, std::uint32_t pixel) {
    const Vec3 key = normalized(-0.55 * camera.right + 0.75 * camera.up - 0.65 * camera.forward);
    const Vec3 fill = normalized(0.9 * camera.right - 0.1 * camera.up - 0.5 * camera.forward);
    const Vec3 own = to_linear(scene.colour(point.triangle));
    const bool is_cap = scene.mesh().cap_of[point.triangle] != no_cap;
    const double sky = ambient_rays > 0 ? sky_light(scene, point, camera.up, ambient_rays, pixel) : 0.7;
    // The lights are wide, so a crevice that sees little sky sees little of them too.
    const double seen = std::min(1.0, 0.25 + sky);
    const double from_key = seen * std::max(0.0, (dot(point.normal, key) + 0.25) / 1.25);
    const double from_fill = seen * std::max(0.0, dot(point.normal, fill));
    const Vec3 light =
        sky * Vec3{0.50, 0.53, 0.60} + from_key * Vec3{0.66, 0.63, 0.57} + from_fill * Vec3{0.11, 0.12, 0.15};
    const Vec3 half = normalized(key - camera.forward);
    const double gloss = 0.05 * sky * std::pow(std::max(0.0, dot(point.normal, half)), 24);
    return times(light, is_cap ? fresh(own) : own) + Vec3{gloss, gloss, gloss};
}

}  // namespace qchopper

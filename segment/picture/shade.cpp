// Diffuse key and fill light, gloss after J. F. Blinn, "Models of Light Reflection for Computer Synthesized Pictures",
// 1977, and ambient light by cosine-weighted rays. O(ambient_rays) rays per point.

#include "segment/picture/shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace qchopper {
namespace {

// lowbias32 of C. Wellons, "Prospecting for Hash Functions", 2018: neighbouring numbers get unrelated ones.
std::uint32_t hash_bits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

double to_unit_interval(std::uint32_t bits) {
    return bits / 4294967296.0;
}

double fraction(double x) {
    return x - std::floor(x);
}

// Two unit vectors that are perpendicular to the unit vector n and to each other.
std::array<Vec3, 2> tangents(Vec3 n) {
    const Vec3 aside = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 first = normalized(cross(n, aside));
    return {first, cross(n, first)};
}

// The share of the sky that is open at the point, weighted with the cosine, brighter above. Directions follow the R2
// sequence (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), which fills the square evenly
// at every count.
double ambient_light(const Scene& scene, const SurfaceHit& point, Vec3 up, int rays, std::uint32_t pixel) {
    const double turn_a = to_unit_interval(hash_bits(pixel));
    const double turn_b = to_unit_interval(hash_bits(pixel + 0x9e3779b9u));
    const double far = 0.5 * scene.diagonal();
    const auto [first, second] = tangents(point.normal);
    double sum = 0;
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
        const std::optional<double> distance = scene.occluder_distance(point, direction);
        // A distant surface hides less; a near one still reflects some light.
        const double open = distance ? std::sqrt(std::min(1.0, *distance / far)) : 1;
        sum += sky * (0.12 + 0.88 * open);
    }
    return sum / rays;
}

// The same hue, lighter: caps differ from the surface of the scan.
Vec3 cap_colour(Vec3 colour) {
    const auto channel = [](double value) { return 0.12 + 0.88 * std::pow(value, 0.72); };
    return {channel(colour.x), channel(colour.y), channel(colour.z)};
}

Vec3 product(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
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

Vec3 shade(const Scene& scene, const SurfaceHit& point, const Camera& camera, int ambient_rays, std::uint32_t pixel) {
    const Vec3 key = normalized(-0.55 * camera.right + 0.75 * camera.up - 0.65 * camera.forward);
    const Vec3 fill = normalized(0.9 * camera.right - 0.1 * camera.up - 0.5 * camera.forward);
    const Vec3 colour = to_linear(scene.colour(point.triangle));
    const bool is_cap = scene.mesh().cap_of[point.triangle] != no_cap;
    const double sky = ambient_rays > 0 ? ambient_light(scene, point, camera.up, ambient_rays, pixel) : 0.7;
    // The lights are large: in a crevice with little sky they are mostly hidden too.
    const double visible = std::min(1.0, 0.25 + sky);
    const double from_key = visible * std::max(0.0, (dot(point.normal, key) + 0.25) / 1.25);
    const double from_fill = visible * std::max(0.0, dot(point.normal, fill));
    const Vec3 light =
        sky * Vec3{0.50, 0.53, 0.60} + from_key * Vec3{0.66, 0.63, 0.57} + from_fill * Vec3{0.11, 0.12, 0.15};
    const Vec3 half = normalized(key - camera.forward);
    const double gloss = 0.05 * sky * std::pow(std::max(0.0, dot(point.normal, half)), 24);
    return product(light, is_cap ? cap_colour(colour) : colour) + Vec3{gloss, gloss, gloss};
}

}  // namespace qchopper

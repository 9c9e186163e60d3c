// Subdivision by edge midpoints; a spiral of equal steps in height and of the golden angle. O(directions squared) for
// the removal of duplicates.

#include "segment/access/tool_directions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "segment/mesh/plane.h"

namespace qchopper {
namespace {

constexpr double same = 1e-9;
constexpr int subdivisions = 3;

bool contains(std::span<const Vec3> directions, Vec3 d) {
    return index_of(directions, d) < directions.size();
}

// Adds what `directions` does not contain.
void add(std::vector<Vec3>& directions, Vec3 d) {
    if (!contains(directions, d)) directions.push_back(d);
}

}  // namespace

std::size_t index_of(std::span<const Vec3> directions, Vec3 d) {
    const auto is_same = [d](Vec3 other) { return norm(other - d) <= same; };
    return static_cast<std::size_t>(std::find_if(directions.begin(), directions.end(), is_same) - directions.begin());
}

std::vector<Vec3> octahedron_normals() {
    std::vector<std::array<Vec3, 3>> faces;
    for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            for (const double z : {1.0, -1.0}) faces.push_back({Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}});
        }
    }
    for (int i = 0; i < subdivisions; ++i) {
        std::vector<std::array<Vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const Vec3 ab = normalized(a + b);
            const Vec3 bc = normalized(b + c);
            const Vec3 ca = normalized(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    std::vector<Vec3> normals;
    for (const std::array<Vec3, 3>& face : faces) {
        for (const Vec3& corner : face) add(normals, canonical({corner, 0}).normal);
    }
    return normals;
}

std::vector<Vec3> tool_directions(const std::array<Vec3, 3>& axes) {
    std::vector<Vec3> directions;
    for (const Vec3& normal : octahedron_normals()) {
        directions.push_back(normal);
        directions.push_back(-normal);
    }
    for (const Vec3& axis : axes) {
        if (contains(directions, axis)) continue;
        directions.push_back(axis);
        directions.push_back(-axis);
    }
    return directions;
}

std::vector<Vec3> dense_directions(std::size_t count) {
    assert(count > 0);
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double r = std::sqrt(1 - z * z);
        const double turn = golden * static_cast<double>(i);
        directions.push_back(normalized({r * std::cos(turn), r * std::sin(turn), z}));
    }
    return directions;
}

bool is_allowed(Vec3 direction, Vec3 up, double tilt_deg) {
    assert(tilt_deg >= 0 && tilt_deg <= largest_tilt_deg);
    return dot(direction, up) >= std::cos(radians(tilt_deg)) - 1e-9;
}

std::vector<std::uint32_t> allowed_directions(std::span<const Vec3> directions, Vec3 up, double tilt_deg) {
    std::vector<std::uint32_t> allowed;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (is_allowed(directions[i], up, tilt_deg)) allowed.push_back(static_cast<std::uint32_t>(i));
    }
    return allowed;
}

}  // namespace qchopper

// Tries boxes of falling size at places on a grid in front of the arm, then looks for all places of one a fifth
// smaller. A point is held if one of four turns about the tool's axis has an answer within the ranges.

#include "cam/cell/new_cell/straight_down_box.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/units.h"

namespace qchopper {
namespace {

constexpr double margin = 3 * degree;
constexpr int points = 5;                   // of the grid along each side
constexpr double largest_half_width = 600;  // mm
constexpr double least_half_width = 100;
constexpr double step = 50;               // of places and of sizes, mm
constexpr double nearest_side = 200;      // of the box from axis 1, mm
constexpr double height_share = 2.0 / 3;  // height over width
constexpr double smaller = 0.8;

// The tool's z points down; `turn` quarters about it.
Pose pointing_down(Vec3 tip, int turn) {
    constexpr std::array<Vec3, 4> directions{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}};
    const Vec3 x = directions[static_cast<std::size_t>(turn)];
    const Vec3 z{0, 0, -1};
    const Vec3 y = cross(z, x);
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, tip};
}

bool is_held(const StraightDownQuestion& question, Vec3 tip_in_cell) {
    const Vec3 flange = tip_in_cell + Vec3{0, 0, question.tool_length};
    for (int turn = 0; turn < 4; ++turn) {
        const Pose flange_in_base = inverse(question.base_in_cell) * pointing_down(flange, turn);
        if (!inverse_within(question.arm, question.ranges, margin, flange_in_base).empty()) return true;
    }
    return false;
}

bool is_held(const StraightDownQuestion& question, const Box& box) {
    const Vec3 size = box.max - box.min;
    for (int k = 0; k < points * points * points; ++k) {
        const int layer = k / (points * points);
        const Vec3 share =
            1.0 / (points - 1) *
            Vec3{static_cast<double>(k % points), static_cast<double>(k / points % points), static_cast<double>(layer)};
        const Vec3 tip = box.min + Vec3{share.x * size.x, share.y * size.y, share.z * size.z};
        if (!is_held(question, tip)) return false;
    }
    return true;
}

// The first `most` places where a box of half the width `half` is held, on a grid.
std::vector<Box> places_held(const StraightDownQuestion& question, double half, std::size_t most = 10'000) {
    const double reach = question.arm.a1 + question.arm.c2 + question.arm.c3;
    std::vector<Box> places;
    for (double z = question.least_height; z <= question.least_height + reach; z += step) {
        for (double x = nearest_side + half; x <= reach; x += step) {
            const Box box{{x - half, -half, z}, {x + half, half, z + 2 * height_share * half}};
            if (is_held(question, box)) places.push_back(box);
            if (places.size() == most) return places;
        }
    }
    return places;
}

// The one nearest to the mean of all; of equals the first. Precondition: there is one.
Box middle_one(const std::vector<Box>& places) {
    Vec3 mean;
    for (const Box& box : places) mean = mean + 1.0 / static_cast<double>(places.size()) * box.min;
    return *std::min_element(places.begin(), places.end(),
                             [&](const Box& a, const Box& b) { return norm(a.min - mean) < norm(b.min - mean); });
}

}  // namespace

std::optional<Box> straight_down_box(const StraightDownQuestion& question) {
    for (double half = largest_half_width; half >= least_half_width; half -= step) {
        if (!places_held(question, half, 1).empty()) return middle_one(places_held(question, smaller * half));
    }
    return std::nullopt;
}

}  // namespace qchopper

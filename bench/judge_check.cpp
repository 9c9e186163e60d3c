// The block is extruded along y from its profile in x and z; its slot opens towards larger x. From the floor of the
// slot the tool leaves along directions that rise by at most the slot's height over what lies before it, so that of the
// floor's depth h a share of min(1, (w / h) tan tilt) is open at a height of w; of the back wall all that lies h / tan
// tilt below the ceiling; of the ceiling nothing.

#include "bench/judge_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <ostream>
#include <utility>

#include "base/text.h"
#include "bench/reach_judge.h"

namespace qchopper::bench {
namespace {

constexpr double depth = 3;     // mm, of the slot
constexpr double height = 1;    // of the slot
constexpr double width = 6;     // of the block
constexpr double top = 3;       // of the block
constexpr double below = 1;     // the slot's floor
constexpr double length = 600;  // so long that its ends do not matter
constexpr std::int32_t cap = 1;

void add_quad(TriangleMesh& mesh, const std::array<Vec3, 4>& corners, std::int32_t cap_of) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.cap_of.insert(mesh.cap_of.end(), 2, cap_of);
}

// Points are not shared: rays do not ask for it.
Piece block() {
    const double roof = below + height;
    const double inner = width - depth;
    const std::array<std::pair<double, double>, 8> profile{
        {{0, 0}, {width, 0}, {width, below}, {inner, below}, {inner, roof}, {width, roof}, {width, top}, {0, top}}};
    TriangleMesh mesh;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const auto [x, z] = profile[i];
        const auto [next_x, next_z] = profile[(i + 1) % profile.size()];
        add_quad(mesh, {Vec3{x, length, z}, {next_x, length, next_z}, {next_x, 0, next_z}, {x, 0, z}},
                 i == 0 ? cap : no_cap);
    }
    for (const auto& [x, low, high] :
         {std::array{width, 0.0, below}, std::array{inner, below, roof}, std::array{width, roof, top}}) {
        add_quad(mesh, {Vec3{0, 0, low}, {x, 0, low}, {x, 0, high}, {0, 0, high}}, no_cap);
        add_quad(mesh, {Vec3{0, length, low}, {0, length, high}, {x, length, high}, {x, length, low}}, no_cap);
    }
    Piece piece;
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    piece.half_spaces.push_back({cap, {{0, 0, 1}, 0}, true});
    return piece;
}

double exact_mm2_per_mm(double tilt_deg) {
    const double slope = std::tan(tilt_deg * std::numbers::pi / 180);
    const double floor = depth * (1 - std::min(1.0, height / depth * slope));
    const double back = std::min(height, depth / slope);
    return floor + back + depth;
}

}  // namespace

void print_judge_check(std::ostream& out) {
    const Piece piece = block();
    out << "| tilt | judged | exact |\n|---|---|---|\n";
    for (const int tilt : {45, 60, 70, 80}) {
        JudgeOptions options;
        options.tilt_deg = tilt;
        options.samples = 40'000;
        out << "| " << tilt << " | " << fixed(judge(piece, options).unreachable_mm2 / length, 3) << " | "
            << fixed(exact_mm2_per_mm(tilt), 3) << " |\n";
    }
}

}  // namespace qchopper::bench

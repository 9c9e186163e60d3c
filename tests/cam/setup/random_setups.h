// Setups of boxes for the tests and the bench of the work envelope.

#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cam/setup/block.h"
#include "cam/setup/placement/place_block.h"
#include "cam/setup/setup.h"
#include "tests/reference/cam/setup/holds_at_placement.h"
#include "tests/shapes.h"

namespace qchopper::test_setups {

struct BoxSetup {
    Setup setup;
    TriangleMesh mesh;
};

// The way out of a tool with a tilt that leans towards an azimuth, both in degrees.
inline Vec3 tool_axis(double tilt_deg, double azimuth_deg) {
    const double t = tilt_deg * std::numbers::pi / 180;
    const double a = azimuth_deg * std::numbers::pi / 180;
    return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

// A box of a size in a block that is just as large as it must be.
inline BoxSetup box_setup(const Cell& cell, Vec3 size, const std::vector<Vec3>& directions) {
    BoxSetup made;
    made.mesh = shapes::box({-size.x / 2, -size.y / 2, 0}, {size.x / 2, size.y / 2, size.z}, 2);
    Setup& setup = made.setup;
    setup.box = {{-size.x / 2, -size.y / 2, 0}, {size.x / 2, size.y / 2, size.z}};
    const Margins margins = margins_of(cell);
    setup.spoil = margins.spoil;
    setup.block.size = size + Vec3{2 * margins.sides, 2 * margins.sides, margins.top + margins.spoil};
    for (const Vec3& direction : directions) {
        setup.access.orientations.push_back({direction, 180 / std::numbers::pi * std::acos(direction.z), 0, 0});
    }
    return made;
}

// Wider at its top, so that further orientations have something to mill.
inline void undercut(BoxSetup& made) {
    const double height = made.setup.box.max.z;
    for (Vec3& p : made.mesh.points) {
        const double share = 0.4 + 0.6 * p.z / height;
        p = {share * p.x, share * p.y, p.z};
    }
}

// A frustum on its smaller end, of a size up to that of the table, and up to three further directions with a tilt of at
// most 60 degrees.
inline BoxSetup random_setup(const Cell& cell, std::mt19937& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const Vec3 size{number(100, 0.9 * cell.table.size_x), number(100, 0.9 * cell.table.size_y), number(50, 950)};
    std::vector<Vec3> directions{{0, 0, 1}};
    const int further = cell.machine->robot ? static_cast<int>(number(0, 4)) : 0;
    for (int i = 0; i < further; ++i) directions.push_back(tool_axis(number(10, 60), number(0, 360)));
    BoxSetup made = box_setup(cell, size, directions);
    undercut(made);
    return made;
}

struct ScanStep {
    double shift = 200;    // mm
    double turn_deg = 30;  // of the block; of a rotary table the angles are searched at every place
};

// Whether any place of a scan about the middle of the table holds all poses.
inline bool scan_holds(Setup setup, const std::vector<OrientationPoses>& poses, const Cell& cell, ScanStep step) {
    const bool turns = !cell.machine->rotary_table;
    const int count = static_cast<int>(1500 / step.shift);
    for (double turn = 0; turn < (turns ? 359.9 : 0.1); turn += step.turn_deg) {
        for (int x = -count; x <= count; ++x) {
            for (int y = -count; y <= count; ++y) {
                setup.placement = {x * step.shift, y * step.shift, turn * std::numbers::pi / 180, {}};
                if (holds_at_placement(setup, poses, cell)) return true;
            }
        }
    }
    return false;
}

}  // namespace qchopper::test_setups

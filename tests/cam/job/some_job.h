// Jobs for the tests of this folder: half a ball on its cap, in a cell of each version. What the tool reaches is
// written down, not computed.

#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "cam/job/job.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/placement/place_block.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper::test_pieces {

inline JobInput some_job(int rings = 8) {
    const auto halves = cut_piece(uncut(shapes::ball({100, 20, -7}, 20, rings)), {{0, 0, 1}, -6.3}, 4);
    JobInput input;
    input.piece = halves->pieces.at(0);
    input.piece.name = "AB";
    input.piece_no = 2;
    input.piece_count = 5;
    input.program_version = "0.1.0";
    for (std::size_t i = 0; i < 16; ++i) input.project_id[i] = static_cast<std::uint8_t>(17 * i);
    for (std::size_t i = 0; i < 32; ++i) input.scan_sha256.bytes[i] = static_cast<std::uint8_t>(255 - i);
    input.cell = cell();
    input.setup = choose_setup(input.piece, input.cell).setups.front();
    input.stock_fit = check_stock_fit(input.setup, input.cell);
    input.warnings = {"scaled by 0.5 on request"};
    return input;
}

inline SurfaceAccess some_access(const JobInput& input) {
    SurfaceAccess access;
    access.method = AccessMethod::mapped;
    const double s = std::sqrt(0.5);
    access.orientations = {{input.setup.up, 0, 0.75, 21.5},
                           {rotate_inverse(input.setup.piece_in_setup, {0, s, s}), 45, 0.125, 30.25}};
    access.further = ToolOrientation{rotate_inverse(input.setup.piece_in_setup, {-1, 0, 0}), 90, 0.01, 12};
    access.area_mm2 = 2000;
    access.hidden_mm2 = 50;
    access.steep_mm2 = 20;
    access.holder_mm2 = 30;
    access.too_narrow_mm2 = 44;
    access.all_directions_share = 0.0125;
    access.foam_mm3 = 12345;
    access.foam_depth_mm = 6.7;
    access.rest_material_mm3 = 890;
    access.ignored_mm2 = 123;
    return access;
}

// In a cell with a machine, from a block that is sawn, with a spoil layer: 5 % of the surface are out of reach, and the
// limit is 2 %.
inline JobInput tilting_job(int rings = 8) {
    JobInput input = some_job(rings);
    input.max_unreachable = 0.02;
    CellMachine machine;
    CuttingTool long_ball;
    long_ball.number = 1;
    long_ball.name = "long ball";
    long_ball.diameter = 20;
    long_ball.corner_radius = 10;
    long_ball.stick_out = 180;
    long_ball.is_length_measured = true;
    long_ball.rpm_max = 18000;
    long_ball.feed_max_mm_per_s = 150;
    CuttingTool fine = long_ball;
    fine.number = 7;
    fine.name = "fine <cone>";
    fine.shape = ToolShape::cone;
    fine.diameter = 6;
    fine.stick_out = 92.5;
    fine.is_length_measured = false;
    machine.tools = {long_ball, fine};
    input.cell.machine = machine;
    input.cell.stock[1].is_sawn = true;
    input.cell.stock[1].kerf = 3;
    Setup& setup = input.setup;
    setup.base_number = 2;
    setup.spoil = 12;
    setup.undercut_by_count = 0.0625;
    setup.block = {1, false, true, {58, 56, 44}, true, {{339, 300, 60}, {58, 241, 60}, {58, 56, 13}}};
    setup.access = some_access(input);
    setup.workholding = Workholding{{20, 0.1, 4}, 0.6, 32, 2500, 50, 45.5, 160.25, 2.5, 2400, std::nullopt};
    input.states.resize(input.piece.mesh->triangles.size());
    for (std::size_t t = 0; t < input.states.size(); ++t) {
        const Vec3 at = apply(setup.piece_in_setup, corners_of(*input.piece.mesh, t)[0]);
        input.states[t] = static_cast<SurfaceState>(static_cast<int>(3 + std::floor(std::atan2(at.y, at.x))) % 5);
    }
    Setup other = setup;
    other.base_number = 1;
    other.base_description = "without a cap, lying on its side";
    other.access.hidden_mm2 = 400;
    input.alternatives = {other};
    other.base_number = 3;
    other.access.method = AccessMethod::sampled;
    input.alternatives.push_back(other);
    return input;
}

// From a block that is sawn: caps at right angles, of which one is the base and the other a face of the block, and one
// askew, which is milled.
inline JobInput sawn_job() {
    JobInput input = some_job(16);
    input.piece = cut_piece(input.piece, {{1, 0, 0}, 97}, 5)->pieces.at(0);
    input.piece = cut_piece(input.piece, {normalized({0.5, 0.8, 0.2}), 64}, 6)->pieces.at(0);
    input.piece.name = "AB";
    for (Stock& stock : input.cell.stock) {
        stock.is_sawn = true;
        stock.kerf = 3;
    }
    input.setup = choose_setup(input.piece, input.cell).setups.front();
    input.stock_fit = check_stock_fit(input.setup, input.cell);
    return input;
}

// In a ready cell with an arm: its block is placed, and every pose of its milling is held.
inline const JobInput& placed_job() {
    static const JobInput job = [] {
        JobInput input = some_job();
        input.cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
        SetupOptions options;
        options.max_directions = 2;
        input.setup = choose_setup(input.piece, input.cell, options).setups.front();
        input.stock_fit = check_stock_fit(input.setup, input.cell);
        input.machine_reachability = place_block(input.setup, *input.piece.mesh, input.cell);
        input.setup.placement = input.machine_reachability.placement;
        return input;
    }();
    return job;
}

inline std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

// A square cap with holes of 8 mm in a row, numbered and not decided about.
inline DrawnCap capped(const JobInput& input, std::size_t holes) {
    DrawnCap drawn;
    drawn.cap.cut = 4;
    drawn.cap.cap_in_piece.shift = {1, 2, 30};
    drawn.outline = {{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};
    drawn.names_at = {{50, 50}};
    drawn.size = {100, 100};
    drawn.cap.joints = {{"B", 10'000, "", {}}};
    const Pose cap_in_setup = input.setup.piece_in_setup * drawn.cap.cap_in_piece;
    for (std::size_t number = 1; number <= holes; ++number) {
        const Point2 at{20.0 * static_cast<double>(number), 30};
        drawn.cap.joints[0].holes.push_back(
            {number, 8, 22, at, apply(cap_in_setup, {at.x, at.y, 0}), rotate(cap_in_setup, {0, 0, -1}), false, ""});
    }
    return drawn;
}

}  // namespace qchopper::test_pieces

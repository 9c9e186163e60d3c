// Toolpaths made by hand over a block of a ready cell, for the tests of cam/program and cam/post.

#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cam/program/make_program.h"
#include "tests/cam/setup/random_setups.h"

namespace qchopper::test_programs {

inline Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(std::string(QCHOPPER_SOURCE_DIR)) / "cells" / name);
}

struct Job {
    Cell cell;
    Setup setup;
    MachineReachability reachability;
    Toolpath toolpath;
};

// Two unit vectors across a direction.
struct Across {
    Vec3 u;
    Vec3 v;
};

inline Across across(Vec3 tool_axis) {
    const Vec3 u = normalized(std::abs(tool_axis.y) < 0.9 ? cross({0, 1, 0}, tool_axis) : Vec3{1, 0, 0});
    return {u, cross(tool_axis, u)};
}

inline double highest(const Setup& setup, Vec3 tool_axis, double clearance) {
    const Vec3 size = setup.block.size;
    return 0.5 * (std::abs(tool_axis.x) * size.x + std::abs(tool_axis.y) * size.y) +
           std::max(tool_axis.z * (size.z - setup.spoil), -tool_axis.z * setup.spoil) + clearance;
}

// A zig-zag about the middle of the block's upper part, at a depth below its highest corner along the direction.
inline PathRun raster(const Setup& setup, Vec3 tool_axis, double retract, double height, double half, double step) {
    const Across axes = across(tool_axis);
    const Vec3 middle{0, 0, 0.5 * (setup.block.size.z - setup.spoil)};
    const auto at = [&](double along, double side, double up) {
        const Vec3 flat = middle + along * axes.u + side * axes.v;
        return flat + (up - dot(tool_axis, flat)) * tool_axis;
    };
    PathRun run{at(-half, -half, retract), {{at(-half, -half, height), MoveKind::approach}}};
    bool is_forward = true;
    for (double side = -half; side <= half + 1e-9; side += step) {
        for (int i = 0; i <= 20; ++i) {
            const double along = (is_forward ? 1 : -1) * half * (i - 10) / 10.0;
            const double wave = 3 * std::sin(0.05 * along + 0.02 * side);
            run.moves.push_back({at(along, side, height + wave), MoveKind::cut, i > 0 && i < 20 ? 2.0 : 0.0});
        }
        is_forward = !is_forward;
    }
    run.moves.back().rounding = 0;
    const Vec3 last = run.moves.back().tip;
    run.moves.push_back({last + (retract - dot(tool_axis, last)) * tool_axis, MoveKind::retract});
    return run;
}

inline Operation operation(const Job& job, std::size_t orientation, std::size_t tool, double step) {
    const Vec3 tool_axis =
        normalized(rotate(job.setup.piece_in_setup, job.setup.access.orientations[orientation].tool_axis));
    Operation made;
    made.kind = tool == 0 ? OperationKind::roughing : OperationKind::finishing;
    made.tool = tool;
    made.orientation = orientation;
    const CuttingTool& own = job.cell.machine->tools[tool];
    made.feed = 0.8 * own.feed_max_mm_per_s;
    made.approach_feed = 0.4 * own.feed_max_mm_per_s;
    made.link_feed = job.cell.machine->program.link_feed_mm_per_s;
    made.rpm = own.rpm_max;
    made.rounding = 2;
    made.retract = highest(job.setup, tool_axis, job.cell.clearance);
    const double top = made.retract - job.cell.clearance;
    for (const double depth : {10.0, 25.0, 40.0}) {
        made.runs.push_back(raster(job.setup, tool_axis, made.retract, top - depth, 60, step));
    }
    return made;
}

// A block of a size, milled straight from above by two tools and from a tilted direction by one.
inline Job job_in(const Cell& cell, Vec3 size, double tilt_deg, double azimuth_deg, double step = 15) {
    Job job;
    job.cell = cell;
    const std::vector<Vec3> directions{{0, 0, 1}, test_setups::tool_axis(tilt_deg, azimuth_deg)};
    test_setups::BoxSetup made = test_setups::box_setup(cell, size, directions);
    job.setup = made.setup;
    job.reachability = place_block(job.setup, made.mesh, cell);
    job.setup.placement = job.reachability.placement;
    job.toolpath.operations = {operation(job, 0, 0, step), operation(job, 0, 3, step), operation(job, 1, 0, step)};
    return job;
}

inline Program program_of(const Job& job) {
    return make_program(job.toolpath, job.setup, job.reachability, job.cell);
}

}  // namespace qchopper::test_programs

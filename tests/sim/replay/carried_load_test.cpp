// What is expected of $LOAD beside what the toolpath's side writes: two computations, made apart, of the same bodies.

#include "sim/replay/carried_load.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "cam/cell/cell.h"
#include "cam/cell/kuka_angles.h"
#include "cam/program/program.h"
#include "sim/replay/turn.h"

namespace qchopper {
namespace {

ProgramLoad as_stated(const LoadData& load) {
    const KukaAngles abc = kuka_angles(load.centre_in_flange);
    return {load.mass_kg, {load.centre_in_flange.shift, {abc.a, abc.b, abc.c}}, load.inertia_kg_m2};
}

TEST(CarriedLoad, IsThatOfThePost) {
    const std::filesystem::path folder = std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells";
    for (const char* name : {"kr60-ha.toml", "kr120-r2500-pro-rotary.toml", "irb6640-185-2.8.toml"}) {
        const Cell cell = read_cell(folder / name);
        Spindle spindle = cell.machine->spindle;
        for (const ToolAxis axis : {ToolAxis::z, ToolAxis::x}) {
            spindle.tool_axis = axis;
            // Across the flange, turned about all axes.
            spindle.spindle_in_flange = turned({Pose{}.row, {20, -35, 180}}, {0.9, normalized({1, 2, 3})}, 1);
            spindle.body_offset = 12;
            for (const CuttingTool& tool : cell.machine->tools) {
                const CarriedLoad expected = carried_load(spindle, tool);
                const CarriedLoad stated = carried_load(as_stated(load_data(spindle, tool)));
                EXPECT_NEAR(stated.mass_kg, expected.mass_kg, 1e-9);
                EXPECT_LT(norm(stated.centre - expected.centre), 1e-6) << name << " " << tool.name;
                EXPECT_LT(inertia_off(stated, expected), 1e-9) << name << " " << tool.name;
            }
        }
    }
}

TEST(CarriedLoad, OfOneCylinderIsThatOfTheFormula) {
    Spindle spindle;
    spindle.mass_kg = 12;
    spindle.body_radius = 100;
    spindle.body_length = 300;
    CuttingTool tool;
    tool.mass_kg = 0;
    const CarriedLoad load = carried_load(spindle, tool);
    EXPECT_LT(norm(load.centre - Vec3{0, 0, -150}), 1e-9);
    EXPECT_NEAR(load.inertia[2].z, 12 * 0.01 / 2, 1e-12);
    EXPECT_NEAR(load.inertia[0].x, 12 * (0.01 / 4 + 0.09 / 12), 1e-12);
}

}  // namespace
}  // namespace qchopper

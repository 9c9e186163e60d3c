// What the flange carries, by the cell file and by the load data of a program.
//
// mm, kg, kg m2, in the frame of the flange. By the cell file: the spindle is a solid cylinder of the size of its body,
// tool and holder are one from the nose to the tip with their largest diameter, both of even density
// (docs/developer/formats/programs.md). Inertia is about the centre of mass; parallel axes by J. Steiner's theorem.
// O(steps of the holder) (tests/sim/replay/carried_load_test.cpp holds it against the load data of cam/program).

#pragma once

#include <array>

#include "base/vec3.h"
#include "cam/cell/cutting_tool.h"
#include "cam/cell/robot.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

struct CarriedLoad {
    double mass_kg = 0;
    Vec3 centre;
    std::array<Vec3, 3> inertia;  // rows of the tensor
};

CarriedLoad carried_load(const Spindle& spindle, const CuttingTool& tool);
CarriedLoad carried_load(const ProgramLoad& stated);

// The largest difference of two components.
double inertia_off(const CarriedLoad& a, const CarriedLoad& b);

}  // namespace qchopper

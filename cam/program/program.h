// The program of a setup before it has a language: what the machine does, in which order, and how it is held.
//
// Values only. mm, mm/s, radians, seconds, kg; tips in setup coordinates (cam/setup/setup.h), joints as the controller
// shows them. Of a gantry all joints are zero and ways hold nothing. Made by make_program.h, written as text by
// cam/post; signals and calls are those of the cell file. tests/cam/program/make_program_test.cpp holds that every tip
// follows from its joints.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/arm.h"
#include "cam/cell/cutting_tool.h"
#include "cam/cell/robot.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// What the flange carries, as the controller's dynamics want it.
struct LoadData {
    double mass_kg = 0;
    Pose centre_in_flange;  // z along the tool axis
    Vec3 inertia_kg_m2;     // about the centre, along the axes of that frame
    bool operator==(const LoadData&) const = default;
};

// Estimated from the cell file: the spindle as a solid cylinder of its body's size, tool and holder as one from the
// nose to the tip with the largest diameter of them, each of even density. Inertia by the theorem of parallel axes.
LoadData load_data(const Spindle& spindle, const CuttingTool& tool);

struct ProgramTool {
    // The frame in which a program states orientations: the axes of the spindle's frame in the cell file (so that
    // Spindle::tool_axis says which of them is the tool axis), its origin at the tip.
    Pose tool_in_flange;
    LoadData load;
    bool operator==(const ProgramTool&) const = default;
};

struct ProgramMove {
    Vec3 tip;  // where it ends
    MoveKind kind = MoveKind::cut;
    double rounding = 0;  // as PathMove::rounding
    double speed = 0;     // of the operation, or less where a joint would be too fast
    bool operator==(const ProgramMove&) const = default;
};

// As PathRun. Within an operation the tip goes straight from the end of one run to the start of the next.
struct ProgramRun {
    Vec3 start;
    Joints start_joints{};
    Joints end_joints{};
    double link_speed = 0;          // from the end of the run before, or from the retracted start
    bool starts_from_home = false;  // whether a joint move from home to its start is clear
    std::vector<ProgramMove> moves;
    std::size_t hole = 0;  // as PathRun::hole
    bool operator==(const ProgramRun&) const = default;
};

// Joint moves between home and an operation.
struct PtpPath {
    // Distance along the tool axis between its first start or last end and the pose where joint moves end or begin.
    double retract = 0;
    double retract_speed = 0;  // that every joint can follow
    std::vector<Joints> targets;
    bool operator==(const PtpPath&) const = default;
};

// What is milled by one tool from one direction in one arm posture. Between operations the arm is at home, where the
// table turns and tools are changed.
struct ProgramOperation {
    std::size_t toolpath_operation = 0;  // index in Toolpath::operations
    OperationKind kind = OperationKind::roughing;
    std::size_t tool = 0;         // index in CellMachine::tools
    std::size_t orientation = 0;  // index in SurfaceAccess::orientations, with those of drilling behind them
    Vec3 tool_axis;               // unit, in setup coordinates
    ArmConfiguration configuration;
    double redundancy_angle = 0;  // about the tool axis, of tip_frame() (machine_reachability.h)
    Pose tool_in_setup;           // orientation of the program's tool frame; its shift is 0
    double table_angle = 0;       // -pi..pi, of a rotary table; held while the operation is milled
    double rpm = 0;
    double link_feed = 0;           // from run to run, and on retracts
    PtpPath entry;                  // from home; the last target is the retracted start
    PtpPath exit;                   // from the retracted end; the last target is home
    std::vector<ProgramRun> runs;   // at least one
    std::size_t lowered_moves = 0;  // slower than the operation asks for
    bool operator==(const ProgramOperation&) const = default;
};

struct Program {
    // The setup in the base of the robot; where there is an external axis, on its table.
    Pose base;
    std::optional<int> external_axis;  // of the rotary table, 1..6
    bool has_arm = true;
    Joints home{};
    std::vector<ProgramTool> tools;  // in the order of CellMachine::tools
    std::vector<ProgramOperation> operations;
    double left_out_mm = 0;        // of cuts: no arm configuration takes them
    std::string left_out_because;  // of the first ones: operation, check, margin and pose
    bool operator==(const Program&) const = default;
};

}  // namespace qchopper

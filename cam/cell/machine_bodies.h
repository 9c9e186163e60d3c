// Where the bodies of a cell are: the links of the arm, spindle, holder and tool for given joints, and what stands
// still.
//
// mm and radians, in the cell's frame. The bodies are those of the cell file: capsules of the links, cylinders about
// the tool axis. The same frames as forward() of arm.h to 1e-9 mm (tests/cam/cell/machine_bodies_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/cell/shape_distance.h"

namespace qchopper {

enum class BodyPart : std::uint8_t { link, spindle, holder, tool };

// About the tool axis; it moves with the flange, link 6.
struct AxisBody {
    BodyPart part = BodyPart::tool;
    Cylinder shape;  // from its end next to the tip to the other one
    bool operator==(const AxisBody&) const = default;
};

struct MovingBodies {
    std::vector<LinkCapsule> links;  // Robot::capsules where they are now
    std::vector<AxisBody> on_axis;   // tool, steps of the holder from the tool on, spindle
    bool operator==(const MovingBodies&) const = default;
};

// Tool, holder and spindle in a frame with its origin at the tip and z out of the spindle. The tool reaches from the
// tip to its stick-out with its whole diameter.
std::vector<AxisBody> bodies_on_axis(const CuttingTool& tool, const Spindle& spindle);

// Whether a link keeps its place about the tool axis whatever the joints: the wrist, link 5, whose capsule lies about
// axis 6, where the tool axis is axis 6.
bool is_about_tool_axis(const LinkCapsule& link, const Robot& robot, const Spindle& spindle);

// bodies_on_axis(), and the wrist where it is about the tool axis and wider than the spindle: what comes over foam and
// piece with the tip. The wrist is a cylinder that holds what of its capsule is outside of the spindle, and `around`
// (mm) wider.
std::vector<AxisBody> bodies_over_tip(const CuttingTool& tool, const CellMachine& machine, double around = 0);

// The links k = 0..6 for joints: from where a point lay in the base while the arm stood straight up, all angles zero,
// to where it is in the cell.
using LinkMotions = std::array<Pose, axes_of_arm + 1>;
LinkMotions link_motions(const ArmGeometry& arm, const Joints& joints, const Pose& base_in_cell = {});

// All that moves. A gantry has no links, and `joints` are not used: its tip is at `gantry_tip`.
// Precondition: the cell has a machine. Allocates: for pictures and reports, not for every pose of a search.
MovingBodies bodies_at(const Cell& cell, const CuttingTool& tool, const Joints& joints, Vec3 gantry_tip = {});

// What stands still. A table is solid from its top down to the floor.
struct StandingBodies {
    double floor_z = 0;                // 0, or the table's top or the robot's base if that is lower
    std::optional<PlacedBox> table;    // a fixed one
    std::optional<Cylinder> rotary;    // the disc of a rotary table
    std::vector<PlacedBox> obstacles;  // in the order of CellMachine::obstacles
    bool operator==(const StandingBodies&) const = default;
};

// Precondition: the cell has a machine.
StandingBodies standing_bodies(const Cell& cell);

// Whether two links may touch, because they meet in an axis or in the wrist, or because the range of axis 5 keeps them
// apart. 6 stands for the flange with the spindle; holder and tool are asked as link 7. The table is in the source.
bool may_touch(int link, int other_link);

}  // namespace qchopper

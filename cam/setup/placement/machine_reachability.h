// The work envelope of a setup: whether the machine can hold every pose of its milling, by how much, and where the
// block has to stand for it.
//
// Values; mm and radians in the cell's frame unless a field says otherwise. A margin is in the unit of its check (mm,
// degrees or degrees/s) and what is left beyond what the check asks for: negative means refused. docs/user/envelope.md
// explains every check. Computed by place_block.h.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/arm.h"
#include "cam/setup/block_placement.h"

namespace qchopper {

// Of the tool tip on the piece, at the block, where it comes and goes above them; and where programs begin and end.
enum class PoseKind : std::uint8_t { tip, corner, edge, retract, home, tool_change };

// The tip's frame for a direction in which the tool comes out: its z is -tool_axis; `turn` (radians) is about the tool
// axis, and at 0 its x lies in the vertical plane of the tool axis, along -x for straight up. R = Rz(azimuth) Ry(pi -
// tilt) Rz(turn).
Pose tip_frame(Vec3 tip, Vec3 tool_axis, double turn);

enum class PoseCheck : std::uint8_t {
    block_on_table,
    travel,  // of a gantry: the tip in the reach box
    reach,   // the wrist centre is neither too far for the arm nor too near
    joint_limit,
    cable,
    shoulder,  // singularities
    elbow,
    wrist,
    joint_speed,        // at the feed, in every direction of motion
    axis_step,          // from one pose to the one beside it
    one_configuration,  // share of a region's poses that its configuration holds, where each could be held alone
    arm_to_block,
    arm_to_table,
    arm_to_floor,
    arm_to_obstacle,
    arm_to_arm,
    tool_to_block,    // tool, holder and spindle at home and where tools are changed
    holder_to_block,  // holder and spindle to the foam that stays, the spoil layer
    tool_to_table,    // tool, holder and spindle
    tool_to_floor,
    tool_to_obstacle,
    tool_to_arm
};

inline constexpr std::size_t pose_checks = 22;

struct CheckRule {
    PoseCheck check;
    const char* key;   // "joint_limit", for JSON
    const char* name;  // "joint limit"
    const char* unit;  // "mm", "deg", "deg/s" or "%"
    double needed;     // of what is measured, in the unit; the margin is what is left beyond
    double scale;      // a margin of so much counts as 1 when margins of several checks are compared
    bool is_placed;    // whether another place of the block can change it; the others are not maximised
};

// In the order of PoseCheck.
const CheckRule& rule_of(PoseCheck check);

// One pose of the machine.
struct ReachabilityPose {
    PoseKind kind = PoseKind::tip;
    std::size_t orientation = 0;  // index in SurfaceAccess::orientations; 0 for home and tool change
    Vec3 tip;                     // in setup coordinates; of home and tool change in the cell
    Vec3 tip_in_cell;
    Vec3 tool_axis_in_cell;        // unit, from the tip into the spindle
    double table_angle = 0;        // of a rotary table
    double redundancy_angle = 0;   // about the tool axis
    std::optional<Joints> joints;  // nothing: not reached, or a gantry
    bool operator==(const ReachabilityPose&) const = default;
};

// The tightest of all poses for one check.
struct ReachabilityMargin {
    PoseCheck check = PoseCheck::reach;
    double margin = 0;    // in rule_of(check).unit; where parts overlap, less what is needed
    double relative = 0;  // margin / rule_of(check).scale
    std::string pair;     // what is near what: "link 3 and the block", "axis 5 and its upper limit"
    ReachabilityPose pose;
    bool operator==(const ReachabilityMargin&) const = default;
};

// Whether nothing is missing, but for rounding.
bool is_held(const ReachabilityMargin& margin);
// False where it is the block that is asked, not a pose.
inline bool has_pose(const ReachabilityMargin& margin) {
    return margin.check != PoseCheck::block_on_table;
}
// "corner of the block at 300, -200, 390 mm, orientation 2"; "home".
std::string describe_pose(const ReachabilityPose& pose);
// "arm to block, link 3 and the block: 12.5 mm (corner of the block at ...)".
std::string describe_margin(const ReachabilityMargin& margin);

// How a region is milled.
struct RegionReachability {
    std::size_t orientation = 0;
    std::size_t poses = 0;
    bool holds = false;
    ArmConfiguration configuration;  // of all its poses
    double redundancy_angle = 0;     // about the tool axis, of all its poses, radians
    double relative = 0;             // the smallest relative margin of what a place can change
    bool operator==(const RegionReachability&) const = default;
};

// In the order in which they are tried. The last three are named, not tried.
enum class Remedy : std::uint8_t {
    none,
    redundancy_angle,
    configuration,
    table_turn,
    block_shift,
    base,
    orientations,
    cut
};

// "turn the tool about its axis", "another arm configuration", ...
const char* describe(Remedy remedy);

// As documents name it: "none", "tool_turn", "arm_configuration", ...
const char* to_word(Remedy remedy);

struct MachineReachability {
    bool is_arm_checked = false;              // false: a cell without a machine; all else is empty then
    BlockPlacement placement;                 // best of those searched, also where none holds
    std::vector<ReachabilityMargin> margins;  // one per check that was made, in the order of PoseCheck
    std::vector<RegionReachability> regions;  // by direction; none for a gantry
    // If all holds: the last remedy that was needed, beginning with the block in the middle of the table, the tool not
    // turned and the arm as at home. Else the nearest remedy that is left: base, orientations or cut.
    Remedy remedy = Remedy::none;
    std::size_t poses = 0;   // checked at the final place
    std::size_t places = 0;  // of the block, tried

    bool holds() const;
    // Of the smallest relative margin: of refused ones if there are any, else of those that a place can change, else of
    // all. Precondition: is_arm_checked.
    const ReachabilityMargin& tightest() const;
    bool operator==(const MachineReachability&) const = default;
};

// "piece B can be carved, tightest: axis 5 and its upper limit 4.2 deg (...)" or "piece B cannot be carved: link 3 and
// the block 12 mm too near at ...; try another base"; "arm not checked" without a machine.
std::string describe_reachability(const std::string& piece, const MachineReachability& reachability);

}  // namespace qchopper

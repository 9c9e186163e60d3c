// The toolpath of a setup: where the tip of which tool goes, in which order, before any machine is asked.
//
// Values only; lengths in mm, in setup coordinates (cam/setup/setup.h), speeds in mm/s. The tip of a tool is the point
// of its lowest end on its axis; while a direction is milled the tool axis points along -tool_axis.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// Roughing leaves an allowance. Fine finishing goes only where the tool of the finishing left more than the scallop
// height. Drilling comes last and makes the holes for dowels (drilling.h).
enum class OperationKind : std::uint8_t { roughing, finishing, fine_finishing, drilling };

// "roughing", "finishing", "fine finishing", "drilling"
inline const char* to_word(OperationKind kind) {
    constexpr std::array words{"roughing", "finishing", "fine finishing", "drilling"};
    return words[static_cast<std::size_t>(kind)];
}

// What a move is for, which decides its speed: an approach enters the foam from above, a cut removes foam, a link leads
// to the next cut through space that is already clear, a retract leaves.
enum class MoveKind : std::uint8_t { approach, cut, link, retract };

// A straight move of the tip.
struct PathMove {
    Vec3 tip;  // where it ends
    MoveKind kind = MoveKind::cut;
    // How far before its end the controller may begin to round the corner there, and as far behind it end; at most in
    // the middle of the shorter move. 0: the corner is exact.
    double rounding = 0;
    // Of a cut or an approach that would remove foam faster than the tool may; 0: that of its kind in the operation.
    double feed = 0;
    bool operator==(const PathMove&) const = default;
};

// Moves without a break. It begins and ends at the retract height of its direction, above everything that stands on the
// table; the last move is a retract.
struct PathRun {
    Vec3 start;
    std::vector<PathMove> moves;  // at least two
    std::size_t hole = 0;         // the number of the hole that it drills; 0: none
    bool operator==(const PathRun&) const = default;
};

// What one tool does from one direction.
struct Operation {
    OperationKind kind = OperationKind::roughing;
    std::size_t tool = 0;         // index in CellMachine::tools
    std::size_t orientation = 0;  // index in SurfaceAccess::orientations; of drilling also beyond (drilling.h)
    double feed = 0;              // of cuts
    double approach_feed = 0;
    double link_feed = 0;  // of links and retracts
    double rpm = 0;
    double rounding = 0;        // the largest of its moves
    double stepover = 0;        // largest distance between neighbouring passes
    double stepdown = 0;        // of roughing: height of a level; else 0
    double allowance = 0;       // of foam that is left on the piece
    double scallop = 0;         // of finishing: the scallop height that holds wherever the tool fits; else 0
    double retract = 0;         // height along the direction's `out` of the plane in which runs begin and end
    std::vector<PathRun> runs;  // at least one
    bool operator==(const Operation&) const = default;
};

// Of a kind of move, in mm/s.
inline double feed_of(const Operation& operation, MoveKind kind) {
    if (kind == MoveKind::approach) return operation.approach_feed;
    return kind == MoveKind::cut ? operation.feed : operation.link_feed;
}
// Of one move, in mm/s.
inline double feed_of(const Operation& operation, const PathMove& move) {
    return move.feed > 0 ? move.feed : feed_of(operation, move.kind);
}

// A ball-ended tool that the toolpath does not use along a direction, and why.
struct UnusedTool {
    std::optional<std::size_t> tool;         // index in CellMachine::tools; nothing: no tool of the cell
    std::optional<std::size_t> orientation;  // index in SurfaceAccess::orientations; nothing: along none
    std::string because;                     // for people, without a full stop
    bool operator==(const UnusedTool&) const = default;
};

struct Toolpath {
    std::vector<Operation> operations;  // in the order in which they are milled; at least one
    double cell = 0;                    // of the height fields that finishing was made from
    double path_tolerance = 0;  // by how much points were reduced: the path is at most so far above the exact one
    std::vector<UnusedTool> unused = {};  // of all directions of the setup
    bool operator==(const Toolpath&) const = default;
};

}  // namespace qchopper

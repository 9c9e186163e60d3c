// Where the real tip of the tool in the spindle goes when a program is executed.
//
// mm, in setup coordinates: of the block as it stands at that moment, on a rotary table turned with it.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "cam/cell/arm.h"
#include "sim/program/parsed_program.h"
#include "sim/program/rounded_corner.h"

namespace qchopper {

// Of spindle and extraction.
struct SignalState {
    bool spindle_is_on = false;
    bool has_speed = false;  // waited for since it was switched on, or the cell has no signal for it
    double rpm = 0;
    bool extraction_is_on = false;
};

// By how much each joint changes while the tip goes on by one mm, radians/mm.
using JointRates = std::array<float, axes_of_arm>;

// A straight line of the tip.
struct TipLine {
    Vec3 from;
    Vec3 to;
    SourcePlace place;
    std::uint32_t chunk = 0;        // index in ReplayScene::chunks
    std::uint32_t tool = 0;         // index in CellMachine::tools
    std::uint32_t orientation = 0;  // index in ReplayScene::orientations
    double feed = 0;
    double acceleration = 0;    // of the tip: $ACC.CP, or less where an axis allows less (path_time.h)
    double rounding = 0;        // of the corner at its end; 0: it is exact
    bool is_aligned = true;     // the tool axis is along the direction
    bool follows_line = false;  // it begins where the line before it ends
    SignalState signals;        // as the chunk itself has switched them
    std::uint32_t hole = 0;     // that a comment of the program names for it; 0: none
    std::uint32_t use = 0;      // index in ToolPath::uses
    JointRates first_rates{};   // where it begins
    JointRates last_rates{};    // where it ends
};

// The tool on the way of a joint move.
struct TipPose {
    Vec3 tip;
    Vec3 tool_axis;  // unit vector from the tip into the spindle
};

struct JointSweep {
    std::vector<TipPose> poses;
    SourcePlace place;
    std::uint32_t tool = 0;
    double seconds = 0;
    bool is_checked_only =
        false;              // not gone: a comment says that the joint move from home to the chunk's start is free
    std::uint32_t use = 0;  // index in ToolPath::uses: of its chunk, or of the chunk before it
    // No joint move, but the line behind one, on which the tool turns (ReplayScene::entered_turn): it is a line of the
    // path too.
    bool is_of_line = false;
};

// A tool in a kind of operation, as the comments of the chunks say it.
struct ToolUse {
    std::string operation;   // ProgramChunk::operation
    std::uint32_t tool = 0;  // index in CellMachine::tools
    bool operator==(const ToolUse&) const = default;
};

// One or the other, in the order of execution.
struct PathPart {
    bool is_line = false;
    std::size_t index = 0;
};

struct ToolChange {
    std::uint32_t use = 0;   // index in ToolPath::uses, of the first chunk with the tool
    std::size_t before = 0;  // index in ToolPath::order of the part that follows
};

struct ToolPath {
    std::vector<TipLine> lines;
    std::vector<JointSweep> sweeps;
    std::vector<PathPart> order;
    std::vector<ToolUse> uses;  // each once, in the order of first use; at least one
    std::vector<ToolChange> tool_changes;

    // The line that ends where line i begins, and the one that begins where it ends; nullptr: there is none.
    const TipLine* before(std::size_t i) const { return i > 0 && lines[i].follows_line ? &lines[i - 1] : nullptr; }
    const TipLine* after(std::size_t i) const {
        return i + 1 < lines.size() && lines[i + 1].follows_line ? &lines[i + 1] : nullptr;
    }
};

// The corner between two lines of which one goes on where the other ends.
inline RoundedCorner corner_of(const TipLine& line, const TipLine& next) {
    return round_corner(line.from, line.to, next.to, line.rounding);
}

}  // namespace qchopper

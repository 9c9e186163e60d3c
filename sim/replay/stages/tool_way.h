// The way of the tool with its times: where the tip comes to, when, and by which line of the program.
//
// mm, seconds, setup coordinates. Times are those of path_time.h, each part after the one before it, and a tool change
// before the part that follows it. O(parts) (tests/sim/replay/stages/replay_stages_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

enum class WayKind : std::uint8_t {
    joint_move,
    tool_change,  // the tip stands
    link,         // faster than the window of the tool
    air,          // at the feed of cuts, removes nothing
    cut
};

// Where the tip comes to, and how.
struct WayPoint {
    Vec3 tip;
    double seconds = 0;  // since the program began
    SourcePlace place;
    std::uint16_t tool = 0;         // CuttingTool::number
    std::uint32_t orientation = 0;  // index in ReplayScene::orientations; of a joint move that of the line before
    WayKind kind = WayKind::link;
};

// What is done when the first so many parts of a path are.
struct PartDone {
    std::size_t points = 0;  // of the way
    double seconds = 0;
    double removed_mm3 = 0;
};

struct ToolWay {
    std::vector<WayPoint> points;
    std::vector<PartDone> done;  // by the number of parts, from 0
    double seconds = 0;          // PathTime::seconds
};

// `cuts` are those of each line of the path. Empty: they are not known, and what is no link is called a cut.
// Precondition: the tools of the path are those of the machine.
ToolWay tool_way(const ToolPath& path, const CellMachine& machine, std::span<const LineCut> cuts = {});

}  // namespace qchopper

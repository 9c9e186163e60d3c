// Where the machine time of a program goes: by kind of operation and tool, and in these by what the machine does.
//
// Seconds, mm, mm3. Times are those of path_time.h, the foam is that of mill_stock.h. A line counts for the chunk that
// it stands in; a joint move between chunks for the one before it, a tool change for the first one with the tool. The
// rows add up to the time, the length and the volume of the whole (tests/sim/replay/time_account_test.cpp, which holds
// the times against a script that reads the text on its own).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/path_time.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

struct TimeRow {
    std::string operation;      // ProgramChunk::operation
    std::uint16_t tool = 0;     // CuttingTool::number
    double tool_mm3_per_s = 0;  // CuttingTool::removal_mm3_per_s
    double cutting_s = 0;       // length over feed of lines that remove foam and are not faster than the tool's window
    double air_s = 0;           // of lines not faster than that, which remove nothing
    double link_s = 0;          // of faster ones
    double acceleration_s = 0;  // what lines take beyond length over feed: ramps, stops, slow corners, the cycle
    double joint_move_s = 0;    // those that are gone, not those that are only checked
    double tool_change_s = 0;
    double cutting_mm = 0;
    double air_mm = 0;
    double link_mm = 0;
    double removed_mm3 = 0;
    std::size_t lines = 0;
    std::size_t stops = 0;        // lines at whose end the tip stands
    std::size_t short_lines = 0;  // shorter than feed times cycle
    std::size_t tool_changes = 0;
    double line_s() const { return cutting_s + air_s + link_s + acceleration_s; }
    double seconds() const { return line_s() + joint_move_s + tool_change_s; }
    double line_mm() const { return cutting_mm + air_mm + link_mm; }
};

struct TimeAccount {
    std::vector<TimeRow> rows;  // one for each of ToolPath::uses
    TimeRow total() const;      // without operation and tool
};

// Preconditions: `time` and `milling` are of the path, its tools are those of the machine. O(lines).
TimeAccount account_of(const ToolPath& path, const PathTime& time, const MillingFigures& milling,
                       const CellMachine& machine);

}  // namespace qchopper

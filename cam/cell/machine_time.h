// Where the machine time of a program goes, in one kind of operation with one tool: as the replay finds it
// (sim/replay/time_account.h), and as verdict, setup sheet and reports show it.
//
// Seconds, mm, mm3.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace qchopper {

struct MachineTime {
    std::string operation;      // "roughing", "finishing", "fine finishing", "drilling" or "unknown"
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
    std::uint64_t lines = 0;
    std::uint64_t stops = 0;        // lines at whose end the tip stands
    std::uint64_t short_lines = 0;  // shorter than feed times cycle
    std::uint64_t tool_changes = 0;
    double line_s() const { return cutting_s + air_s + link_s + acceleration_s; }
    double seconds() const { return line_s() + joint_move_s + tool_change_s; }
    double line_mm() const { return cutting_mm + air_mm + link_mm; }
    bool operator==(const MachineTime&) const = default;
};

// Adds amounts; operation and tool stay those of the sum.
void add(MachineTime& sum, const MachineTime& row);

// Without operation and tool. O(rows).
MachineTime sum_of(const std::vector<MachineTime>& rows);

}  // namespace qchopper

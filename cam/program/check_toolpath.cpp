// Every value is compared with its bounds; comparisons are written so that NaN fails.

#include "cam/program/check_toolpath.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr double farthest = 5000;  // mm

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw InputError(InputFault::use, where + ": " + what);
}

bool is_near(Vec3 point) {
    return std::abs(point.x) < farthest && std::abs(point.y) < farthest && std::abs(point.z) < farthest;
}

void check_value(const std::string& where, const char* name, double value, double least, double largest) {
    constexpr double rounding = 1e-9;
    if (value >= least * (1 - rounding) && value <= largest * (1 + rounding)) return;
    refuse(where, std::string(name) + " " + significant(value, 6) + " is not in " + significant(least, 6) + " to " +
                      significant(largest, 6));
}

void check_speeds(const std::string& where, const Operation& operation, const CellMachine& machine) {
    const CuttingTool& tool = machine.tools[operation.tool];
    const double link = machine.program.link_feed_mm_per_s;
    check_value(where, "feed", operation.feed, tool.feed_min_mm_per_s, tool.feed_max_mm_per_s);
    check_value(where, "approach feed", operation.approach_feed, 0.5 * tool.feed_min_mm_per_s, tool.feed_max_mm_per_s);
    check_value(where, "link feed", operation.link_feed, 0.5 * tool.feed_min_mm_per_s, std::max(link, operation.feed));
    check_value(where, "speed of the spindle", operation.rpm, tool.rpm_min, tool.rpm_max);
    check_value(where, "rounding", operation.rounding, 0, 1000);
}

void check_run(const std::string& where, const PathRun& run) {
    if (run.moves.empty()) refuse(where, "has no moves");
    if (!is_near(run.start)) refuse(where, "starts farther than 5 m from the setup's origin, or nowhere");
    for (std::size_t i = 0; i < run.moves.size(); ++i) {
        if (is_near(run.moves[i].tip)) continue;
        refuse(where + ", move " + std::to_string(i + 1), "ends farther than 5 m from the setup's origin, or nowhere");
    }
}

}  // namespace

void check_toolpath(const Toolpath& toolpath, const Setup& setup, const Cell& cell) {
    assert(cell.machine);
    if (toolpath.operations.empty()) refuse("the toolpath", "is empty");
    for (std::size_t i = 0; i < toolpath.operations.size(); ++i) {
        const Operation& operation = toolpath.operations[i];
        const std::string where = "operation " + std::to_string(i + 1) + " of the toolpath";
        if (operation.tool >= cell.machine->tools.size()) refuse(where, "its tool is not in the cell file");
        if (operation.orientation >= setup.access.orientations.size())
            refuse(where, "its orientation is not of the setup");
        if (operation.runs.empty()) refuse(where, "has no runs");
        check_speeds(where, operation, *cell.machine);
        for (std::size_t k = 0; k < operation.runs.size(); ++k) {
            check_run(where + ", run " + std::to_string(k + 1), operation.runs[k]);
        }
    }
}

}  // namespace qchopper

// Frames are compared by the distance of their origins and by one angle. O(chunks + tools).

#include "app/jobs/entered/entered_values.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/job_tools.h"
#include "cam/cell/kuka_angles.h"
#include "cam/job/read_job.h"
#include "cam/setup/block_placement.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/turn.h"

namespace qchopper {
namespace {

// What rounding in the text of a program does at most: frames have three decimals of mm and four of degrees, and a
// question the length with two.
constexpr double written_shift = 0.001;
constexpr double written_turn_deg = 0.0002;
constexpr double written_length = 0.0051;

[[noreturn]] void refuse(const std::string& what, const std::string& to_do) {
    throw InputError(InputFault::use, what, to_do);
}

Vec3 in_radians(Vec3 deg) {
    return {radians(deg.x), radians(deg.y), radians(deg.z)};
}

Pose pose_of_base(const EnteredBase& base) {
    return pose_of(ProgramFrame{base.shift, in_radians(base.abc_deg)});
}

double degrees_between(const Pose& a, const Pose& b) {
    return degrees(turn_between(a, b).angle);
}

bool is_as_written(const Pose& planned, const Pose& entered) {
    return norm(entered.shift - planned.shift) <= written_shift &&
           degrees_between(planned, entered) <= written_turn_deg;
}

bool is_as_written(double planned, double entered) {
    return std::abs(entered - planned) <= written_length;
}

EnteredBase shown(const Pose& base) {
    const KukaAngles abc = kuka_angles(base);
    return {base.shift, {degrees(abc.a), degrees(abc.b), degrees(abc.c)}};
}

std::string words(const EnteredBase& base) {
    std::string text;
    const auto add = [&](const char* name, double value, int decimals) {
        text += (text.empty() ? "" : " ") + std::string(name) + " " + fixed(value, decimals);
    };
    for (int i = 0; i < 3; ++i) add(i == 0 ? "X" : i == 1 ? "Y" : "Z", base.shift[i], 2);
    for (int i = 0; i < 3; ++i) add(i == 0 ? "A" : i == 1 ? "B" : "C", base.abc_deg[i], 3);
    return text;
}

BaseDifference base_difference(const EnteredBase& entered, const ReadJob& job, const std::string& job_file,
                               const Cell& cell) {
    for (int i = 0; i < 3; ++i) {
        if (std::isfinite(entered.shift[i]) && std::isfinite(entered.abc_deg[i])) continue;
        refuse("the entered base of " + job_file + " is not six finite numbers", "give X, Y, Z, A, B and C");
    }
    const Pose planned = planned_base(cell, job.setup, job.setup_in_cell);
    const Pose base = pose_of_base(entered);
    const BaseDifference off{entered, shown(planned), norm(base.shift - planned.shift), degrees_between(planned, base)};
    if (off.shift <= max_base_shift && off.turn_deg <= max_base_turn_deg) return off;
    refuse("the entered base is " + fixed(off.shift, 1) + " mm and " + fixed(off.turn_deg, 2) +
               " degrees from the base that " + job_file + " is planned for, " + words(off.planned) + "; at most " +
               fixed(max_base_shift, 0) + " mm and " + fixed(max_base_turn_deg, 0) + " degree are allowed",
           "lay the block as the setup sheet shows it, and touch it off again");
}

std::vector<std::uint16_t> used_tools(const ReadJob& job) {
    std::vector<std::uint16_t> tools;
    for (const JobChunk& chunk : job.program->chunks) tools.push_back(chunk.tool);
    std::sort(tools.begin(), tools.end());
    tools.erase(std::unique(tools.begin(), tools.end()), tools.end());
    return tools;
}

const CuttingTool* tool_of(const Cell& cell, std::uint16_t number) {
    const auto found = std::ranges::find(cell.machine->tools, number, &CuttingTool::number);
    return found != cell.machine->tools.end() ? &*found : nullptr;
}

LengthDifference length_difference(const EnteredLength& entered, const std::vector<std::uint16_t>& used,
                                   const std::string& job_file, const Cell& cell) {
    const std::string name = "tool " + std::to_string(entered.tool);
    const CuttingTool* tool = tool_of(cell, entered.tool);
    if (tool == nullptr || !std::binary_search(used.begin(), used.end(), entered.tool)) {
        refuse(job_file + " does not use " + name + ", but " + describe_tools(used),
               "give the lengths of its own tools only");
    }
    const double planned = gauge_length(*tool);
    if (!std::isfinite(entered.length)) {
        refuse("the entered length of " + name + " of " + job_file + " is no finite number",
               "give the length from the spindle nose to the tip in mm");
    }
    if (std::abs(entered.length - planned) <= max_length_off) return {entered.tool, entered.length, planned};
    refuse("the entered length of " + name + " is " + fixed(entered.length, 2) + " mm, " +
               fixed(std::abs(entered.length - planned), 2) + " mm from the " + fixed(planned, 2) + " mm that " +
               job_file + " is planned for; at most " + fixed(max_length_off, 0) + " mm are allowed",
           "set the tool in its holder to the length on the setup sheet, and measure it again");
}

void check_takes_values(const ReadJob& job, const std::string& job_file, const Cell& cell) {
    if (!job.program) {
        refuse(
            job_file + " holds no robot program, so that no entered values can be checked: " + job.no_program_because,
            "its setup sheet says what is done by hand");
    }
    if (job.cell_id != cell.id) {
        refuse(job_file + " is made for cell " + std::to_string(job.cell_id) + ", and the cell file describes cell " +
                   std::to_string(cell.id),
               "give the cell file of the cell in which the values were entered");
    }
    if (!cell.machine || !cell.machine->robot) {
        refuse(job_file +
                   " is made for a machine without an arm, where work offset and lengths of tools stand in "
                   "tables of the controller and in no program",
               "enter them there");
    }
}

}  // namespace

EnteredDifference difference_from_plan(const EnteredValues& values, const ReadJob& job, const std::string& job_file,
                                       const Cell& cell) {
    check_takes_values(job, job_file, cell);
    EnteredDifference difference;
    if (values.base) difference.base = base_difference(*values.base, job, job_file, cell);
    const std::vector<std::uint16_t> used = used_tools(job);
    for (const EnteredLength& entered : values.lengths) {
        if (std::ranges::count(difference.lengths, entered.tool, &LengthDifference::tool) > 0) {
            refuse("the length of tool " + std::to_string(entered.tool) + " is given twice", "give it once");
        }
        difference.lengths.push_back(length_difference(entered, used, job_file, cell));
    }
    return difference;
}

Pose planned_base(const Cell& cell, const Setup& setup, const std::vector<Pose>& setup_in_cell) {
    const Pose& first = setup_in_cell.front();
    if (cell.machine->rotary_table) return inverse(table_in_cell(cell, setup.placement.table_angle(0))) * first;
    return inverse(cell.machine->robot->base_in_cell) * first;
}

std::optional<Pose> other_base(const EnteredValues& values, const Pose& planned) {
    if (!values.base) return std::nullopt;
    const Pose entered = pose_of_base(*values.base);
    return is_as_written(planned, entered) ? std::nullopt : std::optional(entered);
}

std::optional<double> other_length(const EnteredLength& entered, const Cell& planned) {
    const double length = gauge_length(*tool_of(planned, entered.tool));
    return is_as_written(length, entered.length) ? std::nullopt : std::optional(length);
}

}  // namespace qchopper

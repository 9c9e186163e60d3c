// Text from a value: one function per table of the cell file.

#include "app/report/cell/arm_report.h"
#include "app/report/cell/cell_report.h"
#include "app/report/columns.h"
#include "base/text.h"
#include "base/units.h"

namespace qchopper {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void append(std::vector<std::string>& text, const std::vector<std::string>& more) {
    text.insert(text.end(), more.begin(), more.end());
}

std::string number(double value) {
    return significant(value, 7);
}

std::string in_degrees(double angle) {
    return significant(degrees(angle), 6);
}

std::string size_of(Vec3 size) {
    return number(size.x) + " x " + number(size.y) + " x " + number(size.z);
}

std::string machine_of(const Cell& cell) {
    if (!cell.machine) return "no robot described";
    return cell.machine->robot ? cell.machine->robot->name : "gantry of three axes";
}

void add_robot(std::vector<std::string>& text, const Robot& robot) {
    text.push_back("robot      " + robot.name + ", payload " + number(robot.payload_kg) + " kg, base at " +
                   in_brackets(robot.base_in_cell.shift, 1));
    const ArmGeometry& g = robot.geometry;
    text.push_back("lengths    a1 " + number(g.a1) + ", a2 " + number(g.a2) + ", b " + number(g.b) + ", c1 " +
                   number(g.c1) + ", c2 " + number(g.c2) + ", c3 " + number(g.c3) + ", c4 " + number(g.c4));
    Rows rows{{"axis", "min deg", "max deg", "deg/s", "deg/s2", "cable deg"}};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const JointRange& range = robot.ranges[axis];
        rows.push_back({std::to_string(axis + 1), in_degrees(range.min), in_degrees(range.max), in_degrees(range.speed),
                        in_degrees(range.acceleration)});
        if (!robot.cable || (axis != 3 && axis != 5)) continue;
        const AngleRange& cable = axis == 3 ? robot.cable->axis_4 : robot.cable->axis_6;
        rows.back().push_back(in_degrees(cable.min) + " to " + in_degrees(cable.max));
    }
    append(text, columns(rows));
    append(text, pose_lines(g));
}

std::string table_line(const Cell& cell) {
    const Table& table = cell.table;
    if (cell.machine && cell.machine->rotary_table) {
        const RotaryTable& rotary = *cell.machine->rotary_table;
        return "table      rotary, radius " + number(rotary.radius) + ", " + in_degrees(rotary.speed) +
               " deg/s, external axis " + std::to_string(rotary.external_axis) + ", middle of its top at " +
               in_brackets(rotary.table_in_cell.shift, 1);
    }
    return "table      fixed, " + number(table.size_x) + " x " + number(table.size_y) + ", middle of its top at " +
           in_brackets({table.centre_x, table.centre_y, table.height}, 1);
}

void add_spindle(std::vector<std::string>& text, const CellMachine& machine) {
    const Spindle& spindle = machine.spindle;
    text.push_back("spindle    body radius " + number(spindle.body_radius) + ", length " + number(spindle.body_length) +
                   ", " + number(spindle.mass_kg) + " kg" +
                   (machine.robot
                        ? ", nose in the flange's frame at " + in_brackets(spindle.spindle_in_flange.shift, 1) +
                              ", tool along its " + (spindle.tool_axis == ToolAxis::z ? "z" : "x")
                        : ""));
}

void add_tools(std::vector<std::string>& text, const Cell& cell) {
    if (!cell.machine) {
        text.push_back("tool       " + std::to_string(cell.tool.number) + ", " + cell.tool.name + ", diameter " +
                       number(cell.tool.diameter));
        return;
    }
    Rows rows{{"tool", "name", "shape", "diameter", "flute", "stick-out", "feed mm/s", "rpm", "length"}};
    for (const CuttingTool& tool : cell.machine->tools) {
        rows.push_back({std::to_string(tool.number), tool.name, to_word(tool.shape), number(tool.diameter),
                        number(tool.flute_length), number(tool.stick_out),
                        number(tool.feed_min_mm_per_s) + " to " + number(tool.feed_max_mm_per_s),
                        std::to_string(tool.rpm_min) + " to " + std::to_string(tool.rpm_max),
                        tool.is_length_measured ? "measured" : "not measured"});
    }
    append(text, columns(rows));
}

void add_stock(std::vector<std::string>& text, const Cell& cell) {
    Rows rows{{"block", "size", "material", "bending N/mm2", "sawn"}};
    for (const Stock& stock : cell.stock) {
        rows.push_back({stock.name, size_of(stock.size), std::string(to_word(stock.material)),
                        number(bending_strength(stock)), stock.is_sawn ? "kerf " + number(stock.kerf) : "no"});
    }
    append(text, columns(rows));
    if (is_any_sawn(cell)) {
        text.push_back("saw        off its plane by up to " + number(cell.saw.accuracy) +
                       " mm; a cap is a face of its block within " + number(cell.saw.flush_tolerance) + " mm");
    }
}

std::string margins_line(const Margins& margins) {
    return "margins    " + number(margins.sides) + " at the sides, " + number(margins.top) + " above, spoil layer " +
           number(margins.spoil);
}

void add_limits(std::vector<std::string>& text, const CellMachine& machine) {
    if (machine.robot) {
        text.push_back("tilt       up to " + in_degrees(machine.max_tilt) + " degrees from the vertical");
    }
    text.push_back("surface    up to " + number(100 * machine.max_unreachable) + " % of a piece's may be unreachable");
    text.push_back("holding    by tape or glue of " + number(machine.holding.strength) +
                   " N/mm2, against a cutting force of " + number(machine.holding.cutting_force) + " N; pieces up to " +
                   number(machine.holding.max_slenderness) + " times as high as wide");
    for (const Obstacle& obstacle : machine.obstacles) {
        text.push_back("obstacle   " + obstacle.name + ", " + in_brackets(obstacle.box.min, 1) + " to " +
                       in_brackets(obstacle.box.max, 1));
    }
    const ProgramSettings& program = machine.program;
    text.push_back(std::string("programs   ") + to_word(program.dialect) + ", " + with_commas(program.memory_bytes) +
                   " bytes, " + with_commas(program.lines_per_chunk) + " lines a chunk, links up to " +
                   number(program.link_feed_mm_per_s) + " mm/s, tool change by " +
                   (program.tool_change_call ? "calling " + *program.tool_change_call : "a stop") + " of " +
                   number(program.tool_change_s) + " s");
    text.push_back("motion     up to " + number(program.acceleration) + " mm/s2, " + in_degrees(program.turn_speed) +
                   " degrees/s of orientation, joint moves at " + number(100 * program.joint_share) +
                   " % of each axis, straight moves of " + number(1000 * program.interpolation_cycle_s) +
                   " ms and more; finishing leaves ridges of " + number(program.scallop));
}

std::string picture_line(const Cell& cell, const ReachPicture& picture) {
    const std::string start = "picture    " + picture.file + ", section x-z at y = " + number(picture.y) + ": ";
    if (!cell.machine) return start + "table and reach box only, because no robot is described";
    if (!cell.machine->robot) return start + "a gantry reaches its box straight from above, and nothing at a tilt";
    return start + "reach of the tool tip at tilts of 0, 30, 60 and 90 degrees, points " + number(picture.step) +
           " apart, no collision checked";
}

std::string with_table(const ValueOrigin& value) {
    return value.table.empty() ? std::string("outside of tables") : value.table;
}

// One row per table and origin.
std::vector<std::string> origin_lines(const std::vector<ValueOrigin>& values) {
    Rows rows;
    for (const ValueOrigin& value : values) {
        const std::string table = with_table(value);
        const std::string word(to_word(value.origin));
        bool is_added = false;
        for (auto& row : rows) {
            if (row[0] != word || row[1] != table) continue;
            row[2] += ", " + value.key;
            is_added = true;
        }
        if (!is_added) rows.push_back({word, table, value.key});
    }
    for (auto& row : rows) row[0].resize(11, ' ');
    return columns(rows);
}

}  // namespace

std::vector<std::string> lines(const std::vector<ListedCell>& cells) {
    Rows rows{{"file", "name", "robot", "dispatch"}};
    for (const ListedCell& row : cells) {
        if (!row.cell) {
            rows.push_back({row.file, "wrong: " + row.error});
            continue;
        }
        rows.push_back({row.file, row.cell->name, machine_of(*row.cell),
                        check_cell(*row.cell).may_be_dispatched() ? "yes" : "no"});
    }
    return columns(rows);
}

std::vector<std::string> lines(const ShownCell& shown) {
    const Cell& cell = shown.cell;
    std::vector<std::string> text{shown.file + ": \"" + cell.name + "\", cell " + std::to_string(cell.id) +
                                  "; lengths in mm"};
    if (!cell.machine) text.emplace_back("robot      not described: the arm is not checked");
    if (cell.machine && !cell.machine->robot) text.emplace_back("robot      none: a gantry of three axes");
    if (cell.machine && cell.machine->robot) add_robot(text, *cell.machine->robot);
    text.push_back("reach      of the tool tip " + in_brackets(cell.workspace.min, 1) + " to " +
                   in_brackets(cell.workspace.max, 1));
    text.push_back(table_line(cell));
    if (cell.machine) add_spindle(text, *cell.machine);
    if (cell.machine) add_limits(text, *cell.machine);
    text.push_back(margins_line(cell.margins));
    text.push_back("clearance  " + number(cell.clearance) + " above the block");
    add_tools(text, cell);
    add_stock(text, cell);
    text.push_back("link       to " + cell.link.to.value_or("no address") + ", drop folder " +
                   (cell.link.drop ? cell.link.drop->string() : "not given"));
    if (shown.picture) text.push_back(picture_line(cell, *shown.picture));
    return text;
}

std::vector<std::string> lines(const CheckedCell& checked) {
    std::vector<std::string> text{checked.file + ": " + machine_of(checked.cell)};
    if (checked.poses) append(text, lines(*checked.poses));
    append(text, origin_lines(checked.check.uncertain));
    for (const std::string& sentence : checked.check.missing) text.push_back("missing      " + sentence);
    for (const std::string& sentence : checked.check.against_dispatch) text.push_back("no dispatch  " + sentence);
    text.emplace_back(checked.check.may_be_dispatched()
                          ? "dispatch: allowed"
                          : "dispatch: not allowed to a real cell; planning and simulation are");
    return text;
}

}  // namespace qchopper

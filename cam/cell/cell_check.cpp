// Goes through the origins with a table of the values that decide where tool and joints really are.

#include "cam/cell/cell_check.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace qchopper {
namespace {

struct Decisive {
    std::string_view table;
    std::string_view key;
    std::string_view what;
};

constexpr std::array<Decisive, 23> decisive{{{"robot", "a1", "a length of the arm"},
                                             {"robot", "a2", "a length of the arm"},
                                             {"robot", "b", "a length of the arm"},
                                             {"robot", "c1", "a length of the arm"},
                                             {"robot", "c2", "a length of the arm"},
                                             {"robot", "c3", "a length of the arm"},
                                             {"robot", "c4", "a length of the arm"},
                                             {"robot", "offset_deg", "the arm's zero position"},
                                             {"robot", "sign", "the arm's zero position"},
                                             {"robot", "min_deg", "a joint limit"},
                                             {"robot", "max_deg", "a joint limit"},
                                             {"robot.cable", "axis_4_deg", "a joint limit"},
                                             {"robot.cable", "axis_6_deg", "a joint limit"},
                                             {"robot.base", "position", "a frame"},
                                             {"robot.base", "abc_deg", "a frame"},
                                             {"spindle", "position", "a frame"},
                                             {"spindle", "abc_deg", "a frame"},
                                             {"table", "centre", "a frame"},
                                             {"table", "height", "a frame"},
                                             {"rotary_table", "position", "a frame"},
                                             {"rotary_table", "abc_deg", "a frame"},
                                             {"reach", "min", "the travel of an axis"},
                                             {"reach", "max", "the travel of an axis"}}};

const Decisive* decisive_of(const ValueOrigin& value, bool has_robot) {
    if (has_robot && value.table == "reach") return nullptr;  // there the joint limits decide
    const auto* found = std::find_if(decisive.begin(), decisive.end(), [&](const Decisive& row) {
        return row.table == value.table && row.key == value.key;
    });
    return found == decisive.end() ? nullptr : found;
}

bool is_uncertain(const ValueOrigin& value) {
    return value.origin != Origin::data_sheet && value.origin != Origin::measured;
}

std::vector<std::string> missing_of(const Cell& cell) {
    if (!cell.machine) return {"spindle: no machine is described, so no arm is checked and no program is made"};
    const CellMachine& machine = *cell.machine;
    const Spindle& spindle = machine.spindle;
    const bool has_words = machine.program.dialect == Dialect::ngc;  // M3, M5 and S in place of signals
    const std::pair<bool, const char*> rows[] = {
        {machine.robot && machine.robot->capsules.empty(),
         "robot.capsule: the arm's body is not described, so its collisions cannot be checked"},
        {machine.robot && !machine.robot->cable, "robot.cable: limits of hoses and cables are not described"},
        {!has_words && !spindle.on, "spindle.on: no signal switches the spindle on"},
        {!has_words && !spindle.speed, "spindle.speed: no signal sets the spindle's speed"},
        {!has_words && !spindle.at_speed, "spindle.at_speed: no signal tells that the spindle has its speed"},
        {!has_words && !spindle.off, "spindle.off: no signal switches the spindle off"},
        {!machine.extraction || !machine.extraction->on, "extraction.on: no signal switches the extraction on"},
        {!machine.extraction || !machine.extraction->off, "extraction.off: no signal switches the extraction off"},
        {!cell.link.to, "link.to: the controller's address is not given"},
        {!cell.link.drop, "link.drop: the drop folder is not given"}};
    std::vector<std::string> missing;
    for (const auto& [is_missing, sentence] : rows) {
        if (is_missing) missing.emplace_back(sentence);
    }
    return missing;
}

}  // namespace

CellCheck check_cell(const Cell& cell) {
    CellCheck check;
    const bool has_robot = cell.machine && cell.machine->robot;
    for (const ValueOrigin& value : cell.origins) {
        if (!is_uncertain(value)) continue;
        check.uncertain.push_back(value);
        const Decisive* const row = decisive_of(value, has_robot);
        if (row == nullptr) continue;
        const std::string how = value.origin == Origin::assumed ? "assumed" : "given without its origin";
        check.against_dispatch.push_back(value.table + "." + value.key + " is " + how + ": " + std::string(row->what));
    }
    check.missing = missing_of(cell);
    if (!cell.machine) return check;
    for (const CuttingTool& tool : cell.machine->tools) {
        if (tool.is_length_measured) continue;
        check.against_dispatch.push_back("tool " + std::to_string(tool.number) + ": its length is not measured");
    }
    return check;
}

}  // namespace qchopper

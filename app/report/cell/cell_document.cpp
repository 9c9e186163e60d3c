// JSON from a value. Lengths in mm, angles in degrees.

#include <nlohmann/json.hpp>

#include "app/report/cell/arm_report.h"
#include "app/report/cell/cell_report.h"
#include "app/report/cell/machine_reachability_report.h"
#include "app/report/report_json.h"
#include "base/units.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 2;  // of all cell files that are read

Json box_json(const Box& box) {
    return {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
}

Json pose_json(const Pose& pose) {
    return {{"position", json_of(pose.shift)},
            {"rotation", {json_of(pose.row[0]), json_of(pose.row[1]), json_of(pose.row[2])}}};
}

Json range_json(const AngleRange& range) {
    return {degrees(range.min), degrees(range.max)};
}

Json robot_json(const Robot& robot) {
    const ArmGeometry& g = robot.geometry;
    Json axes = Json::array();
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const JointRange& range = robot.ranges[axis];
        axes.push_back({{"min_deg", degrees(range.min)},
                        {"max_deg", degrees(range.max)},
                        {"speed_deg_per_s", degrees(range.speed)},
                        {"acceleration_deg_per_s2", degrees(range.acceleration)},
                        {"offset_deg", degrees(g.offset[axis])},
                        {"sign", g.sign[axis]}});
    }
    Json cable;
    if (robot.cable) {
        cable = {{"axis_4_deg", range_json(robot.cable->axis_4)}, {"axis_6_deg", range_json(robot.cable->axis_6)}};
    }
    return {
        {"name", robot.name},
        {"lengths", {{"a1", g.a1}, {"a2", g.a2}, {"b", g.b}, {"c1", g.c1}, {"c2", g.c2}, {"c3", g.c3}, {"c4", g.c4}}},
        {"axes", axes},
        {"display_poses", pose_json(g)},
        {"payload_kg", robot.payload_kg},
        {"base", pose_json(robot.base_in_cell)},
        {"cable", cable},
        {"capsules", list_of(robot.capsules, [](const LinkCapsule& capsule) {
             return Json{{"link", capsule.link},
                         {"from", json_of(capsule.shape.from)},
                         {"to", json_of(capsule.shape.to)},
                         {"radius", capsule.shape.radius}};
         })}};
}

Json rotary_table_json(const RotaryTable& table) {
    return {{"pose", pose_json(table.table_in_cell)},
            {"radius", table.radius},
            {"speed_deg_per_s", degrees(table.speed)},
            {"external_axis", table.external_axis}};
}

Json tool_json(const CuttingTool& tool) {
    return {{"number", tool.number},
            {"name", tool.name},
            {"shape", to_word(tool.shape)},
            {"diameter", tool.diameter},
            {"corner_radius", tool.corner_radius},
            {"tip_angle_deg", tool.tip_angle > 0 ? Json(degrees(tool.tip_angle)) : Json()},
            {"flute_length", tool.flute_length},
            {"stick_out", tool.stick_out},
            {"holder", list_of(tool.holder,
                               [](const HolderStep& step) {
                                   return Json{step.diameter, step.length};
                               })},
            {"gauge_length", gauge_length(tool)},
            {"feed_mm_per_s", {tool.feed_min_mm_per_s, tool.feed_max_mm_per_s}},
            {"rpm", {tool.rpm_min, tool.rpm_max}},
            {"mass_kg", tool.mass_kg},
            {"removal_mm3_per_s", tool.removal_mm3_per_s},
            {"length_measured", tool.is_length_measured},
            {"centre_cutting", tool.is_centre_cutting}};
}

Json spindle_json(const Spindle& spindle) {
    return {{"pose", pose_json(spindle.spindle_in_flange)}, {"tool_axis", spindle.tool_axis == ToolAxis::z ? "z" : "x"},
            {"body_radius", spindle.body_radius},           {"body_length", spindle.body_length},
            {"body_offset", spindle.body_offset},           {"mass_kg", spindle.mass_kg}};
}

Json start_json(const CellMachine& machine) {
    if (!machine.robot) return {{"tip", json_of(machine.start.tip)}};
    Json joints = Json::array();
    for (const double joint : machine.start.joints) joints.push_back(degrees(joint));
    return {{"joints_deg", joints}};
}

Json margins_json(const Margins& margins) {
    return {{"sides", margins.sides}, {"top", margins.top}, {"spoil", margins.spoil}};
}

Json machine_json(const CellMachine& machine, const Margins& margins) {
    return {{"robot", machine.robot ? robot_json(*machine.robot) : Json()},
            {"rotary_table", machine.rotary_table ? rotary_table_json(*machine.rotary_table) : Json()},
            {"spindle", spindle_json(machine.spindle)},
            {"tools", list_of(machine.tools, tool_json)},
            {"max_tilt_deg", degrees(machine.max_tilt)},
            {"max_unreachable", machine.max_unreachable},
            {"margin", margins_json(margins)},
            {"holding",
             {{"cutting_force_n", machine.holding.cutting_force},
              {"joint_strength", machine.holding.strength},
              {"max_slenderness", machine.holding.max_slenderness}}},
            {"obstacles", list_of(machine.obstacles,
                                  [](const Obstacle& obstacle) {
                                      Json json{{"name", obstacle.name}};
                                      json.update(box_json(obstacle.box));
                                      return json;
                                  })},
            {"start", start_json(machine)},
            {"program",
             {{"dialect", to_word(machine.program.dialect)},
              {"memory_bytes", machine.program.memory_bytes},
              {"lines_per_chunk", machine.program.lines_per_chunk},
              {"interpolation_cycle_s", machine.program.interpolation_cycle_s},
              {"tool_change_time_s", machine.program.tool_change_s},
              {"link_feed_mm_per_s", machine.program.link_feed_mm_per_s},
              {"acceleration_mm_per_s2", machine.program.acceleration},
              {"turn_speed_deg_per_s", degrees(machine.program.turn_speed)},
              {"joint_move_percent", 100 * machine.program.joint_share},
              {"scallop", machine.program.scallop}}},
            {"load_tolerance",
             {{"mass_kg", machine.load_tolerance.mass_kg},
              {"centre_mm", machine.load_tolerance.centre_mm},
              {"inertia_kg_m2", machine.load_tolerance.inertia_kg_m2}}}};
}

Json stock_json(const Stock& stock) {
    return {{"name", stock.name},
            {"size", json_of(stock.size)},
            {"material", to_word(stock.material)},
            {"bending_strength", bending_strength(stock)},
            {"sawn", stock.is_sawn},
            {"kerf", stock.kerf}};
}

Json origin_json(const ValueOrigin& value) {
    return {{"table", value.table}, {"key", value.key}, {"origin", to_word(value.origin)}};
}

Json listed_json(const ListedCell& row) {
    if (!row.cell) return {{"file", row.file}, {"error", row.error}};
    Json robot;
    if (row.cell->machine && row.cell->machine->robot) robot = row.cell->machine->robot->name;
    return {{"file", row.file},       {"version", version},
            {"name", row.cell->name}, {"id", row.cell->id},
            {"robot", robot},         {"may_be_dispatched", check_cell(*row.cell).may_be_dispatched()}};
}

}  // namespace

Document document(const std::vector<ListedCell>& cells) {
    return compose({{"schema", "qchopper-cells-1"}, {"cells", list_of(cells, listed_json)}});
}

Document document(const ShownCell& shown) {
    const Cell& cell = shown.cell;
    Json json = {{"schema", "qchopper-cell-2"},
                 {"file", shown.file},
                 {"version", version},
                 {"name", cell.name},
                 {"id", cell.id},
                 {"reach", box_json(cell.workspace)},
                 {"table",
                  {{"centre", {cell.table.centre_x, cell.table.centre_y}},
                   {"size", {cell.table.size_x, cell.table.size_y}},
                   {"height", cell.table.height}}},
                 {"clearance", cell.clearance},
                 {"stock_margin", cell.stock_margin()},
                 {"stock", list_of(cell.stock, stock_json)},
                 {"tool", {{"number", cell.tool.number}, {"name", cell.tool.name}, {"diameter", cell.tool.diameter}}},
                 {"machine", cell.machine ? machine_json(*cell.machine, cell.margins) : Json()}};
    if (!cell.machine) json["margin"] = margins_json(cell.margins);
    if (is_any_sawn(cell)) {
        json["saw"] = {{"accuracy_mm", cell.saw.accuracy}, {"flush_tolerance_mm", cell.saw.flush_tolerance}};
    }
    if (shown.picture) json["picture"] = shown.picture->file;
    return compose(json);
}

Document document(const PlacesInCell& places) {
    const BlockPlaces& map = places.map;
    return compose({{"schema", "qchopper-cell-reach-2"},
                    {"file", places.file},
                    {"block_mm", json_of(map.block)},
                    {"tilt_deg", degrees(map.tilt)},
                    {"step_mm", map.step},
                    {"places", list_of(map.places,
                                       [](const BlockPlace& place) {
                                           return Json{
                                               {"x_mm", place.x},
                                               {"y_mm", place.y},
                                               {"on_table", place.is_on_table},
                                               {"relative_margin", place.margin ? Json(*place.margin) : Json()}};
                                       })},
                    {"best", json_of(map.best)}});
}

Document document(const CheckedCell& checked) {
    Json json = {{"schema", "qchopper-cell-check-1"},
                 {"file", checked.file},
                 {"version", version},
                 {"uncertain", list_of(checked.check.uncertain, origin_json)},
                 {"missing", checked.check.missing},
                 {"against_dispatch", checked.check.against_dispatch},
                 {"may_be_dispatched", checked.check.may_be_dispatched()}};
    if (checked.poses) json["taught_poses"] = json_of(*checked.poses);
    return compose(json);
}

}  // namespace qchopper

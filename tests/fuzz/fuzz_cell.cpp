// The cell file: a cell that is accepted is possible.

#include <cmath>

#include "cam/cell/cell.h"
#include "cam/cell/cell_check.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

void demand_possible(const Robot& robot) {
    for (const JointRange& range : robot.ranges) {
        demand(range.min < range.max && range.speed > 0 && range.acceleration > 0);
        demand(std::isfinite(range.min) && std::isfinite(range.max));
    }
    for (const int sign : robot.geometry.sign) demand(sign == 1 || sign == -1);
    for (const LinkCapsule& capsule : robot.capsules) demand(capsule.shape.radius > 0 && capsule.link >= 0);
}

void demand_possible(const CellMachine& machine) {
    if (machine.robot) demand_possible(*machine.robot);
    demand(!machine.tools.empty() && machine.max_unreachable >= 0 && machine.max_unreachable <= 1);
    for (const CuttingTool& tool : machine.tools) {
        demand(tool.diameter > 0 && tool.flute_length <= tool.stick_out && gauge_length(tool) > tool.stick_out);
        demand(tool.feed_min_mm_per_s < tool.feed_max_mm_per_s && tool.rpm_min < tool.rpm_max);
        demand(tool.corner_radius >= 0 && 2 * tool.corner_radius <= tool.diameter);
    }
}

void demand_possible(const Cell& cell) {
    if (cell.machine) demand_possible(*cell.machine);
    check_cell(cell);
    demand(!cell.name.empty() && cell.id >= 1 && !cell.stock.empty());
    for (int axis = 0; axis < 3; ++axis) demand(cell.workspace.min[axis] < cell.workspace.max[axis]);
    demand(cell.table.size_x > 0 && cell.table.size_y > 0);
    demand(cell.table.height >= cell.workspace.min.z && cell.table.height < cell.workspace.max.z);
    for (const Stock& block : cell.stock) {
        for (int axis = 0; axis < 3; ++axis) demand(block.size[axis] > 0 && std::isfinite(block.size[axis]));
        demand(!block.name.empty());
    }
    demand(cell.stock_margin() >= 0 && cell.margins.spoil >= 0 && cell.clearance >= 0);
    demand(cell.tool.diameter > 0 && cell.tool.removal_mm3_per_s > 0);
    demand(cell.tool.spindle_max_rpm > 0 && cell.tool.feed_max_mm_per_min > 0);
    demand(!cell.link.to || cell.link.to->find(':') != std::string::npos);
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = qchopper::text_of(data, size);
    qchopper::or_refused(qchopper::InputFault::config,
                         [&] { qchopper::demand_possible(qchopper::parse_cell(text, "fuzz.toml")); });
    return 0;
}

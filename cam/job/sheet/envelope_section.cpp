// Tables of values.

#include "cam/job/sheet/envelope_section.h"

#include "base/text.h"
#include "base/units.h"
#include "cam/job/sheet/envelope_picture.h"
#include "cam/job/sheet/sheet_html.h"

namespace qchopper {
namespace {

using namespace sheet;

constexpr const char* title = "Work envelope";

std::string in_degrees(double angle) {
    return fixed(degrees(angle), 1);
}

std::string picture_of(const MachineReachability& reachability) {
    return figure({"envelope.png", envelope_picture_width, envelope_picture_height},
                  "The tightest pose: " + describe_margin(reachability.tightest()) +
                      ". Links of the arm as capsules; what the margin lies between is red. The block is drawn by its "
                      "edges.");
}

std::string joints_of(const ReachabilityPose& pose) {
    if (!pose.joints) return {};
    std::string text = "Joints of the arm there, degrees: ";
    for (std::size_t axis = 0; axis < pose.joints->size(); ++axis) {
        text += (axis == 0 ? "" : ", ") + in_degrees((*pose.joints)[axis]);
    }
    return paragraph(text + ". Tool tip in the cell: (" + fixed(pose.tip_in_cell.x, 1) + ", " +
                     fixed(pose.tip_in_cell.y, 1) + ", " + fixed(pose.tip_in_cell.z, 1) + ").");
}

std::string checks_of(const MachineReachability& reachability) {
    Rows rows{{word("check"), word("between"), right("measured"), right("needed"), right("margin"), word("unit"),
               word("pose")}};
    for (const ReachabilityMargin& margin : reachability.margins) {
        const CheckRule& rule = rule_of(margin.check);
        rows.push_back({word(rule.name), word(margin.pair), number(margin.margin + rule.needed, 1),
                        number(rule.needed, 1), number(margin.margin, 1), word(rule.unit),
                        word(has_pose(margin) ? describe_pose(margin.pose) : "")});
    }
    return table(rows);
}

std::string angles_of(const BlockPlacement& placement) {
    if (placement.table_angles.empty()) return {};
    Rows rows{{right("orientation"), right("rotary table, degrees")}};
    for (std::size_t d = 0; d < placement.table_angles.size(); ++d) {
        rows.push_back({right(std::to_string(d + 1)), right(in_degrees(placement.table_angles[d]))});
    }
    return table(rows);
}

}  // namespace

std::string envelope_section(const JobInput& input) {
    const MachineReachability& reachability = input.machine_reachability;
    if (!reachability.is_arm_checked) {
        return section(title, paragraph("Arm not checked: the cell file describes none."));
    }
    std::string html =
        paragraph(counted(reachability.poses, "pose") +
                  " of the tool were asked of the machine: tips on the piece, corners and edges "
                  "of the block, above it, home and tool changes. " +
                  (reachability.holds() ? "It holds all of them; the tightest margin of each check is listed."
                                        : "What has a negative margin is not held."));
    if (reachability.holds() && reachability.remedy != Remedy::none) {
        html += paragraph(std::string("What it takes: ") + describe(reachability.remedy) + ".");
    }
    return section(title, html + picture_of(reachability) + joints_of(reachability.tightest().pose) +
                              checks_of(reachability) + angles_of(input.setup.placement));
}

}  // namespace qchopper

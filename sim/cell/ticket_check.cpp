// Field by field in the order of the map, so that the first fault is reported. O(registers of TICKET + tools).

#include "sim/cell/ticket_check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/files/portable_name.h"

namespace qchopper {
namespace {

CommandAnswer fault_at(std::uint16_t address) {
    return {AckResult::ticket_field, address};
}

CommandAnswer fault_in(const char* field_name) {
    return fault_at(address_of(ticket_block, field_name));
}

// `vector` is BOX_MIN, BOX_MAX or STOCK.
std::uint16_t axis_address(const char* vector, int axis) {
    const std::string name = std::string(vector) + "_" + "XYZ"[axis];
    return address_of(ticket_block, name.c_str());
}

// Characters behind the first NUL, where the text ends.
bool has_hidden_text(const std::string& text, const Field& field, std::span<const std::uint16_t> block) {
    std::size_t characters = 0;
    for (const std::uint16_t pair : block.subspan(field.address - ticket_block.base, field.count)) {
        characters += (pair >> 8U) != 0 ? 1U : 0U;
        characters += (pair & 0xFFU) != 0 ? 1U : 0U;
    }
    return characters != text.size();
}

// No value may exceed the largest one in the rack.
std::optional<CommandAnswer> wrong_tool_value(const WireTicket& t, const std::vector<CellTool>& tools) {
    CellTool largest{0, 0, 0, 0};
    for (const CellTool& tool : tools) {
        largest.diameter = std::max(largest.diameter, tool.diameter);
        largest.spindle_max_rpm = std::max(largest.spindle_max_rpm, tool.spindle_max_rpm);
        largest.feed_max_mm_per_min = std::max(largest.feed_max_mm_per_min, tool.feed_max_mm_per_min);
    }
    if (t.tool_diameter_um > std::round(1000 * largest.diameter)) return fault_in("TOOL_DIAMETER");
    if (t.spindle_max_rpm > largest.spindle_max_rpm) return fault_in("SPINDLE_MAX");
    if (t.feed_max_mm_per_min > largest.feed_max_mm_per_min) return fault_in("FEED_MAX");
    return std::nullopt;
}

}  // namespace

std::optional<CommandAnswer> wrong_field(const WireTicket& t, std::span<const std::uint16_t> block,
                                         const CellLimits& limits) {
    if (t.ticket_version != 1) return fault_in("TICKET_VERSION");
    if (t.job_id == Uuid{}) return fault_in("JOB_ID");
    if (t.file_size == 0) return fault_in("FILE_SIZE");
    if (t.transfer != Transfer::drop_folder && t.transfer != Transfer::chunks) return fault_in("TRANSFER");
    if (!is_portable_name(t.file_name) ||
        has_hidden_text(t.file_name, *field_named(ticket_block, "FILE_NAME"), block)) {
        return fault_in("FILE_NAME");
    }
    if (t.unit != 1) return fault_in("UNIT");
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (t.box_min[a] >= t.box_max[a]) return fault_at(axis_address("BOX_MIN", axis));
        if (t.stock[a] <= 0) return fault_at(axis_address("STOCK", axis));
    }
    if (t.material > 4) return fault_in("MATERIAL");
    if (t.tool_diameter_um == 0) return fault_in("TOOL_DIAMETER");
    if (t.piece_no < 1 || t.piece_no > t.piece_count) return fault_in("PIECE_NO");
    if (t.on_link_loss != LinkLoss::go_on && t.on_link_loss != LinkLoss::hold) return fault_in("ON_LINK_LOSS");
    if (t.requirements > 1) return fault_in("REQUIREMENTS");
    const bool is_divided = t.part != 0 || t.parts != 0;
    if (is_divided && (t.part < 1 || t.part > t.parts)) return fault_in("PART");
    const std::optional<std::uint16_t> used = used_reserved<WireTicket>(block);
    if (used && *used < address_of(ticket_block, "CELL_ID")) return fault_at(*used);
    if (t.cell_id != limits.cell_id) return fault_in("CELL_ID");
    if (t.made_for != 1) return fault_in("MADE_FOR");  // not for a real cell: this one is simulated
    if (used) return fault_at(*used);
    return std::nullopt;
}

std::optional<CommandAnswer> does_not_fit(const WireTicket& t, const CellLimits& limits) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        // Rounded as the ticket is.
        if (t.box_min[a] < std::round(100 * limits.workspace.min[axis]))
            return CommandAnswer{AckResult::envelope, axis_address("BOX_MIN", axis)};
        if (t.box_max[a] > std::round(100 * limits.workspace.max[axis]))
            return CommandAnswer{AckResult::envelope, axis_address("BOX_MAX", axis)};
        if (t.stock[a] > std::round(100 * limits.max_stock[axis]))
            return CommandAnswer{AckResult::envelope, axis_address("STOCK", axis)};
        // In 64 bits: two opposite ends of the range do not fit into 32.
        if (std::int64_t{t.box_max[a]} - t.box_min[a] > t.stock[a]) {
            return CommandAnswer{AckResult::stock_too_small, axis_address("STOCK", axis)};
        }
    }
    const bool has_tool =
        limits.tools.empty() || std::any_of(limits.tools.begin(), limits.tools.end(),
                                            [&](const CellTool& tool) { return tool.number == t.tool_no; });
    if (!has_tool) return CommandAnswer{AckResult::tool, address_of(ticket_block, "TOOL_NO")};
    if (t.box_min[2] < 0) return fault_at(axis_address("BOX_MIN", 2));  // below the table
    return limits.tools.empty() ? std::nullopt : wrong_tool_value(t, limits.tools);
}

}  // namespace qchopper

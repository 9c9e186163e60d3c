#include "sim/ticket_check.h"
#include "base/portable_name.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace qchopper {
namespace {

// `vector` is BOX_MIN, BOX_MAX or STOCK.
std::uint16_t axis_address(const char* vector, int axis) {
    const std::string name = std::string(vector) + "_" + "XYZ"[axis];
    return address_of(ticket_block, name.c_str());
}

// The first register between two fields that is reserved and not zero.
std::optional<std::uint16_t> used_reserve(std::span<const std::uint16_t> block, const char* from, const char* to) {
    for (const Field& field : ticket_block.fields) {
        if (std::string(field.name) != "reserved") continue;
        if (field.address < address_of(ticket_block, from) || field.address > address_of(ticket_block, to)) continue;
        for (std::uint16_t at = field.address; at < field.address + field.count; ++at) {
            if (block[at - ticket_block.base] != 0) return at;
        }
    }
    return std::nullopt;
}

// Text ends at the first NUL; what comes behind it would be shown to nobody.
bool has_hidden_text(const std::string& text, const Field& field, std::span<const std::uint16_t> block) {
    std::size_t characters = 0;
    for (const std::uint16_t word : block.subspan(field.address - ticket_block.base, field.count)) {
        characters += (word >> 8U) != 0 ? 1U : 0U;
        characters += (word & 0xFFU) != 0 ? 1U : 0U;
    }
    return characters != text.size();
}

// At most what the largest tool of the rack has.
std::optional<TicketFault> wrong_tool_value(const WireTicket& t, const std::vector<CellTool>& tools) {
    CellTool largest{0, 0, 0, 0};
    for (const CellTool& tool : tools) {
        largest.diameter = std::max(largest.diameter, tool.diameter);
        largest.spindle_max_rpm = std::max(largest.spindle_max_rpm, tool.spindle_max_rpm);
        largest.feed_max_mm_per_min = std::max(largest.feed_max_mm_per_min, tool.feed_max_mm_per_min);
    }
    const auto field = [](const char* name) {
        return TicketFault{AckResult::ticket_field, address_of(ticket_block, name)};
    };
    if (t.tool_diameter_um > std::round(1000 * largest.diameter)) return field("TOOL_DIAMETER");
    if (t.spindle_max_rpm > largest.spindle_max_rpm) return field("SPINDLE_MAX");
    if (t.feed_max_mm_per_min > largest.feed_max_mm_per_min) return field("FEED_MAX");
    return std::nullopt;
}

}  // namespace

std::optional<TicketFault> wrong_field(const WireTicket& t, std::span<const std::uint16_t> block,
                                       const CellLimits& limits) {
    const auto fault_at = [](std::uint16_t address) { return TicketFault{AckResult::ticket_field, address}; };
    const auto field = [&](const char* name) { return fault_at(address_of(ticket_block, name)); };
    if (t.ticket_version != 1) return field("TICKET_VERSION");
    if (t.job_id == Uuid{}) return field("JOB_ID");
    if (t.file_size == 0) return field("FILE_SIZE");
    if (t.transfer != Transfer::drop_folder && t.transfer != Transfer::chunks) return field("TRANSFER");
    if (!is_portable_name(t.file_name) ||
        has_hidden_text(t.file_name, *field_named(ticket_block, "FILE_NAME"), block)) {
        return field("FILE_NAME");
    }
    if (t.unit != 1) return field("UNIT");
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (t.box_min[a] >= t.box_max[a]) return fault_at(axis_address("BOX_MIN", axis));
        if (t.stock[a] <= 0) return fault_at(axis_address("STOCK", axis));
    }
    if (t.material > 4) return field("MATERIAL");
    if (t.tool_diameter_um == 0) return field("TOOL_DIAMETER");
    if (t.piece_no < 1 || t.piece_no > t.piece_count) return field("PIECE_NO");
    if (t.on_link_loss != LinkLoss::go_on && t.on_link_loss != LinkLoss::hold) return field("ON_LINK_LOSS");
    if (t.requirements > 1) return field("REQUIREMENTS");
    if (const auto used = used_reserve(block, "REQUIREMENTS", "CELL_ID")) return fault_at(*used);
    if (t.cell_id != limits.cell_id) return field("CELL_ID");
    if (t.made_for != 1) return field("MADE_FOR");  // this cell is simulated, and a real job is not for it
    if (const auto used = used_reserve(block, "KEY_ID", "CRC")) return fault_at(*used);
    return std::nullopt;
}

std::optional<TicketFault> does_not_fit(const WireTicket& t, const CellLimits& limits) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (t.box_min[a] < 100 * limits.reach.min[axis])
            return TicketFault{AckResult::envelope, axis_address("BOX_MIN", axis)};
        if (t.box_max[a] > 100 * limits.reach.max[axis])
            return TicketFault{AckResult::envelope, axis_address("BOX_MAX", axis)};
        if (t.stock[a] > 100 * limits.max_stock[axis])
            return TicketFault{AckResult::envelope, axis_address("STOCK", axis)};
        // In 64 bits: two opposite ends of the range do not fit into 32.
        if (std::int64_t{t.box_max[a]} - t.box_min[a] > t.stock[a]) {
            return TicketFault{AckResult::stock_too_small, axis_address("STOCK", axis)};
        }
    }
    const bool has_tool =
        limits.tools.empty() || std::any_of(limits.tools.begin(), limits.tools.end(),
                                            [&](const CellTool& tool) { return tool.number == t.tool_no; });
    if (!has_tool) return TicketFault{AckResult::tool, address_of(ticket_block, "TOOL_NO")};
    if (t.box_min[2] < 0) return TicketFault{AckResult::ticket_field, axis_address("BOX_MIN", 2)};  // below the table
    return limits.tools.empty() ? std::nullopt : wrong_tool_value(t, limits.tools);
}

}  // namespace qchopper

#include "sim/ticket_check.h"

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

constexpr std::uint16_t box_min_at = 145;
constexpr std::uint16_t box_max_at = 151;
constexpr std::uint16_t stock_at = 157;

std::uint16_t axis_address(std::uint16_t base, int axis) {
    return static_cast<std::uint16_t>(base + 2 * axis);
}

std::uint16_t address_of(const char* field_name) {
    return field_named(ticket_block, field_name)->address;
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
std::optional<TicketFault> wrong_tool_value(const TicketWords& t, const std::vector<CellTool>& tools) {
    CellTool largest{0, 0, 0, 0};
    for (const CellTool& tool : tools) {
        largest.diameter = std::max(largest.diameter, tool.diameter);
        largest.spindle_max_rpm = std::max(largest.spindle_max_rpm, tool.spindle_max_rpm);
        largest.feed_max_mm_per_min = std::max(largest.feed_max_mm_per_min, tool.feed_max_mm_per_min);
    }
    const auto field = [](const char* name) { return TicketFault{AckResult::ticket_field, address_of(name)}; };
    if (t.tool_diameter_um > std::round(1000 * largest.diameter)) return field("TOOL_DIAMETER");
    if (t.spindle_max_rpm > largest.spindle_max_rpm) return field("SPINDLE_MAX");
    if (t.feed_max_mm_per_min > largest.feed_max_mm_per_min) return field("FEED_MAX");
    return std::nullopt;
}

}  // namespace

std::optional<TicketFault> wrong_field(const TicketWords& t, std::span<const std::uint16_t> block,
                                       const CellLimits& limits) {
    const auto field = [](std::uint16_t address) { return TicketFault{AckResult::ticket_field, address}; };
    if (t.ticket_version != 1) return field(100);
    if (t.job_id == Uuid{}) return field(101);
    if (t.file_size == 0) return field(125);
    if (t.transfer != Transfer::drop_folder && t.transfer != Transfer::chunks) return field(127);
    if (!is_file_name(t.file_name) || has_hidden_text(t.file_name, *field_named(ticket_block, "FILE_NAME"), block)) {
        return field(128);
    }
    if (t.unit != 1) return field(144);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (t.box_min[a] >= t.box_max[a]) return field(axis_address(box_min_at, axis));
        if (t.stock[a] <= 0) return field(axis_address(stock_at, axis));
    }
    if (t.material > 4) return field(163);
    if (t.tool_diameter_um == 0) return field(165);
    if (t.piece_no < 1 || t.piece_no > t.piece_count) return field(173);
    if (t.on_link_loss != LinkLoss::go_on && t.on_link_loss != LinkLoss::hold) return field(187);
    if (t.requirements > 1) return field(188);
    for (std::uint16_t reserved = 189; reserved < 193; ++reserved) {
        if (block[reserved - ticket_block.base] != 0) return field(reserved);
    }
    if (t.cell_id != limits.cell_id) return field(193);
    if (t.made_for != 1) return field(194);  // this cell is simulated, and a real job is not for it
    if (block[197 - ticket_block.base] != 0) return field(197);
    return std::nullopt;
}

std::optional<TicketFault> does_not_fit(const TicketWords& t, const CellLimits& limits) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (t.box_min[a] < 100 * limits.reach.min[axis])
            return TicketFault{AckResult::envelope, axis_address(box_min_at, axis)};
        if (t.box_max[a] > 100 * limits.reach.max[axis])
            return TicketFault{AckResult::envelope, axis_address(box_max_at, axis)};
        if (t.stock[a] > 100 * limits.max_stock[axis])
            return TicketFault{AckResult::envelope, axis_address(stock_at, axis)};
        // In 64 bits: two opposite ends of the range do not fit into 32.
        if (std::int64_t{t.box_max[a]} - t.box_min[a] > t.stock[a]) {
            return TicketFault{AckResult::stock_too_small, axis_address(stock_at, axis)};
        }
    }
    const bool has_tool =
        limits.tools.empty() || std::any_of(limits.tools.begin(), limits.tools.end(),
                                            [&](const CellTool& tool) { return tool.number == t.tool_no; });
    if (!has_tool) return TicketFault{AckResult::tool, 164};
    if (t.box_min[2] < 0) return TicketFault{AckResult::ticket_field, axis_address(box_min_at, 2)};  // below the table
    return limits.tools.empty() ? std::nullopt : wrong_tool_value(t, limits.tools);
}

}  // namespace qchopper

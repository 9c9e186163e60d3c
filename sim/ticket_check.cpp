#include "sim/ticket_check.h"

#include <algorithm>

namespace qchopper {
namespace {

constexpr std::uint16_t box_min_at = 145;
constexpr std::uint16_t box_max_at = 151;
constexpr std::uint16_t stock_at = 157;

std::uint16_t axis_address(std::uint16_t base, int axis) {
    return static_cast<std::uint16_t>(base + 2 * axis);
}

}  // namespace

std::optional<TicketFault> wrong_field(const TicketWords& t, std::span<const std::uint16_t> block,
                                       const CellLimits& limits) {
    const auto field = [](std::uint16_t address) { return TicketFault{AckResult::ticket_field, address}; };
    if (t.ticket_version != 1) return field(100);
    if (t.job_id == Uuid{}) return field(101);
    if (t.file_size == 0) return field(125);
    if (t.transfer != Transfer::drop_folder && t.transfer != Transfer::chunks) return field(127);
    if (!is_file_name(t.file_name)) return field(128);
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
        limits.tools.empty() || std::find(limits.tools.begin(), limits.tools.end(), t.tool_no) != limits.tools.end();
    if (!has_tool) return TicketFault{AckResult::tool, 164};
    return std::nullopt;
}

}  // namespace qchopper

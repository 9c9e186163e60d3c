// Of each place the points in the box around tool, holder and spindle are looked at.

#include "tests/cam/toolpath/plain_replay.h"

#include <algorithm>
#include <cmath>

#include "cam/setup/holder_clearance.h"
#include "cam/stock/cl_surface.h"

namespace qchopper::test_pieces {
namespace {

constexpr double touch = 0.1;             // mm that count as contact only
constexpr std::size_t holder_every = 40;  // places

}  // namespace

PlainReplay::PlainReplay(const Setup& setup, const Cell& cell, double step) : setup_(setup), cell_(cell), step_(step) {
    const Vec3 size = setup.block.size;
    origin_ = {-0.5 * size.x, -0.5 * size.y, -setup.spoil};
    for (int i = 0; i < 3; ++i) count_[i] = static_cast<std::size_t>(size[i] / step) + 1;
    for (std::size_t x = 0; x < count_[0]; ++x) {
        for (std::size_t y = 0; y < count_[1]; ++y) {
            for (std::size_t z = 0; z < count_[2]; ++z) {
                const auto at = [&](std::size_t i) { return std::min(step * (static_cast<double>(i) + 0.01), 1e9); };
                points_.push_back(origin_ + Vec3{at(x), at(y), at(z)});
            }
        }
    }
    is_stock_.assign(points_.size(), 1);
}

void PlainReplay::note(std::size_t& count, const std::string& what) {
    if (faults_.first.empty()) faults_.first = what;
    ++count;
}

void PlainReplay::meet(const CuttingTool& tool, std::size_t point, double above, double beside, MoveKind kind) {
    const bool is_cut = kind == MoveKind::cut || kind == MoveKind::approach;
    const Vec3 p = points_[point];
    const std::string where = " at " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
                              ", " + std::to_string(above) + " above the tip, " + std::to_string(beside) + " beside";
    const double in_shape = above - tool_profile(tool, beside);
    if (above <= tool.stick_out && in_shape >= 0) {
        const bool is_inside = beside < 0.5 * tool.diameter - touch && in_shape > touch;
        if (is_inside && !is_cut) note(faults_.link_in_stock, "link in foam" + where);
        if (is_inside && is_cut && above > tool.flute_length) note(faults_.above_flute, "above the flute" + where);
        const bool is_centre = beside < 0.25 * tool.diameter && in_shape > touch;
        if (is_steep_ && is_centre && !tool.is_centre_cutting) note(faults_.plunge, "plunge" + where);
        if (is_cut) is_stock_[point] = 0;
        return;
    }
    double from = tool.stick_out;
    for (const HolderStep& step : tool_body(tool, *cell_.machine).steps) {
        if (above > from && above < from + step.length && beside < 0.5 * step.diameter) {
            note(faults_.holder, "holder" + where);
        }
        from += step.length;
    }
}

void PlainReplay::stand(const Operation& operation, Vec3 tip, MoveKind kind, bool with_holder) {
    const CuttingTool& tool = cell_.machine->tools[operation.tool];
    const Vec3 tool_axis = rotate(setup_.piece_in_setup, setup_.access.orientations[operation.orientation].tool_axis);
    if (tip.z < -setup_.spoil + 2 - 1e-9) note(faults_.below_spoil, "below the spoil layer");
    double reach = 0.5 * tool.diameter;
    double length = tool.stick_out;
    const std::vector<HolderStep> steps = tool_body(tool, *cell_.machine).steps;
    for (std::size_t i = 0; i < steps.size() && with_holder; ++i) {
        reach = std::max(reach, 0.5 * steps[i].diameter);
        length += steps[i].length;
    }
    const Vec3 end = tip + length * tool_axis;
    std::size_t first[3];
    std::size_t last[3];
    for (int i = 0; i < 3; ++i) {
        const double more = reach * std::sqrt(std::max(0.0, 1 - tool_axis[i] * tool_axis[i])) + step_;
        const double low = (std::min(tip[i], end[i]) - more - origin_[i]) / step_;
        const double high = (std::max(tip[i], end[i]) + more - origin_[i]) / step_;
        if (high < 0) return;
        first[i] = static_cast<std::size_t>(std::max(0.0, low));
        last[i] = std::min(static_cast<std::size_t>(high) + 1, count_[i]);
    }
    for (std::size_t x = first[0]; x < last[0]; ++x) {
        for (std::size_t y = first[1]; y < last[1]; ++y) {
            for (std::size_t z = first[2]; z < last[2]; ++z) {
                const std::size_t point = (x * count_[1] + y) * count_[2] + z;
                if (is_stock_[point] == 0) continue;
                const Vec3 from_tip = points_[point] - tip;
                const double above = dot(tool_axis, from_tip);
                if (above < 0) continue;
                const double beside = norm(from_tip - above * tool_axis);
                if (beside <= reach) meet(tool, point, above, beside, kind);
            }
        }
    }
}

void PlainReplay::mill(const Operation& operation) {
    const Vec3 tool_axis = rotate(setup_.piece_in_setup, setup_.access.orientations[operation.orientation].tool_axis);
    for (const PathRun& run : operation.runs) {
        Vec3 at = run.start;
        const auto is_at_retract = [&](Vec3 p) { return std::abs(dot(tool_axis, p) - operation.retract) < 1e-6; };
        if (!is_at_retract(run.start) || !is_at_retract(run.moves.back().tip)) {
            note(faults_.not_at_retract, "a run does not begin and end at the retract plane");
        }
        for (const PathMove& move : run.moves) {
            const double length = norm(move.tip - at);
            const double down = dot(tool_axis, at - move.tip);
            is_steep_ = down > 0.4663 * norm(move.tip - at + down * tool_axis);
            const auto parts = static_cast<std::size_t>(length / 1.4) + 1;
            for (std::size_t i = 0; i <= parts; ++i) {
                const Vec3 tip = at + (static_cast<double>(i) / static_cast<double>(parts)) * (move.tip - at);
                stand(operation, tip, move.kind, places_++ % holder_every == 0);
            }
            at = move.tip;
        }
    }
}

}  // namespace qchopper::test_pieces

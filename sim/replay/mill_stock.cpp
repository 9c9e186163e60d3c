// The rules are those of the facts about milling: a rapid is a joint move or a line faster than the tool's window, and
// removes nothing; the window holds for lines that remove foam, from half its least feed on the way down. O(cells under
// the tool) for each line, O(points of its bodies) for each pose of a joint move.

#include "sim/replay/mill_stock.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <utility>

#include "base/text.h"
#include "cam/cell/machine_bodies.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr double written = 0.011;      // mm: what rounding of coordinates may do to a bound
constexpr int max_chords = 6;          // of a parabola
constexpr double chord_error = 0.003;  // mm between a chord and the parabola, where fewer chords suffice for it
constexpr double straight = 0.001;     // mm of deviation that needs no parabola
// Of the tool's section, and of its diameter in mm: so much foam may stand above the flute while the tool goes on by
// its diameter. It is what rounding of a corner leaves, and skins on walls that are thinner than half a millimetre.
constexpr double deep_share = 0.1;
constexpr double deep_width = 0.5;
// Of a tool whose centre does not cut: tangent of the steepest way down in foam, the share of the radius within which
// it does not cut, and the foam under it that is none.
constexpr double steepest_ramp = 0.466;  // of 25 degrees
constexpr double centre_share = 0.5;
constexpr double under_centre = 0.15;  // mm
constexpr double rim_step = 8;         // mm between points of a body that is sampled

// Foam above the flute on the last lines: lines may be short, so that each alone meets little.
class DeepWay {
 public:
    // Goes on by `mm` and meets `mm2`; the sum of the last `window` mm and the rest of the line where they begin.
    double add(double mm, double mm2, double window) {
        parts_.push_back({std::min(mm, window), mm2});
        mm_ += parts_.back().mm;
        mm2_ += mm2;
        while (mm_ - parts_.front().mm >= window) {
            mm_ -= parts_.front().mm;
            mm2_ -= parts_.front().mm2;
            parts_.pop_front();
        }
        return mm2_;
    }
    void reset() { *this = {}; }

 private:
    struct Part {
        double mm = 0;
        double mm2 = 0;
    };
    std::deque<Part> parts_;
    double mm_ = 0;
    double mm2_ = 0;
};

class StockMilling {
 public:
    StockMilling(StockModel& stock_model, const ReplayScene& scene, std::size_t lines, FindingLog& log)
        : stock_model_(stock_model), scene_(scene), machine_(*scene.cell->machine), log_(log), holes_(scene, log) {
        for (const CuttingTool& tool : machine_.tools) cutters_.push_back(cutter_of(tool));
        figures_.lines.resize(lines);
    }
    // `index` is that of the line in the path.
    void take_line(const TipLine& line, std::size_t index, const std::vector<Vec3>& way);
    void take_sweep(const JointSweep& sweep);
    MillingFigures finish() {
        figures_.holes = holes_.finish();
        return std::move(figures_);
    }

 private:
    void check_bounds(const TipLine& line, const CuttingTool& tool);
    void check_cut(const TipLine& line, const CuttingTool& tool, const CutResult& cut);
    void check_spindle(const TipLine& line, const CuttingTool& tool);
    void check_feed(const TipLine& line, const CuttingTool& tool);
    // Of a part of the line, before it removes anything.
    void check_plunge(const TipLine& line, const CuttingTool& tool, Vec3 from, Vec3 to);
    void check_holder(const TipLine& line, const CuttingTool& tool);
    bool is_body_in_stock(const TipPose& pose, double from, double to, double radius) const;
    Vec3 tool_axis_of(const TipLine& line) const { return scene_.orientations[line.orientation].tool_axis; }

    StockModel& stock_model_;
    const ReplayScene& scene_;
    const CellMachine& machine_;
    FindingLog& log_;
    HoleCheck holes_;
    DeepWay deep_way_;
    std::vector<Cutter> cutters_;
    MillingFigures figures_;
};

void StockMilling::take_line(const TipLine& line, std::size_t index, const std::vector<Vec3>& way) {
    const CuttingTool& tool = machine_.tools[line.tool];
    check_bounds(line, tool);
    if (!line.is_aligned) return;
    CutResult all;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        if (!tool.is_centre_cutting) check_plunge(line, tool, way[i], way[i + 1]);
        const CutResult cut =
            stock_model_.cut(line.orientation, cutters_[line.tool], tool.flute_length + written, way[i], way[i + 1]);
        all.touches |= cut.touches;
        all.volume += cut.volume;
        all.depth = std::max(all.depth, cut.depth);
        const double deep_mm2 = deep_way_.add(norm(way[i + 1] - way[i]), cut.deep_mm2, tool.diameter);
        if (cut.deep_mm2 > 0) all.deep_mm2 = std::max(all.deep_mm2, deep_mm2);
    }
    const double length = norm(line.to - line.from);
    const bool is_link = is_rapid(line, tool);
    figures_.removed_mm3 += all.volume;
    figures_.lines[index] = {all.touches, all.volume};
    if (is_link) ++figures_.rapids;
    if (!is_link) figures_.feed_mm += length;
    if (!is_link && !all.touches) figures_.air_mm += length;
    if (all.touches) ++figures_.cuts;
    if (all.touches && is_link) {
        log_.add(FindingKind::rapid_in_foam, line.place, all.depth, all.volume, [&] {
            return "a rapid of " + fixed(line.feed, 1) + " mm/s removes foam " + fixed(all.depth, 2) + " mm deep";
        });
    }
    if (all.touches) check_cut(line, tool, all);
    if (is_drill(tool)) holes_.take_line(line, all.touches);
    check_holder(line, tool);
}

void StockMilling::check_bounds(const TipLine& line, const CuttingTool& tool) {
    const double low = std::min(line.from.z, line.to.z) + lowest_point(cutters_[line.tool], tool_axis_of(line).z);
    const double least = scene_.floor_z();
    const double beyond = least - low;
    if (beyond > written) {
        log_.add(FindingKind::below_floor, line.place, low, beyond,
                 [&] { return "a tool point is at z " + fixed(low, 2) + ", the least is " + fixed(least, 2); });
    }
    const double link_feed = machine_.program.link_feed_mm_per_s;
    if (line.feed > 1.001 * std::max(link_feed, tool.feed_max_mm_per_s)) {
        log_.add(FindingKind::link_feed, line.place, line.feed, line.feed,
                 [&] { return fixed(line.feed, 1) + " mm/s, links may go at " + fixed(link_feed, 1); });
    }
}

void StockMilling::check_cut(const TipLine& line, const CuttingTool& tool, const CutResult& cut) {
    check_spindle(line, tool);
    check_feed(line, tool);
    const double section = 0.25 * std::numbers::pi * tool.diameter * tool.diameter;
    if (cut.deep_mm2 > std::max(deep_share * section, deep_width * tool.diameter)) {
        log_.add(FindingKind::deep_cut, line.place, cut.depth, cut.depth, [&] {
            return fixed(cut.depth, 1) + " mm of foam are cut at once, on " + fixed(cut.deep_mm2, 0) +
                   " mm2 of the way of one diameter, the flute is " + fixed(tool.flute_length, 1) + " mm";
        });
    }
}

void StockMilling::check_spindle(const TipLine& line, const CuttingTool& tool) {
    const Spindle& spindle = machine_.spindle;
    const SignalState& signals = line.signals;
    if ((spindle.on || !machine_.robot) && !(signals.spindle_is_on && signals.has_speed)) {
        log_.add(FindingKind::spindle_off, line.place,
                 signals.spindle_is_on ? "foam is cut before the chunk has waited for the speed of the spindle"
                                       : "foam is cut, and the chunk has not switched the spindle on");
    }
    if (machine_.extraction && machine_.extraction->on && !signals.extraction_is_on) {
        log_.add(FindingKind::extraction_off, line.place, "foam is cut, and the chunk has not switched extraction on");
    }
    const double rpm = signals.rpm;
    if ((!spindle.speed && machine_.robot) || (rpm >= 0.995 * tool.rpm_min && rpm <= 1.005 * tool.rpm_max)) return;
    log_.add(FindingKind::spindle_speed, line.place, rpm, std::abs(rpm - tool.rpm_min), [&] {
        return "foam is cut at " + fixed(rpm, 0) + " revolutions/min, tool " + std::to_string(tool.number) +
               " may do " + std::to_string(tool.rpm_min) + " to " + std::to_string(tool.rpm_max);
    });
}

void StockMilling::check_feed(const TipLine& line, const CuttingTool& tool) {
    const bool goes_down = dot(line.to - line.from, tool_axis_of(line)) < -1e-6;
    const double least = (goes_down ? 0.5 : 1.0) * tool.feed_min_mm_per_s;
    if (line.feed >= 0.999 * least) return;
    log_.add(FindingKind::feed_window, line.place, line.feed, least - line.feed,
             [&] { return "foam is cut at " + fixed(line.feed, 1) + " mm/s, the least is " + fixed(least, 1); });
}

void StockMilling::check_plunge(const TipLine& line, const CuttingTool& tool, Vec3 from, Vec3 to) {
    const Vec3 way = to - from;
    const double down = -dot(way, tool_axis_of(line));
    const double across = norm(way + down * tool_axis_of(line));
    if (down <= steepest_ramp * across) return;
    const double foam = stock_model_.disc_contact(line.orientation, centre_share * 0.5 * tool.diameter, 0, from, to);
    if (foam <= under_centre) return;
    log_.add(FindingKind::plunge, line.place, foam, foam, [&] {
        return "tool " + std::to_string(tool.number) + ", whose centre does not cut, goes straight down into " +
               fixed(foam, 2) + " mm of foam";
    });
}

void StockMilling::check_holder(const TipLine& line, const CuttingTool& tool) {
    for (const AxisBody& body : bodies_over_tip(tool, machine_)) {
        if (body.part == BodyPart::tool) continue;
        const double into =
            stock_model_.disc_contact(line.orientation, body.shape.radius, -body.shape.from.z, line.from, line.to);
        if (into <= written) continue;
        const std::string what = body.part == BodyPart::link      ? "the wrist"
                                 : body.part == BodyPart::spindle ? "the spindle"
                                                                  : "the holder";
        log_.add(FindingKind::holder_contact, line.place, into, into,
                 [&] { return what + " comes " + fixed(into, 2) + " mm into the foam"; });
    }
}

bool StockMilling::is_body_in_stock(const TipPose& pose, double from, double to, double radius) const {
    const Pose frame = tool_axis_frame(pose.tool_axis);
    const Box& block = stock_model_.block();
    const Vec3 low = pose.tip + from * pose.tool_axis;
    const Vec3 high = pose.tip + to * pose.tool_axis;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::max(low[axis], high[axis]) + radius <= block.min[axis]) return false;
        if (std::min(low[axis], high[axis]) - radius >= block.max[axis]) return false;
    }
    const auto rings = static_cast<int>(std::ceil((to - from) / rim_step)) + 1;
    const int around = std::max(8, static_cast<int>(6.3 * radius / rim_step));
    for (int k = 0; k <= rings; ++k) {
        const Vec3 middle = low + (static_cast<double>(k) / rings) * (high - low);
        if (stock_model_.is_in_stock(middle)) return true;
        for (int i = 0; i < around; ++i) {
            const double angle = 6.283185307179586 * i / around;
            if (stock_model_.is_in_stock(middle +
                                         rotate(frame, {radius * std::cos(angle), radius * std::sin(angle), 0})))
                return true;
        }
    }
    return false;
}

void StockMilling::take_sweep(const JointSweep& sweep) {
    if (!sweep.is_checked_only && !sweep.is_of_line) ++figures_.rapids;
    if (!sweep.is_checked_only) deep_way_.reset();
    const auto find = [&](FindingKind kind, const std::string& what) {
        const std::string way = sweep.is_of_line ? "on the line behind a joint move " : "on a joint move ";
        if (!sweep.is_checked_only) return log_.add(kind, sweep.place, way + what);
        log_.add(FindingKind::start_from_home, sweep.place,
                 "the comment says that the start from home is free, and on it " + what);
    };
    const CuttingTool& tool = machine_.tools[sweep.tool];
    const Cutter& cutter = cutters_[sweep.tool];
    const std::vector<AxisBody> bodies = bodies_over_tip(tool, machine_);
    for (const TipPose& pose : sweep.poses) {
        // The body of the tool without its rounded end, 0.01 mm smaller, and the tip.
        const double straight_from = cutter.shape == ToolShape::flat ? written : std::max(cutter.corner, written);
        const bool is_in = stock_model_.is_in_stock(pose.tip + written * pose.tool_axis) ||
                           is_body_in_stock(pose, straight_from, tool.stick_out, cutter.radius - written);
        if (is_in) return find(FindingKind::rapid_in_foam, "the tool goes through foam");
        for (const AxisBody& body : bodies) {
            if (body.part == BodyPart::tool) continue;
            if (!is_body_in_stock(pose, -body.shape.from.z, -body.shape.to.z, body.shape.radius)) continue;
            return find(FindingKind::holder_contact, "holder, spindle or wrist comes into the foam");
        }
    }
}

}  // namespace

std::vector<Vec3> rounded_way(const TipLine* before, const TipLine& line, const TipLine* after) {
    std::vector<Vec3> way;
    const RoundedCorner first = before != nullptr ? corner_of(*before, line) : RoundedCorner{};
    way.push_back(before != nullptr && first.deviation > straight ? first.after : line.from);
    if (after == nullptr || line.rounding <= 0) {
        way.push_back(line.to);
        return way;
    }
    const RoundedCorner last = corner_of(line, *after);
    if (last.deviation <= straight) {
        way.push_back(line.to);
        return way;
    }
    // Equal parts of the parameter lie at equal distances from their chords, n^-2 of the whole's, which is the
    // deviation.
    const int chords = std::clamp(static_cast<int>(std::ceil(std::sqrt(last.deviation / chord_error))), 1, max_chords);
    for (int i = 0; i <= chords; ++i) way.push_back(last.at(static_cast<double>(i) / chords));
    return way;
}

MillingFigures mill_stock(StockModel& stock_model, const ToolPath& path, const ReplayScene& scene, bool is_worst,
                          FindingLog& log, const Context& context, const MillingObserver& on_part) {
    StockMilling milling(stock_model, scene, path.lines.size(), log);
    std::size_t done = 0;
    for (const PathPart& part : path.order) {
        if (done % 256 == 0) {
            context.check_cancelled();
            context.progress("moves carved", done, path.order.size());
        }
        if (part.is_line) {
            const TipLine& line = path.lines[part.index];
            milling.take_line(line, part.index,
                              is_worst ? rounded_way(path.before(part.index), line, path.after(part.index))
                                       : std::vector<Vec3>{line.from, line.to});
        } else {
            milling.take_sweep(path.sweeps[part.index]);
        }
        ++done;
        if (on_part) on_part(done);
    }
    context.progress("moves carved", done, path.order.size());
    return milling.finish();
}

}  // namespace qchopper

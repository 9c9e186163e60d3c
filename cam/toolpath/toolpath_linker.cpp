// Ways are looked at in samples half a cell of the foam's map apart, and for the tip limit a cell of it, or a sixteenth
// where the tool is known. Each run lowers the foam as it goes, so that what was milled a moment ago is free.
// O(samples * (radius / cell)^2).

#include "cam/toolpath/toolpath_linker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "cam/toolpath/cutting_parts.h"
#include "cam/toolpath/pass_order.h"
#include "cam/toolpath/pass_stretches.h"
#include "cam/toolpath/run_motion.h"
#include "segment/raster/bilinear_cell.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr std::size_t many_moves = 600;                      // a run ends at the next link that goes high
constexpr std::size_t max_moves = 900;                       // a run ends in the middle of a pass
constexpr double ramp_slope = 0.364;                         // tangent of 20 degrees
constexpr double highest_lift = 5;                           // over a ridge between two passes, at the feed of cuts
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;  // of a cell
constexpr double least_rounding = 0.05;                      // mm before a corner that are worth a line
constexpr double cut_into = 0.02;                            // mm below the limit that a rounded corner may be
// What roughing does not come for: foam so low, and so narrow a strip along a wall; finishing takes it.
constexpr double film_of_roughing = 0.1;
constexpr double left_at_rim = 1;
// So much air stays that a link to the cut touches no foam.
constexpr AirOptions air_of_roughing{2, 5};
constexpr double ramp_penalty = 60;  // mm of way that an entry beside the foam is worth

Vec3 raised(Vec3 point, double z) {
    return {point.x, point.y, z};
}

// The first part of a pass, of a length.
std::vector<Vec3> beginning_of(const Pass& pass, double length) {
    std::vector<Vec3> part{pass.points[0].tip};
    for (std::size_t i = 1; i < pass.points.size() && length > 0; ++i) {
        const Vec3 next = pass.points[i].tip;
        const double leg = norm(next - part.back());
        if (leg <= 0) continue;
        part.push_back(leg <= length ? next : part.back() + (length / leg) * (next - part.back()));
        length -= leg;
    }
    return part;
}

}  // namespace

// What is on a straight line from the tip to another place.
struct ToolpathLinker::Way {
    double length = 0;
    double foam = -std::numeric_limits<double>::infinity();  // highest that the tool may touch
    double limit = foam;                                     // of the tip
    double holder = foam;
    double over_limit = foam;  // most by which the limit is above the way
    double over_holder = foam;
    double over_stock = foam;
    double over_flute = foam;  // most by which foam under the tool is above the flute
};

ToolpathLinker::ToolpathLinker(MillingSpace& space, const CuttingTool& tool, const Operation& operation,
                               LinkOptions options)
    : space_(&space),
      tool_(&tool),
      operation_(&operation),
      options_(options),
      sweep_(tool, space.stock.cell, options.slack),
      centre_sweep_(tool, space.stock.cell, 0, StockCells::centres) {
    const double radius = 0.5 * tool.diameter;
    const double cell = space.stock.cell;
    outer_ = radius + (half_diagonal + 0.25) * cell + options.slack;
    inner_ = std::max(0.0, radius - 2 * half_diagonal * cell);
}

double ToolpathLinker::stock_near(Vec3 at, double radius) const {
    return static_cast<double>(dilation_at(space_->stock, at.x, at.y, radius));
}

double ToolpathLinker::over_flute(Vec3 at) const {
    const double radius = std::max(0.0, 0.5 * tool_->diameter - flute_rim);
    return static_cast<double>(dilation_at(space_->centre_stock, at.x, at.y, radius)) - at.z - tool_->flute_length;
}

// Across an edge the limit between the centres of cells is no straight line: there the tool tells.
double ToolpathLinker::limit_at(Vec3 p) const {
    if (!space_->is_limit_between) return static_cast<double>(space_->cl_limit->height_under(p.x, p.y));
    const HeightField& cl = *space_->cl_limit;
    const BilinearCell around(cl, p.x, p.y);
    const double limit = around.height(cl);
    if (space_->tool == nullptr) return limit;
    const auto height_of = [&](std::size_t cell) { return static_cast<double>(cl.height[cell]); };
    const auto is_lower = [&](std::size_t a, std::size_t b) { return cl.height[a] < cl.height[b]; };
    const auto [lowest, highest] = std::minmax_element(around.cells.begin(), around.cells.end(), is_lower);
    const double rise = height_of(*highest) - height_of(*lowest);
    if (height_of(*highest) <= p.z || rise <= edge_rise(0.5 * tool_->diameter, cl.cell)) return limit;
    const double of_tool = space_->tool->height(p.x, p.y);
    const bool is_raised = std::any_of(around.cells.begin(), around.cells.end(), [&](std::size_t cell) {
        return height_of(cell) > p.z && !is_of_tool(cl, *space_->tool, cell);
    });
    return is_raised ? std::max(limit, of_tool) : of_tool;
}

// At least limit_at(). Between the centres of four cells the tool stands nowhere higher than over one of them: a cell
// raises it the more, the nearer it is, and counts as a square around its own centre, to which of all places between
// two centres one of the two is the nearest (tests/cam/stock/cl_surface_test.cpp, NoHeightBetweenFourMiddles...).
double ToolpathLinker::highest_limit_around(Vec3 p) const {
    const HeightField& cl = *space_->cl_limit;
    if (!space_->is_limit_between) return static_cast<double>(cl.height_under(p.x, p.y));
    double highest = -std::numeric_limits<double>::infinity();
    for (const std::size_t cell : BilinearCell(cl, p.x, p.y).cells) {
        highest = std::max(highest, static_cast<double>(cl.height[cell]));
    }
    return highest;
}

// How far apart a way is held against the limit. An edge that is known between the centres of cells may lie between two
// places as well: then the tool is at most so far in the wall.
double ToolpathLinker::limit_spacing() const {
    const double cell = space_->cl_limit->cell;
    if (!space_->is_limit_between) return 0.5 * cell;
    return space_->tool != nullptr ? cell / 16 : cell;
}

double ToolpathLinker::holder_at(double x, double y) const {
    return static_cast<double>(space_->holder_clearance_height.height_under(x, y));
}

bool ToolpathLinker::needs_ramp(Vec3 at) const {
    return stock_near(at, inner_) > at.z + film_of_roughing;
}

bool ToolpathLinker::removes_foam(Vec3 at) const {
    const double core = std::max(0.0, 0.5 * tool_->diameter - left_at_rim);
    return is_dilation_above(space_->centre_stock, at.x, at.y, core, at.z + film_of_roughing);
}

ToolpathLinker::Way ToolpathLinker::way_to(Vec3 to) const {
    Way way;
    const Vec3 line = to - at_;
    way.length = norm(line);
    const double across = std::hypot(line.x, line.y);
    const double fine = limit_spacing();
    const auto samples = static_cast<std::size_t>(across / fine) + 1;
    const auto every = std::max<std::size_t>(1, static_cast<std::size_t>(0.5 * space_->stock.cell / fine));
    for (std::size_t i = 0; i <= samples; ++i) {
        const Vec3 p = at_ + (static_cast<double>(i) / static_cast<double>(samples)) * line;
        const double most = highest_limit_around(p);
        if (most > way.limit || most - p.z > way.over_limit) {
            const double limit = limit_at(p);
            way.limit = std::max(way.limit, limit);
            way.over_limit = std::max(way.over_limit, limit - p.z);
        }
        if (i % every != 0 && i != samples) continue;
        const double foam = stock_near(p, outer_);
        const double holder = holder_at(p.x, p.y);
        way.foam = std::max(way.foam, foam);
        way.over_stock = std::max(way.over_stock, foam - p.z);
        way.holder = std::max(way.holder, holder);
        way.over_holder = std::max(way.over_holder, holder - p.z);
        way.over_flute = std::max(way.over_flute, over_flute(p));
    }
    return way;
}

void ToolpathLinker::move(Vec3 tip, MoveKind kind, Corner corner) {
    const bool is_move = norm(tip - at_) > 1e-6;
    // Before the move removes foam that the rounded corner would meet.
    if (is_move && !run_.moves.empty()) run_.moves.back().rounding = rounding_before(tip, kind);
    double removed = 0;
    if (kind == MoveKind::cut || kind == MoveKind::approach) {
        sweep_.move(space_->stock, space_->removed, at_, tip);
        removed = centre_sweep_.move(space_->centre_stock, space_->centre_removed, at_, tip);
        all_removed_mm3_ += removed;
    }
    if (is_move) {
        run_.moves.push_back({tip, kind});
        removed_mm3_.push_back(removed);
        before_ = at_;
    }
    corner_ = corner;
    at_ = tip;
}

// Of the corner at the end of the last move, if the tool goes on like that.
double ToolpathLinker::rounding_before(Vec3 to, MoveKind kind) const {
    const double largest = operation_->rounding;
    if (corner_ == Corner::rounded && !options_.has_ramps) return largest;
    if (corner_ == Corner::clear) return std::min(largest, options_.clearance);
    const bool is_within = corner_ == Corner::inner && !options_.has_ramps;
    const double deviation = is_within ? options_.within : options_.slack;
    double rounding = corner_rounding(before_, at_, to, deviation, largest);
    for (; rounding >= least_rounding; rounding *= 0.5) {
        if (is_round_way_clear(to, kind, rounding)) return rounding;
        rounding = std::min(rounding, 0.5 * std::min(norm(at_ - before_), norm(to - at_)));
    }
    return 0;
}

// A link may touch no foam, and where it ends in a rounded corner its feed holds to the end of that: the controller
// changes it there as it likes. Roughing stays beyond its allowance by more than it passes beside a corner.
bool ToolpathLinker::is_round_way_clear(Vec3 to, MoveKind kind, double rounding) const {
    const auto is_link = [](MoveKind of) { return of == MoveKind::link || of == MoveKind::retract; };
    for (const double t : {0.125, 0.25, 0.5, 0.75, 0.875}) {
        const Vec3 p = on_parabola(before_, at_, to, rounding, t);
        if (space_->is_limit_between && limit_at(p) > p.z + cut_into) return false;
        if (space_->is_limit_between && holder_at(p.x, p.y) > p.z) return false;
        const bool is_before = is_link(run_.moves.back().kind);
        const bool is_behind = t >= 0.5 && is_link(kind);
        if ((is_before || is_behind) && stock_near(p, outer_) > p.z) return false;
    }
    return true;
}

void ToolpathLinker::begin_run(Vec3 at) {
    run_ = {};
    removed_mm3_.clear();
    at_ = raised(at, space_->retract);
    run_.start = at_;
}

void ToolpathLinker::end_run() {
    if (run_.moves.empty()) return;
    move(raised(at_, space_->retract), MoveKind::retract);
    settle_rounding(run_, operation_->rounding);
    limit_feeds(run_, removed_mm3_, space_->stock.cell, *tool_, *operation_);
    runs_.push_back(std::move(run_));
    run_ = {};
}

void ToolpathLinker::hop_to(Vec3 to, double height) {
    move(raised(at_, height), MoveKind::retract, Corner::clear);
    move(raised(to, height), MoveKind::link, Corner::clear);
}

void ToolpathLinker::ramp(const Pass& pass, double top) {
    const double down = top - pass.points[0].tip.z;
    const double whole = down / ramp_slope;
    const double least = tool_->is_centre_cutting ? 0 : least_length();
    std::vector<Vec3> part = beginning_of(pass, std::min(std::max(0.5 * whole, least), length_of(pass)));
    double length = 0;
    for (std::size_t i = 1; i < part.size(); ++i) length += norm(part[i] - part[i - 1]);
    const auto pairs = static_cast<std::size_t>(std::ceil(whole / (2 * length) - 1e-9));
    const double slope = down / (2 * length * static_cast<double>(pairs));
    double z = top;
    for (std::size_t traverse = 0; traverse < 2 * pairs; ++traverse) {
        for (std::size_t i = 1; i < part.size(); ++i) {
            z -= slope * norm(part[i] - part[i - 1]);
            move(raised(part[i], std::max(z, part[i].z)), MoveKind::cut, Corner::inner);
        }
        std::reverse(part.begin(), part.end());
    }
    move(pass.points[0].tip, MoveKind::cut);
}

// From above the first point.
void ToolpathLinker::enter(const Pass& pass) {
    const Vec3 first = pass.points[0].tip;
    const double clear = std::max(first.z, stock_near(first, outer_)) + options_.gap;
    if (clear < at_.z) move(raised(first, clear), MoveKind::link);
    const bool is_ramped = options_.has_ramps && length_of(pass) >= least_length() && needs_ramp(first);
    double top = std::max(first.z, stock_near(first, inner_));
    if (is_ramped) {
        for (const Vec3& p : beginning_of(pass, std::max((top - first.z) / ramp_slope, least_length())))
            top = std::max(top, stock_near(p, inner_));
    }
    if (top + options_.gap < at_.z) move(raised(first, top + options_.gap), MoveKind::cut);
    if (!is_ramped) return move(first, MoveKind::approach);
    if (top < at_.z) move(raised(first, top), MoveKind::approach);
    ramp(pass, std::min(top, at_.z));
}

void ToolpathLinker::go_to(const Pass& pass) {
    const Vec3 to = pass.points[0].tip;
    if (run_.moves.empty()) {
        begin_run(to);
        return enter(pass);
    }
    if (std::hypot(to.x - at_.x, to.y - at_.y) > options_.stay_down) {
        end_run();
        begin_run(to);
        return enter(pass);
    }
    const Way way = way_to(to);
    const bool is_free = way.over_limit <= 1e-3 && way.over_holder <= 0;
    if (is_free && way.over_stock <= 0) return move(to, MoveKind::link);
    const double height = std::max({way.foam, way.limit, way.holder, at_.z, to.z}) + options_.clearance;
    const double hop_s = (2 * height - at_.z - to.z + way.length) / operation_->link_feed + 0.3 +
                         2 * options_.gap / std::max(1.0, operation_->approach_feed);
    const bool is_cut_shorter = way.length / operation_->feed <= hop_s;
    if (is_cut_shorter && way.over_flute <= 0 && way.over_holder <= 0) {
        if (is_free) return move(to, MoveKind::cut);
        const double lift = way.over_limit + 0.01;
        const Vec3 above = raised(at_, at_.z + lift);
        const Vec3 end = raised(to, to.z + lift);
        const auto& is_beside = space_->is_beside_sawn_face;
        const bool is_clear = !is_beside || (!is_beside(above) && !is_beside(end));
        if (space_->is_limit_between && way.over_limit < highest_lift && is_clear) {
            move(above, MoveKind::cut);
            move(end, MoveKind::cut);
            return move(to, MoveKind::cut);
        }
    }
    if (height >= space_->retract - options_.clearance || run_.moves.size() >= many_moves) {
        end_run();
        begin_run(to);
    } else {
        hop_to(to, height);
    }
    enter(pass);
}

void ToolpathLinker::add_pass(const Pass& pass) {
    assert(pass.points.size() >= 2);
    go_to(pass);
    for (std::size_t i = 1; i < pass.points.size(); ++i) {
        const bool is_last = i + 1 == pass.points.size();
        if (run_.moves.size() >= max_moves) {
            Pass rest;
            rest.points.assign(pass.points.begin() + static_cast<std::ptrdiff_t>(i) - 1, pass.points.end());
            end_run();
            begin_run(rest.points[0].tip);
            enter(rest);
        }
        const Corner corner = is_last ? Corner::joint : pass.points[i].is_rounded ? Corner::rounded : Corner::inner;
        move(pass.points[i].tip, MoveKind::cut, corner);
    }
}

void ToolpathLinker::add(const std::vector<Pass>& passes) {
    if (options_.has_ramps) return add_roughing(passes);
    for (const PassEntry& entry : short_order(passes, at_)) {
        const Pass pass = begun_at(passes[entry.pass], entry.point);
        if (options_.film > 0 && !is_cutting(pass, space_->centre_stock, *tool_, options_.film)) continue;
        add_pass(pass);
    }
}

// Where the tool ends depends on how each pass is begun: the next one is chosen from there.
void ToolpathLinker::add_roughing(const std::vector<Pass>& passes) {
    PassOrder order(passes);
    while (const std::optional<PassEntry> entry = order.take_nearest(at_)) {
        Pass pass = begun_at(passes[entry->pass], entry->point);
        // An open pass is rather begun beside the foam.
        if (!pass.is_closed && needs_ramp(pass.points[0].tip)) {
            const Vec3 other = pass.points.back().tip;
            const double more = norm(other - at_) - norm(pass.points[0].tip - at_);
            if (more < ramp_penalty && !needs_ramp(other)) std::reverse(pass.points.begin(), pass.points.end());
        }
        const auto removes = [&](Vec3 at) { return removes_foam(at); };
        for (const Pass& part : cutting_parts(pass, air_of_roughing, removes)) {
            const bool is_short = length_of(part) < least_length();
            if (is_short && !tool_->is_centre_cutting && needs_ramp(part.points[0].tip)) continue;
            add_pass(part);
        }
    }
}

std::vector<PathRun> ToolpathLinker::finish() {
    end_run();
    return std::move(runs_);
}

}  // namespace qchopper

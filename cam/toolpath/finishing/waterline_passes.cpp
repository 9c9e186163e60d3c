// Levels are halved twice where needed: at each point of the level between two others the surface is followed up and
// down to them, and the scallop height comes from where they are (scallop.h). O(levels * squares of the map) at most.

#include "cam/toolpath/finishing/waterline_passes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "cam/stock/edge_rises.h"
#include "cam/toolpath/finishing/path_reduction.h"
#include "cam/toolpath/finishing/scallop.h"
#include "cam/toolpath/finishing/waterlines.h"
#include "segment/raster/bilinear_cell.h"

namespace qchopper {
namespace {

constexpr std::size_t halvings = 4;  // levels between two of the coarsest ones, and one of these

// The CL surface between the centres of cells.
class SmoothClSurface {
 public:
    explicit SmoothClSurface(const HeightField& cl) : cl_(cl) {}

    double height(Point2 p) const { return BilinearCell(cl_, p.x, p.y).height(cl_); }

    Point2 gradient(Point2 p) const {
        const double c = cl_.cell;
        return {(height({p.x + c, p.y}) - height({p.x - c, p.y})) / (2 * c),
                (height({p.x, p.y + c}) - height({p.x, p.y - c})) / (2 * c)};
    }

    std::size_t cell(Point2 p) const {
        const auto index = [&](double x, std::size_t count) {
            return static_cast<std::size_t>(std::clamp(std::floor(x / cl_.cell), 0.0, static_cast<double>(count - 1)));
        };
        return index(p.y, cl_.rows) * cl_.columns + index(p.x, cl_.columns);
    }

 private:
    const HeightField& cl_;
};

// Decides where a level between two others is needed.
class WaterlineNeed {
 public:
    WaterlineNeed(const HeightField& cl, const CellMask& mask, const RasterOptions& options)
        : smooth_(cl), mask_(mask), options_(options), cell_(cl.cell) {}

    // At a point of a level whose neighbours are `gap` above and below.
    bool holds(Point2 p, double z, double gap) const {
        if (mask_[smooth_.cell(p)] == 0) return false;
        const Point2 slope = smooth_.gradient(p);
        const double steepness = std::hypot(slope.x, slope.y);
        if (!(steepness > 0)) return false;
        const Point2 uphill{slope.x / steepness, slope.y / steepness};
        const Point2 up = follow(p, z, uphill, 1, gap);
        const Point2 down = follow(p, z, uphill, -1, gap);
        const Point2 chord{up.x - down.x, up.y - down.y};
        const double length = std::hypot(chord.x, chord.y);
        // The air is above and downhill.
        const double bulge = (down.x * chord.y - down.y * chord.x) / length;
        return scallop_height(options_.radius, length, bulge) > options_.scallop;
    }

 private:
    // Along the slope from p: how far off, and how much higher, the surface meets the neighbouring level, ends to be
    // steep, or has been followed far enough.
    Point2 follow(Point2 p, double z, Point2 uphill, double sign, double gap) const {
        double before = 0;
        for (double far = cell_; far <= 2 * options_.radius; far += cell_) {
            const Point2 at{p.x + sign * far * uphill.x, p.y + sign * far * uphill.y};
            const double rise = sign * (smooth_.height(at) - z);
            if (rise >= gap) {
                const double t = rise > before ? (gap - before) / (rise - before) : 1;
                return {sign * (far - cell_ + t * cell_), sign * gap};
            }
            if (mask_[smooth_.cell(at)] == 0) return {sign * far, sign * rise};
            before = rise;
        }
        return {sign * 2 * options_.radius, sign * before};
    }

    SmoothClSurface smooth_;
    const CellMask& mask_;
    const RasterOptions& options_;
    double cell_;
};

double distance(Point2 a, Point2 b) {
    return std::hypot(b.x - a.x, b.y - a.y);
}

// Whether each point is within a distance along the line from a marked one.
void grow_marks(const Waterline& line, std::vector<std::uint8_t>& marks, double by) {
    const std::size_t count = line.points.size();
    const std::vector<std::uint8_t> was = marks;
    for (const bool is_forward : {true, false}) {
        double since = std::numeric_limits<double>::infinity();
        // A closed line twice round, so that its start is reached from its end.
        for (std::size_t k = 0; k < (line.is_closed ? 2 * count : count); ++k) {
            const std::size_t i = is_forward ? k % count : count - 1 - k % count;
            const std::size_t before = is_forward ? (i + count - 1) % count : (i + 1) % count;
            since = was[i] != 0 ? 0 : since + distance(line.points[i].at, line.points[before].at);
            if (since <= by) marks[i] = 1;
        }
    }
}

// The marked parts of a line.
std::vector<Waterline> marked_parts(const Waterline& line, const std::vector<std::uint8_t>& marks) {
    const std::size_t count = line.points.size();
    const auto unmarked = static_cast<std::size_t>(std::find(marks.begin(), marks.end(), 0) - marks.begin());
    if (unmarked == count) return {line};
    std::vector<Waterline> parts;
    bool goes_on = false;
    // A closed line from a point that is not marked, so that no part is cut in two.
    const std::size_t begin = line.is_closed ? unmarked : 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = (begin + k) % count;
        if (marks[i] == 0) {
            goes_on = false;
            continue;
        }
        if (!goes_on) parts.push_back({line.level, {}, false});
        goes_on = true;
        parts.back().points.push_back(line.points[i]);
    }
    parts.erase(std::remove_if(parts.begin(), parts.end(), [](const Waterline& p) { return p.points.size() < 2; }),
                parts.end());
    return parts;
}

class WaterlineGates {
 public:
    WaterlineGates(const HeightField& cl, double tolerance)
        : cl_(cl), smooth_(cl), tolerance_(tolerance), cell_(cl.cell) {}

    std::vector<Gate> of(const Waterline& line, double z) const {
        const auto count = static_cast<std::ptrdiff_t>(line.points.size());
        const auto point = [&](std::ptrdiff_t i) {
            return line.points[static_cast<std::size_t>(line.is_closed ? (i + 2 * count) % count
                                                                       : std::clamp<std::ptrdiff_t>(i, 0, count - 1))];
        };
        std::vector<Gate> gates;
        gates.reserve(line.points.size() + 1);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const bool is_end = !line.is_closed && (i == 0 || i + 1 == count);
            if (!is_end && is_straight(point(i - 1).at, point(i).at, point(i + 1).at)) continue;
            WaterlinePoint at = point(i);
            for (std::ptrdiff_t k = -around; k <= around; ++k) at.is_at_edge = at.is_at_edge || point(i + k).is_at_edge;
            gates.push_back(gate(point(i - around).at, at, point(i + around).at, z));
        }
        if (line.is_closed) gates.push_back(gates.front());
        return gates;
    }

 private:
    // Points before and behind from which the direction of a line is taken: at an edge it goes in steps from cell to
    // cell.
    static constexpr std::ptrdiff_t around = 4;

    static bool is_straight(Point2 a, Point2 b, Point2 c) {
        const Point2 in{b.x - a.x, b.y - a.y};
        const Point2 out{c.x - b.x, c.y - b.y};
        return std::abs(in.x * out.y - in.y * out.x) < 1e-9 && in.x * out.x + in.y * out.y > 0;
    }

    // To the left of the line; narrow where the surface rises above the level again. At an edge, and between its steps,
    // wider by what the line is uncertain, so that the path does not follow the steps.
    Gate gate(Point2 before, const WaterlinePoint& point, Point2 after, double z) const {
        const Point2 at = point.at;
        const double length = std::max(distance(before, after), 1e-9);
        const Point2 left{-(after.y - before.y) / length, (after.x - before.x) / length};
        const double width_at_edge = 0.75 * cell_ + 0.7 * tolerance_;
        double width = point.is_at_edge ? std::max(tolerance_, width_at_edge) : tolerance_;
        const auto beside = [&](double far) { return Point2{at.x + far * left.x, at.y + far * left.y}; };
        // A cell farther, because next to an edge the interpolated surface is too high; and at the edge itself not even
        // interpolated.
        const Point2 far = beside(width + cell_);
        const double rise = point.is_at_found_edge ? cl_.height[smooth_.cell(far)] : smooth_.height(far);
        if (rise > z) width = 0.01 * tolerance_;
        return {at, beside(width)};
    }

    const HeightField& cl_;
    SmoothClSurface smooth_;
    double tolerance_;
    double cell_;
};

Pass pass_along(const Waterline& line, double z, const WaterlineGates& gates, const RasterOptions& options) {
    Pass pass;
    pass.is_closed = line.is_closed;
    for (const ReducedPoint& p : reduced_path(gates.of(line, z), line.is_closed, {options.rounding})) {
        pass.points.push_back({{p.at.x, p.at.y, z}, p.is_rounded});
    }
    return pass;
}

// The parts of lines whose points hold a condition, and what is at most `overlap` beside them along the line.
template <class Holds>
std::vector<Waterline> parts_where(const std::vector<Waterline>& lines, double overlap, const Holds& holds) {
    std::vector<std::vector<Waterline>> by_line(lines.size());
    parallel_for(0, lines.size(), [&](std::size_t i) {
        const Waterline& line = lines[i];
        std::vector<std::uint8_t> marks(line.points.size(), 0);
        for (std::size_t k = 0; k < marks.size(); ++k) {
            marks[k] = holds(line.points[k].at, line.level) ? 1 : 0;
        }
        if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return;
        grow_marks(line, marks, overlap);
        by_line[i] = marked_parts(line, marks);
    });
    std::vector<Waterline> parts;
    for (auto& some : by_line) std::move(some.begin(), some.end(), std::back_inserter(parts));
    return parts;
}

double lowest_of(const HeightField& cl, const CellMask& mask) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] != 0) lowest = std::min(lowest, static_cast<double>(cl.height[i]));
    }
    return lowest;
}

// Whether a ball whose tip is on a level touches the region: where it touches, steeply, is its radius uphill and as
// much higher.
class WaterlineContact {
 public:
    WaterlineContact(const HeightField& cl, const WaterlineGround& ground, double radius, double slack)
        : smooth_(cl), ground_(ground), radius_(radius), slack_(slack) {}

    bool holds(Point2 p, double z) const {
        const WaterlineFloor& floor = ground_.floor;
        if (z < floor.top && !floor.cells.empty() && floor.cells[smooth_.cell(p)] != 0) return true;
        const Point2 slope = smooth_.gradient(p);
        const double upright = 1 / std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
        const Point2 contact{p.x + radius_ * upright * slope.x, p.y + radius_ * upright * slope.y};
        return z + radius_ * (1 - upright) + slack_ >= static_cast<double>(ground_.region[smooth_.cell(contact)]);
    }

 private:
    SmoothClSurface smooth_;
    const WaterlineGround& ground_;
    double radius_;
    double slack_;
};

}  // namespace

std::vector<Pass> waterline_passes(const HeightField& cl, const PassCells& cells, const WaterlineGround& ground,
                                   double min_slope, const RasterOptions& options, const Context& context) {
    assert(cells.wanted.size() == cl.height.size() && cells.allowed.size() == cl.height.size());
    assert(options.scallop > 0 && options.path_tolerance > 0 && min_slope > 0);
    const double lowest = lowest_of(cl, cells.allowed);
    if (!std::isfinite(lowest)) return {};
    const double sine = min_slope / std::hypot(1, min_slope);
    const double step = sine * chord_for_scallop(options.radius, options.scallop);
    // A little above the lowest cell, where single precision may leave the floor uneven.
    const Levels levels{lowest + 1e-3, step / halvings};
    const double jump = edge_rise(options.radius, cl.cell);
    const WaterlineContact contact(cl, ground, options.radius, step);
    std::optional<EdgeRises> found;
    if (ground.tool != nullptr) found.emplace(cl, cells.allowed, jump, *ground.tool);
    const EdgeRises* edges = found ? &*found : nullptr;
    std::vector<Waterline> lines =
        parts_where(waterlines(cl, cells.allowed, levels, halvings, 0, jump, edges), options.overlap,
                    [&](Point2 p, std::size_t level) { return contact.holds(p, levels.height(level)); });
    const WaterlineNeed need(cl, cells.wanted, options);
    for (std::size_t gap = halvings / 2; gap > 0; gap /= 2) {
        context.check_cancelled();
        const double distance_up = levels.step * static_cast<double>(gap);
        std::vector<Waterline> between = parts_where(waterlines(cl, cells.allowed, levels, 2 * gap, gap, jump, edges),
                                                     options.overlap, [&](Point2 p, std::size_t level) {
                                                         const double z = levels.height(level);
                                                         return need.holds(p, z, distance_up) && contact.holds(p, z);
                                                     });
        std::move(between.begin(), between.end(), std::back_inserter(lines));
    }
    // From above.
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Waterline& a, const Waterline& b) { return a.level > b.level; });
    context.check_cancelled();
    const WaterlineGates gates(cl, options.path_tolerance);
    std::vector<Pass> passes(lines.size());
    parallel_for(0, lines.size(), [&](std::size_t i) {
        passes[i] = pass_along(lines[i], levels.height(lines[i].level), gates, options);
    });
    return passes;
}

}  // namespace qchopper

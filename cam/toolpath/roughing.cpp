// Levels are evenly spaced from the highest foam that is to go to the lowest tip, and between flats of the tip limit,
// each of which has a level of its own. A level's region is where the tip may be at that height (ISO 14649-11, "plane
// milling strategy" contour-parallel and bidirectional), and of it what lies near foam above the level. O(levels *
// cells * widest radius / cell) at most.

#include "cam/toolpath/roughing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "cam/toolpath/roughing_passes.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double min_foam = 0.2;          // mm above a level that is worth a cut
constexpr double allowance_share = 0.24;  // by which corners may be passed beside
constexpr double rim_share = 0.4;         // of the allowance, by which lines may pass beside a rim
constexpr double level_within = 0.05;     // mm
constexpr double flats_apart = 1;         // mm; finishing takes less
constexpr double cells_beside = 2.5;      // by which a pass goes on beyond the foam, so that it begins beside it

constexpr HolderGap holder_gap{1, 4};  // roughing passes farther beside its way than finishing, and asks at each level

class RoughingLevels {
 public:
    RoughingLevels(MillingSpace& space, const CuttingTool& tool, const Operation& operation,
                   const RoughingOptions& options)
        : space_(space), tool_(tool), stepdown_(operation.stepdown), options_(options) {
        beside_rim_ = rim_share * operation.allowance;
        const double radius = 0.5 * tool.diameter;
        core_radius_ = std::max(0.0, radius - options.skin_width);
        flute_radius_ = std::max(0.0, radius - flute_rim);
        beside_ = radius - core_radius_ + cells_beside * space.stock.cell;
    }

    // From the highest foam that is to go, to the lowest tip over such foam, evenly spaced between them and the flats;
    // of these, from above, the ones at which there is anything to mill.
    std::vector<double> heights() {
        const HeightField core = dilate_by_disc(space_.stock, core_radius_);
        const HeightField whole = dilate_by_disc(space_.centre_stock, flute_radius_);
        const HeightField& cl = *space_.cl_limit;
        double top = -std::numeric_limits<double>::infinity();
        double bottom = std::numeric_limits<double>::infinity();
        std::vector<double> tips;  // over foam that is to go
        for (std::size_t i = 0; i < core.height.size(); ++i) {
            const auto low = static_cast<double>(cl.height[i]);
            const bool is_high = static_cast<double>(whole.height[i]) > low + highest_skin();
            if (!is_high && !(static_cast<double>(core.height[i]) > low + min_above())) continue;
            const auto high = static_cast<double>(is_high ? std::max(core.height[i], whole.height[i]) : core.height[i]);
            deepest_ = std::max(deepest_, static_cast<double>(core.height[i]) - low);
            top = std::max(top, high);
            bottom = std::min(bottom, low);
            tips.push_back(low);
        }
        if (!(top > bottom)) return {};
        const std::vector<double> levels = spaced(top, flats_of(tips, bottom, top), bottom);
        // Cells that begin to have work at a level, less those that have none from there on.
        std::vector<std::ptrdiff_t> begins(levels.size() + 2, 0);
        // How many levels are not below a height, at least one.
        const auto level_of = [&](double height) {
            const auto below = std::upper_bound(levels.begin(), levels.end(), height, std::greater<>());
            return std::max<std::size_t>(1, static_cast<std::size_t>(below - levels.begin()));
        };
        for (std::size_t i = 0; i < core.height.size(); ++i) {
            const double high = std::max(static_cast<double>(core.height[i]) - min_above(),
                                         static_cast<double>(whole.height[i]) - highest_skin());
            if (!(high > static_cast<double>(cl.height[i]))) continue;
            // One level more to both sides: heights are rounded.
            ++begins[level_of(high)];
            --begins[std::min(level_of(static_cast<double>(cl.height[i])) + 2, begins.size() - 1)];
        }
        std::vector<double> heights;
        std::ptrdiff_t cells = 0;
        for (std::size_t k = 1; k <= levels.size(); ++k) {
            cells += begins[k];
            if (cells > 0) heights.push_back(levels[k - 1]);
        }
        return lowest_first(heights, top);
    }

    // What heights() found: RoughingRuns::deepest.
    double deepest() const { return deepest_; }

    LevelRegion region(double level) const {
        LevelRegion region{space_.stock.cell, space_.stock.columns, space_.stock.rows, {}, {}, beside_rim_};
        const auto height = static_cast<float>(level);
        const CellMask core = near_stock(space_.stock, static_cast<float>(level + min_above()), core_radius_);
        const CellMask skin =
            near_stock(space_.centre_stock, static_cast<float>(level + highest_skin()), flute_radius_);
        const CellMask over_flute =
            near_stock(space_.centre_stock, static_cast<float>(level + tool_.flute_length), flute_radius_);
        region.is_allowed.resize(core.size());
        CellMask work(core.size());
        for (std::size_t i = 0; i < core.size(); ++i) {
            const bool is_allowed = space_.cl_limit->height[i] <= height &&
                                    space_.holder_clearance_height.height[i] <= height && over_flute[i] == 0;
            region.is_allowed[i] = is_allowed ? 1 : 0;
            work[i] = is_allowed && (core[i] != 0 || skin[i] != 0) ? 1 : 0;
        }
        region.is_wanted = marked_within(work, region.columns, region.rows, beside_ / region.cell);
        return region;
    }

 private:
    // Heights at which the tip limit is level over at least four times the tool, from above; none near another, the top
    // or the bottom.
    std::vector<double> flats_of(std::vector<double> tips, double bottom, double top) const {
        const double cell_mm2 = space_.stock.cell * space_.stock.cell;
        const double least = std::numbers::pi * tool_.diameter * tool_.diameter / cell_mm2;
        std::sort(tips.begin(), tips.end(), std::greater<>());
        std::vector<double> flats;
        double above = top;
        for (std::size_t first = 0, end = 0; first < tips.size();) {
            const double height = tips[first];
            while (end < tips.size() && tips[end] > height - level_within) ++end;
            const bool is_flat = static_cast<double>(end - first) >= least;
            first = is_flat ? end : first + 1;
            if (!is_flat || above - height < flats_apart || height - bottom < flats_apart) continue;
            above = height;
            flats.push_back(height);
        }
        return flats;
    }

    // No farther apart than a step, the flats and the bottom among them; from above, below the top.
    std::vector<double> spaced(double top, std::vector<double> flats, double bottom) const {
        std::vector<double> levels;
        flats.push_back(bottom);
        for (const double flat : flats) {
            const double count = std::ceil((top - flat) / stepdown_ - 1e-6);
            for (double k = 1; k < count; ++k) levels.push_back(top - k * (top - flat) / count);
            levels.push_back(flat);
            top = flat;
        }
        return levels;
    }

    // Of levels that lie within what may be cut at once below the one before, the lowest before the others.
    std::vector<double> lowest_first(const std::vector<double>& levels, double top) const {
        std::vector<double> ordered;
        for (std::size_t first = 0; first < levels.size();) {
            std::size_t end = first + 1;
            while (end < levels.size() && top - levels[end] <= options_.deepest + 1e-6) ++end;
            ordered.push_back(levels[end - 1]);
            for (std::size_t k = first; k + 1 < end; ++k) ordered.push_back(levels[k]);
            top = levels[end - 1];
            first = end;
        }
        return ordered;
    }

    // The cells that have foam above a height within a radius.
    static CellMask near_stock(const HeightField& stock, float height, double radius) {
        CellMask above(stock.height.size());
        for (std::size_t i = 0; i < above.size(); ++i) above[i] = stock.height[i] > height ? 1 : 0;
        return marked_within(above, stock.columns, stock.rows, radius / stock.cell);
    }

    // A higher skin is not left to finishing: at the next level but one it would be higher than the flute.
    double highest_skin() const { return std::max(0.5 * tool_.flute_length, tool_.flute_length - 2 * stepdown_); }
    double min_above() const { return std::max(min_foam, options_.skin_height); }

    const MillingSpace& space_;
    const CuttingTool& tool_;
    double stepdown_;
    RoughingOptions options_;
    double deepest_ = 0;
    double core_radius_ = 0;   // foam within it is to go
    double flute_radius_ = 0;  // foam within it is cut by the flute
    double beside_ = 0;
    double beside_rim_ = 0;
};

}  // namespace

RoughingRuns rough(MillingSpace& space, const CuttingTool& tool, const ToolBody& body, const Operation& operation,
                   const RoughingOptions& options, const Context& context) {
    RoughingLevels levels(space, tool, operation, options);
    const std::vector<double> heights = levels.heights();
    double highest = -std::numeric_limits<double>::infinity();  // foam only gets lower
    for (const float height : space.stock.height) highest = std::max(highest, static_cast<double>(height));
    space.holder_clearance_height = {};
    LinkOptions links;
    links.has_ramps = true;
    links.slack = std::min(links.slack, allowance_share * operation.allowance);
    ToolpathLinker runs(space, tool, operation, links);
    for (const double level : heights) {
        context.check_cancelled();
        // The level before may have been a lower one: the link from there begins at its height.
        const double lowest = std::min(level, runs.end_height());
        // The float of the lowest tip is not above it.
        if (space.holder_clearance_height.height.empty() || is_holder_limiting(highest, body, holder_gap, lowest)) {
            space.holder_clearance_height = holder_clearance_over(space.stock, body, holder_gap, lowest);
        }
        runs.add(roughing_passes(levels.region(level), level, operation.stepover));
    }
    RoughingRuns result{runs.finish(), 0, levels.deepest()};
    result.removed_mm3 = runs.removed_mm3();
    return result;
}

}  // namespace qchopper

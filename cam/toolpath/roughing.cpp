// Levels are evenly spaced from the highest foam that is to go to the lowest tip. A level's region is where the tip may
// be at that height (ISO 14649-11, "plane milling strategy" contour-parallel and bidirectional), and of it what lies
// near foam above the level. O(levels * cells * widest radius / cell) at most.

#include "cam/toolpath/roughing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cam/toolpath/roughing_passes.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double min_foam = 0.2;          // mm above a level that is worth a cut
constexpr double allowance_share = 0.24;  // by which corners may be passed beside
constexpr double cells_beside = 2.5;      // by which a pass goes on beyond the foam, so that it begins beside it

constexpr HolderGap holder_gap{1, 4};  // roughing passes farther beside its way than finishing, and asks at each level

class RoughingLevels {
 public:
    RoughingLevels(MillingSpace& space, const CuttingTool& tool, double stepdown, const RoughingOptions& options)
        : space_(space), tool_(tool), stepdown_(stepdown), options_(options) {
        const double radius = 0.5 * tool.diameter;
        core_radius_ = std::max(0.0, radius - options.skin_width);
        flute_radius_ = std::max(0.0, radius - flute_rim);
        beside_ = radius - core_radius_ + cells_beside * space.stock.cell;
    }

    // Evenly spaced from the highest foam that is to go, to the lowest tip over such foam; of these, from above, the
    // ones at which there is anything to mill.
    std::vector<double> heights() {
        const HeightField core = dilate_by_disc(space_.stock, core_radius_);
        const HeightField whole = dilate_by_disc(space_.centre_stock, flute_radius_);
        const HeightField& cl = *space_.cl_limit;
        double top = -std::numeric_limits<double>::infinity();
        double bottom = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < core.height.size(); ++i) {
            const auto low = static_cast<double>(cl.height[i]);
            const bool is_high = static_cast<double>(whole.height[i]) > low + highest_skin();
            if (!is_high && !(static_cast<double>(core.height[i]) > low + min_above())) continue;
            const auto high = static_cast<double>(is_high ? std::max(core.height[i], whole.height[i]) : core.height[i]);
            deepest_ = std::max(deepest_, static_cast<double>(core.height[i]) - low);
            top = std::max(top, high);
            bottom = std::min(bottom, low);
        }
        if (!(top > bottom)) return {};
        const double count = std::ceil((top - bottom) / stepdown_ - 1e-6);
        const double down = (top - bottom) / count;
        // Cells that begin to have work at a level, less those that have none from there on.
        std::vector<std::ptrdiff_t> begins(static_cast<std::size_t>(count) + 2, 0);
        const auto level_of = [&](double height) {
            return static_cast<std::size_t>(std::clamp((top - height) / down, 1.0, count + 1));
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
        for (std::size_t k = 1; static_cast<double>(k) <= count; ++k) {
            cells += begins[k];
            if (cells > 0)
                heights.push_back(static_cast<double>(k) == count ? bottom : top - static_cast<double>(k) * down);
        }
        const auto at_once = static_cast<std::size_t>(std::max(1.0, std::floor(options_.deepest / down + 1e-6)));
        std::vector<double> ordered;
        for (std::size_t first = 0; first < heights.size(); first += at_once) {
            const std::size_t end = std::min(heights.size(), first + at_once);
            ordered.push_back(heights[end - 1]);
            for (std::size_t k = first; k + 1 < end; ++k) ordered.push_back(heights[k]);
        }
        return ordered;
    }

    // What heights() found: RoughingRuns::deepest.
    double deepest() const { return deepest_; }

    LevelRegion region(double level) const {
        LevelRegion region{space_.stock.cell, space_.stock.columns, space_.stock.rows, {}, {}};
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
};

}  // namespace

RoughingRuns rough(MillingSpace& space, const CuttingTool& tool, const ToolBody& body, const Operation& operation,
                   const RoughingOptions& options, const Context& context) {
    RoughingLevels levels(space, tool, operation.stepdown, options);
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
        // The float of the lowest tip is not above the level.
        if (space.holder_clearance_height.height.empty() || is_holder_limiting(highest, body, holder_gap, level)) {
            space.holder_clearance_height = holder_clearance_over(space.stock, body, holder_gap, level);
        }
        runs.add(roughing_passes(levels.region(level), level, operation.stepover));
    }
    RoughingRuns result{runs.finish(), 0, levels.deepest()};
    result.removed_mm3 = runs.removed_mm3();
    return result;
}

}  // namespace qchopper

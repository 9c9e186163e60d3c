// Levels are evenly spaced from the highest foam that is to go to the lowest tip. A level's region is where the tip may
// be at that height (ISO 14649-11, "plane milling strategy" contour-parallel and bidirectional), and of it what lies
// near foam above the level. O(levels * cells * widest radius / cell).

#include "cam/toolpath/roughing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cam/toolpath/disc_max.h"
#include "cam/toolpath/roughing_passes.h"

namespace qchopper {
namespace {

constexpr double least_foam = 0.2;    // mm above a level that is worth a cut
constexpr double cells_beside = 2.5;  // by which a pass goes on beyond the foam, so that it begins beside it

constexpr HolderGap holder_gap{1, 4};  // roughing passes farther beside its way than finishing, and asks at each level

struct LevelSpan {
    double top = 0;
    double bottom = 0;
    bool is_empty() const { return !(top > bottom); }
};

class RoughingLevels {
 public:
    RoughingLevels(CarvingSpace& space, const CarvingTool& tool, double step_down, const RoughingOptions& options)
        : space_(space), tool_(tool), step_down_(step_down), options_(options) {
        const double radius = 0.5 * tool.diameter;
        core_radius_ = std::max(0.0, radius - options.skin_width);
        flute_radius_ = std::max(0.0, radius - flute_rim);
        beside_ = radius - core_radius_ + cells_beside * space.foam.cell;
    }

    // From the highest foam that is to go, to the lowest tip over such foam.
    LevelSpan heights() const {
        const HeightMap core = disc_max(space_.foam, core_radius_);
        const HeightMap whole = disc_max(space_.middle_foam, flute_radius_);
        const HeightMap& tip = *space_.tip_limit;
        LevelSpan found{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        for (std::size_t i = 0; i < core.height.size(); ++i) {
            const auto low = static_cast<double>(tip.height[i]);
            const bool is_high = static_cast<double>(whole.height[i]) > low + highest_skin();
            const auto high = static_cast<double>(is_high ? std::max(core.height[i], whole.height[i]) : core.height[i]);
            if (!is_high && !(high > low + least_above())) continue;
            found.top = std::max(found.top, high);
            found.bottom = std::min(found.bottom, low);
        }
        return found;
    }

    LevelRegion region(double level) const {
        LevelRegion region{space_.foam.cell, space_.foam.columns, space_.foam.rows, {}, {}};
        const HeightMap whole = disc_max(space_.middle_foam, flute_radius_);
        HeightMap core = disc_max(space_.foam, core_radius_);
        region.is_allowed.resize(whole.height.size());
        const auto height = static_cast<float>(level);
        const auto flute_top = static_cast<float>(level + tool_.flute_length);
        const auto skin_top = static_cast<float>(level + highest_skin());
        const auto foam_top = static_cast<float>(level + least_above());
        for (std::size_t i = 0; i < whole.height.size(); ++i) {
            const bool is_allowed = space_.tip_limit->height[i] <= height && space_.holder_limit.height[i] <= height &&
                                    whole.height[i] <= flute_top;
            region.is_allowed[i] = is_allowed ? 1 : 0;
            const bool has_work = core.height[i] > foam_top || whole.height[i] > skin_top;
            core.height[i] = is_allowed && has_work ? 1.0F : 0.0F;
        }
        const HeightMap near = disc_max(core, beside_);
        region.is_wanted.resize(near.height.size());
        for (std::size_t i = 0; i < near.height.size(); ++i) region.is_wanted[i] = near.height[i] > 0.5F ? 1 : 0;
        return region;
    }

 private:
    // A higher skin is not left to finishing: at the next level but one it would be higher than the flute.
    double highest_skin() const { return std::max(0.5 * tool_.flute_length, tool_.flute_length - 2 * step_down_); }
    double least_above() const { return std::max(least_foam, options_.skin_height); }

    const CarvingSpace& space_;
    const CarvingTool& tool_;
    double step_down_;
    RoughingOptions options_;
    double core_radius_ = 0;   // foam within it is to go
    double flute_radius_ = 0;  // foam within it is cut by the flute
    double beside_ = 0;
};

}  // namespace

std::vector<PathRun> rough(CarvingSpace& space, const CarvingTool& tool, const ToolBody& body,
                           const Operation& operation, const RoughingOptions& options, const Context& context) {
    const RoughingLevels levels(space, tool, operation.step_down, options);
    const LevelSpan heights = levels.heights();
    if (heights.is_empty()) return {};
    const auto count = static_cast<std::size_t>(std::ceil((heights.top - heights.bottom) / operation.step_down - 1e-6));
    const double down = (heights.top - heights.bottom) / static_cast<double>(count);
    LinkOptions links;
    links.has_ramps = true;
    links.slack = 0.36 * operation.rounding;  // at a right angle the parabola passes 0.354 of it beside the corner
    RunBuilder runs(space, tool, operation, links);
    for (std::size_t k = 1; k <= count; ++k) {
        context.check_cancelled();
        const double level = k == count ? heights.bottom : heights.top - static_cast<double>(k) * down;
        // The float of the lowest tip is not above the level.
        space.holder_limit = holder_limit_over(space.foam, body, holder_gap);
        runs.add(roughing_passes(levels.region(level), level, operation.step));
    }
    return runs.finish();
}

}  // namespace qchopper

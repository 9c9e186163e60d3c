// The surface of the target (target_surface.h), then cutter_morphology.h; points that no tool has come to yet are asked
// of the next closing, which is computed about them alone: of a ball only about those that a finer ball comes to but
// for its holder. O(cells * (radius / cell)^2) at most a closing.

#include "sim/replay/reach/reachable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "cam/cell/machine_bodies.h"
#include "sim/replay/reach/cutter_morphology.h"
#include "sim/replay/reach/target_surface.h"
#include "sim/replay/stock/cutter.h"

namespace qchopper {
namespace {

constexpr double holder_cell = 2;

// The cells about the target that its closing needs: tips stand up to the radius beside it, on surface as far again.
std::int32_t margin_of(const CuttingTool& tool, double cell) {
    return static_cast<std::int32_t>(std::ceil(tool.diameter / cell)) + 2;
}

// A flat disc above the tip, where holder, spindle or wrist begin.
struct BodyDisc {
    double radius = 0;
    double above = 0;
};

std::vector<BodyDisc> discs_of(const CuttingTool& tool, const CellMachine& machine) {
    std::vector<BodyDisc> discs;
    for (const AxisBody& body : bodies_over_tip(tool, machine)) {
        if (body.part != BodyPart::tool) discs.push_back({body.shape.radius, -body.shape.from.z});
    }
    return discs;
}

// Whether the edges of a tool touch nothing that those of a finer one do not: a ball rolls about in a larger ball, and
// a flat end slides about in a wider one. A flat end does not come to the ends of a bull or cone, nor these to each
// other's.
bool is_held_by(const CuttingTool& finer, const CuttingTool& tool) {
    return finer.shape == tool.shape && (tool.shape == ToolShape::ball || tool.shape == ToolShape::flat);
}

// Whether holder and spindle of a tool hold those of a finer one wherever the finer one touches what the tool touches:
// is_held_by() it, the finer one stands up to the difference of their radii beside the tool, and no lower.
bool holds_all_of(const CuttingTool& tool, const CuttingTool& finer, const CellMachine& machine) {
    const double beside = 0.5 * (tool.diameter - finer.diameter);
    const std::vector<BodyDisc> own = discs_of(tool, machine);
    const std::vector<BodyDisc> discs = discs_of(finer, machine);
    return std::all_of(discs.begin(), discs.end(), [&](const BodyDisc& disc) {
        return std::any_of(own.begin(), own.end(), [&](const BodyDisc& wide) {
            return wide.radius >= disc.radius + beside && wide.above <= disc.above;
        });
    });
}

// Surfaces of the target in coarse cells, dilated by discs of holders and spindles: each is made once. Not for several
// threads at once.
class HolderMaps {
 public:
    explicit HolderMaps(const ReplayScene& scene) : scene_(scene) {}
    const ReplayScene& scene() const { return scene_; }
    // The highest point of the target along the orientation.
    float top(std::size_t orientation) {
        const auto [found, is_new] = tops_.try_emplace(orientation);
        if (is_new) {
            const SurfaceMap map = target_surface(scene_, orientation, holder_cell, 0);
            found->second = *std::max_element(map.height.begin(), map.height.end());
        }
        return found->second;
    }
    const SurfaceMap& of(std::size_t orientation, double radius) {
        const auto [found, is_new] = known_.try_emplace({orientation, radius});
        if (is_new) {
            SurfaceMap& map = found->second;
            const auto around = static_cast<std::int32_t>(std::ceil(radius / holder_cell));
            map = target_surface(scene_, orientation, holder_cell, around);
            map.height = dilated(map, {ToolShape::flat, radius, 0, 0, 1}, CellBlocks::all_of(map));
        }
        return found->second;
    }

 private:
    const ReplayScene& scene_;
    std::map<std::size_t, float> tops_;
    std::map<std::pair<std::size_t, double>, SurfaceMap> known_;
};

// The ball-ended ones, the finest first; where there are none, all but drills.
void keep_finishing(std::vector<std::size_t>& tools, const std::vector<CuttingTool>& of_cell) {
    std::erase_if(tools, [&](std::size_t i) { return is_drill(of_cell[i]); });
    const auto is_ball = [&](std::size_t i) { return of_cell[i].shape == ToolShape::ball; };
    if (std::any_of(tools.begin(), tools.end(), is_ball)) std::erase_if(tools, std::not_fn(is_ball));
    std::stable_sort(tools.begin(), tools.end(),
                     [&](std::size_t a, std::size_t b) { return of_cell[a].diameter < of_cell[b].diameter; });
}

// Raises tips to where flat discs above them, holder and spindle, are clear of the surface. Tips that are no_surface
// are not asked for.
void clear_holder(HolderMaps& holders, std::size_t orientation, const CuttingTool& tool, double clearance,
                  SurfaceMap& tips) {
    std::vector<BodyDisc> discs = discs_of(tool, *holders.scene().cell->machine);
    for (BodyDisc& disc : discs) disc.radius += clearance, disc.above -= clearance;
    float lowest = -no_surface;  // before tips are raised
    for (const float tip : tips.height) {
        if (tip != no_surface) lowest = std::min(lowest, tip);
    }
    // Below all of the target, also where no tip is asked for: holders are wider than what is asked about.
    const double depth = holders.top(orientation) - lowest;
    std::vector<std::int32_t> columns(static_cast<std::size_t>(tips.columns));
    for (const auto& [radius, height] : discs) {
        if (depth < height) continue;
        const SurfaceMap& coarse = holders.of(orientation, radius);
        const auto cell_of = [&](double at, double min) {
            return static_cast<std::int32_t>(std::floor((at - min) / coarse.cell));
        };
        for (std::int32_t i = 0; i < tips.columns; ++i) {
            columns[static_cast<std::size_t>(i)] = cell_of(tips.x_min + (i + 0.5) * tips.cell, coarse.x_min);
        }
        for (std::int32_t j = 0; j < tips.rows; ++j) {
            const std::int32_t row = cell_of(tips.y_min + (j + 0.5) * tips.cell, coarse.y_min);
            if (row < 0 || row >= coarse.rows) continue;
            const float* const over = coarse.height.data() + static_cast<std::ptrdiff_t>(row) * coarse.columns;
            float* const own = tips.height.data() + static_cast<std::ptrdiff_t>(j) * tips.columns;
            for (std::int32_t i = 0; i < tips.columns; ++i) {
                const std::int32_t column = columns[static_cast<std::size_t>(i)];
                if (own[i] == no_surface || column < 0 || column >= coarse.columns) continue;
                const auto least = static_cast<float>(static_cast<double>(over[column]) - height);
                if (least > own[i]) own[i] = least, tips.is_limited = true;
            }
        }
    }
}

// The least heights of tips over a map of the target, about the cells asked for, without the holder.
std::vector<float> tips_about(const CellBlocks& asked, const CuttingTool& tool, const SurfaceMap& map) {
    const Cutter cutter = cutter_of(tool);
    return dilated(map, cutter, asked.grown(static_cast<std::int32_t>(std::ceil(cutter.radius / map.cell))));
}

// The closing of the target, of the cells asked for: of a map of its tips.
void close(HolderMaps& holders, std::size_t orientation, const CuttingTool& tool, double clearance,
           const CellBlocks& asked, SurfaceMap& map) {
    clear_holder(holders, orientation, tool, clearance, map);
    map.height = eroded(map, cutter_of(tool), asked);
}

// What is nearer to a point than `most` along both sides of the map.
CellRange cells_around(const SurfaceMap& map, Vec3 point, double most) {
    const auto cell_of = [&](double at, double min) {
        return static_cast<std::int32_t>(std::floor((at - min) / map.cell));
    };
    return {cell_of(point.x - most, map.x_min) - 1, cell_of(point.x + most, map.x_min) + 2,
            cell_of(point.y - most, map.y_min) - 1, cell_of(point.y + most, map.y_min) + 2};
}

CellBlocks blocks_about(const SurfaceMap& map, const std::vector<Vec3>& points, const std::vector<std::size_t>& asked,
                        double most) {
    CellBlocks blocks(map);
    for (const std::size_t i : asked) blocks.add(cells_around(map, apply_inverse(map.frame_in_setup, points[i]), most));
    return blocks;
}

// Which of the points lie as near to the closing of a map as `within`.
std::vector<std::uint8_t> near_closing(const SurfaceMap& map, const std::vector<Vec3>& points,
                                       const std::vector<std::size_t>& asked, double within) {
    std::vector<std::uint8_t> is_near(asked.size());
    parallel_for(0, asked.size(), [&](std::size_t k) {
        const Vec3 q = apply_inverse(map.frame_in_setup, points[asked[k]]);
        is_near[k] = map.distance_above(q, within + map.cell) <= within ? 1 : 0;
    });
    return is_near;
}

// Of points to which a ball does not come those to which a larger one may, from a map of the smaller one's tips
// without its holder. Where the larger ball removes the column of a cell, a smaller one inside of it that touches the
// same point does; moved to the next cells towards the larger one's axis it removes the same height of the same column
// or of one of its neighbours, so that it comes as near but for the diagonal of a cell. Points beside the map are kept
// (tests/sim/replay/given_up_test.cpp).
std::vector<std::size_t> kept_by_holder(SurfaceMap tips, const CuttingTool& tool, const std::vector<Vec3>& points,
                                        const std::vector<std::size_t>& asked, double within) {
    constexpr double rounding = 1e-3;  // mm, generous
    const double most = within + std::numbers::sqrt2 * tips.cell + rounding;
    const CellBlocks blocks = blocks_about(tips, points, asked, most + tips.cell);
    tips.height = eroded(tips, cutter_of(tool), blocks);
    const std::vector<std::uint8_t> is_near = near_closing(tips, points, asked, most);
    const auto is_on_map = [&](Vec3 point) {
        const Vec3 q = apply_inverse(tips.frame_in_setup, point);
        const CellRange cells = cells_around(tips, q, most + tips.cell);
        return cells.x_begin >= 0 && cells.y_begin >= 0 && cells.x_end <= tips.columns && cells.y_end <= tips.rows;
    };
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < asked.size(); ++k) {
        if (is_near[k] != 0 || !is_on_map(points[asked[k]])) kept.push_back(asked[k]);
    }
    return kept;
}

// Whether a tool reaches nothing that a finer one, whose closing is known to be limited by its holder or not, does not.
bool adds_nothing(const CuttingTool& tool, const CuttingTool& finer, bool is_finer_limited,
                  const CellMachine& machine) {
    return is_held_by(finer, tool) && (!is_finer_limited || holds_all_of(tool, finer, machine));
}

}  // namespace

SurfaceMap closing_of(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool,
                      const ClosingOptions& options, const Context& context) {
    context.check_cancelled();
    const auto around = static_cast<std::int32_t>(std::ceil(options.around / options.cell));
    SurfaceMap map = target_surface(scene, orientation, options.cell, std::max(around, margin_of(tool, options.cell)));
    const CellBlocks all = CellBlocks::all_of(map);
    map.height = tips_about(all, tool, map);
    HolderMaps holders(scene);
    close(holders, orientation, tool, options.holder_clearance, all, map);
    context.check_cancelled();
    return map;
}

std::vector<StockTool> used_tools(const ReplayScene& scene) {
    std::vector<StockTool> used;
    if (scene.before != nullptr) used = scene.before->tools;
    for (const SceneChunk& chunk : scene.chunks) {
        used.push_back({chunk.tool, static_cast<std::uint32_t>(chunk.orientation)});
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

std::size_t milling_orientations(const ReplayScene& scene) {
    return std::min(scene.drilling, scene.orientations.size());
}

std::vector<std::size_t> allowed_tools(const ReplayScene& scene) {
    const std::vector<CuttingTool>& tools = scene.cell->machine->tools;
    std::vector<std::size_t> allowed;
    for (std::size_t i = 0; i < tools.size(); ++i) {
        const bool is_named = std::find(scene.tools.begin(), scene.tools.end(), tools[i].number) != scene.tools.end();
        if (scene.tools.empty() || is_named) allowed.push_back(i);
    }
    return allowed;
}

std::vector<std::size_t> tools_along(const ReplayScene& scene, std::size_t orientation) {
    const std::vector<CuttingTool>& tools = scene.cell->machine->tools;
    std::vector<std::size_t> along;
    for (const StockTool& used : used_tools(scene)) {
        if (used.orientation != orientation) continue;
        for (std::size_t i = 0; i < tools.size(); ++i) {
            if (tools[i].number == used.tool) along.push_back(i);
        }
    }
    return along;
}

std::vector<const Closing*> Closings::along(std::size_t orientation, std::vector<std::size_t> tools,
                                            const Context& context) {
    const CellMachine& machine = *scene_.cell->machine;
    keep_finishing(tools, machine.tools);
    std::vector<const Closing*> closings;
    for (const std::size_t tool : tools) {
        const bool is_needless = std::any_of(closings.begin(), closings.end(), [&](const Closing* finer) {
            return adds_nothing(machine.tools[tool], machine.tools[finer->tool], finer->map.is_limited, machine);
        });
        if (!is_needless) closings.push_back(&of(orientation, tool, context));
    }
    return closings;
}

std::vector<std::optional<ReachingTool>> first_reach(const ReplayScene& scene, const std::vector<Vec3>& points,
                                                     const ToolsOf& tools_of, double cell, double within,
                                                     const Context& context) {
    const CellMachine& machine = *scene.cell->machine;
    const double most = within + cell;  // beyond `within` the distance does not count
    HolderMaps holders(scene);
    std::vector<std::optional<ReachingTool>> reach(points.size());
    std::vector<std::size_t> left(points.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    const std::size_t directions = milling_orientations(scene);
    for (std::size_t d = 0; d < directions; ++d) {
        context.progress("orientations closed", d, directions);
        std::vector<std::size_t> tools = tools_of(d);
        keep_finishing(tools, machine.tools);
        std::vector<std::pair<std::size_t, bool>> closed;  // tools, and whether their holders limit them
        std::int32_t widest = 0;
        for (const std::size_t tool : tools) widest = std::max(widest, margin_of(machine.tools[tool], cell));
        std::optional<SurfaceMap> target;
        std::optional<std::vector<std::size_t>> kept;  // of those left what coarser tools may come to
        for (const std::size_t tool : tools) {
            const CuttingTool& own = machine.tools[tool];
            const bool is_needless = std::any_of(closed.begin(), closed.end(), [&](const auto& finer) {
                return adds_nothing(own, machine.tools[finer.first], finer.second, machine);
            });
            const std::vector<std::size_t> asked = kept ? *kept : left;
            if (is_needless || asked.empty()) continue;
            context.check_cancelled();
            if (!target) target = target_surface(scene, d, cell, widest);
            SurfaceMap map = narrowed(*target, widest - margin_of(own, cell));
            const CellBlocks blocks = blocks_about(map, points, asked, most);
            map.height = tips_about(blocks, own, map);
            std::optional<SurfaceMap> tips;
            if (!kept && own.shape == ToolShape::ball && tool != tools.back()) tips = map;
            close(holders, d, own, 0, blocks, map);
            closed.emplace_back(tool, map.is_limited);
            const std::vector<std::uint8_t> is_near = near_closing(map, points, asked, within);
            for (std::size_t k = 0; k < asked.size(); ++k) {
                if (is_near[k] != 0) reach[asked[k]] = ReachingTool{tool, d};
            }
            const auto is_reached = [&](std::size_t i) { return reach[i].has_value(); };
            std::erase_if(left, is_reached);
            if (kept) std::erase_if(*kept, is_reached);
            if (tips && map.is_limited) kept = kept_by_holder(std::move(*tips), own, points, left, within);
        }
    }
    return reach;
}

const Closing& Closings::of(std::size_t orientation, std::size_t tool, const Context& context) {
    const auto [found, is_new] = known_.try_emplace({orientation, tool});
    if (is_new) {
        const CuttingTool& own = scene_.cell->machine->tools[tool];
        found->second = {tool, orientation, closing_of(scene_, orientation, own, options_, context)};
    }
    return found->second;
}

}  // namespace qchopper

// Heights of triangles at the centres of cells by barycentric coordinates, then cutter_morphology.h; points that no
// tool has come to yet are asked of the next closing, which is computed about them alone. O(cells * (radius / cell)^2)
// at most a closing.

#include "sim/replay/reach/reachable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "base/parallel.h"
#include "cam/cell/machine_bodies.h"
#include "sim/replay/reach/cutter_morphology.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr double holder_cell = 2;

void raise(SurfaceMap& map, Vec3 p) {
    const auto i = static_cast<std::int32_t>(std::floor((p.x - map.x_min) / map.cell));
    const auto j = static_cast<std::int32_t>(std::floor((p.y - map.y_min) / map.cell));
    if (i < 0 || j < 0 || i >= map.columns || j >= map.rows) return;
    float& height = map.height[static_cast<std::size_t>(j) * map.columns + i];
    height = std::max(height, static_cast<float>(p.z));
}

void rasterise(SurfaceMap& map, const std::array<Vec3, 3>& t) {
    const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    if (std::abs(area) < 1e-12) return;
    const auto cell_of = [&](double at, double min) { return (at - min) / map.cell - 0.5; };
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto i_first = std::max(0, static_cast<std::int32_t>(std::ceil(cell_of(x0, map.x_min))));
    const auto i_last = std::min(map.columns - 1, static_cast<std::int32_t>(std::floor(cell_of(x1, map.x_min))));
    const auto j_first = std::max(0, static_cast<std::int32_t>(std::ceil(cell_of(y0, map.y_min))));
    const auto j_last = std::min(map.rows - 1, static_cast<std::int32_t>(std::floor(cell_of(y1, map.y_min))));
    for (std::int32_t j = j_first; j <= j_last; ++j) {
        const double y = map.y_min + (j + 0.5) * map.cell;
        for (std::int32_t i = i_first; i <= i_last; ++i) {
            const double x = map.x_min + (i + 0.5) * map.cell;
            const double b = ((x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y)) / area;
            const double c = ((t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y)) / area;
            if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
            const double z = t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z);
            float& height = map.height[static_cast<std::size_t>(j) * map.columns + i];
            height = std::max(height, static_cast<float>(z));
        }
    }
}

// Raises the map to the horizontal plane at a height of the setup.
void raise_to_floor(SurfaceMap& map, double floor_z) {
    const Vec3 up = map.frame_in_setup.row[2];
    if (up.z < 1e-9) return;  // seen from its edge
    const double height = floor_z - map.frame_in_setup.shift.z;
    for (std::int32_t j = 0; j < map.rows; ++j) {
        const double y = map.y_min + (j + 0.5) * map.cell;
        for (std::int32_t i = 0; i < map.columns; ++i) {
            const double x = map.x_min + (i + 0.5) * map.cell;
            float& own = map.height[static_cast<std::size_t>(j) * map.columns + i];
            own = std::max(own, static_cast<float>((height - up.x * x - up.y * y) / up.z));
        }
    }
}

// The map of the target and of the floor below it, `around` cells wider than the target on each side.
SurfaceMap target_surface(const ReplayScene& scene, std::size_t orientation, double cell, std::int32_t around) {
    SurfaceMap map{tool_axis_frame(scene.orientations[orientation].tool_axis), 0, 0, cell, 0, 0, {}, false};
    std::vector<Vec3> points = scene.target->points;
    for (Vec3& p : points) p = apply_inverse(map.frame_in_setup, p);
    Box box{points.front(), points.front()};
    for (const Vec3 p : points) extend(box, p);
    map.x_min = (std::floor(box.min.x / cell) - around - 1) * cell;
    map.y_min = (std::floor(box.min.y / cell) - around - 1) * cell;
    map.columns = static_cast<std::int32_t>(std::ceil((box.max.x - map.x_min) / cell)) + around + 1;
    map.rows = static_cast<std::int32_t>(std::ceil((box.max.y - map.y_min) / cell)) + around + 1;
    map.height.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), no_surface);
    for (const Triangle& t : scene.target->triangles) rasterise(map, {points[t[0]], points[t[1]], points[t[2]]});
    for (const Vec3 p : points) raise(map, p);
    raise_to_floor(map, scene.floor_z());
    return map;
}

// Without so many cells on each side.
SurfaceMap narrowed(const SurfaceMap& wide, std::int32_t by) {
    SurfaceMap map{wide.frame_in_setup,
                   wide.x_min + by * wide.cell,
                   wide.y_min + by * wide.cell,
                   wide.cell,
                   wide.columns - 2 * by,
                   wide.rows - 2 * by,
                   {},
                   false};
    map.height.reserve(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    for (std::int32_t j = 0; j < map.rows; ++j) {
        const auto row = wide.height.begin() + static_cast<std::ptrdiff_t>(j + by) * wide.columns + by;
        map.height.insert(map.height.end(), row, row + map.columns);
    }
    return map;
}

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
void clear_holder(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool, SurfaceMap& tips) {
    const std::vector<BodyDisc> discs = discs_of(tool, *scene.cell->machine);
    float lowest = -no_surface;
    float highest = no_surface;
    for (const float tip : tips.height) {
        if (tip == no_surface) continue;
        lowest = std::min(lowest, tip);
        highest = std::max(highest, tip);
    }
    const double depth = highest - lowest;  // before tips are raised
    for (const auto& [radius, height] : discs) {
        if (depth < height) continue;
        SurfaceMap coarse =
            target_surface(scene, orientation, holder_cell, static_cast<std::int32_t>(std::ceil(radius / holder_cell)));
        coarse.height = dilated(coarse, {ToolShape::flat, radius, 0, 0, 1}, CellBlocks::all_of(coarse));
        for (std::int32_t j = 0; j < tips.rows; ++j) {
            for (std::int32_t i = 0; i < tips.columns; ++i) {
                float& tip = tips.height[static_cast<std::size_t>(j) * tips.columns + i];
                if (tip == no_surface) continue;
                const double x = tips.x_min + (i + 0.5) * tips.cell;
                const double y = tips.y_min + (j + 0.5) * tips.cell;
                const auto least = static_cast<float>(coarse.at(x, y) - height);
                if (least > tip) tip = least, tips.is_limited = true;
            }
        }
    }
}

// The closing of a map of the target, of the cells asked for.
void close(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool, const CellBlocks& asked,
           SurfaceMap& map) {
    const Cutter cutter = cutter_of(tool);
    map.height = dilated(map, cutter, asked.grown(static_cast<std::int32_t>(std::ceil(cutter.radius / map.cell))));
    clear_holder(scene, orientation, tool, map);
    map.height = eroded(map, cutter, asked);
}

// What is nearer to a point than `most` along both sides of the map.
CellRange cells_around(const SurfaceMap& map, Vec3 point, double most) {
    const auto cell_of = [&](double at, double min) {
        return static_cast<std::int32_t>(std::floor((at - min) / map.cell));
    };
    return {cell_of(point.x - most, map.x_min) - 1, cell_of(point.x + most, map.x_min) + 2,
            cell_of(point.y - most, map.y_min) - 1, cell_of(point.y + most, map.y_min) + 2};
}

// Whether a tool reaches nothing that a finer one, whose closing is known to be limited by its holder or not, does not.
bool adds_nothing(const CuttingTool& tool, const CuttingTool& finer, bool is_finer_limited,
                  const CellMachine& machine) {
    return is_held_by(finer, tool) && (!is_finer_limited || holds_all_of(tool, finer, machine));
}

}  // namespace

SurfaceMap closing_of(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool, double cell,
                      const Context& context) {
    context.check_cancelled();
    SurfaceMap map = target_surface(scene, orientation, cell, margin_of(tool, cell));
    close(scene, orientation, tool, CellBlocks::all_of(map), map);
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
        for (const std::size_t tool : tools) {
            const bool is_needless = std::any_of(closed.begin(), closed.end(), [&](const auto& finer) {
                return adds_nothing(machine.tools[tool], machine.tools[finer.first], finer.second, machine);
            });
            if (is_needless || left.empty()) continue;
            context.check_cancelled();
            if (!target) target = target_surface(scene, d, cell, widest);
            SurfaceMap map = narrowed(*target, widest - margin_of(machine.tools[tool], cell));
            CellBlocks asked(map);
            for (const std::size_t i : left) {
                asked.add(cells_around(map, apply_inverse(map.frame_in_setup, points[i]), most));
            }
            close(scene, d, machine.tools[tool], asked, map);
            closed.emplace_back(tool, map.is_limited);
            parallel_for(0, left.size(), [&](std::size_t k) {
                const Vec3 q = apply_inverse(map.frame_in_setup, points[left[k]]);
                if (map.distance_above(q, most) <= within) reach[left[k]] = ReachingTool{tool, d};
            });
            std::erase_if(left, [&](std::size_t i) { return reach[i].has_value(); });
        }
    }
    return reach;
}

const Closing& Closings::of(std::size_t orientation, std::size_t tool, const Context& context) {
    const auto [found, is_new] = known_.try_emplace({orientation, tool});
    if (is_new) {
        const CuttingTool& own = scene_.cell->machine->tools[tool];
        found->second = {tool, orientation, closing_of(scene_, orientation, own, cell_, context)};
    }
    return found->second;
}

}  // namespace qchopper

// Heights of triangles at the centres of cells by barycentric coordinates; grey dilation and erosion (J. Serra: Image
// Analysis and Mathematical Morphology, 1982) tap by tap, whole rows at a time. O(cells * (radius / cell)^2).

#include "sim/replay/reachable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/parallel.h"
#include "cam/cell/machine_bodies.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/dexel_map.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr float nothing = -1e30F;
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

// The map of the target and of the floor below it, `around` wider than the target.
SurfaceMap target_surface(const ReplayScene& scene, std::size_t orientation, double cell, double around) {
    SurfaceMap map{tool_axis_frame(scene.orientations[orientation].tool_axis), 0, 0, cell, 0, 0, {}, false};
    std::vector<Vec3> points = scene.target->points;
    for (Vec3& p : points) p = apply_inverse(map.frame_in_setup, p);
    Box box{points.front(), points.front()};
    for (const Vec3 p : points) extend(box, p);
    map.x_min = (std::floor((box.min.x - around) / cell) - 1) * cell;
    map.y_min = (std::floor((box.min.y - around) / cell) - 1) * cell;
    map.columns = static_cast<std::int32_t>(std::ceil((box.max.x + around - map.x_min) / cell)) + 1;
    map.rows = static_cast<std::int32_t>(std::ceil((box.max.y + around - map.y_min) / cell)) + 1;
    map.height.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), nothing);
    for (const Triangle& t : scene.target->triangles) rasterise(map, {points[t[0]], points[t[1]], points[t[2]]});
    for (const Vec3 p : points) raise(map, p);
    constexpr double wide = 1e5;
    std::array<Vec3, 4> floor{Vec3{-wide, -wide, 0}, Vec3{wide, -wide, 0}, Vec3{wide, wide, 0}, Vec3{-wide, wide, 0}};
    for (Vec3& p : floor) p = apply_inverse(map.frame_in_setup, p + Vec3{0, 0, scene.floor_z()});
    rasterise(map, {floor[0], floor[1], floor[2]});
    rasterise(map, {floor[0], floor[2], floor[3]});
    return map;
}

// A point of the tool's underside: cells aside, and height above the tip.
struct Tap {
    std::int32_t dx = 0;
    std::int32_t dy = 0;
    float height = 0;
};

std::vector<Tap> taps_of(const Cutter& cutter, double cell) {
    std::vector<Tap> taps;
    const auto most = static_cast<std::int32_t>(std::floor(cutter.radius / cell));
    for (std::int32_t dy = -most; dy <= most; ++dy) {
        for (std::int32_t dx = -most; dx <= most; ++dx) {
            const double r = cell * std::sqrt(static_cast<double>(dx) * dx + static_cast<double>(dy) * dy);
            if (r <= cutter.radius) taps.push_back({dx, dy, static_cast<float>(profile_height(cutter, r))});
        }
    }
    return taps;
}

struct Dilation {
    static constexpr float none = nothing;
    static float joined(float best, float height, float tap) { return std::max(best, height - tap); }
};

struct Erosion {
    static constexpr float none = -nothing;
    static float joined(float best, float height, float tap) { return std::min(best, height + tap); }
};

// For each cell of a map what joins the heights about it with the taps. The inner loop is one that compilers vectorise.
template <class Morphology>
std::vector<float> morph(const SurfaceMap& map, const std::vector<Tap>& taps) {
    std::vector<float> result(map.height.size(), Morphology::none);
    parallel_for(0, static_cast<std::size_t>(map.rows), [&](std::size_t row) {
        const auto j = static_cast<std::int32_t>(row);
        for (const Tap& tap : taps) {
            if (j + tap.dy < 0 || j + tap.dy >= map.rows) continue;
            const std::int32_t begin = std::max(0, -tap.dx);
            const std::int32_t end = std::min(map.columns, map.columns - tap.dx);
            float* to = result.data() + row * static_cast<std::size_t>(map.columns);
            const float* from = map.height.data() + static_cast<std::ptrdiff_t>(j + tap.dy) * map.columns + tap.dx;
            const float height = tap.height;
            for (std::int32_t i = begin; i < end; ++i) to[i] = Morphology::joined(to[i], from[i], height);
        }
    });
    return result;
}

// A flat disc above the tip, where holder or spindle begin.
struct BodyDisc {
    double radius = 0;
    double above = 0;
};

std::vector<BodyDisc> discs_of(const CuttingTool& tool, const Spindle& spindle) {
    std::vector<BodyDisc> discs;
    for (const AxisBody& body : bodies_on_axis(tool, spindle)) {
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
bool holds_all_of(const CuttingTool& tool, const CuttingTool& finer, const Spindle& spindle) {
    const double beside = 0.5 * (tool.diameter - finer.diameter);
    const std::vector<BodyDisc> own = discs_of(tool, spindle);
    const std::vector<BodyDisc> discs = discs_of(finer, spindle);
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

// Raises tips to where flat discs above them, holder and spindle, are clear of the surface.
void clear_holder(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool, SurfaceMap& tips) {
    const std::vector<BodyDisc> discs = discs_of(tool, scene.cell->machine->spindle);
    const auto [lowest, highest] = std::minmax_element(tips.height.begin(), tips.height.end());
    const double depth = *highest - *lowest;  // before tips are raised
    for (const auto& [radius, height] : discs) {
        if (depth < height) continue;
        SurfaceMap coarse = target_surface(scene, orientation, holder_cell, radius);
        coarse.height = morph<Dilation>(coarse, taps_of({ToolShape::flat, radius, 0, 0, 1}, holder_cell));
        for (std::int32_t j = 0; j < tips.rows; ++j) {
            for (std::int32_t i = 0; i < tips.columns; ++i) {
                float& tip = tips.height[static_cast<std::size_t>(j) * tips.columns + i];
                const double x = tips.x_min + (i + 0.5) * tips.cell;
                const double y = tips.y_min + (j + 0.5) * tips.cell;
                const auto least = static_cast<float>(coarse.at(x, y) - height);
                if (least > tip) tip = least, tips.is_limited = true;
            }
        }
    }
}

}  // namespace

double SurfaceMap::at(double x, double y) const {
    const auto i = static_cast<std::int32_t>(std::floor((x - x_min) / cell));
    const auto j = static_cast<std::int32_t>(std::floor((y - y_min) / cell));
    if (i < 0 || j < 0 || i >= columns || j >= rows) return nothing;
    return height[static_cast<std::size_t>(j) * columns + i];
}

double SurfaceMap::distance_above(Vec3 point, double most) const {
    return distance_to_cells(point, x_min, y_min, cell, most, [&](std::int32_t i, std::int32_t j) {
        if (i < 0 || j < 0 || i >= columns || j >= rows) return std::numeric_limits<float>::infinity();
        return height[static_cast<std::size_t>(j) * columns + i];
    });
}

SurfaceMap closing_of(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool, double cell,
                      const Context& context) {
    context.check_cancelled();
    const Cutter cutter = cutter_of(tool);
    SurfaceMap map = target_surface(scene, orientation, cell, 2 * cutter.radius + 2 * cell);
    const std::vector<Tap> taps = taps_of(cutter, cell);
    map.height = morph<Dilation>(map, taps);
    context.check_cancelled();
    clear_holder(scene, orientation, tool, map);
    map.height = morph<Erosion>(map, taps);
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
        const bool adds_nothing = std::any_of(closings.begin(), closings.end(), [&](const Closing* finer) {
            const CuttingTool& other = machine.tools[finer->tool];
            return is_held_by(other, machine.tools[tool]) &&
                   (!finer->map.is_limited || holds_all_of(machine.tools[tool], other, machine.spindle));
        });
        if (!adds_nothing) closings.push_back(&of(orientation, tool, context));
    }
    return closings;
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

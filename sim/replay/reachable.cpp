// Heights of triangles at the centres of cells by barycentric coordinates; grey dilation and erosion (J. Serra: Image
// Analysis and Mathematical Morphology, 1982) in stretches of a row, by taps that can change them. O(cells * (radius /
// cell)^2) at most, a fifth of it on smooth surfaces.

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

// Points of the underside of a tool: a few beside each other in a row of cells.
struct Taps {
    std::int32_t dx = 0;  // of the first, in cells from the axis
    std::int32_t dy = 0;
    std::vector<float> height;  // above the tip
    float lowest = 0;           // of them
};

constexpr std::int32_t columns_at_once = 64;
constexpr std::int32_t taps_at_once = 16;

// The lowest first: they decide most cells.
std::vector<Taps> taps_of(const Cutter& cutter, double cell) {
    std::vector<Taps> taps;
    const auto most = static_cast<std::int32_t>(std::floor(cutter.radius / cell));
    for (std::int32_t dy = -most; dy <= most; ++dy) {
        for (std::int32_t dx = -most; dx <= most; ++dx) {
            const double r = cell * std::sqrt(static_cast<double>(dx) * dx + static_cast<double>(dy) * dy);
            if (r > cutter.radius) continue;
            const auto height = static_cast<float>(profile_height(cutter, r));
            const bool goes_on = !taps.empty() && taps.back().dy == dy && taps.back().height.size() < taps_at_once;
            if (!goes_on) taps.push_back({dx, dy, {}, height});
            taps.back().height.push_back(height);
            taps.back().lowest = std::min(taps.back().lowest, height);
        }
    }
    std::stable_sort(taps.begin(), taps.end(), [](const Taps& a, const Taps& b) { return a.lowest < b.lowest; });
    return taps;
}

struct Dilation {
    static constexpr float none = nothing;
    static float first(float a, float b) { return std::max(a, b); }
    static float last(float a, float b) { return std::min(a, b); }
    static float shifted(float height, float tap) { return height - tap; }
};

struct Erosion {
    static constexpr float none = -nothing;
    static float first(float a, float b) { return std::min(a, b); }
    static float last(float a, float b) { return std::max(a, b); }
    static float shifted(float height, float tap) { return height + tap; }
};

// For each cell of a map the first, by the order of `Morphology`, of the shifted heights about it. Taps are passed over
// where the first of all heights under them, shifted least, is behind what all cells of the stretch have.
template <class Morphology>
class Morph {
 public:
    Morph(const SurfaceMap& map, const std::vector<Taps>& taps)
        : map_(map), taps_(taps), blocks_((map.columns + taps_at_once - 1) / taps_at_once) {
        first_.assign(static_cast<std::size_t>(blocks_) * map.rows, Morphology::none);
        for (std::int32_t j = 0; j < map.rows; ++j) {
            for (std::int32_t i = 0; i < map.columns; ++i) {
                float& own = first_[static_cast<std::size_t>(j) * blocks_ + i / taps_at_once];
                own = Morphology::first(own, row(j)[i]);
            }
        }
    }

    std::vector<float> result() const {
        std::vector<float> result(map_.height.size());
        parallel_for(0, static_cast<std::size_t>(map_.rows), [&](std::size_t j) {
            for (std::int32_t c = 0; c < map_.columns; c += columns_at_once) {
                const std::int32_t count = std::min(columns_at_once, map_.columns - c);
                const Stretch found = stretch(static_cast<std::int32_t>(j), c, count);
                std::copy_n(found.begin(), count, result.begin() + static_cast<std::ptrdiff_t>(j) * map_.columns + c);
            }
        });
        return result;
    }

 private:
    using Stretch = std::array<float, columns_at_once>;

    const float* row(std::int32_t j) const {
        return map_.height.data() + static_cast<std::ptrdiff_t>(j) * map_.columns;
    }

    Stretch stretch(std::int32_t j, std::int32_t column, std::int32_t count) const {
        Stretch own;
        own.fill(-Morphology::none);  // beyond the map nothing is behind it
        std::fill_n(own.begin(), count, Morphology::none);
        float last = Morphology::none;
        for (const Taps& taps : taps_) {
            const std::int32_t from = j + taps.dy;
            if (from < 0 || from >= map_.rows) continue;
            const float reached =
                Morphology::shifted(first_in(from, column + taps.dx,
                                             column + taps.dx + count + static_cast<std::int32_t>(taps.height.size())),
                                    taps.lowest);
            if (Morphology::last(reached, last) == reached) continue;
            for (std::size_t k = 0; k < taps.height.size(); ++k) {
                const std::int32_t begin = column + taps.dx + static_cast<std::int32_t>(k);
                join(own, row(from), begin, count, taps.height[k]);
            }
            last = last_of(own);
        }
        return own;
    }

    // In lanes, which compilers turn into vectors.
    static float last_of(const Stretch& own) {
        std::array<float, 8> lanes{};
        std::copy_n(own.begin(), lanes.size(), lanes.begin());
        for (std::size_t i = lanes.size(); i < own.size(); i += lanes.size()) {
            for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = Morphology::last(lanes[k], own[i + k]);
        }
        float last = lanes[0];
        for (const float lane : lanes) last = Morphology::last(last, lane);
        return last;
    }

    // Cells outside of the map are not asked.
    void join(Stretch& own, const float* heights, std::int32_t begin, std::int32_t count, float tap) const {
        const std::int32_t first = std::max(0, -begin);
        const std::int32_t end = std::min(count, map_.columns - begin);
        if (first == 0 && end == columns_at_once) {
            const float* from = heights + begin;
            for (std::size_t i = 0; i < columns_at_once; ++i) {
                own[i] = Morphology::first(own[i], Morphology::shifted(from[i], tap));
            }
            return;
        }
        for (std::int32_t i = first; i < end; ++i) {
            float& cell = own[static_cast<std::size_t>(i)];
            cell = Morphology::first(cell, Morphology::shifted(heights[begin + i], tap));
        }
    }

    // Of the columns from `begin` to before `end`, at least.
    float first_in(std::int32_t j, std::int32_t begin, std::int32_t end) const {
        float first = Morphology::none;
        const std::int32_t last_block = std::min(blocks_, (end + taps_at_once - 1) / taps_at_once);
        for (std::int32_t b = std::max(0, begin) / taps_at_once; b < last_block; ++b) {
            first = Morphology::first(first, first_[static_cast<std::size_t>(j) * blocks_ + b]);
        }
        return first;
    }

    const SurfaceMap& map_;
    const std::vector<Taps>& taps_;
    std::int32_t blocks_;       // of columns
    std::vector<float> first_;  // of the heights of a block, row by row
};

template <class Morphology>
std::vector<float> morph(const SurfaceMap& map, const std::vector<Taps>& taps) {
    return Morph<Morphology>(map, taps).result();
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
    const std::vector<Taps> taps = taps_of(cutter, cell);
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

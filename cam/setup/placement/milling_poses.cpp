// The map of each direction is divided into squares of the step; the lowest tip of a square stands for it, and squares
// beside each other are connected. Extremes are taken over all cells. O(cells x directions of extremes).

#include "cam/setup/placement/milling_poses.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "cam/setup/limiting_tools.h"
#include "cam/setup/placement/foam_left.h"
#include "segment/raster/disc_dilation.h"
#include "segment/raster/height_field.h"

namespace qchopper {
namespace {

constexpr double upright = 0.999;    // cosine; a direction this steep mills down to the base all around
constexpr double faced = 0.17;       // sine of 10 degrees; a side that is nearly parallel to the tool is not begun from
constexpr double highest_tip = 1e6;  // mm; what the holder allows nowhere is higher
constexpr double near_flush_face = 0.2;  // mm; caps and the sizes of sawn blocks are to tenths
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
// Squares, beside those under foam: a wide tool and the ends of its passes come so far. With 1 three of 29 pieces of a
// bunny had runs that no arm posture took.
constexpr double beside_foam = 3;

double number(std::size_t count) {
    return static_cast<double>(count);
}

Vec3 column(const Pose& pose, int i) {
    return {pose.row[0][i], pose.row[1][i], pose.row[2][i]};
}

Vec3 corner_of(const Box& box, int corner) {
    Vec3 point;
    for (int i = 0; i < 3; ++i) point[i] = ((corner >> i) & 1) != 0 ? box.max[i] : box.min[i];
    return point;
}

// Of one direction: how high the tip must be, and how high it comes and goes.
struct ClHeights {
    Vec3 tool_axis;
    double retract = 0;  // along out
    double min_z = 0;    // of the tip in the setup, so that holder and spindle stay above z = 0

    Vec3 retracted(Vec3 tip) const { return tip + (retract - dot(tool_axis, tip)) * tool_axis; }

    // The point, or the one above it along `out` where the holder is free; nothing if there is none.
    std::optional<Vec3> allowed(Vec3 tip) const {
        if (tip.z >= min_z) return tip;
        if (tool_axis.z < 1e-6) return std::nullopt;
        const Vec3 raised = tip + ((min_z - tip.z) / tool_axis.z) * tool_axis;
        if (dot(tool_axis, raised) > retract) return std::nullopt;
        return raised;
    }
};

ClHeights cl_heights(const Box& block, const ToolBody& tool, Vec3 tool_axis, double clearance) {
    ClHeights heights{tool_axis, -std::numeric_limits<double>::infinity(), 0};
    for (int i = 0; i < 8; ++i)
        heights.retract = std::max(heights.retract, dot(tool_axis, corner_of(block, i)) + clearance);
    heights.min_z = std::max(0.0, min_tip_z(tool, std::hypot(tool_axis.x, tool_axis.y), tool_axis.z));
    return heights;
}

// Which sides of the block the tool comes to.
struct FacedSides {
    explicit FacedSides(Vec3 tool_axis) {
        for (int i = 0; i < 3; ++i) {
            is_min[static_cast<std::size_t>(i)] = tool_axis[i] < -faced;
            is_max[static_cast<std::size_t>(i)] = tool_axis[i] > faced;
        }
    }
    bool has(int axis, bool far) const { return (far ? is_max : is_min)[static_cast<std::size_t>(axis)]; }
    // Whether a point that lies on the sides given for two or three axes is on one that is faced.
    bool any(int corner, int without_axis = -1) const {
        for (int i = 0; i < 3; ++i) {
            if (i != without_axis && has(i, ((corner >> i) & 1) != 0)) return true;
        }
        return false;
    }
    std::array<bool, 3> is_min{};
    std::array<bool, 3> is_max{};
};

void add_block_corners(const Box& block, const FacedSides& sides, const ClHeights& heights, PoseRegion& region) {
    const Vec3 middle{0.5 * (block.min.x + block.max.x), 0.5 * (block.min.y + block.max.y), block.max.z};
    region.poses.push_back({PoseKind::retract, heights.retracted(middle), 0});
    for (int corner = 0; corner < 8; ++corner) {
        if (!sides.any(corner)) continue;
        const std::optional<Vec3> tip = heights.allowed(corner_of(block, corner));
        if (tip) region.poses.push_back({PoseKind::corner, *tip, 0});
    }
    const std::size_t corners = region.poses.size();
    for (std::size_t i = 1; i < corners; ++i) {
        region.poses.push_back({PoseKind::retract, heights.retracted(region.poses[i].tip), 0});
    }
    region.extremes = region.poses.size();
}

void add_edge(Vec3 from, Vec3 to, const ClHeights& heights, const PoseOptions& options, PoseRegion& region) {
    const double length = norm(to - from);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / options.step)));
    const int every = std::max(1, static_cast<int>(std::lround(options.retract_step / options.step)));
    for (int i = 1; i < parts; ++i) {
        const std::optional<Vec3> tip = heights.allowed(from + (static_cast<double>(i) / parts) * (to - from));
        if (!tip) continue;
        region.poses.push_back({PoseKind::edge, *tip, 0});
        if (i % every == 0) region.poses.push_back({PoseKind::retract, heights.retracted(*tip), 0});
    }
}

PoseRegion block_region(const Box& block, const ClHeights& heights, const PoseOptions& options) {
    PoseRegion region;
    const FacedSides sides(heights.tool_axis);
    add_block_corners(block, sides, heights, region);
    if (options.extremes_only) return region;
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 8; ++corner) {
            if (((corner >> axis) & 1) != 0 || !sides.any(corner, axis)) continue;
            add_edge(corner_of(block, corner), corner_of(block, corner | (1 << axis)), heights, options, region);
        }
    }
    return region;
}

// The CL surface of one direction in squares of the step.
class ClSurface {
 public:
    ClSurface(const HeightField& map, const Pose& map_in_setup, const ClHeights& heights, double step)
        : map_(map), map_in_setup_(map_in_setup), heights_(heights) {
        stride_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(step / map.cell)));
        columns_ = (map.columns + stride_ - 1) / stride_;
        rows_ = (map.rows + stride_ - 1) / stride_;
        lowest_.assign(columns_ * rows_, nowhere);
        for (std::size_t i = 0; i < map.height.size(); ++i) {
            if (!is_tip(i)) continue;
            std::size_t& own = lowest_[square_of(i)];
            if (own == nowhere || map.height[i] < map.height[own]) own = i;
        }
    }

    std::vector<PoseRegion> regions(const PoseOptions& options) const {
        std::vector<PoseRegion> found;
        std::vector<std::size_t> label(lowest_.size(), nowhere);
        std::vector<std::vector<std::size_t>> parts;
        for (std::size_t start = 0; start < lowest_.size(); ++start) {
            if (lowest_[start] == nowhere || label[start] != nowhere) continue;
            parts.push_back(connected(start, parts.size(), label));
        }
        const std::vector<std::vector<std::size_t>> extremes = extreme_cells(parts.size(), label);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            found.push_back(region(parts[i], extremes[i], i, label, options));
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const PoseRegion& a, const PoseRegion& b) { return a.poses.size() > b.poses.size(); });
        return found;
    }

 private:
    bool is_tip(std::size_t cell) const {
        const double height = static_cast<double>(map_.height[cell]);
        return height > -highest_tip && height < highest_tip && dot(heights_.tool_axis, tip(cell)) <= heights_.retract;
    }

    std::size_t square_of(std::size_t cell) const {
        return cell / map_.columns / stride_ * columns_ + cell % map_.columns / stride_;
    }

    Vec3 tip(std::size_t cell) const {
        const Vec3 in_map{map_.cell * (number(cell % map_.columns) + 0.5),
                          map_.cell * (number(cell / map_.columns) + 0.5), static_cast<double>(map_.height[cell])};
        return apply(map_in_setup_, in_map);
    }

    // Calls visit(square) for those beside one.
    template <class Visit>
    void beside(std::size_t square, const Visit& visit) const {
        const std::size_t column = square % columns_;
        const std::size_t row = square / columns_;
        if (column > 0) visit(square - 1);
        if (column + 1 < columns_) visit(square + 1);
        if (row > 0) visit(square - columns_);
        if (row + 1 < rows_) visit(square + columns_);
    }

    // Squares connected with one, which get its label.
    std::vector<std::size_t> connected(std::size_t start, std::size_t name, std::vector<std::size_t>& label) const {
        std::vector<std::size_t> part{start};
        label[start] = name;
        for (std::size_t i = 0; i < part.size(); ++i) {
            beside(part[i], [&](std::size_t next) {
                if (lowest_[next] == nowhere || label[next] != nowhere) return;
                label[next] = name;
                part.push_back(next);
            });
        }
        return part;
    }

    // Of each part the outermost cells: along the axes of setup and map, both ways, and between those across the tool.
    std::vector<std::vector<std::size_t>> extreme_cells(std::size_t parts,
                                                        const std::vector<std::size_t>& label) const {
        const Vec3 x = column(map_in_setup_, 0);
        const Vec3 y = column(map_in_setup_, 1);
        const std::array<Vec3, 8> along{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, x, y, column(map_in_setup_, 2),
                                        x + y,         x - y};
        std::vector<std::vector<std::size_t>> cells(parts, std::vector<std::size_t>(2 * along.size(), nowhere));
        std::vector<std::array<double, 16>> most(parts);
        for (std::size_t cell = 0; cell < map_.height.size(); ++cell) {
            if (!is_tip(cell)) continue;
            const std::size_t part = label[square_of(cell)];
            const Vec3 point = tip(cell);
            for (std::size_t k = 0; k < along.size(); ++k) {
                const double value = dot(along[k], point);
                for (const std::size_t side : {2 * k, 2 * k + 1}) {
                    const double signed_value = side == 2 * k ? value : -value;
                    std::size_t& own = cells[part][side];
                    if (own != nowhere && signed_value <= most[part][side]) continue;
                    own = cell;
                    most[part][side] = signed_value;
                }
            }
        }
        for (std::vector<std::size_t>& own : cells) {
            std::sort(own.begin(), own.end());
            own.erase(std::unique(own.begin(), own.end()), own.end());
        }
        return cells;
    }

    // The square nearest to the middle of a part.
    std::size_t middle_of(const std::vector<std::size_t>& part) const {
        double column = 0;
        double row = 0;
        for (const std::size_t square : part) {
            column += number(square % columns_) / number(part.size());
            row += number(square / columns_) / number(part.size());
        }
        const auto far = [&](std::size_t square) {
            return std::hypot(number(square % columns_) - column, number(square / columns_) - row);
        };
        return *std::min_element(part.begin(), part.end(),
                                 [&](std::size_t a, std::size_t b) { return far(a) < far(b); });
    }

    PoseRegion region(const std::vector<std::size_t>& part, const std::vector<std::size_t>& extremes, std::size_t name,
                      const std::vector<std::size_t>& label, const PoseOptions& options) const {
        PoseRegion region;
        const std::size_t root = middle_of(part);
        region.poses.push_back({PoseKind::tip, tip(lowest_[root]), 0});
        for (const std::size_t cell : extremes) {
            const std::size_t own = region.poses.size();
            region.poses.push_back({PoseKind::tip, tip(cell), 0});
            region.poses.push_back({PoseKind::retract, heights_.retracted(region.poses.back().tip), own});
        }
        region.extremes = region.poses.size();
        if (!options.extremes_only) add_squares(part, root, name, label, options, region);
        return region;
    }

    // From the root outwards, each compared with the one that it was come to from.
    void add_squares(const std::vector<std::size_t>& part, std::size_t root, std::size_t name,
                     const std::vector<std::size_t>& label, const PoseOptions& options, PoseRegion& region) const {
        const auto every = static_cast<std::size_t>(std::max(1L, std::lround(options.retract_step / options.step)));
        std::vector<std::size_t> pose_of(lowest_.size(), nowhere);
        std::vector<std::size_t> order{root};
        order.reserve(part.size());
        pose_of[root] = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            beside(order[i], [&](std::size_t next) {
                if (label[next] != name || pose_of[next] != nowhere) return;
                pose_of[next] = region.poses.size();
                region.poses.push_back({PoseKind::tip, tip(lowest_[next]), pose_of[order[i]]});
                order.push_back(next);
                if (next % columns_ % every != 0 || next / columns_ % every != 0) return;
                const Vec3 above = heights_.retracted(tip(lowest_[next]));
                region.poses.push_back({PoseKind::retract, above, pose_of[next]});
            });
        }
    }

    const HeightField& map_;
    Pose map_in_setup_;
    ClHeights heights_;
    std::size_t stride_ = 1;  // cells of a square's side
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::vector<std::size_t> lowest_;  // cell per square
};

// Beside the piece the first direction mills down to its base.
void fill_with_base(HeightField& map, const Pose& piece_in_setup) {
    const Pose map_in_setup = piece_in_setup * inverse(map.piece_in_field);
    const Vec3 z = map_in_setup.row[2];
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        if (map.height[i] != HeightField::nothing) continue;
        const double x = map.cell * (number(i % map.columns) + 0.5);
        const double y = map.cell * (number(i / map.columns) + 0.5);
        map.height[i] = static_cast<float>(-(map_in_setup.shift.z + z.x * x + z.y * y) / z.z);
    }
}

// Where the surface that the map shows is a cap that is a sawn face of the block.
CellMask shown_flush_caps(const HeightField& map, const Setup& setup) {
    CellMask shown(map.height.size(), 0);
    if (setup.flush_caps.empty()) return shown;
    const Pose map_in_setup = setup.piece_in_setup * inverse(map.piece_in_field);
    const Box block = setup.block_box();
    const FlushFaces flush = setup.flush_faces();
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        if (map.height[i] == HeightField::nothing) continue;
        const Vec3 p =
            apply(map_in_setup, {map.cell * (number(i % map.columns) + 0.5), map.cell * (number(i / map.columns) + 0.5),
                                 static_cast<double>(map.height[i])});
        const std::array<double, block_faces> away = inside_faces(block, p);
        for (std::size_t f = 0; f < block_faces; ++f) {
            if (flush[f] && away[f] < near_flush_face) shown[i] = 1;
        }
    }
    return shown;
}

// The tips of an orientation, a cell each. None stands on a cap that is sawn.
HeightField tips_of(const Setup& setup, const TriangleMesh& mesh, const ToolOrientation& orientation,
                    const ToolBody& tool, const PoseOptions& options) {
    HeightField map =
        height_field(mesh, orientation.tool_axis, options.map_cell > 0 ? options.map_cell : options.step / 8);
    if (setup.tool_axis(orientation).z > upright) fill_with_base(map, setup.piece_in_setup);
    const CellMask sawn = shown_flush_caps(map, setup);
    raise_to_holder_clearance(map, tool, setup.piece_in_setup);
    for (std::size_t i = 0; i < sawn.size(); ++i) {
        if (sawn[i] != 0) map.height[i] = HeightField::nothing;
    }
    return map;
}

// Of the tools that rough.
double widest_radius(const std::vector<CuttingTool>& tools) {
    double widest = 0;
    for (const CuttingTool& tool : tools) {
        const bool is_roughing = tool.shape == ToolShape::flat || tool.shape == ToolShape::ball;
        if (is_roughing) widest = std::max(widest, 0.5 * tool.diameter);
    }
    return widest;
}

bool is_inside(const Box& box, Vec3 p) {
    for (int i = 0; i < 3; ++i) {
        if (!(p[i] > box.min[i] && p[i] < box.max[i])) return false;
    }
    return true;
}

// Leaves tips where foam stands over them, up to where their tool leaves the block, and tips in squares beside.
void keep_tips_under_foam(HeightField& map, const Pose& map_in_setup, const Box& block, const FoamLeft& foam,
                          double step) {
    const Vec3 tool_axis = column(map_in_setup, 2);
    const auto side = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(step / map.cell)));
    const std::size_t columns = (map.columns + side - 1) / side;
    const std::size_t rows = (map.rows + side - 1) / side;
    CellMask is_needed(columns * rows, 0);
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        std::uint8_t& needed = is_needed[i / map.columns / side * columns + i % map.columns / side];
        const auto height = static_cast<double>(map.height[i]);
        if (needed != 0 || !(std::abs(height) < highest_tip)) continue;
        Vec3 point = apply(map_in_setup, {map.cell * (number(i % map.columns) + 0.5),
                                          map.cell * (number(i / map.columns) + 0.5), height + map.cell});
        for (; is_inside(block, point) && needed == 0; point = point + 0.5 * step * tool_axis) {
            needed = foam.stands_at(point) ? 1 : 0;
        }
    }
    const CellMask is_near = marked_within(is_needed, columns, rows, beside_foam);
    for (std::size_t i = 0; i < map.height.size(); ++i) {
        if (is_near[i / map.columns / side * columns + i % map.columns / side] == 0)
            map.height[i] = HeightField::nothing;
    }
}

}  // namespace

std::vector<OrientationPoses> milling_poses(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                            const PoseOptions& options) {
    assert(cell.machine && !setup.access.orientations.empty() && options.step > 0);
    const ToolBody tool = *limiting_tools(cell).longest;
    const Box block = setup.milled_box();
    FoamLeft foam(setup.piece_in_setup, widest_radius(cell.machine->tools));
    std::vector<OrientationPoses> all;
    for (const ToolOrientation& orientation : setup.access.orientations) {
        const Vec3 tool_axis = setup.tool_axis(orientation);
        const ClHeights heights = cl_heights(block, tool, tool_axis, cell.clearance);
        const bool is_first = all.empty();
        OrientationPoses poses{tool_axis, {}};
        if (is_first || options.block_only) poses.regions.push_back(block_region(block, heights, options));
        if (!options.block_only) {
            HeightField map = tips_of(setup, mesh, orientation, tool, options);
            const Pose map_in_setup = setup.piece_in_setup * inverse(map.piece_in_field);
            HeightField needed = map;
            if (!is_first) keep_tips_under_foam(needed, map_in_setup, block, foam, options.step);
            for (PoseRegion& region : ClSurface(needed, map_in_setup, heights, options.step).regions(options)) {
                poses.regions.push_back(std::move(region));
            }
            const bool is_last = all.size() + 1 == setup.access.orientations.size();
            if (!is_last) foam.remove_above(std::move(map), tool_axis.z > upright);
        }
        all.push_back(std::move(poses));
    }
    return all;
}

}  // namespace qchopper

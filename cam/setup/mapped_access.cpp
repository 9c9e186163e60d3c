// One direction after another, with one map at a time: what it reaches is joined to what the ones before it reached,
// and the foam above it is taken away from a grid of points, so no map is held beside another. Sums are taken over
// blocks of triangles in their order. O(directions x (triangles + cells + foam points)).

#include "cam/setup/mapped_access.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "base/units.h"
#include "cam/setup/stock_points.h"
#include "segment/mesh/measure.h"
#include "segment/raster/height_field.h"

namespace qchopper {
namespace {

constexpr std::size_t triangles_at_once = 4096;
constexpr double smallest_cell = 0.25;  // mm
constexpr double cells_of_longest_side = 700;
constexpr double max_cells_per_ball_radius = 6;  // and a half

double cell_of(const TriangleMesh& mesh, const HeightFieldOptions& options) {
    if (options.cell > 0) return options.cell;
    const Vec3 size = bounds(mesh).size();
    return std::max(smallest_cell, std::max({size.x, size.y, size.z}) / cells_of_longest_side);
}

Vec3 middle_of(const TriangleMesh& mesh, std::size_t triangle) {
    const std::array<Vec3, 3> p = corners_of(mesh, triangle);
    return (1.0 / 3) * (p[0] + p[1] + p[2]);
}

// Length of the way from a point in a box along a direction to where it leaves the box.
double way_out(const Box& box, Vec3 from, Vec3 direction) {
    double way = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0) continue;
        way = std::min(way, ((direction[i] > 0 ? box.max[i] : box.min[i]) - from[i]) / direction[i]);
    }
    return std::max(0.0, way);
}

// Of the map under a point above it, 0 where there is no surface, beside the map, and of a triangle without normal.
float height_above(const HeightField& map, Vec3 point) {
    const Vec3 p = apply(map.piece_in_field, point);
    const std::optional<std::size_t> cell = map.cell_under(p.x, p.y);
    return cell ? std::max(0.0F, map.height[*cell] - static_cast<float>(p.z)) : 0;
}

// Whether no surface nearby is much higher than a point: a triangle at the outline of what lies over it may be taken as
// reached though it is not, because a cell holds both.
bool is_open_around(const HeightField& map, Vec3 point) {
    const double side = map.cell;
    for (const double x : {-side, 0.0, side}) {
        for (const double y : {-side, 0.0, side}) {
            const Vec3 beside = point + x * map.piece_in_field.row[0] + y * map.piece_in_field.row[1];
            if (static_cast<double>(height_above(map, beside)) > 3 * side) return false;
        }
    }
    return true;
}

// Adds up what add(sums, triangle) gives, in the order of the triangles on any number of threads.
template <class Sums, class Add>
Sums summed(std::size_t triangles, const Add& add) {
    std::vector<Sums> blocks((triangles + triangles_at_once - 1) / triangles_at_once);
    parallel_for(0, blocks.size(), [&](std::size_t b) {
        const std::size_t end = std::min(triangles, (b + 1) * triangles_at_once);
        for (std::size_t t = b * triangles_at_once; t < end; ++t) add(blocks[b], t);
    });
    Sums all;
    for (const Sums& block : blocks) all.add(block);
    return all;
}

struct Sum {
    double value = 0;
    void add(const Sum& other) { value += other.value; }
};

// How deep surface lies. Whole numbers are added up, so that their order is of no influence.
class Depths {
 public:
    Depths(double most, double area) : bin_(most / static_cast<double>(bins)), unit_(area / units) {}

    void add(double depth, double area) {
        if (!(depth > 0)) depth = 0;
        const auto bin = std::min(bins - 1, static_cast<std::size_t>(depth / bin_));
        units_in_[bin].fetch_add(static_cast<std::uint64_t>(area / unit_), std::memory_order_relaxed);
    }

    // But for a ten-thousandth of the surface, against single triangles that are taken as reached by mistake.
    double largest() const {
        std::uint64_t all = 0;
        for (const auto& some : units_in_) all += some.load();
        std::uint64_t beyond = 0;
        for (std::size_t bin = bins; bin > 1; --bin) {
            beyond += units_in_[bin - 1].load();
            if (beyond > all / 10'000) return static_cast<double>(bin) * bin_;
        }
        return 0;
    }

 private:
    static constexpr std::size_t bins = 4096;
    static constexpr double units = 1e15;
    double bin_;   // mm
    double unit_;  // mm2
    std::vector<std::atomic<std::uint64_t>> units_in_ = std::vector<std::atomic<std::uint64_t>>(bins);
};

struct StateSums {
    double area = 0;
    double hidden = 0;
    double steep = 0;
    double holder = 0;
    double ignored = 0;
    void add(const StateSums& other) {
        area += other.area;
        hidden += other.hidden;
        steep += other.steep;
        holder += other.holder;
        ignored += other.ignored;
    }
};

class Reaching {
 public:
    Reaching(const TriangleMesh& mesh, const Setup& setup)
        : setup_(setup), mesh_(mesh), surfaces_(mesh.triangles.size()) {
        area_ = summed<StateSums>(surfaces_.size(), [&](StateSums& sums, std::size_t t) {
                    if (counts(t)) sums.area += norm(area_vector(mesh_, t));
                }).area;
    }

    // What is in sight of a direction: its map, and of each triangle the share.
    void join_seen(const HeightField& map, const std::vector<float>& seen) {
        const Vec3 tool_axis = map.tool_axis();
        parallel_ranges(0, surfaces_.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
            for (std::size_t t = first; t < end; ++t) {
                Surface& surface = surfaces_[t];
                surface.seen = std::max(surface.seen, seen[t]);
                if (surface.seen == 1) continue;
                surface.is_steep = surface.is_steep || is_steep(mesh_, t, tool_axis);
                const Vec3 above = middle_of(mesh_, t) + map.cell * normalized(area_vector(mesh_, t));
                surface.foam = std::min(surface.foam, height_above(map, above));
            }
        });
    }

    // What it reaches, by its map after raise_to_holder_clearance().
    ToolOrientation join_reached(const HeightField& map, const std::vector<float>& reached) {
        ToolOrientation orientation;
        orientation.tool_axis = map.tool_axis();
        orientation.tilt_deg = degrees(std::acos(std::clamp(dot(orientation.tool_axis, setup_.up), -1.0, 1.0)));
        const Vec3 tool_axis = setup_.tool_axis(orientation);
        const Box block_box = setup_.block_box();
        Depths depths(norm(block_box.size()), area_);
        const auto gained = summed<Sum>(surfaces_.size(), [&](Sum& block, std::size_t t) {
            if (!counts(t)) return;
            Surface& surface = surfaces_[t];
            if (is_cut_freely(map, t, reached[t])) {
                const Vec3 middle = apply(setup_.piece_in_setup, middle_of(mesh_, t));
                depths.add(way_out(block_box, middle, tool_axis), norm(area_vector(mesh_, t)));
            }
            if (reached[t] <= surface.reached) return;
            block.value += static_cast<double>(reached[t] - surface.reached) * norm(area_vector(mesh_, t));
            surface.reached = reached[t];
        });
        orientation.gained_share = area_ > 0 ? gained.value / area_ : 0;
        orientation.depth_mm = depths.largest();
        return orientation;
    }

    void finish(MappedAccess& result) const {
        result.states.assign(surfaces_.size(), SurfaceState::reached);
        result.reached.resize(surfaces_.size());
        std::transform(surfaces_.begin(), surfaces_.end(), result.reached.begin(),
                       [](const Surface& surface) { return surface.reached; });
        Depths depths(norm(bounds(mesh_).size()), area_);
        const StateSums sums = summed<StateSums>(surfaces_.size(), [&](StateSums& block, std::size_t t) {
            const double area = norm(area_vector(mesh_, t));
            if (!counts(t)) {
                if (is_unmilled(t)) return;
                block.ignored += area;
                result.states[t] = SurfaceState::ignored;
                return;
            }
            const Surface& surface = surfaces_[t];
            const float holder = std::max(0.0F, surface.seen - surface.reached);
            const float unseen = 1 - surface.seen;
            block.holder += static_cast<double>(holder) * area;
            (surface.is_steep ? block.steep : block.hidden) += static_cast<double>(unseen) * area;
            if (surface.reached >= std::max(holder, unseen)) return;
            result.states[t] = holder >= unseen   ? SurfaceState::holder
                               : surface.is_steep ? SurfaceState::steep
                                                  : SurfaceState::hidden;
            if (holder < unseen && surface.seen == 0) {
                depths.add(static_cast<double>(surface.foam), area);
            }
        });
        result.access.area_mm2 = area_;
        result.access.hidden_mm2 = sums.hidden;
        result.access.steep_mm2 = sums.steep;
        result.access.holder_mm2 = sums.holder;
        result.access.ignored_mm2 = sums.ignored;
        result.access.foam_depth_mm = depths.largest();
    }

 private:
    // Of a triangle, over the directions so far.
    struct Surface {
        float seen = 0;                                  // largest share in sight
        float reached = 0;                               // largest share reached with the holder
        float foam = std::numeric_limits<float>::max();  // mm, least height of the maps over it
        bool is_steep = false;
    };

    // Whether a triangle tells how deep the tool goes.
    bool is_cut_freely(const HeightField& map, std::size_t t, float reached) const {
        if (reached > 0.5F) return is_open_around(map, middle_of(mesh_, t));
        if (setup_.access.steep_counts || !is_steep(mesh_, t, map.tool_axis())) return false;
        const Vec3 beside = middle_of(mesh_, t) + 2 * map.cell * normalized(area_vector(mesh_, t));
        return height_above(map, beside) == 0;
    }

    bool is_unmilled(std::size_t t) const { return setup_.is_unmilled(cap_of(mesh_, t)); }
    // Whether the triangle is surface that is to be reached.
    bool counts(std::size_t t) const { return !is_unmilled(t) && !is_ignored(mesh_, t); }

    const Setup& setup_;
    const TriangleMesh& mesh_;
    double area_ = 0;
    std::vector<Surface> surfaces_;
};

// In the piece's box, because what lies below the surface seen from straight above lies there.
std::optional<StockPoints> stock_around(const TriangleMesh& mesh, const Setup& setup, std::size_t count) {
    const Vec3 any = apply(setup.piece_in_setup, mesh.points[mesh.triangles.front()[0]]);
    Box box{any, any};
    for (const Vec3& p : mesh.points) extend(box, apply(setup.piece_in_setup, p));
    const Box block = setup.block_box();
    for (int i = 0; i < 3; ++i) {
        box.min[i] = std::max(box.min[i], block.min[i]);
        box.max[i] = std::min(box.max[i], block.max[i]);
    }
    box.min.z = std::max(box.min.z, 0.0);
    const Vec3 size = box.size();
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) return std::nullopt;
    return StockPoints(mesh, setup.piece_in_setup, box, count);
}

// On cells of which the radius is a whole number and a half, and half as many as those of the map at most.
void mill_with_ball(StockPoints& stock_points, const HeightField& map, double radius) {
    const double most = std::floor(radius / (std::numbers::sqrt2 * map.cell) - 0.5);
    if (most < 1) return stock_points.mill(map);
    const double cells = std::min(most, max_cells_per_ball_radius) + 0.5;
    const HeightField wide = coarser(map, radius / cells / map.cell);
    const HeightField closed = closed_by_ball(wide, radius);
    stock_points.mill(map, {&wide, &closed});
}

}  // namespace

MappedAccess mapped_access(const TriangleMesh& mesh, const Setup& setup, const LimitingTools& tools,
                           const HeightFieldOptions& options) {
    assert(!setup.access.orientations.empty());
    const double cell = cell_of(mesh, options);
    std::optional<StockPoints> stock_points = stock_around(mesh, setup, options.stock_points);
    std::optional<StockPoints> stock_after_ball;
    if (tools.smallest_radius > 0) stock_after_ball = stock_points;
    Reaching reaching(mesh, setup);
    MappedAccess result;
    for (const ToolOrientation& orientation : setup.access.orientations) {
        HeightField map = height_field(mesh, orientation.tool_axis, cell);
        std::vector<float> share = reached_share(mesh, map);
        reaching.join_seen(map, share);
        if (stock_points) stock_points->mill(map);
        if (stock_after_ball) mill_with_ball(*stock_after_ball, map, tools.smallest_radius);
        if (tools.longest && raise_to_holder_clearance(map, *tools.longest, setup.piece_in_setup)) {
            share = reached_share(mesh, map);
        }
        result.access.orientations.push_back(reaching.join_reached(map, share));
    }
    reaching.finish(result);
    result.access.method = AccessMethod::mapped;
    result.access.steep_counts = setup.access.steep_counts;
    result.access.foam_mm3 = stock_points ? stock_points->volume_mm3() : 0;
    if (stock_after_ball) result.access.rest_material_mm3 = stock_after_ball->volume_mm3() - result.access.foam_mm3;
    result.stock_points = std::move(stock_points);
    return result;
}

}  // namespace qchopper

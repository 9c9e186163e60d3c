// A point is free at a distance if the point so far along its normal lies above what remains in its cell. The points of
// a triangle are the middles of the upright ones of the small triangles into which it is divided evenly.
// O(points * directions).

#include "cam/toolpath/finishing/finishing_region.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "segment/mesh/measure.h"
#include "segment/raster/shared_value.h"
#include "segment/raster/square_dilation.h"

namespace qchopper {
namespace {

constexpr std::uint8_t all = 255;      // more foam than is examined, or not seen at all
constexpr std::uint8_t max_twice = 4;  // foam is examined up to near * 2^(max_twice - 1)
constexpr double overhanging = -0.01;  // sine of half a degree: a vertical wall is not one by rounding
// Sine of 12 degrees. Under an edge a tool comes within `near` of overhanging surface: of what faces farther down in a
// strip narrower than three millimetres.
constexpr double lowest_facing = -0.2;
constexpr std::uint8_t worst_under_edges = 1;  // k of overhanging surface; with more, much is milled to no avail
constexpr std::size_t triangles_at_once = 1024;

// k for at most near * 2^k of foam over a point of the map.
std::uint8_t foam_class(const HeightField& remaining, Vec3 at, Vec3 normal, double near) {
    double far = near;
    for (std::uint8_t k = 0; k < max_twice; ++k, far *= 2) {
        const Vec3 p = at + far * normal;
        const auto cell = remaining.cell_under(p.x, p.y);
        if (!cell || static_cast<double>(remaining.height[*cell]) <= p.z) return k;
    }
    return all;
}

std::uint8_t class_of(double foam, double near) {
    std::uint8_t k = 0;
    for (double far = near; far < foam && k < max_twice; far *= 2) ++k;
    return k;
}

}  // namespace

RestMaterial::RestMaterial(const TriangleMesh& mesh, const Setup& setup, double spacing)
    : mesh_(&mesh), spacing_(spacing), first_point_(mesh.triangles.size() + 1, 0) {
    assert(is_consistent(mesh) && spacing > 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const bool is_unmilled = setup.is_unmilled(cap_of(mesh, t));
        const bool is_ignored = !mesh.ignored.empty() && mesh.ignored[t] != 0;
        std::size_t points = 0;
        if (!is_unmilled && !is_ignored) {
            const auto& corner = mesh.triangles[t];
            double longest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                longest = std::max(longest, norm(mesh.points[corner[k]] - mesh.points[corner[(k + 1) % 3]]));
            }
            const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil(longest / spacing)));
            points = n * (n + 1) / 2;
        }
        first_point_[t + 1] = first_point_[t] + points;
    }
    left_.assign(first_point_.back(), all);
    before_ = left_;
    taken_by_.assign(left_.size(), 0);
}

template <class Visit>
void RestMaterial::for_each_point(std::size_t triangle, const Visit& visit) const {
    const std::size_t points = first_point_[triangle + 1] - first_point_[triangle];
    const auto n = static_cast<std::size_t>(std::lround(0.5 * (std::sqrt(8.0 * static_cast<double>(points) + 1) - 1)));
    const auto& corner = mesh_->triangles[triangle];
    const Vec3 a = mesh_->points[corner[0]];
    const Vec3 u = (1.0 / static_cast<double>(std::max<std::size_t>(n, 1))) * (mesh_->points[corner[1]] - a);
    const Vec3 v = (1.0 / static_cast<double>(std::max<std::size_t>(n, 1))) * (mesh_->points[corner[2]] - a);
    std::size_t index = first_point_[triangle];
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; i + j < n; ++j) {
            visit(index++, a + (static_cast<double>(i) + 1.0 / 3) * u + (static_cast<double>(j) + 1.0 / 3) * v);
        }
    }
}

template <class Visit>
void RestMaterial::for_each_left(const HeightField& frame, double near, double worth, const Visit& visit) const {
    const std::uint8_t min_before = worth > 0 ? class_of(worth, near) : 0;
    parallel_ranges(0, mesh_->triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            const Vec3 normal = normalized(rotate(frame.piece_in_field, area_vector(*mesh_, t)));
            if (!(normal.z > lowest_facing)) continue;
            for_each_point(t, [&](std::size_t index, Vec3 p) {
                if (left_[index] > min_before) visit(index, apply(frame.piece_in_field, p), normal);
            });
        }
    });
}

FieldTiles RestMaterial::places(const HeightField& frame, double near, double worth) const {
    FieldTiles tiles(frame.columns, frame.rows);
    for_each_left(frame, near, worth, [&](std::size_t, Vec3 at, Vec3) {
        const auto cell = frame.cell_under(at.x, at.y);
        if (cell) tiles.add(*cell);
    });
    return tiles;
}

double RestMaterial::examined(double near) {
    return std::ldexp(near, max_twice - 1);
}

FinishingRegion RestMaterial::take(const HeightField& remaining, double near, double overlap, double worth,
                                   bool is_whole) {
    assert(near > 0 && overlap >= 0);
    FinishingRegion region(remaining.height.size(), not_finished);
    ++takes_;
    for_each_left(remaining, near, worth, [&](std::size_t index, Vec3 at, Vec3 normal) {
        const std::uint8_t worst = is_whole ? 0 : normal.z > overhanging ? max_twice : worst_under_edges;
        const std::uint8_t k = foam_class(remaining, at, normal, near);
        if (k >= left_[index] || k > worst) return;
        before_[index] = left_[index];
        left_[index] = k;
        taken_by_[index] = static_cast<std::uint16_t>(takes_);
        const auto cell = remaining.cell_under(at.x, at.y);
        if (cell) lower_shared(region[*cell], static_cast<float>(at.z));
    });
    const double beside = std::max(overlap, spacing_);
    return erode_by_square(region, remaining.columns, remaining.rows,
                           static_cast<std::size_t>(std::ceil(beside / remaining.cell)));
}

bool RestMaterial::give_back(std::size_t take, const HeightField& remaining, double near) {
    assert(take > 0 && take <= takes_ && near > 0);
    std::atomic<bool> is_any = false;
    parallel_ranges(0, mesh_->triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            const Vec3 normal = normalized(rotate(remaining.piece_in_field, area_vector(*mesh_, t)));
            for_each_point(t, [&](std::size_t index, Vec3 p) {
                if (taken_by_[index] != take) return;
                const Vec3 at = apply(remaining.piece_in_field, p);
                const std::uint8_t k = foam_class(remaining, at, normal, near);
                if (k <= left_[index]) return;
                left_[index] = std::min(k, before_[index]);
                taken_by_[index] = 0;
                is_any.store(true, std::memory_order_relaxed);
            });
        }
    });
    return is_any;
}

double RestMaterial::area_mm2() const {
    double area = 0;
    for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
        if (first_point_[t + 1] > first_point_[t]) area += norm(area_vector(*mesh_, t));
    }
    return area;
}

double RestMaterial::share_within(std::size_t k) const {
    double within = 0;
    double sum = 0;
    for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
        const std::size_t points = first_point_[t + 1] - first_point_[t];
        if (points == 0) continue;
        const double area = norm(area_vector(*mesh_, t)) / static_cast<double>(points);
        for (std::size_t i = first_point_[t]; i < first_point_[t + 1]; ++i) {
            sum += area;
            if (left_[i] <= k) within += area;
        }
    }
    return sum > 0 ? within / sum : 1;
}

void add_floor_band(FinishingRegion& region, const HeightField& target, double width, const Setup& setup) {
    assert(region.size() == target.height.size());
    if (target.height.empty()) return;
    const float floor = *std::min_element(target.height.begin(), target.height.end());
    CellMask piece(region.size(), 0);
    for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = target.height[i] > floor + 1e-3F ? 1 : 0;
    const auto by = static_cast<std::size_t>(std::ceil(width / target.cell));
    const CellMask band = dilate_by_square(piece, target.columns, target.rows, by);
    const Box block = setup.block_box();
    const FlushFaces flush = setup.flush_faces();
    const auto is_beyond_saw = [&](std::size_t i) {
        const std::size_t column = i % target.columns;
        const std::size_t row = i / target.columns;
        const Vec3 p = field_to_setup(
            setup, target,
            {target.cell * (static_cast<double>(column) + 0.5), target.cell * (static_cast<double>(row) + 0.5), 0});
        const std::array<double, block_faces> inside = inside_faces(block, p);
        for (const BlockFace side : {BlockFace::minus_x, BlockFace::plus_x, BlockFace::minus_y, BlockFace::plus_y}) {
            const auto f = static_cast<std::size_t>(side);
            if (flush[f] && inside[f] < 0) return true;
        }
        return false;
    };
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (band[i] != 0 && piece[i] == 0 && !is_beyond_saw(i)) region[i] = std::min(region[i], target.height[i]);
    }
}

}  // namespace qchopper

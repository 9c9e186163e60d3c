// S. F. F. Gibson: Constrained elastic surface nets, 1998, with the crossings of the edges in place of relaxation: they
// are found by halving. O(points of the grid * maps).

#include "sim/replay/stages/stock_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"

namespace qchopper {
namespace {

constexpr int halvings = 7;
constexpr std::uint32_t no_point = UINT32_MAX;
constexpr double share_of_surface = 1.2;  // more than that of the block, in steps of the grid

// The points of a grid around a block, of which the outer ones lie outside.
class StockGrid {
 public:
    StockGrid(const StockModel& stock_model, double spacing, const Context& context)
        : stock_model_(stock_model), spacing_(spacing) {
        const Box& block = stock_model.block();
        const Vec3 size = block.size();
        for (int axis = 0; axis < 3; ++axis) {
            count_[axis] = static_cast<std::size_t>(std::ceil(size[axis] / spacing + 0.5)) + 1;
            origin_[axis] = block.min[axis] - 0.5 * spacing;
        }
        is_foam_.resize(count_[0] * count_[1] * count_[2]);
        parallel_for(0, count_[2], [&](std::size_t k) {
            context.check_cancelled();
            for (std::size_t j = 0; j < count_[1]; ++j) {
                for (std::size_t i = 0; i < count_[0]; ++i) {
                    is_foam_[index(i, j, k)] = stock_model.is_in_stock(point(i, j, k)) ? 1 : 0;
                }
            }
        });
    }
    const std::array<std::size_t, 3>& count() const { return count_; }
    std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (k * count_[1] + j) * count_[0] + i; }
    bool is_foam(std::size_t index) const { return is_foam_[index] != 0; }
    Vec3 point(std::size_t i, std::size_t j, std::size_t k) const {
        return origin_ + spacing_ * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    }
    // Where the foam ends between a point in it and one that is not.
    Vec3 crossing(Vec3 in, Vec3 out) const {
        for (int i = 0; i < halvings; ++i) {
            const Vec3 middle = 0.5 * (in + out);
            (stock_model_.is_in_stock(middle) ? in : out) = middle;
        }
        return 0.5 * (in + out);
    }

 private:
    const StockModel& stock_model_;
    double spacing_;
    std::array<std::size_t, 3> count_{};
    Vec3 origin_;
    std::vector<std::uint8_t> is_foam_;
};

struct GridPlace {
    std::array<std::size_t, 3> at{};
    GridPlace next(int axis) const {
        GridPlace result = *this;
        ++result.at[static_cast<std::size_t>(axis)];
        return result;
    }
    GridPlace before(int axis) const {
        GridPlace result = *this;
        --result.at[static_cast<std::size_t>(axis)];
        return result;
    }
};

class SurfaceMaker {
 public:
    explicit SurfaceMaker(const StockGrid& grid)
        : grid_(grid), point_of_(grid.count()[0] * grid.count()[1] * grid.count()[2], no_point) {}

    TriangleMesh make() {
        for_each_edge([&](const GridPlace& from, int axis) { add_crossing(from, axis); });
        for (std::size_t p = 0; p < mesh_.points.size(); ++p) {
            mesh_.points[p] = (1.0 / static_cast<double>(crossings_[p])) * mesh_.points[p];
        }
        for_each_edge([&](const GridPlace& from, int axis) { add_faces(from, axis); });
        return std::move(mesh_);
    }

 private:
    std::size_t index(const GridPlace& place) const { return grid_.index(place.at[0], place.at[1], place.at[2]); }

    // Edges of the grid whose ends differ, row by row. None lies on the border: points there are not foam.
    template <class Use>
    void for_each_edge(const Use& use) const {
        const auto& n = grid_.count();
        GridPlace place;
        for (place.at[2] = 0; place.at[2] < n[2]; ++place.at[2]) {
            for (place.at[1] = 0; place.at[1] < n[1]; ++place.at[1]) {
                for (place.at[0] = 0; place.at[0] < n[0]; ++place.at[0]) {
                    for (int axis = 0; axis < 3; ++axis) {
                        const GridPlace to = place.next(axis);
                        if (to.at[static_cast<std::size_t>(axis)] == n[static_cast<std::size_t>(axis)]) continue;
                        if (grid_.is_foam(index(place)) != grid_.is_foam(index(to))) use(place, axis);
                    }
                }
            }
        }
    }

    // The cubes about an edge, counter-clockwise seen against its axis, each by its least corner.
    static std::array<GridPlace, 4> cubes_about(const GridPlace& from, int axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        return {from.before(u).before(v), from.before(v), from, from.before(u)};
    }

    void add_crossing(const GridPlace& from, int axis) {
        const GridPlace to = from.next(axis);
        Vec3 in = grid_.point(from.at[0], from.at[1], from.at[2]);
        Vec3 out = grid_.point(to.at[0], to.at[1], to.at[2]);
        if (!grid_.is_foam(index(from))) std::swap(in, out);
        const Vec3 crossing = grid_.crossing(in, out);
        for (const GridPlace& cube : cubes_about(from, axis)) {
            std::uint32_t& point = point_of_[index(cube)];
            if (point == no_point) {
                point = static_cast<std::uint32_t>(mesh_.points.size());
                mesh_.points.push_back({});
                crossings_.push_back(0);
            }
            mesh_.points[point] = mesh_.points[point] + crossing;
            ++crossings_[point];
        }
    }

    void add_faces(const GridPlace& from, int axis) {
        std::array<std::uint32_t, 4> corner{};
        const std::array<GridPlace, 4> cubes = cubes_about(from, axis);
        for (std::size_t i = 0; i < 4; ++i) corner[i] = point_of_[index(cubes[i])];
        if (!grid_.is_foam(index(from))) std::swap(corner[1], corner[3]);
        mesh_.triangles.push_back({corner[0], corner[1], corner[2]});
        mesh_.triangles.push_back({corner[0], corner[2], corner[3]});
    }

    const StockGrid& grid_;
    std::vector<std::uint32_t> point_of_;  // by the least corner of the cube
    std::vector<std::size_t> crossings_;   // of each point
    TriangleMesh mesh_;
};

}  // namespace

double surface_spacing(const Box& block, std::size_t triangles, double least) {
    const Vec3 size = block.size();
    const double area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    return std::max(least, std::sqrt(share_of_surface * area / (0.5 * static_cast<double>(triangles))));
}

TriangleMesh stock_surface(const StockModel& stock_model, double spacing, const Context& context) {
    const StockGrid grid(stock_model, spacing, context);
    return SurfaceMaker(grid).make();
}

}  // namespace qchopper

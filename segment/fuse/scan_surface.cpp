// One pass over the places of the grid, and one over the edges of the mesh.

#include "segment/fuse/scan_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "segment/fuse/median.h"
#include "segment/mesh/connectivity/edges.h"

namespace qchopper {
namespace {

constexpr double border_weight = 0.1;  // there points lie at steps in depth, and are less exact

// Those of the places (row, column) to (row + 1, column + 1), around the square.
std::array<std::uint32_t, 4> square_at(const RangeScan& scan, std::size_t row, std::size_t column) {
    const std::size_t at = row * scan.columns + column;
    return {scan.grid[at], scan.grid[at + 1], scan.grid[at + scan.columns + 1], scan.grid[at + scan.columns]};
}

template <class Visit>
void for_each_square(const RangeScan& scan, const Visit& visit) {
    for (std::size_t row = 0; row + 1 < scan.rows; ++row) {
        for (std::size_t column = 0; column + 1 < scan.columns; ++column) visit(square_at(scan, row, column));
    }
}

class GridTriangles {
 public:
    GridTriangles(const RangeScan& scan, double longest_edge) : scan_(scan), longest_edge_(longest_edge) {}

    void add_square(const std::array<std::uint32_t, 4>& corner) {
        const auto missing = std::ranges::count(corner, RangeScan::no_point);
        if (missing > 1) return;
        if (missing == 1) {
            const auto gap = static_cast<std::size_t>(std::ranges::find(corner, RangeScan::no_point) - corner.begin());
            return add({corner[(gap + 1) % 4], corner[(gap + 2) % 4], corner[(gap + 3) % 4]});
        }
        const std::size_t from = length(corner[0], corner[2]) <= length(corner[1], corner[3]) ? 0 : 1;
        add({corner[from], corner[from + 1], corner[from + 2]});
        add({corner[from], corner[from + 2], corner[(from + 3) % 4]});
    }

    std::vector<Triangle> triangles;

 private:
    double length(std::uint32_t a, std::uint32_t b) const { return norm(scan_.points[a] - scan_.points[b]); }
    void add(const Triangle& t) {
        const double longest = std::max({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])});
        if (longest <= longest_edge_ && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }

    const RangeScan& scan_;
    double longest_edge_;
};

}  // namespace

double grid_spacing(const RangeScan& scan) {
    std::vector<double> lengths;
    for_each_square(scan, [&](const std::array<std::uint32_t, 4>& corner) {
        for (const std::size_t other : {std::size_t{1}, std::size_t{3}}) {
            if (corner[0] == RangeScan::no_point || corner[other] == RangeScan::no_point) continue;
            lengths.push_back(norm(scan.points[corner[0]] - scan.points[corner[other]]));
        }
    });
    return median(std::move(lengths));
}

TriangleMesh triangulate(const RangeScan& scan, double longest_edge) {
    GridTriangles made(scan, longest_edge);
    for_each_square(scan, [&](const auto& corner) { made.add_square(corner); });
    TriangleMesh mesh{scan.points, std::move(made.triangles), {}};
    double towards_scanner = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) towards_scanner += area_vector(mesh, t).z;
    if (towards_scanner < 0) {
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    return mesh;
}

ScanSurface scan_surface(std::string name, TriangleMesh mesh, bool is_grid) {
    ScanSurface surface{std::move(name), std::move(mesh), {}, {}, {}, {}};
    const TriangleMesh& m = surface.mesh;
    surface.normals.resize(m.points.size());
    surface.border.assign(m.points.size(), 0);
    surface.open.assign(m.triangles.size(), 0);
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
        for (const std::uint32_t corner : m.triangles[t]) {
            surface.normals[corner] = surface.normals[corner] + area_vector(m, t);
        }
    }
    const Edges found = edges(m);
    for (std::size_t h = 0; h < found.twin.size(); ++h) {
        if (found.twin[h] != no_twin) continue;
        surface.open[h / 3] |= static_cast<std::uint8_t>(1U << h % 3);
        surface.border[m.triangles[h / 3][h % 3]] = 1;
        surface.border[m.triangles[h / 3][(h + 1) % 3]] = 1;
    }
    for (std::size_t i = 0; i < m.points.size(); ++i) {
        surface.normals[i] = normalized(surface.normals[i]);
        const double slant = is_grid ? std::max(0.0, surface.normals[i].z) : 1;
        surface.weights.push_back(static_cast<float>(slant * (surface.border[i] != 0 ? border_weight : 1)));
    }
    return surface;
}

}  // namespace qchopper

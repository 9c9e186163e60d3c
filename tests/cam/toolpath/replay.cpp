// A ball removes what is above its underside. Points for gouges are sorted into the cells of a grid as wide as the
// ball.

#include "tests/cam/toolpath/replay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "segment/mesh/measure.h"

namespace qchopper::test_pieces {
namespace {

template <class Visit>
void for_each_tip(const Pass& pass, double step, const Visit& visit) {
    visit(pass.points.front().tip);
    for (std::size_t i = 1; i < pass.points.size(); ++i) {
        const Vec3 a = pass.points[i - 1].tip;
        const Vec3 b = pass.points[i].tip;
        const auto count = static_cast<std::size_t>(std::ceil(norm(b - a) / step));
        for (std::size_t k = 1; k <= count; ++k) {
            visit(a + static_cast<double>(k) / static_cast<double>(count) * (b - a));
        }
    }
}

}  // namespace

HeightField replayed(const HeightField& from, const std::vector<Pass>& passes, const CuttingTool& tool) {
    HeightField map = from;
    const double radius = 0.5 * tool.diameter;
    for (const Pass& pass : passes) {
        for_each_tip(pass, map.cell, [&](Vec3 tip) {
            const auto low = [&](double x) {
                return static_cast<std::size_t>(std::max(0.0, std::ceil((x - radius) / map.cell - 0.5)));
            };
            for (std::size_t r = low(tip.y);
                 r < map.rows && (static_cast<double>(r) + 0.5) * map.cell <= tip.y + radius; ++r) {
                const double dy = (static_cast<double>(r) + 0.5) * map.cell - tip.y;
                for (std::size_t c = low(tip.x);
                     c < map.columns && (static_cast<double>(c) + 0.5) * map.cell <= tip.x + radius; ++c) {
                    const double dx = (static_cast<double>(c) + 0.5) * map.cell - tip.x;
                    const double square = radius * radius - dx * dx - dy * dy;
                    if (square < 0) continue;
                    float& z = map.height[r * map.columns + c];
                    z = std::min(z, static_cast<float>(tip.z + radius - std::sqrt(square)));
                }
            }
        });
    }
    return map;
}

std::vector<SurfacePoint> surface_points(const TriangleMesh& mesh, const HeightField& map, double spacing) {
    std::vector<SurfacePoint> points;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 area = rotate(map.piece_in_field, area_vector(mesh, t));
        if (area.z <= 1e-3 * norm(area)) continue;
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = apply(map.piece_in_field, mesh.points[mesh.triangles[t][k]]);
        const double longest = std::max({norm(p[1] - p[0]), norm(p[2] - p[0]), norm(p[2] - p[1])});
        const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                const Vec3 at = p[0] + (i + 1.0 / 3) / n * (p[1] - p[0]) + (j + 1.0 / 3) / n * (p[2] - p[0]);
                points.push_back({at, normalized(area), norm(area) / (0.5 * n * (n + 1))});
            }
        }
    }
    return points;
}

double foam_over(const HeightField& remaining, const SurfacePoint& point, double most) {
    for (double far = 0; far < most; far += 0.02) {
        const Vec3 p = point.at + far * point.normal;
        const auto c = static_cast<std::ptrdiff_t>(std::floor(p.x / remaining.cell));
        const auto r = static_cast<std::ptrdiff_t>(std::floor(p.y / remaining.cell));
        if (c < 0 || r < 0 || c >= static_cast<std::ptrdiff_t>(remaining.columns) ||
            r >= static_cast<std::ptrdiff_t>(remaining.rows))
            return far;
        if (static_cast<double>(remaining.at(static_cast<std::size_t>(c), static_cast<std::size_t>(r))) <= p.z)
            return far;
    }
    return most;
}

double deepest_gouge(const std::vector<Pass>& passes, const CuttingTool& tool, const std::vector<SurfacePoint>& points,
                     const HeightField& frame) {
    const double radius = 0.5 * tool.diameter;
    const auto columns = static_cast<std::size_t>(static_cast<double>(frame.columns) * frame.cell / radius) + 3;
    const auto rows = static_cast<std::size_t>(static_cast<double>(frame.rows) * frame.cell / radius) + 3;
    std::vector<std::vector<Vec3>> grid(columns * rows);
    const auto index = [&](double x, std::size_t count) {
        return std::min(static_cast<std::size_t>(std::max(0.0, x / radius + 1)), count - 1);
    };
    for (const SurfacePoint& p : points) grid[index(p.at.y, rows) * columns + index(p.at.x, columns)].push_back(p.at);
    std::vector<double> deepest(passes.size(), -radius);
    parallel_for(0, passes.size(), [&](std::size_t i) {
        for_each_tip(passes[i], 0.25 * frame.cell, [&](Vec3 tip) {
            const std::size_t c = index(tip.x, columns);
            const std::size_t r = index(tip.y, rows);
            for (std::size_t y = r > 0 ? r - 1 : 0; y <= std::min(r + 1, rows - 1); ++y) {
                for (std::size_t x = c > 0 ? c - 1 : 0; x <= std::min(c + 1, columns - 1); ++x) {
                    for (const Vec3& p : grid[y * columns + x]) {
                        Vec3 away = p - (tip + Vec3{0, 0, radius});
                        if (away.z > 0) away.z = 0;  // the shank is as wide
                        deepest[i] = std::max(deepest[i], radius - norm(away));
                    }
                }
            }
        });
    });
    return deepest.empty() ? -radius : *std::max_element(deepest.begin(), deepest.end());
}

double length_of(const std::vector<Pass>& passes) {
    double sum = 0;
    for (const Pass& pass : passes) {
        for (std::size_t i = 1; i < pass.points.size(); ++i) sum += norm(pass.points[i].tip - pass.points[i - 1].tip);
    }
    return sum;
}

std::size_t points_of(const std::vector<Pass>& passes) {
    std::size_t sum = 0;
    for (const Pass& pass : passes) sum += pass.points.size();
    return sum;
}

}  // namespace qchopper::test_pieces

// Edge functions over the samples of each triangle's box (Pineda, "A parallel algorithm for polygon rasterization",
// 1988), in double; depth and triangle compete as one 64-bit number by an atomic minimum, so that the result does not
// depend on the order. O(triangles + samples of their boxes); 8 bytes a sample.
// Not by cells_under.h: an edge counts for both of its triangles, so that no sample between them stays empty.

#include "segment/picture/film.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

struct ScreenPoint {
    double x = 0;  // in samples: sample centres are at whole numbers
    double y = 0;
    double depth = 0;  // mm
};

class Rasteriser {
 public:
    Rasteriser(Film& film, const Camera& camera) : film_(film), camera_(camera) {}

    ScreenPoint screen(Vec3 p) const {
        const Vec3 from = p - camera_.origin;
        return {dot(camera_.right, from) / film_.mm_per_sample + 0.5 * static_cast<double>(film_.width) - 0.5,
                -dot(camera_.up, from) / film_.mm_per_sample + 0.5 * static_cast<double>(film_.height) - 0.5,
                dot(camera_.forward, from)};
    }

    void draw(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, std::uint32_t triangle) {
        const double left = std::ceil(std::max(0.0, std::min({a.x, b.x, c.x})));
        const double right = std::floor(std::min(static_cast<double>(film_.width) - 1, std::max({a.x, b.x, c.x})));
        const double top = std::ceil(std::max(0.0, std::min({a.y, b.y, c.y})));
        const double bottom = std::floor(std::min(static_cast<double>(film_.height) - 1, std::max({a.y, b.y, c.y})));
        if (left > right || top > bottom) return;
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) return;  // seen edge on
        const double to_b = ((b.depth - a.depth) * (c.y - a.y) - (c.depth - a.depth) * (b.y - a.y)) / area;
        const double to_c = ((c.depth - a.depth) * (b.x - a.x) - (b.depth - a.depth) * (c.x - a.x)) / area;
        const double nearest = std::min({a.depth, b.depth, c.depth});
        const double farthest = std::max({a.depth, b.depth, c.depth});
        const double sign = area > 0 ? 1 : -1;
        for (double y = top; y <= bottom; ++y) {
            const auto [first, last] = span(a, b, c, y);
            for (double x = std::max(left, first); x <= std::min(right, last); ++x) {
                const bool is_inside = sign * ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) >= 0 &&
                                       sign * ((c.x - b.x) * (y - b.y) - (c.y - b.y) * (x - b.x)) >= 0 &&
                                       sign * ((a.x - c.x) * (y - c.y) - (a.y - c.y) * (x - c.x)) >= 0;
                if (!is_inside) continue;
                // Clamped, because the slope of a triangle seen nearly edge on is all rounding.
                const double depth = std::clamp(a.depth + to_b * (x - a.x) + to_c * (y - a.y), nearest, farthest);
                take(static_cast<std::size_t>(x), static_cast<std::size_t>(y), static_cast<float>(depth), triangle);
            }
        }
    }

 private:
    // Whole numbers around the part of a row that the triangle can cover: thin triangles fill little of their box.
    static std::pair<double, double> span(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, double y) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        const auto meet = [&](const ScreenPoint& p, const ScreenPoint& q) {
            if ((p.y < y && q.y < y) || (p.y > y && q.y > y)) return;
            const double x = p.y == q.y ? q.x : p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
            low = std::min({low, x, p.y == q.y ? p.x : x});
            high = std::max({high, x, p.y == q.y ? p.x : x});
        };
        meet(a, b);
        meet(b, c);
        meet(c, a);
        constexpr double rounding = 1e-6;
        return {std::ceil(low - rounding), std::floor(high + rounding)};
    }

    void take(std::size_t x, std::size_t y, float depth, std::uint32_t triangle) {
        const std::uint64_t mine = static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(depth)) << 32 | triangle;
        const std::atomic_ref sample(film_.seen[y * film_.width + x]);
        std::uint64_t there = sample.load(std::memory_order_relaxed);
        while (mine < there && !sample.compare_exchange_weak(there, mine, std::memory_order_relaxed)) {
        }
    }

    Film& film_;
    const Camera& camera_;
};

}  // namespace

float Film::depth(std::uint64_t sample) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(sample >> 32));
}

Vec3 Film::start(const Camera& camera, std::size_t x, std::size_t y) const {
    const double right = static_cast<double>(x) + 0.5 - 0.5 * static_cast<double>(width);
    const double down = static_cast<double>(y) + 0.5 - 0.5 * static_cast<double>(height);
    return camera.origin + (mm_per_sample * right) * camera.right - (mm_per_sample * down) * camera.up;
}

Film rasterised(std::span<const ColouredMesh> meshes, const Camera& camera, const PictureOptions& options) {
    const auto fine = static_cast<std::size_t>(options.supersampling);
    Film film{static_cast<std::size_t>(options.width) * fine,
              static_cast<std::size_t>(options.height) * fine,
              camera.mm_per_pixel / options.supersampling,
              {}};
    film.seen.assign(film.width * film.height, Film::nothing);
    Rasteriser rasteriser(film, camera);
    std::size_t before = 0;  // triangles of the meshes before
    for (const ColouredMesh& one : meshes) {
        const TriangleMesh& mesh = *one.mesh;
        std::vector<ScreenPoint> screen(mesh.points.size());
        parallel_ranges(0, screen.size(), 1 << 14, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) screen[i] = rasteriser.screen(mesh.points[i] + one.shift);
        });
        parallel_ranges(0, mesh.triangles.size(), 1 << 12, [&](std::size_t first, std::size_t end) {
            for (std::size_t t = first; t < end; ++t) {
                const Triangle& v = mesh.triangles[t];
                rasteriser.draw(screen[v[0]], screen[v[1]], screen[v[2]], static_cast<std::uint32_t>(before + t));
            }
        });
        before += mesh.triangles.size();
    }
    return film;
}

}  // namespace qchopper

// Interleaved sampling (Keller and Heidrich, "Interleaved sampling", 2001) of the hemisphere, smoothed by a filter that
// stops at edges of the surface (Tomasi and Manduchi, "Bilateral filtering for gray and color images", 1998).
// Directions follow Roberts' R2 sequence. O(pixels / 4 x rays); 100 bytes per four pixels.

#include "segment/picture/ambient.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace qchopper {
namespace {

double fraction(double x) {
    return x - std::floor(x);
}

std::array<Vec3, 2> around(Vec3 n) {
    const Vec3 aside = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 first = normalized(cross(n, aside));
    return {first, cross(n, first)};
}

// Sixteen turns that fill the square evenly, in an order in which neighbours in the picture differ much.
std::array<double, 2> turn_of(std::size_t column, std::size_t row) {
    constexpr std::array<int, 16> order{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};  // Bayer 1973
    const int i = order[4 * (row % 4) + column % 4];
    return {(i + 0.5) / 16, fraction(0.5 + i * 0.5698402909980532)};
}

}  // namespace

double sky_light(const Scene& scene, const SurfacePoint& point, Vec3 up, int rays, std::array<double, 2> turn) {
    constexpr int most = 64;
    assert(rays >= 1 && rays <= most);
    const double far = 0.5 * scene.diagonal();
    const auto [first, second] = around(point.normal);
    std::array<Vec3, most> directions;
    std::array<float, most> distance{};
    for (int i = 0; i < rays; ++i) {
        const double angle = 2 * std::numbers::pi * fraction(turn[0] + i * 0.7548776662466927);
        const double b = (i + turn[1]) / rays;  // one ray in every ring of equal weight
        const double out = std::sqrt(b);
        const Vec3 direction = out * std::cos(angle) * first + out * std::sin(angle) * second +
                               std::sqrt(std::max(0.0, 1 - b)) * point.normal;
        const double under = dot(direction, point.face_normal);
        directions[i] = under < 0 ? direction - 2 * under * point.face_normal : direction;
    }
    for (int i = 0; i < rays; i += RayScene::max_rays) {
        const auto n = static_cast<std::size_t>(std::min<int>(rays - i, RayScene::max_rays));
        scene.distances(point, std::span(directions).subspan(i, n), far, std::span(distance).subspan(i, n));
    }
    double light = 0;
    for (int i = 0; i < rays; ++i) {
        const double sky = 0.72 + 0.28 * dot(directions[i], up);
        // What stands far off hides less; what stands near still throws some light back.
        light += sky * (0.12 + 0.88 * std::sqrt(std::min(1.0, distance[i] / far)));
    }
    return light / rays;
}

AmbientLight::AmbientLight(const Scene& scene, const Film& film, const Camera& camera, const PictureOptions& options,
                           const std::function<void(std::size_t, std::size_t)>& on_rows)
    : scene_(scene),
      film_(film),
      camera_(camera),
      rays_(options.ambient_rays),
      side_(2 * static_cast<std::size_t>(options.supersampling)),
      columns_((film.width + side_ - 1) / side_),
      rows_((film.height + side_ - 1) / side_),
      cells_(columns_ * rows_) {
    if (rays_ == 0) return;
    constexpr std::size_t band = 16;
    for (std::size_t top = 0; top < rows_; top += band) {
        const std::size_t bottom = std::min(rows_, top + band);
        parallel_for(top, bottom, [&](std::size_t row) {
            for (std::size_t column = 0; column < columns_; ++column) {
                cells_[row * columns_ + column] = sampled(column, row);
            }
        });
        on_rows(bottom, rows_);
    }
    parallel_for(0, rows_, [&](std::size_t row) {
        for (std::size_t column = 0; column < columns_; ++column) {
            cells_[row * columns_ + column].smooth = smoothed(column, row);
        }
    });
}

// Seen at the sample in the middle of the cell, or at the first of its samples that sees anything.
AmbientLight::Cell AmbientLight::sampled(std::size_t column, std::size_t row) const {
    const std::size_t left = column * side_;
    const std::size_t top = row * side_;
    std::size_t x = std::min(left + side_ / 2, film_.width - 1);
    std::size_t y = std::min(top + side_ / 2, film_.height - 1);
    for (std::size_t i = 0; film_.at(x, y) == Film::nothing && i < side_ * side_; ++i) {
        x = std::min(left + i % side_, film_.width - 1);
        y = std::min(top + i / side_, film_.height - 1);
    }
    Cell cell;
    const std::uint64_t sample = film_.at(x, y);
    if (sample == Film::nothing) return cell;
    const Vec3 at = film_.start(camera_, x, y) + static_cast<double>(Film::depth(sample)) * camera_.forward;
    cell.is_seen = true;
    cell.point = scene_.surface(Film::triangle(sample), at, camera_.forward);
    cell.light = static_cast<float>(sky_light(scene_, cell.point, camera_.up, rays_, turn_of(column, row)));
    return cell;
}

bool AmbientLight::is_alike(const Cell& cell, const SurfacePoint& point) const {
    if (!cell.is_seen || cell.point.region != point.region) return false;
    const double cell_mm = film_.mm_per_sample * static_cast<double>(side_);
    return dot(cell.point.normal, point.normal) > 0.85 &&
           std::abs(dot(cell.point.at - point.at, point.normal)) < 1.5 * cell_mm &&
           dot(cell.point.at - point.at, cell.point.at - point.at) < 36 * cell_mm * cell_mm;
}

// The mean over five by five cells, of which the outer ones count half: every one of the sixteen turns weighs the same.
float AmbientLight::smoothed(std::size_t column, std::size_t row) const {
    const Cell& own = cells_[row * columns_ + column];
    if (!own.is_seen) return 0;
    constexpr std::array<double, 5> weight{0.5, 1, 1, 1, 0.5};
    double sum = 0;
    double weights = 0;
    for (std::size_t dy = 0; dy < 5; ++dy) {
        for (std::size_t dx = 0; dx < 5; ++dx) {
            const std::size_t x = column + dx - 2;  // wraps around below 0, and is too large then
            const std::size_t y = row + dy - 2;
            if (x >= columns_ || y >= rows_) continue;
            const Cell& other = cells_[y * columns_ + x];
            if (!is_alike(other, own.point)) continue;
            sum += weight[dx] * weight[dy] * other.light;
            weights += weight[dx] * weight[dy];
        }
    }
    return static_cast<float>(weights > 0 ? sum / weights : own.light);
}

double AmbientLight::at(std::size_t x, std::size_t y, const SurfacePoint& point) const {
    if (rays_ == 0) return 0.7;
    const auto side = static_cast<double>(side_);
    const double column = (static_cast<double>(x) + 0.5) / side - 0.5;
    const double row = (static_cast<double>(y) + 0.5) / side - 0.5;
    const auto left = static_cast<std::ptrdiff_t>(std::floor(column));
    const auto top = static_cast<std::ptrdiff_t>(std::floor(row));
    double sum = 0;
    double weights = 0;
    for (std::ptrdiff_t j = top; j <= top + 1; ++j) {
        for (std::ptrdiff_t i = left; i <= left + 1; ++i) {
            if (i < 0 || j < 0 || i >= static_cast<std::ptrdiff_t>(columns_) ||
                j >= static_cast<std::ptrdiff_t>(rows_)) {
                continue;
            }
            const Cell& cell = cells_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
            if (!is_alike(cell, point)) continue;
            const double weight =
                (1 - std::abs(column - static_cast<double>(i))) * (1 - std::abs(row - static_cast<double>(j))) + 1e-3;
            sum += weight * cell.smooth;
            weights += weight;
        }
    }
    if (weights > 0.02) return sum / weights;
    return sky_light(scene_, point, camera_.up, 2 * rays_, {0.5, 0.5});  // a surface that no cell saw
}

}  // namespace qchopper

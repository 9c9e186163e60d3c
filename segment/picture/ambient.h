// Ambient light: how much of the sky every visible point sees.
//
// Computed at half the resolution of the picture with few rays a point; the directions of neighbouring points differ in
// a pattern of four by four, so that the mean over such a square, which stops at edges, is that of sixteen times as
// many rays. 0 dark, 1 open to a sky of brightness 1 (tests/segment/picture/ambient_test.cpp: against many rays at
// every point).

#pragma once

#include <array>
#include <functional>
#include <vector>

#include "segment/picture/film.h"
#include "segment/picture/scene.h"

namespace qchopper {

// Share of the sky that the point sees by `rays` rays (at most 64), weighted with the cosine, brighter above. The
// directions are a stratified set turned by `turn`, two numbers in [0, 1).
double sky_light(const Scene& scene, const SurfacePoint& point, Vec3 up, int rays, std::array<double, 2> turn);

class AmbientLight {
 public:
    // on_rows(rows done, rows in all) is called from this thread now and then.
    AmbientLight(const Scene& scene, const Film& film, const Camera& camera, const PictureOptions& options,
                 const std::function<void(std::size_t, std::size_t)>& on_rows);

    // At a sample of the film, whose surface is `point`.
    double at(std::size_t x, std::size_t y, const SurfacePoint& point) const;

 private:
    struct Cell {
        SurfacePoint point;
        float light = 0;
        float smooth = 0;
        bool is_seen = false;
    };
    Cell sampled(std::size_t column, std::size_t row) const;
    float smoothed(std::size_t column, std::size_t row) const;
    // Whether the light of a cell serves a point: the same surface goes on between them.
    bool is_alike(const Cell& cell, const SurfacePoint& point) const;

    const Scene& scene_;
    const Film& film_;
    const Camera& camera_;
    int rays_ = 0;
    std::size_t side_ = 1;  // of a cell, in samples
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
    std::vector<Cell> cells_;  // row by row
};

}  // namespace qchopper

// A pass is looked at in samples half a cell of the foam's map apart; squares of cells tell of most of them that they
// are free. O(cells + length / cell * (radius / cell)^2) at most.

#include "cam/toolpath/clipped_passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "cam/stock/cl_surface.h"
#include "cam/toolpath/pass_stretches.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double square = 8;       // cells of foam on each side
constexpr float rounding = 1e-3F;  // mm, of heights in single precision
// A ball whose centre is so much less than a radius beyond a sawn face still touches skin beside its rim.
constexpr double inside_sawn_face = 0.3;  // mm
constexpr double sawn_step = 0.5;         // mm, between points of passes that are asked

// None is short, and none is near to another or to an end of the pass: short parts would be milled never, not even when
// all foam is gone.
std::vector<Stretch> without_short_parts(const std::vector<Stretch>& blocked, double length) {
    std::vector<Stretch> wide;
    for (const Stretch& own : blocked) {
        const double more = std::max(0.0, 0.5 * (min_part - (own.to - own.from)));
        Stretch next{own.from - more, own.to + more};
        if (next.from < min_part) next.from = 0;
        if (length - next.to < min_part) next.to = length;
        if (!wide.empty() && next.from - wide.back().to < min_part) {
            wide.back().to = std::max(wide.back().to, next.to);
        } else {
            wide.push_back(next);
        }
    }
    return wide;
}

template <class IsFree>
ClippedPasses divided(const std::vector<Pass>& passes, double apart, const IsFree& is_free) {
    ClippedPasses parts;
    const auto add = [](std::vector<Pass>& to, Pass part) {
        if (length_of(part) > min_length) to.push_back(std::move(part));
    };
    for (const Pass& pass : passes) {
        const double length = length_of(pass);
        const std::vector<Stretch> blocked = without_short_parts(blocked_stretches(pass, apart, is_free), length);
        if (blocked.empty()) {
            add(pass.is_closed || length >= min_part ? parts.free : parts.blocked, pass);
            continue;
        }
        if (blocked[0].from <= 0 && blocked[0].to >= length) {
            add(parts.blocked, pass);
            continue;
        }
        PassCutter cutter(pass);
        for (const Stretch& own : blocked) {
            add(parts.free, cutter.up_to(own.from));
            add(parts.blocked, cutter.up_to(own.to));
        }
        add(parts.free, cutter.up_to(length + 1));
    }
    return parts;
}

// For squares of cells of foam, a height of the tip from which on neither the holder nor the flute is blocked anywhere
// in the square.
HeightField free_above(const MillingSpace& space, double radius, double flute) {
    const HeightField stock = coarser(space.centre_stock, square);
    HeightField free = coarser(space.holder_clearance_height, square);
    // From the middle of a square to a place in it, to a centre of a cell, and to the middle of its square.
    const HeightField highest = dilate_by_disc(stock, radius + std::numbers::sqrt2 * stock.cell);
    for (std::size_t i = 0; i < free.height.size(); ++i) {
        free.height[i] = std::max(free.height[i], highest.height[i] - static_cast<float>(flute) + rounding);
    }
    return free;
}

}  // namespace

ClippedPasses clipped(const std::vector<Pass>& passes, const MillingSpace& space, const CuttingTool& tool) {
    const double inner = std::max(0.0, 0.5 * tool.diameter - flute_rim);
    const HeightField free = free_above(space, inner, tool.flute_length);
    return divided(passes, 0.5 * space.stock.cell, [&](Vec3 p) {
        if (static_cast<double>(free.height_under(p.x, p.y)) <= p.z) return true;
        return static_cast<double>(space.holder_clearance_height.height_under(p.x, p.y)) <= p.z &&
               !is_dilation_above(space.centre_stock, p.x, p.y, inner, p.z + tool.flute_length);
    });
}

std::vector<Pass> near_surface(const std::vector<Pass>& passes, const HeightField& cl) {
    return divided(passes, touching,
                   [&](Vec3 p) { return static_cast<double>(dilation_at(cl, p.x, p.y, touching)) >= p.z - touching; })
        .free;
}

std::vector<Pass> clear_of_sawn_faces(const std::vector<Pass>& passes, const HeightField& map, const CuttingTool& tool,
                                      const Setup& setup) {
    if (setup.flush_caps.empty()) return passes;
    const BesideSawnFaces is_beside(setup, map, 0.5 * tool.diameter);
    return divided(passes, sawn_step, [&](Vec3 p) { return !is_beside(p); }).free;
}

BesideSawnFaces::BesideSawnFaces(const Setup& setup, const HeightField& map, double radius)
    : block_(setup.block_box()),
      flush_(setup.flush_faces()),
      map_in_setup_(setup.piece_in_setup * inverse(map.piece_in_field)),
      radius_(radius) {}

bool BesideSawnFaces::operator()(Vec3 tip) const {
    const std::array<double, block_faces> inside =
        inside_faces(block_, apply(map_in_setup_, tip + Vec3{0, 0, radius_}));
    for (std::size_t f = 0; f < block_faces; ++f) {
        if (flush_[f] && -inside[f] > radius_ - inside_sawn_face) return true;
    }
    return false;
}

}  // namespace qchopper

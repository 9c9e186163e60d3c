// The sweep of a single offset gives each side's best base and its area; then, per asked sample, the allowed directions
// of the scan, and if none opens it the dense ones until one does. Rows in parallel; sums are counts.

#include "segment/access/dense_access.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "segment/access/access_sweep.h"
#include "segment/access/sampled_piece.h"
#include "segment/access/tool_directions.h"

namespace qchopper {
namespace {

constexpr std::size_t max_asked = 1'000;
constexpr std::size_t rows_at_once = 16;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

// One side of a plane on one base.
struct Side {
    Plane plane;
    bool is_above = false;
    Vec3 up;  // of the base
    Vec3 outward() const { return is_above ? -plane.normal : plane.normal; }
    // How deep a point lies under the plane; negative: on the other side.
    double depth(Vec3 point) const {
        const double h = height(plane.normal, point) - plane.offset;
        return is_above ? h : -h;
    }
};

}  // namespace

struct DenseAccess::Asked {
    Asked(const Piece& of, double tilt)
        : piece(of),
          tilt_deg(tilt),
          judged(of.samples->judged()),
          sweep(of, tilt),
          rays(judged.scan, judged.accessibility),
          dense(dense_directions()),
          stride((judged.accessibility.sample.size() + max_asked - 1) / max_asked),
          distance(stride > 0 ? (judged.accessibility.sample.size() + stride - 1) / stride : 0) {}

    // Whether a ray that meets the piece after `t` leaves the side before.
    static bool is_open(const Side& side, double depth, Vec3 direction, float t) {
        if (std::isinf(t)) return true;
        const double along = dot(side.outward(), direction);
        return t > 0 && along > 0 && static_cast<double>(t) * along > depth;
    }

    // Open along a direction of the scan, or steep to one where that does not count.
    bool is_settled(const Side& side, std::size_t row, double depth, std::span<const std::uint32_t> allowed) const {
        const std::vector<Vec3>& directions = judged.scan.directions;
        const std::span<const float> t = judged.accessibility.distances(row);
        const Vec3 normal = judged.sample(row).normal;
        const bool is_steep_settled = tilt_deg < steep_counts_from_deg;
        const auto settles = [&](Vec3 d, float until) {
            return is_open(side, depth, d, until) || (is_steep_settled && std::abs(dot(normal, d)) < min_facing);
        };
        return std::any_of(allowed.begin(), allowed.end(),
                           [&](std::uint32_t k) { return settles(directions[k], t[k]); }) ||
               settles(side.up, rays.distance(row, side.up));
    }

    bool is_open_densely(const Side& side, std::size_t row, double depth, std::span<const std::uint32_t> allowed) {
        std::vector<float>& known = distance[row / stride];
        if (known.empty()) known.assign(dense.size(), unknown);
        return std::any_of(allowed.begin(), allowed.end(), [&](std::uint32_t k) {
            if (std::isnan(known[k])) known[k] = rays.distance(row, dense[k]);
            return is_open(side, depth, dense[k], known[k]);
        });
    }

    double opened_mm2(const Side& side) {
        const std::vector<std::uint32_t> allowed = allowed_directions(judged.scan.directions, side.up, tilt_deg);
        const std::vector<std::uint32_t> allowed_dense = allowed_directions(dense, side.up, tilt_deg);
        std::atomic<std::size_t> opened = 0;
        parallel_ranges(0, distance.size(), rows_at_once, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) {
                const std::size_t row = i * stride;
                const double depth = side.depth(judged.sample(row).point);
                if (depth < 0 || is_settled(side, row, depth, allowed)) continue;
                if (is_open_densely(side, row, depth, allowed_dense)) ++opened;
            }
        });
        return judged.scan.samples.area_each_mm2 * static_cast<double>(opened * stride);
    }

    double unreachable(const Plane& plane, bool is_above, std::span<const SideOnBase> bases) {
        const SideOnBase& best = best_base(bases);
        if (best.unreachable_mm2 <= 0) return 0;
        Side side{plane, is_above, is_above ? plane.normal : -plane.normal};
        for (const OwnedCap& cap : judged.caps) {
            if (cap.cut == best.cut) side.up = lying_on(cap).up;
        }
        return std::max(0.0, best.unreachable_mm2 - opened_mm2(side));
    }

    const Piece& piece;
    double tilt_deg;
    JudgedPiece judged;
    AccessSweep sweep;
    PieceRays rays;
    std::vector<Vec3> dense;
    std::size_t stride;
    std::vector<std::vector<float>> distance;  // per asked sample: empty, or per dense direction what is known
};

DenseAccess::DenseAccess(const Piece& piece, double tilt_deg) : asked_(std::make_unique<Asked>(piece, tilt_deg)) {}

DenseAccess::~DenseAccess() = default;

double DenseAccess::unreachable_mm2(const Plane& plane) {
    const PlaneAccess access = asked_->sweep.sweep(plane.normal, {&plane.offset, 1}).front();
    return asked_->unreachable(plane, true, access.above) + asked_->unreachable(plane, false, access.below);
}

}  // namespace qchopper

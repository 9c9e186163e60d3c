// Per sample the allowed directions in turn until one is open; samples in parallel, sums as counts, whatever the number
// of threads.

#include "segment/access/unreachable.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "segment/access/up_column.h"

namespace qchopper {
namespace {

constexpr std::size_t samples_at_once = 256;
constexpr double turned_away = -1e-9;  // the cosine between a cap that faces away and the direction is below this

}  // namespace

TiltBase lying_on(const OwnedCap& cap) {
    return {-cap.outward, cap.cut};
}

bool counts_as_surface(const OwnedCap& cap, const TiltBase& base) {
    return base.cut != cap.cut && std::find(base.flush.begin(), base.flush.end(), cap.cut) == base.flush.end();
}

bool is_out_of_reach(const OwnedCap& cap, const TiltBase& base, std::span<const Vec3> directions) {
    return counts_as_surface(cap, base) && std::all_of(directions.begin(), directions.end(), [&](const Vec3& d) {
               return dot(cap.outward, d) < turned_away;
           });
}

std::vector<OwnedCap> owned_caps(const Piece& piece) {
    std::vector<OwnedCap> caps;
    for (const HalfSpace& half_space : piece.half_spaces) caps.push_back({half_space.cut, -half_space.up(), 0});
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        const std::int32_t cut = cap_of(*piece.mesh, t);
        if (cut == no_cap) continue;
        const auto cap = std::find_if(caps.begin(), caps.end(), [&](const OwnedCap& c) { return c.cut == cut; });
        assert(cap != caps.end());
        cap->area_mm2 += dot(area_vector(*piece.mesh, t), cap->outward);
    }
    std::erase_if(caps, [](const OwnedCap& cap) { return cap.area_mm2 <= 0; });
    return caps;
}

double JudgedPiece::area_mm2() const {
    double area = scan.samples.area_each_mm2 * static_cast<double>(accessibility.sample.size());
    for (const OwnedCap& cap : caps) area += cap.area_mm2;
    return area;
}

double JudgedPiece::surface_mm2(const TiltBase& base) const {
    double area = area_mm2();
    for (const OwnedCap& cap : caps) area -= counts_as_surface(cap, base) ? 0 : cap.area_mm2;
    return area;
}

double projected_area_mm2(const JudgedPiece& piece, Vec3 up) {
    const UpColumn column(piece.scan, piece.accessibility, up);
    double sum = 0;
    for (std::size_t row = 0; row < piece.accessibility.sample.size(); ++row) {
        if (column.is_open(row)) sum += dot(piece.sample(row).normal, up);
    }
    double caps = 0;  // none is hidden along a direction that it faces
    for (const OwnedCap& cap : piece.caps) caps += cap.area_mm2 * std::max(0.0, dot(cap.outward, up));
    return piece.scan.samples.area_each_mm2 * sum + caps;
}

UnreachableArea unreachable_area(const JudgedPiece& piece, const TiltBase& base, double tilt_deg,
                                 std::span<const Vec3> further) {
    const std::vector<Vec3>& directions = piece.scan.directions;
    const std::vector<std::uint32_t> allowed = allowed_directions(directions, base.up, tilt_deg);
    const std::vector<std::uint32_t> allowed_further = allowed_directions(further, base.up, tilt_deg);
    const UpColumn up(piece.scan, piece.accessibility, base.up);
    std::optional<PieceRays> rays;
    if (!allowed_further.empty()) rays.emplace(piece.scan, piece.accessibility);
    std::atomic<std::size_t> hidden = 0;
    std::atomic<std::size_t> steep = 0;
    const auto judge = [&](std::size_t row) {
        const auto is_open = [&](std::uint32_t k) { return piece.accessibility.is_open(row, k); };
        const auto is_open_further = [&](std::uint32_t k) { return std::isinf(rays->distance(row, further[k])); };
        if (up.is_open(row) || std::any_of(allowed.begin(), allowed.end(), is_open) ||
            std::any_of(allowed_further.begin(), allowed_further.end(), is_open_further))
            return;
        const Vec3 normal = piece.sample(row).normal;
        const auto is_steep = [&](Vec3 d) { return std::abs(dot(normal, d)) < min_facing; };
        const auto is_steep_to = [&](std::uint32_t k) { return is_steep(directions[k]); };
        if (is_steep(base.up) || std::any_of(allowed.begin(), allowed.end(), is_steep_to))
            ++steep;
        else
            ++hidden;
    };
    parallel_ranges(0, piece.accessibility.sample.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t row = first; row < end; ++row) judge(row);
    });
    UnreachableArea result;
    result.hidden_mm2 = piece.scan.samples.area_each_mm2 * static_cast<double>(hidden);
    result.steep_mm2 = piece.scan.samples.area_each_mm2 * static_cast<double>(steep);
    std::vector<Vec3> with_up{base.up};
    for (const std::uint32_t k : allowed) with_up.push_back(directions[k]);
    for (const OwnedCap& cap : piece.caps) result.caps_mm2 += is_out_of_reach(cap, base, with_up) ? cap.area_mm2 : 0;
    return result;
}

}  // namespace qchopper

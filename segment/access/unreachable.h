// Which surface of a piece counts on a base, and what of it a tilting tool does not reach: hidden and steep surface,
// and caps that face away.
//
// mm2, on samples, for a tool of radius zero that comes out along any direction within a largest tilt of the base's up.
// Growing the tilt never makes it larger, steep surface counted throughout (tests/segment/access/unreachable_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "segment/access/accessibility.h"
#include "segment/access/tool_directions.h"

namespace qchopper {

// A cap of a piece: all that it owns of the plane of one cut.
struct OwnedCap {
    std::int32_t cut = 0;
    Vec3 outward;  // unit
    double area_mm2 = 0;
};
// One per half-space of which the piece owns a cap, in their order. O(triangles + half-spaces).
std::vector<OwnedCap> owned_caps(const Piece& piece);

// How a piece lies, and with it which of its caps are no surface that a tool has to reach.
struct TiltBase {
    Vec3 up{0, 0, 1};                      // unit
    std::optional<std::int32_t> cut;       // whose cap lies on the table, if any
    std::vector<std::int32_t> flush = {};  // whose caps are sawn faces of the block
};
TiltBase lying_on(const OwnedCap& cap);

// Whether the cap counts as surface when the piece lies on the base: all do but the one on the table and those that are
// sawn. Nothing else decides this for samples, chosen directions and the sweep.
bool counts_as_surface(const OwnedCap& cap, const TiltBase& base);
// Whether the cap counts and no tool that comes out along one of the directions (unit vectors) reaches it. Caps are
// flat and hide nothing of themselves: they need no rays.
bool is_out_of_reach(const OwnedCap& cap, const TiltBase& base, std::span<const Vec3> directions);

// The vertical walls of a piece are no undercut for a tool that hardly tilts: below this tilt steep surface does not
// count.
constexpr double steep_counts_from_deg = 15;
// Whether a piece can lie on a cap: on a tenth of its projected area at least.
constexpr bool carries(double cap_mm2, double projected_mm2) {
    return cap_mm2 >= 0.1 * projected_mm2;
}

struct UnreachableArea {
    double hidden_mm2 = 0;  // open along no allowed direction, and not steep
    double steep_mm2 = 0;   // open along none, but within min_facing of a right angle with an allowed one
    double caps_mm2 = 0;    // of caps that count and face away from all allowed directions
    double total_mm2(double tilt_deg) const {
        return hidden_mm2 + caps_mm2 + (tilt_deg < steep_counts_from_deg ? 0 : steep_mm2);
    }
};

// A piece as this judges it. All must outlive it.
struct JudgedPiece {
    const SampledScan& scan;
    const PieceAccessibility& accessibility;
    std::span<const OwnedCap> caps;
    const SurfaceSample& sample(std::size_t row) const { return scan.samples.sample[accessibility.sample[row]]; }
    double area_mm2() const;                         // its samples and its caps
    double surface_mm2(const TiltBase& base) const;  // of it what counts: shares of a piece are taken of this
};

// The sum of the areas of the samples that are open along `up` and of the caps that face it, projected on it.
double projected_area_mm2(const JudgedPiece& piece, Vec3 up);

// Allowed are `up`, the scan's directions within the tilt of it, and of `further` those within the tilt, along which
// only samples are asked that are open along none of the others. Rays are cast only for `further`, and for an up that
// is not a direction of the scan. O(samples x directions).
UnreachableArea unreachable_area(const JudgedPiece& piece, const TiltBase& base, double tilt_deg,
                                 std::span<const Vec3> further = {});

}  // namespace qchopper

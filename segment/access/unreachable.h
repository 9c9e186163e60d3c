// The area of a piece that a tilting tool does not reach: hidden and steep surface, and caps that face away.
//
// mm2, on samples, for a tool of radius zero that comes out along any direction within a largest tilt of the base's up.
// Growing the tilt never makes it larger, steep surface counted throughout (tests/segment/access/unreachable_test.cpp).

#pragma once

#include <array>
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

// How a piece lies: its up direction, and the cut whose cap lies on the table, if any.
struct TiltBase {
    Vec3 up{0, 0, 1};  // unit
    std::optional<std::int32_t> cut;
};

// Whether the cap is the base. It lies on the table then, and counts as no surface.
bool is_base(const OwnedCap& cap, const TiltBase& base);
// Whether a tool that comes out along the direction (a unit vector) does not reach the cap. Caps are flat and hide
// nothing of themselves: they need no rays.
bool faces_away(const OwnedCap& cap, Vec3 direction);

// The vertical walls of a piece are no undercut for a tool that hardly tilts: below this tilt steep surface does not
// count.
constexpr double steep_counts_from_deg = 15;
// Of the projected area: a smaller cap is no base.
constexpr double min_base_share = 0.1;

struct UnreachableArea {
    double hidden_mm2 = 0;  // open along no allowed direction, and not steep
    double steep_mm2 = 0;   // open along none, but within min_facing of a right angle with an allowed one
    double caps_mm2 = 0;    // of caps other than the base that face away from all allowed directions
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
    double area_mm2() const;                            // its samples and its caps
    double area_without_base_mm2(TiltBase base) const;  // what shares of a piece are taken of
};

// The sum of the areas of the samples that are open along `up` and of the caps that face it, projected on it.
double projected_area_mm2(const JudgedPiece& piece, Vec3 up);

// The caps that can be bases: area at least min_base_share of the projected area along their inward normal.
std::vector<TiltBase> bases_of(const JudgedPiece& piece);

// Allowed are `up`, the scan's directions within the tilt of it, and of `further` those within the tilt, along which
// only samples are asked that are open along none of the others. Rays are cast only for `further`, and for an up that
// is not a direction of the scan. O(samples x directions).
UnreachableArea unreachable_area(const JudgedPiece& piece, const TiltBase& base, double tilt_deg,
                                 std::span<const Vec3> further = {});

struct MinUnreachable {
    TiltBase base;
    UnreachableArea unreachable;
    double total_mm2 = 0;              // with or without steep surface, as the tilt wants
    double area_without_base_mm2 = 0;  // of the piece
    double share() const { return area_without_base_mm2 > 0 ? total_mm2 / area_without_base_mm2 : 0; }
};
// The base with the least total; the first of several. A piece without a base: the best of the six directions of
// `box_axes`, those of its own oriented box, as up.
MinUnreachable min_unreachable(const JudgedPiece& piece, const std::array<Vec3, 3>& box_axes, double tilt_deg,
                               std::span<const Vec3> further = {});

}  // namespace qchopper

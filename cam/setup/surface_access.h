// How much of a piece's surface the tool reaches from the directions of a setup, and what stays.
//
// Values only; mm, mm2, mm3. Shares are of skin and milled caps: of the piece's area without its base, without caps
// that are sawn faces of the block, and without surface that is ignored. Visibility is that of a tool of radius zero;
// what its radius leaves is told apart as too narrow, and as rest material.

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// Along which a setup is milled; the tool points the opposite way.
struct ToolOrientation {
    Vec3 tool_axis;           // unit, in piece coordinates, from the tip into the spindle
    double tilt_deg = 0;      // from the base's up
    double gained_share = 0;  // of the area, what it reaches and no direction before it does
    double depth_mm = 0;      // along it, from where the tool enters the block to the deepest surface that it reaches
    bool operator==(const ToolOrientation&) const = default;
};

enum class AccessMethod { sampled, mapped };  // by rays from samples of the surface; by height fields

// What becomes of one triangle or sample.
enum class SurfaceState : std::uint8_t {
    reached,
    too_narrow,  // in sight of a direction, but the ball of the smallest tool does not fit
    steep,       // within 3 degrees of a direction and reached from none
    holder,      // in sight, but holder or spindle would touch piece, spoil layer or table: the tool is too short
    hidden,
    ignored  // may stay as it is (TriangleMesh::ignored)
};

struct SurfaceAccess {
    AccessMethod method = AccessMethod::sampled;
    std::vector<ToolOrientation> orientations;  // the base's up first
    double area_mm2 = 0;                        // of skin and milled caps, without what is ignored
    double hidden_mm2 = 0;                      // caps that face away from all directions included
    double steep_mm2 = 0;
    double holder_mm2 = 0;
    double too_narrow_mm2 = 0;        // reached, but not by the ball
    double ignored_mm2 = 0;           // beside area_mm2
    bool steep_counts = true;         // false for a tool that hardly tilts (unreachable.h)
    bool narrow_counts = false;       // on request
    double all_directions_share = 0;  // unreachable with all directions that can be held; sampled; in the setup that is
                                      // taken with dense directions too
    double foam_mm3 = 0;              // that no tool of these directions removes; mapped only
    double foam_depth_mm = 0;         // largest height of it over a surface point, along the best direction; mapped
    double rest_material_mm3 = 0;     // that the smallest tool's radius leaves besides; mapped only
    std::optional<ToolOrientation> further;  // a further direction worth having
    // So much may stay out of reach whatever its share: what a small share of a small piece is. 0 where no block is
    // sawn.
    double allowed_mm2 = 0;
    bool is_arm_checked = false;  // whether the directions are held was asked of the arm

    double unreachable_mm2() const {
        return hidden_mm2 + holder_mm2 + (steep_counts ? steep_mm2 : 0) + (narrow_counts ? too_narrow_mm2 : 0);
    }
    // 0..1: sums that rounding makes a little larger than the area are no more than all of it.
    double unreachable_share() const { return area_mm2 > 0 ? std::min(1.0, unreachable_mm2() / area_mm2) : 0; }
    // Whether more is out of reach than may be.
    bool exceeds(double max_share) const { return unreachable_share() > max_share && unreachable_mm2() > allowed_mm2; }
    bool operator==(const SurfaceAccess&) const = default;
};

}  // namespace qchopper

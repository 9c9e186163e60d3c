// The joints of a segmentation: which pieces touch along which cut, and the dowels that hold them together.
//
// mm. A joint is two final pieces and the plane along which they touch: all contact regions together, each at least
// `min_mm2`. Its dowels are clear in both pieces (dowel_sites.h) and of the pieces' other holes; a pattern of two or
// more cannot be turned, and no two joints have patterns alike (dowel_pattern.h) unless the joint says so. Two equal
// dowels alone never appear (tests/segment/joint/piece_joints_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/joint/dowel.h"
#include "segment/joint/flat_region.h"

namespace qchopper {

struct JointSettings {
    std::vector<DowelSize> sizes = default_dowels();
    double play = default_dowel_play;
    double min_mm2 = 400;      // of a contact region
    std::size_t sites = 1500;  // about so many points of a contact are tried, up to 16 times as many in thin walls
};

enum class JointFault {
    none,
    can_be_swapped,  // another joint has the same pattern within the tolerance
    can_be_turned,   // there is room for one dowel only
    no_dowel
};

struct PieceJoint {
    std::int32_t cut = 0;
    Plane plane;
    std::size_t below = 0;  // indices of pieces
    std::size_t above = 0;
    FlatRegion contact;
    std::vector<Dowel> dowels;
    JointFault fault = JointFault::no_dowel;
    std::optional<std::size_t> alike = {};  // the joint that it can be swapped with
};

// Without dowels; in the order of the cuts, then of the pieces below and above. O(cap triangles of all pairs).
std::vector<PieceJoint> contacts_of(std::span<const Piece> pieces, double min_mm2);

// With dowels. Sites are searched on several threads; the result does not depend on their number. Joints with little
// room choose first. Reports progress in joints. Throws Cancelled.
std::vector<PieceJoint> piece_joints(std::span<const Piece> pieces, const JointSettings& settings,
                                     const Context& context = {});

// "joint A-B (cut 3, 12.5 cm2): no dowel fits", for people; empty for a joint without fault.
std::string describe_fault(const PieceJoint& joint, std::span<const Piece> pieces, std::span<const PieceJoint> joints);
// "A-B (cut 3)": the piece below, then the one above.
std::string joint_name(const PieceJoint& joint, std::span<const Piece> pieces);

}  // namespace qchopper

// The order in which the pieces of a segmentation are joined again: steps that need no force and no second way.
//
// mm. The cuts are undone, the last one first. The solids that a cut parted, each whole by then, are joined by straight
// moves along its normal: the plane separates the two sides, and all dowels of the plane are parallel to the move. Of
// several solids on one side those nearer the plane go first; solids that are each in front of the other interlock, and
// move together (tests/segment/joint/assembly_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/joint/piece_joints.h"
#include "segment/search/segmentation.h"

namespace qchopper {

struct AssemblyStep {
    std::int32_t cut = 0;               // that is undone
    std::vector<std::size_t> moved;     // indices of pieces, ascending; they are joined to each other
    std::vector<std::size_t> standing;  // those that stand already, ascending
    std::size_t solids = 1;             // that move; more than one: they interlock and move together
    Vec3 direction;                     // unit vector of the move
    double distance_mm = 0;             // of the move, from where nothing touches
    std::vector<std::size_t> joints;    // indices of the joints that the step closes
    bool is_clear = false;              // nothing is in the way; dowels stand in the pieces that do not move
    bool operator==(const AssemblyStep&) const = default;
};

struct Assembly {
    std::vector<AssemblyStep> steps;  // in the order in which they are made
};

// `joints` are those of the pieces. A discarded piece is left out. O(cuts x solids squared) tests of pairs of solids on
// one side of a cut, each of O(triangles that lie over each other). Reports progress in cuts. Throws Cancelled.
Assembly assembly_of(const Segmentation& segmentation, std::span<const PieceJoint> joints, const Context& context = {});

// Where a piece is at a time: beside its place by `shift`, linear between.
struct AssemblyKey {
    double time_s = 0;
    Vec3 shift;
};

// Per piece the keys of an animation in which step i takes the second from i to i + 1; empty for a piece that never
// moves. The last key of a piece is its place.
std::vector<std::vector<AssemblyKey>> assembly_keys(const Assembly& assembly, std::size_t pieces);

}  // namespace qchopper

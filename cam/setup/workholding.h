// Whether tape or glue, and the foam near the base, hold a piece against the cutting force.
//
// mm, mm2, mm3, N, N/mm2; values only, in setup coordinates. What stands at the end of finishing, the weakest state:
// the block's spoil layer, held by its whole underside, and on it the piece, joined by its base, with the foam that no
// tool of its directions removes. The cutting force F acts sideways in any direction at the highest point of the piece,
// at the height h over its base. Three conditions:
//
// 1. The joint with the table. The thin spoil layer bends, so tension reaches the tape or glue only near the base: in a
//    footprint that is the base spread at 45 degrees through the layer, by its thickness t, but not beyond the block.
//    Of the base's section with modulus W and its farthest point at r from the centroid, the spread contains the
//    section scaled by k = 1 + t / r, of modulus k^3 W; of a disc it is that. Stress is linear over it (eccentric load:
//    J. M. Gere and S. P. Timoshenko, "Mechanics of Materials", 4th ed. 1997, sections 5.5 and 5.12), so the joint
//    parts at F = s k^3 W / (h + t) for tape or glue of strength s. Before roughing the whole block stands on its
//    underside; a high one may be the worse state, and the lesser force counts.
// 2. Bending. At a height z the section carries F (h - z) and breaks at F = b W(z) / (h - z): b is the bending
//    strength of the foam (the flexure formula, Gere and Timoshenko, equation 5-14). The least over sections up to a
//    third of the height counts; the one at z = 0 is the base. Shear, F / A, is the larger stress only where h - z is
//    less than a sixth of the width, and such a piece breaks nowhere: it is not computed.
// 3. Slenderness, for what bends and sings before it breaks: h over the smallest width of the base.
//
// W is that of the weakest direction of the force: with the second moments J about the centroid, the stress at a point
// p under a moment M of any direction is at most M |J^-1 p|; 1 / W is the largest |J^-1 p| of the section. The weight
// of the foam is left out. Shape of the sections: standing_sections.h (tests/cam/setup/workholding_test.cpp).

#pragma once

#include <optional>
#include <string>

#include "cam/cell/cell.h"

namespace qchopper {

// A square block of foam that is left around the lowest part of a piece, on the spoil layer, until it is milled.
struct HoldingStand {
    double top = 0;   // above the base plane; from there on the piece holds itself
    double side = 0;  // of the square
    double x = 0;     // of its middle
    double y = 0;
    bool operator==(const HoldingStand&) const = default;
};

struct Workholding {
    Holding holding;                         // of the cell file
    double foam_strength = 0;                // of the block, in bending
    double height = 0;                       // h
    double base_mm2 = 0;                     // area that joins the piece to the spoil layer
    double base_width = 0;                   // the smallest
    double joint_force = 0;                  // at which tape or glue part
    double foam_force = 0;                   // at which the foam breaks at its narrowest section near the base
    double narrowest_z = 0;                  // of that section
    double narrowest_mm2 = 0;                // of that section
    std::optional<HoldingStand> stand = {};  // with which it is held; nothing: none is needed or helps
    bool operator==(const Workholding&) const = default;

    bool joint_holds() const { return joint_force >= holding.cutting_force; }
    bool foam_holds() const { return foam_force >= holding.cutting_force; }
    bool is_stout() const { return height <= holding.max_slenderness * base_width; }
    bool passes() const { return joint_holds() && foam_holds() && is_stout(); }
};

// "the tape or glue parts at 3 N, for a cutting force of 20 N; ...": what does not hold. Empty if it passes.
std::string workholding_problem(const Workholding& check);

// What can be done about it, as one sentence without a full stop. Empty if it passes.
std::string workholding_remedy(const Workholding& check);

}  // namespace qchopper

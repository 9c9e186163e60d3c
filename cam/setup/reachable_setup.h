// Takes the setup of a piece at which the machine holds every pose of its milling: the remedies that go beyond one
// place.
//
// Where the best setup is not held wherever its block stands (place_block.h), the piece is laid on another base, then
// milled from other directions. Pure functions; the result does not depend on the number of threads
// (tests/cam/setup/reachable_setup_test.cpp).

#pragma once

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/placement/machine_reachability.h"
#include "segment/cut/piece.h"

namespace qchopper {

struct ReachableSetup {
    SetupChoice choice;                // with the setup that is taken first, its placement filled in
    MachineReachability reachability;  // of that setup; its remedy names base or directions if these were needed
};

struct ReachableSetupOptions {
    SetupOptions setup;          // with what `choice` was chosen
    double max_unreachable = 1;  // a base that leaves a larger share out of reach, and more than the best, comes last
};

// In their order are tried: the best setup at any place of its block; the other bases, unless the operator ordered one;
// and directions that are held, of each base in the same order: those that are not held are left out and others chosen
// in their place, twice, then left out without others. Where nothing helps, the best setup is handed back with what
// refuses its first direction.
// A cell without a machine is not checked, nor a piece whose block does not fit into the cell: the choice is handed
// back.
//
// Precondition: `choice` is choose_setup() of the same piece, cell and options. Throws what place_block() throws.
ReachableSetup reachable_setup(const Piece& piece, SetupChoice choice, const Cell& cell,
                               const ReachableSetupOptions& options = {}, const Context& context = {});

}  // namespace qchopper

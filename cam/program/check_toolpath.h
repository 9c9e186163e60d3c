// Refuses a toolpath that no machine may run: empty, not finite, too far, or outside of the windows of its tools.

#pragma once

#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// No coordinate may be farther than 5 m from the origin. Throws InputError (use) that names operation, run and move.
// Precondition: the cell has a machine. O(moves).
void check_toolpath(const Toolpath& toolpath, const Setup& setup, const Cell& cell);

}  // namespace qchopper

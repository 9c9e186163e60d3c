// The toolpath of a setup with the tools of a cell (toolpath.h).
//
// mm. Roughing of all directions comes first, then finishing of all, then fine finishing, so that each tool is taken
// once; within a tool directions come in the order of the setup. Before finishing, its tool clears where the tool of
// the roughing was too thick, and so does that of the fine finishing. All is judged against the foam that stands at
// that time (in_process_stock.h): passes of finishing that foam blocks are taken up again in rounds over the
// directions, until a round mills nothing. Surface under passes that stay blocked is then left to the other
// directions. The result does not depend on the number of threads (tests/cam/toolpath/make_toolpath_test.cpp).

#pragma once

#include <functional>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "cam/stock/in_process_stock.h"
#include "cam/toolpath/toolpath.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Height along a direction, in setup coordinates, in which the tool comes and goes (milling_poses.h): `clearance` above
// all of the block.
double retract_height(const Setup& setup, Vec3 tool_axis, double clearance);

// Asked after each operation with those so far, in their order; what it throws ends the work.
using OperationCheck = std::function<void(const std::vector<Operation>& so_far)>;

// At least one operation. `left`, if given, becomes the foam that stands afterwards. Reports operations done; can be
// cancelled. Preconditions: the mesh is that of the piece, and setup.access.orientations is not empty. Throws
// InputError: config if the cell has no machine or no tool for it, use if a setting is not valid, if maps would have
// too many cells, or if no operation has anything to cut.
Toolpath make_toolpath(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                       const ToolpathSettings& settings = {}, const Context& context = {},
                       InProcessStock* left = nullptr, const OperationCheck& check = {});

}  // namespace qchopper

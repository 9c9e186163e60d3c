// Which of the tools that may finish a piece are worth being changed in.
//
// mm, seconds. Where a large ball leaves no more than the scallop height, a smaller one would take longer; a tool that
// finishes little costs its change. Judged in maps with cells of half a millimetre, before anything is milled.
// tests/cam/toolpath/worthwhile_tools_test.cpp.

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// What the tools left out add together is less than this share of the surface.
constexpr double worthwhile_share = 0.003;

// Of `tools`, in the order of ToolChoice::finishing, those that shorten the work, and of the smallest ones those that
// add worthwhile_share or more; at least one, and all with FineTools::all. Preconditions: as of make_toolpath().
// O(tools * directions * cells).
std::vector<std::size_t> worthwhile_tools(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                          const std::vector<std::size_t>& tools, const ToolpathSettings& settings,
                                          const Context& context);

}  // namespace qchopper

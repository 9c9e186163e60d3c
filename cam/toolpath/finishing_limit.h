// How deep the tip of a finishing tool may go over foam, so that holder and spindle stay clear of it and the flute cuts
// all that is in its way.
//
// mm. Maps of one direction that share their frame: limits have the cells of foam, tip surfaces narrower ones.

#pragma once

#include "cam/cell/carving_tool.h"
#include "cam/setup/holder_limit.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/links.h"
#include "segment/raster/height_map.h"

namespace qchopper {

// From foam at the middles of cells of a size.
HolderGap finishing_gap(const Setup& setup, double foam_cell);

// Over the piece, a map of its highest points, with so much foam on it as finishing leaves: passes that go deeper stay
// blocked whatever else is carved. O(cells * widest radius / cell).
HeightMap limit_over_finished(HeightMap piece, double foam_left, const ToolBody& body, const HolderGap& gap);

// Over foam that stands at the middles of cells, flute included. Cost as above.
HeightMap limit_over_foam(const HeightMap& middle_foam, const CarvingTool& tool, const ToolBody& body,
                          const HolderGap& gap);

// Raises a tip surface, so that no straight line between the middles of neighbouring cells lies below the limit
// (tests/cam/toolpath/passes_and_links_test.cpp). O(cells).
void raise_to_limit(HeightMap& tip, const HeightMap& limit);

}  // namespace qchopper

// How deep the tip of a finishing tool may go over foam, so that holder and spindle stay clear of it and the flute cuts
// all that is in its way.
//
// mm. Maps of one direction that share their frame: limits have the cells of foam, CL surfaces narrower ones.

#pragma once

#include "cam/cell/cutting_tool.h"
#include "cam/setup/holder_clearance.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath_linker.h"
#include "segment/raster/field_tiles.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// The height, in setup coordinates, below which no point of a finishing ball comes. It goes below the base, so that it
// mills the sides down to it, but not into the table: from above by its radius, and tilted, where it comes under what
// leans over, as far as its rim, were it a cylinder, stays clear of the table, because poses are judged with that.
double finishing_floor(const Setup& setup, Vec3 tool_axis, double radius);

// From foam at the centres of cells of a size.
HolderGap finishing_gap(const Setup& setup, double stock_cell);

// Over the piece, a map of its highest points, with so much foam on it as finishing leaves: passes that go deeper stay
// blocked whatever else is milled. Limits below `lowest` may be lower. O(cells * widest radius / cell).
HeightField limit_over_finished(HeightField piece, double foam_left, const ToolBody& body, const HolderGap& gap,
                                double lowest);

// Over foam that stands at the centres of cells, flute included. Cost and `lowest` as above.
HeightField limit_over_stock(const HeightField& centre_stock, const CuttingTool& tool, const ToolBody& body,
                             const HolderGap& gap, double lowest);

// Raises a CL surface, so that no straight line between the centres of neighbouring cells lies below the limit
// (tests/cam/toolpath/passes_and_links_test.cpp). In tiles alone. O(cells).
void raise_to_limit(HeightField& cl, const HeightField& limit, const FieldTiles& tiles);

}  // namespace qchopper

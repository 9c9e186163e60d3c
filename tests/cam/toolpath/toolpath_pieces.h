// Setups and tools for the tests of toolpaths, made without a cell file.

#pragma once

#include <cstddef>

#include "cam/cell/cutting_tool.h"
#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/height_field.h"

namespace qchopper::test_pieces {

CuttingTool ball_tool(double diameter);
CuttingTool flat_tool(double diameter);

// The piece stands with its lowest point at z = 0 in a block with `margin` around and above it and 15 mm below. Its
// directions are up and, with a tilt, one that leans towards x.
Setup setup_of(const TriangleMesh& mesh, double margin = 5, double tilt_deg = 0);

// A closed body over [0, size] x [0, size] with its underside at z = 0 and bumps of a given height; the same for a
// seed.
TriangleMesh bumpy(double size, std::size_t cells, double high, unsigned seed);

// Heights from 0 to 50, the same for a seed.
HeightField random_map(std::size_t columns, std::size_t rows, double cell, unsigned seed);

}  // namespace qchopper::test_pieces

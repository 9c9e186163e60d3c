// Random meshes whose directed edges balance, as nasty as they come: shells on a small grid of whole numbers that share
// points, edges and faces, repeated and doubled faces, faces without area, faces collapsed to a line.

#pragma once

#include <cstdint>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Soup {
    bool all_outward = true;  // else shells are inside out at random
    std::uint32_t seed = 0;
};

// Every face with three points of its own.
TriangleMesh balanced_soup(const Soup& soup);

// Every point moved to the middle of its cell in a grid of cells that large, as decimation by clustering does.
TriangleMesh clustered(TriangleMesh mesh, double cell);

}  // namespace qchopper

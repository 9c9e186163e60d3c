// Merges scans that lie together into one surface, by the weighted mean of their signed distances in a sparse lattice.
//
// In the unit of the scans. B. Curless and M. Levoy, "A volumetric method for building complex models from range
// images" (1996), which replaced the zippering of meshes (Turk and Levoy 1994). Two things are ours: the distance is
// that to the nearest point of a scan, not along the line of sight, which a file of points does not tell; and the
// lattice is the body-centred one of marching_tetrahedra.h. A point of it has been seen by a scan if its nearest point
// there is nearer than the reach and at no border; only tetrahedra of which all corners have been seen give triangles,
// so holes stay open. The result does not depend on the number of threads (tests/segment/fuse/distance_grid_test.cpp).

#pragma once

#include <span>

#include "base/context.h"
#include "base/pose.h"
#include "segment/fuse/scan_surface.h"

namespace qchopper {

// In the common frame. `voxel`: the edge of a lattice cell; the reach is two of them. Faces look out of the solid.
// Throws InputError (use) if the lattice would have more than 200 million points; Cancelled. Preconditions: both spans
// have the same size, voxel > 0. O(triangles * points of the lattice within reach of one).
TriangleMesh merge_scans(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, double voxel,
                         const Context& context = {});

}  // namespace qchopper

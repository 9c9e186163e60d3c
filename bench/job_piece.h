// The piece of a job file, with its caps marked, for benches that make its program again.

#pragma once

#include "cam/job/job.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

// Of piece.stl, in setup coordinates: the caps are found by the planes that the job states. Throws InputError (mesh).
TriangleMesh mesh_of(const ReadJob& job);

}  // namespace qchopper::bench

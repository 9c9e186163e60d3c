// Passes divided where holder, spindle or shank would meet foam.
//
// mm, in the frame of the maps of the space. What is blocked is taken up again when other passes have removed the foam
// (make_toolpath.h).

#pragma once

#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "cam/cell/cutting_tool.h"
#include "cam/setup/block_face.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/pass.h"
#include "cam/toolpath/toolpath_linker.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// Together all that the passes mill: a blocked part begins and ends where a free one does
// (tests/cam/toolpath/passes_and_links_test.cpp). Parts are at least 2 mm long, at the cost of free ones, and so is
// what stays blocked: when the foam is gone it is free as a whole and worth a way there. Shorter passes stay as they
// are.
struct ClippedPasses {
    std::vector<Pass> free;     // the tip stays above the holder's limit and removes nothing above its flute
    std::vector<Pass> blocked;  // the rest, and open passes that are too short
};

ClippedPasses clipped(const std::vector<Pass>& passes, const MillingSpace& space, const CuttingTool& tool);

constexpr double touching = 1.5;  // mm of air at most under a tool that counts as touching

// The parts of passes along which a tool is touching, where `cl` is the CL surface of the tool alone: where holder or
// spindle keep it farther away it finishes nothing. O(length / cell).
std::vector<Pass> near_surface(const std::vector<Pass>& passes, const HeightField& cl);

// Whether a ball with its tip at a point of a map touches a sawn face of the block, or would if that stood out a
// little: its middle is beyond the plane of the face by nearly its radius or more. The points where it does not are
// convex.
class BesideSawnFaces {
 public:
    BesideSawnFaces(const Setup& setup, const HeightField& map, double radius);
    bool operator()(Vec3 tip) const;

 private:
    Box block_;
    FlushFaces flush_;
    Pose map_in_setup_;
    double radius_;
};

// The parts of passes of a ball-ended tool, in the frame of a map, along which it comes nearer to the piece than a sawn
// face of the block: where its centre is about a radius beyond the face it touches nothing else, and would mill the
// face of a block that stands out a little. O(length).
std::vector<Pass> clear_of_sawn_faces(const std::vector<Pass>& passes, const HeightField& map, const CuttingTool& tool,
                                      const Setup& setup);

}  // namespace qchopper

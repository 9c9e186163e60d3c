// The poses of runs of a toolpath that the arm is asked for: the end of every move, and poses between them.
//
// mm, in setup coordinates. Every move is divided into equal steps, and so is the line from the end of a run to
// the start of the next one.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cam/setup/placement/milling_poses.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

inline constexpr double longest_sample_step = 10;

// Steps of a straight move, at least 1.
std::size_t sample_steps(Vec3 from, Vec3 to);

struct SampledPath {
    PoseRegion region;               // each pose beside the one before it; the last one stands twice
    std::vector<std::size_t> first;  // per run: index of its start
    std::vector<std::size_t> last;   // per run: index of the end of its last move

    std::size_t poses() const { return region.poses.size() - 1; }
    // The runs whose poses are all among the first `poses`.
    std::size_t runs_within(std::size_t poses) const;
};

// Precondition: there is a run. O(length / step + moves).
SampledPath sampled_path(std::span<const PathRun> runs);

// At least one pose of a path in each cube of a size that has one: after the outermost ones, each beside the one in the
// cube before it.
PoseRegion sparse_poses(const SampledPath& path, double size);

// The outermost poses of a path along 13 axes, the first pose of the path before them, and the last one twice.
PoseRegion extreme_poses(const SampledPath& path);

}  // namespace qchopper

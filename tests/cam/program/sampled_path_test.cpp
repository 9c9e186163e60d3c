#include "cam/program/sampled_path.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace qchopper {
namespace {

PathRun zigzag() {
    PathRun run;
    run.start = {0, 0, 50};
    for (int i = 0; i < 12; ++i) run.moves.push_back({{i % 2 == 0 ? 200.0 : 0.0, 15.0 * i, 3.0 * i}, MoveKind::cut});
    return run;
}

TEST(SparsePoses, HaveAPoseNearEveryPoseOfThePathAndItsOutermostOnesFirst) {
    constexpr double size = 20;
    const PathRun run = zigzag();
    const SampledPath path = sampled_path({&run, 1});
    const PoseRegion sparse = sparse_poses(path, size);
    EXPECT_EQ(sparse.extremes, extreme_poses(path).poses.size());
    EXPECT_LT(sparse.poses.size(), path.poses() / 2 + sparse.extremes);
    for (const MillingPose& pose : path.region.poses) {
        EXPECT_TRUE(std::ranges::any_of(
            sparse.poses, [&](const MillingPose& kept) { return norm(kept.tip - pose.tip) <= size * std::sqrt(3.0); }));
    }
    for (std::size_t i = sparse.extremes; i < sparse.poses.size(); ++i) {
        EXPECT_LT(sparse.poses[i].beside, i);
        EXPECT_TRUE(std::ranges::any_of(path.region.poses, [&](const MillingPose& pose) {
            return pose.tip == sparse.poses[i].tip;
        })) << "it is a pose of the path";
    }
}

}  // namespace
}  // namespace qchopper

// One pass over the moves; the second time that the last pose stands tells whether the first time was passed.

#include "cam/program/sampled_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace qchopper {
namespace {

void add_straight(Vec3 to, PoseRegion& region) {
    const Vec3 from = region.poses.back().tip;
    const std::size_t steps = sample_steps(from, to);
    for (std::size_t i = 1; i <= steps; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(steps);
        const Vec3 tip = i == steps ? to : from + share * (to - from);
        region.poses.push_back({PoseKind::tip, tip, region.poses.size() - 1});
    }
}

std::vector<Vec3> axes_13() {
    std::vector<Vec3> axes;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (9 * x + 3 * y + z > 0) axes.push_back({1.0 * x, 1.0 * y, 1.0 * z});
            }
        }
    }
    return axes;
}

}  // namespace

std::size_t sample_steps(Vec3 from, Vec3 to) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(norm(to - from) / longest_sample_step - 1e-9)));
}

std::size_t SampledPath::runs_within(std::size_t poses) const {
    return static_cast<std::size_t>(std::lower_bound(last.begin(), last.end(), poses) - last.begin());
}

SampledPath sampled_path(std::span<const PathRun> runs) {
    assert(!runs.empty());
    SampledPath path;
    path.region.poses.push_back({PoseKind::tip, runs.front().start, 0});
    for (const PathRun& run : runs) {
        if (!path.last.empty()) add_straight(run.start, path.region);
        path.first.push_back(path.region.poses.size() - 1);
        for (const PathMove& move : run.moves) add_straight(move.tip, path.region);
        path.last.push_back(path.region.poses.size() - 1);
    }
    path.region.poses.push_back({PoseKind::tip, path.region.poses.back().tip, path.region.poses.size() - 1});
    return path;
}

PoseRegion extreme_poses(const SampledPath& path) {
    PoseRegion region{{path.region.poses.front()}, 0};
    for (const Vec3& axis : axes_13()) {
        const auto [least, most] = std::minmax_element(
            path.region.poses.begin(), path.region.poses.end(),
            [&](const MillingPose& a, const MillingPose& b) { return dot(axis, a.tip) < dot(axis, b.tip); });
        region.poses.push_back({PoseKind::tip, least->tip, 0});
        region.poses.push_back({PoseKind::tip, most->tip, 0});
    }
    region.poses.push_back(region.poses.back());
    return region;
}

PoseRegion sparse_poses(const SampledPath& path, double size) {
    PoseRegion region = extreme_poses(path);
    region.extremes = region.poses.size();
    std::map<std::array<std::int64_t, 3>, std::size_t> of_cube;
    std::size_t before = 0;
    for (const MillingPose& pose : path.region.poses) {
        std::array<std::int64_t, 3> cube{};
        for (int i = 0; i < 3; ++i) {
            cube[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(pose.tip[i] / size));
        }
        const auto [found, is_new] = of_cube.emplace(cube, region.poses.size());
        if (is_new) region.poses.push_back({PoseKind::tip, pose.tip, before});
        before = found->second;
    }
    return region;
}

}  // namespace qchopper

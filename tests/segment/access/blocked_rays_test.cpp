#include "segment/access/blocked_rays.h"

#include <gtest/gtest.h>

#include "tests/segment/access/sampled_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(BlockedRays, EndsAreTheHighestAndTheLowestOfEachSamplesRays) {
    const SampledScan scan = sampled(shapes::torus({0, 0, 0}, 30, 10), 300);
    const TrackedPiece piece = uncut_pieces(scan).front();
    const JudgedPiece judged{scan, piece.accessibility, {}};
    std::mt19937 random(3);
    for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 150U}) {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t row = 0; row < count; ++row) rows.push_back(2 * row);
        const std::vector<Vec3> directions(scan.directions.begin(), scan.directions.begin() + 40);
        std::vector<float> table(scan.samples.sample.size() * directions.size());
        for (float& distance : table) distance = random() % 3 > 0 ? 0 : 0.1F * static_cast<float>(random() % 500);
        const auto distance = [&](std::uint32_t row, std::uint32_t d) { return table[row * directions.size() + d]; };
        const BlockedRays blocked(judged, rows, directions, distance);
        std::vector<std::uint32_t> sorted = blocked.rows();
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(sorted, rows);
        const Vec3 normal = normalized(Vec3{0.3, -0.5, 0.8});
        const BlockedRays::Ends ends = blocked.ends(normal);
        ASSERT_EQ(ends.highest.size(), rows.size());
        ASSERT_EQ(ends.lowest.size(), rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            float highest = 0;
            float lowest = 0;
            for (std::uint32_t d = 0; d < directions.size(); ++d) {
                const float end = distance(blocked.rows()[i], d) * static_cast<float>(dot(normal, directions[d]));
                highest = std::max(highest, end);
                lowest = std::min(lowest, end);
            }
            EXPECT_EQ(ends.highest[i], highest);
            EXPECT_EQ(ends.lowest[i], lowest);
        }
    }
}

}  // namespace
}  // namespace qchopper

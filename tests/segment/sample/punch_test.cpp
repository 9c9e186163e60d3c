#include "segment/sample/punch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "segment/mesh/connectivity/edges.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The numbers of edges of the border loops; none if a border touches itself.
std::vector<std::size_t> loops(const TriangleMesh& mesh) {
    const Edges found = edges(mesh);
    std::map<std::uint32_t, std::uint32_t> next;
    for (std::uint32_t h = 0; h < found.twin.size(); ++h) {
        if (found.twin[h] != no_twin) continue;
        const Triangle& t = mesh.triangles[h / 3];
        if (!next.emplace(t[h % 3], t[(h % 3 + 1) % 3]).second) return {};
    }
    std::vector<std::size_t> sizes;
    while (!next.empty()) {
        std::size_t size = 0;
        for (auto at = next.begin(); at != next.end(); ++size) {
            const std::uint32_t to = at->second;
            next.erase(at);
            at = next.find(to);
        }
        sizes.push_back(size);
    }
    return sizes;
}

TEST(Punch, LeavesOneBorderLoopPerHole) {
    for (const int holes : {1, 2, 7, 30}) {
        TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 60);
        EXPECT_EQ(punch_holes(ball, holes), holes);
        EXPECT_EQ(loops(ball).size(), static_cast<std::size_t>(holes));
    }
}

TEST(Punch, HolesDifferInSize) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 90);
    punch_holes(ball, 4);
    const std::vector<std::size_t> sizes = loops(ball);
    ASSERT_EQ(sizes.size(), 4U);
    EXPECT_GT(*std::max_element(sizes.begin(), sizes.end()), *std::min_element(sizes.begin(), sizes.end()));
}

TEST(Punch, ReportsFewerHolesWhenThereIsNoRoom) {
    TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    EXPECT_LT(punch_holes(box, 20), 20);
}

TEST(Punch, LeavesNoPointWithoutATriangle) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 60);
    punch_holes(ball, 3);
    std::vector<bool> is_used(ball.points.size());
    for (const Triangle& t : ball.triangles) {
        for (const std::uint32_t corner : t) is_used[corner] = true;
    }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
}

}  // namespace
}  // namespace qchopper

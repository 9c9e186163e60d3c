#include "segment/joint/joint_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <utility>

namespace qchopper {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<PieceJoint> joints_of(const Pairs& pairs) {
    std::vector<PieceJoint> joints;
    for (const auto& [below, above] : pairs) {
        PieceJoint joint;
        joint.below = below;
        joint.above = above;
        joints.push_back(joint);
    }
    return joints;
}

// By every way that visits no piece twice.
void walk(std::size_t at, std::size_t to, std::size_t joints, const Pairs& pairs, std::vector<bool>& is_visited,
          std::size_t& shortest) {
    if (at == to) shortest = std::min(shortest, joints);
    is_visited[at] = true;
    for (const auto& [a, b] : pairs) {
        if (a == at && !is_visited[b]) walk(b, to, joints + 1, pairs, is_visited, shortest);
        if (b == at && !is_visited[a]) walk(a, to, joints + 1, pairs, is_visited, shortest);
    }
    is_visited[at] = false;
}

std::size_t shortest_by_every_way(std::size_t from, std::size_t to, std::size_t pieces, const Pairs& pairs) {
    std::vector<bool> is_visited(pieces, false);
    std::size_t shortest = std::numeric_limits<std::size_t>::max();
    walk(from, to, 0, pairs, is_visited, shortest);
    return shortest;
}

std::size_t longest_by_every_way(std::size_t pieces, const Pairs& pairs) {
    std::size_t longest = 0;
    for (std::size_t from = 0; from < pieces; ++from) {
        for (std::size_t to = 0; to < from; ++to) {
            const std::size_t joints = shortest_by_every_way(from, to, pieces, pairs);
            if (joints != std::numeric_limits<std::size_t>::max()) longest = std::max(longest, joints);
        }
    }
    return longest;
}

bool are_joined(std::size_t a, std::size_t b, const Pairs& pairs) {
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const auto& pair) { return pair == std::pair(a, b) || pair == std::pair(b, a); });
}

TEST(JointChain, OfAWallOfTwoRowsGoesAroundNoCorner) {
    // 0 - 1 - 2
    // |   |   |
    // 3 - 4 - 5 - 6
    const Pairs pairs{{0, 1}, {1, 2}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 6}};
    const JointChain chain = longest_chain(7, joints_of(pairs));
    EXPECT_EQ(chain.joints(), 4U);
    EXPECT_EQ(chain.pieces, (std::vector<std::size_t>{0, 1, 2, 5, 6}));
    EXPECT_EQ(chain.largest_deviation(0.5), 2);
    EXPECT_EQ(chain.usual_deviation(0.5), 1);
}

TEST(JointChain, WithoutJointsIsEmpty) {
    EXPECT_EQ(longest_chain(0, {}), JointChain{});
    EXPECT_EQ(longest_chain(3, {}), JointChain{});
    EXPECT_EQ(JointChain{}.largest_deviation(0.5), 0);
    EXPECT_EQ(longest_chain(2, joints_of({{1, 0}})).pieces, (std::vector<std::size_t>{0, 1}));
}

TEST(JointChain, IsAsLongAsEveryWayOfRandomGraphsSays) {
    std::mt19937 random(7);
    std::size_t longest = 0;
    for (int i = 0; i < 300; ++i) {
        const std::size_t pieces = 2 + random() % 6;
        Pairs pairs;
        for (std::size_t n = random() % (2 * pieces); n > 0; --n) {
            const std::size_t a = random() % pieces;
            const std::size_t b = random() % pieces;
            if (a != b) pairs.emplace_back(a, b);
        }
        const JointChain chain = longest_chain(pieces, joints_of(pairs));
        ASSERT_EQ(chain.joints(), longest_by_every_way(pieces, pairs)) << "graph " << i;
        for (std::size_t k = 1; k < chain.pieces.size(); ++k) {
            EXPECT_TRUE(are_joined(chain.pieces[k - 1], chain.pieces[k], pairs));
        }
        if (!chain.pieces.empty()) {
            EXPECT_EQ(shortest_by_every_way(chain.pieces.front(), chain.pieces.back(), pieces, pairs), chain.joints());
        }
        longest = std::max(longest, chain.joints());
    }
    EXPECT_GE(longest, 4U) << "the graphs were too small to tell";
}

}  // namespace
}  // namespace qchopper

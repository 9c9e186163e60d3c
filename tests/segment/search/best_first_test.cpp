#include "segment/search/best_first.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace qchopper {
namespace {

// Planes whose costs are drawn, and which are evaluated in three steps: their solids, fragility, the other terms.
struct Drawn {
    explicit Drawn(unsigned seed) {
        std::mt19937 random(seed);
        const auto draw = [&](unsigned count) { return static_cast<double>(random() % count); };
        planes.resize(static_cast<std::size_t>(draw(12)));
        for (PlanesOfNormal& of_normal : planes) {
            of_normal.resize(static_cast<std::size_t>(draw(9)));
            std::vector<std::array<double, 3>>& steps = terms.emplace_back();
            for (std::size_t k = 0; k < of_normal.size(); ++k) {
                // Few different values, so that many planes cost the same.
                steps.push_back({draw(10) < 1 ? never : draw(4), draw(3), draw(12) < 1 ? never : draw(6)});
            }
        }
    }

    double cost(std::size_t n, std::size_t k, TermStage stage) const {
        double sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(stage); ++i) sum += terms[n][k][i];
        return sum;
    }

    // Evaluates the planes that can win one step further.
    double find(std::size_t best, std::size_t at_once) {
        BestFirst search{planes, best, at_once};
        search.bound = [&](std::size_t n, std::size_t k) { return cost(n, k, planes[n][k].stage); };
        search.evaluate = [&](std::span<const std::size_t> normals, const Bounds& bounds, double most) {
            EXPECT_LE(normals.size(), at_once);
            for (const std::size_t n : normals) {
                bool is_any = false;
                for (std::size_t k = 0; k < planes[n].size(); ++k) {
                    EXPECT_EQ(bounds[n][k], cost(n, k, planes[n][k].stage));
                    if (!can_win(planes[n][k], bounds[n][k], most)) continue;
                    planes[n][k].stage = static_cast<TermStage>(static_cast<int>(planes[n][k].stage) + 1);
                    is_any = true;
                }
                EXPECT_TRUE(is_any) << "a normal without a plane that can win";
            }
        };
        return evaluate_what_can_win(search);
    }

    std::vector<PlanesOfNormal> planes;
    std::vector<std::vector<std::array<double, 3>>> terms;  // per plane: what each step adds
};

TEST(BestFirst, FindsTheBestOfAllPlanesAndEvaluatesNoneThatCannotWin) {
    std::size_t left_out = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        for (const std::size_t best : {std::size_t{1}, std::size_t{4}, std::size_t{1'000}}) {
            Drawn drawn(seed);
            std::vector<double> all;
            for (std::size_t n = 0; n < drawn.planes.size(); ++n) {
                for (std::size_t k = 0; k < drawn.planes[n].size(); ++k) {
                    const double cost = drawn.cost(n, k, TermStage::whole);
                    if (cost < never) all.push_back(cost);
                }
            }
            std::sort(all.begin(), all.end());
            const double most = drawn.find(best, 1 + seed % 3);
            ASSERT_EQ(most, all.size() < best ? never : all[best - 1]) << seed;
            for (std::size_t n = 0; n < drawn.planes.size(); ++n) {
                for (std::size_t k = 0; k < drawn.planes[n].size(); ++k) {
                    const bool is_whole = drawn.planes[n][k].stage == TermStage::whole;
                    const double cost = drawn.cost(n, k, TermStage::whole);
                    ASSERT_TRUE(is_whole || cost > most || cost == never) << seed;
                    const double bound = drawn.cost(n, k, drawn.planes[n][k].stage);
                    ASSERT_TRUE(is_whole || bound == never || bound > most) << seed;
                    left_out += is_whole ? 0 : 1;
                }
            }
        }
    }
    EXPECT_GT(left_out, 0U);
}

TEST(BestFirst, TakesTheNormalsWithTheLeastBoundFirst) {
    std::vector<PlanesOfNormal> planes(5, PlanesOfNormal(1));
    const std::vector<double> costs{3, 1, never, 2, 1};
    std::vector<std::size_t> order;
    BestFirst search{planes, 3, 2};
    search.bound = [&](std::size_t n, std::size_t) { return costs[n]; };
    search.evaluate = [&](std::span<const std::size_t> normals, const Bounds&, double) {
        for (const std::size_t n : normals) {
            order.push_back(n);
            planes[n][0].stage = TermStage::whole;
        }
    };
    EXPECT_EQ(evaluate_what_can_win(search), 2);
    EXPECT_EQ(order, (std::vector<std::size_t>{1, 4, 3, 0}));
}

TEST(BestFirst, KeepsTheLeastInTheirOrder) {
    const std::vector<double> values{5, 1, 4, 1, 0, 4};
    std::vector<std::size_t> planes{0, 1, 2, 3, 5};
    keep_least(planes, 3, values);
    EXPECT_EQ(planes, (std::vector<std::size_t>{1, 2, 3}));
    keep_least(planes, 3, values);
    EXPECT_EQ(planes.size(), 3U);
}

}  // namespace
}  // namespace qchopper

#include "segment/objectives/weights.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace qchopper {
namespace {

TEST(Weights, EveryFieldOfBothStructsHasARowOfItsOwn) {
    EXPECT_EQ(all_objectives.size(), sizeof(Weights) / sizeof(double));
    EXPECT_EQ(all_objectives.size() + 1, sizeof(Terms) / sizeof(double)) << "and the total";
    Weights weights;
    Terms terms;
    std::set<std::string> keys;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        weights.*all_objectives[i].weight = 1 + static_cast<double>(i);
        terms.*all_objectives[i].value = 100 + static_cast<double>(i);
        keys.insert(all_objectives[i].key);
    }
    EXPECT_EQ(keys.size(), all_objectives.size());
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        EXPECT_EQ(weights.*all_objectives[i].weight, 1 + static_cast<double>(i)) << all_objectives[i].key;
        EXPECT_EQ(terms.*all_objectives[i].value, 100 + static_cast<double>(i)) << all_objectives[i].key;
    }
    EXPECT_EQ(terms.total, 0);
}

TEST(Weights, TheSumTakesEachValueByItsOwnWeight) {
    for (const ObjectiveField& field : all_objectives) {
        Weights weights{0, 0, 0, 0};
        weights.*field.weight = 3;
        Terms terms;
        for (const ObjectiveField& other : all_objectives) terms.*other.value = &other == &field ? 7 : 1000;
        terms.total = 1000;
        EXPECT_EQ(weighted_sum(terms, weights), 21) << field.key;
    }
}

}  // namespace
}  // namespace qchopper

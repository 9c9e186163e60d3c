#include "app/project/presets.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(Presets, TheFourCasesOfTheThesisAreThere) {
    EXPECT_EQ(preset("bunny")->stop.min_cuts, 3);
    EXPECT_EQ(preset("bunny")->objectives.weights, (Weights{10, 5, 50, 10}));
    EXPECT_EQ(preset("skull")->stop.max_faces, 100'000U);
    EXPECT_EQ(preset("vertebrae")->objectives.weights, (Weights{5, 1, 200, 1}));
    EXPECT_TRUE(preset("femur"));
    EXPECT_FALSE(preset("rabbit"));
}

}  // namespace
}  // namespace qchopper

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

TEST(Presets, CarveLooksForWhatIsOutOfReachFirst) {
    const SearchSettings settings = *preset("carve");
    EXPECT_TRUE(settings.takes_samples());
    EXPECT_EQ(settings.stop.max_unreachable, 0.02);
    EXPECT_FALSE(settings.stop.fits_cell) << "a preset knows no cell";
    EXPECT_EQ(settings.objectives.scope, TermScope::cut);
    EXPECT_FALSE(preset("bunny")->takes_samples());
    EXPECT_EQ(preset("bunny")->objectives.scope, TermScope::whole);
}

}  // namespace
}  // namespace qchopper

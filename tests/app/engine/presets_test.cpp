#include "app/engine/presets.h"

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

TEST(Presets, ThesisHasItsObjectivesAndNoStopRule) {
    EXPECT_EQ(*preset("thesis"), SearchSettings{});
    EXPECT_EQ(preset("thesis")->objectives.weights, preset("bunny")->objectives.weights);
    EXPECT_FALSE(preset("thesis")->stop.is_any_set());
}

TEST(Presets, ACellAddsItsTiltAndThatEveryPieceFitsToCarve) {
    const SearchSettings carve = with_cell(*preset("carve"), "carve", 30 * (1 + 1e-15));
    EXPECT_TRUE(carve.stop.fits_cell);
    EXPECT_EQ(carve.objectives.tilt_deg, 30);
    for (const char* name : {"thesis", "bunny", "femur", "vertebrae", "skull"}) {
        EXPECT_EQ(with_cell(*preset(name), name, 30), *preset(name)) << name;
    }
}

TEST(Presets, RulesOfTheOperatorAreNotThoseOfCarve) {
    SearchSettings settings = *preset("carve");
    settings.stop.max_cuts = 3;
    settings.stop.count_narrow = true;
    EXPECT_TRUE(are_rules_of_carve("carve", settings.stop)) << "these are no rules";
    EXPECT_FALSE(are_rules_of_carve("", settings.stop)) << "a project of before";
    StopRules other = settings.stop;
    other.max_unreachable = 0.05;
    EXPECT_FALSE(are_rules_of_carve("carve", other));
    other = settings.stop;
    other.min_cuts = 1;
    EXPECT_FALSE(are_rules_of_carve("carve", other));
}

TEST(Presets, ChopperStopsAtThePrintVolumeThatIsGivenOrThatOfTheCell) {
    const SearchSettings chopper = *preset("chopper");
    EXPECT_EQ(chopper.objectives.fragility_form, FragilityForm::binary);
    EXPECT_EQ(chopper.objectives.weights, (Weights{0, 1, 0, 0, 0, 1, 0.05, 1, 0.1, 0.25}));
    EXPECT_FALSE(stopping_at_print_volume(chopper, "chopper").stop.is_any_set());
    const SearchSettings in_cell = with_cell(chopper, "chopper", 30, Vec3{300, 200, 100});
    EXPECT_EQ(in_cell.objectives.print_volume, (Vec3{300, 200, 100}));
    EXPECT_EQ(in_cell.stop.max_obb, (Vec3{300, 200, 100}));
    SearchSettings given = chopper;
    given.objectives.print_volume = Vec3{50, 60, 70};
    given.stop.min_cuts = 2;
    const SearchSettings kept = with_cell(given, "chopper", 30, Vec3{300, 200, 100});
    EXPECT_EQ(kept.objectives.print_volume, (Vec3{50, 60, 70}));
    EXPECT_FALSE(kept.stop.max_obb) << "a rule is set already";
}

}  // namespace
}  // namespace qchopper

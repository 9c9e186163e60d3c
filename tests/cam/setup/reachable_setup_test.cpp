// The setup that is taken where the machine does not hold the best one: other bases, other directions, or none.

#include "cam/setup/reachable_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cam/setup/placement/place_block.h"
#include "tests/cam/setup/pieces.h"
#include "tests/reference/cam/setup/holds_at_placement.h"

namespace qchopper {
namespace {

using namespace test_pieces;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

// A ball on a cap: much of it is reached from the side alone.
Piece ball_on_cap() {
    return cut_piece(uncut(shapes::ball({0, 0, 0}, 80, 24)), {{0, 0, 1}, -56.3}, 1)->pieces.at(0);
}

ReachableSetup held(const Piece& piece, const Cell& cell, const ReachableSetupOptions& options = {}) {
    return reachable_setup(piece, choose_setup(piece, cell, options.setup), cell, options);
}

// A wall behind the table, seen from the arm.
Cell with_wall(const std::string& name, double x = 1600) {
    Cell cell = ready_cell(name);
    cell.machine->obstacles.push_back({"wall", {{x, -500, 0}, {x + 100, 500, 1100}}});
    return cell;
}

void expect_held_at_its_place(const ReachableSetup& result, const Piece& piece, const Cell& cell) {
    ASSERT_TRUE(result.reachability.is_arm_checked);
    EXPECT_TRUE(result.reachability.holds());
    const Setup& setup = result.choice.setups.front();
    EXPECT_EQ(setup.placement, result.reachability.placement);
    EXPECT_TRUE(holds_at_placement(setup, milling_poses(setup, *piece.mesh, cell), cell));
    EXPECT_EQ(setup.access.method, AccessMethod::mapped) << "what it reaches is judged as of any other";
}

TEST(ReachableSetup, HandsTheChoiceBackWhereNothingIsKnownOfTheArm) {
    const Piece piece = ball_on_cap();
    const SetupChoice choice = choose_setup(piece, ready_cell("foam-1.toml"));
    const ReachableSetup result = reachable_setup(piece, choice, ready_cell("foam-1.toml"));
    EXPECT_EQ(result.choice.setups, choice.setups);
    EXPECT_EQ(result.reachability, MachineReachability{});
}

TEST(ReachableSetup, PlacesTheBlockOfTheBestSetup) {
    const Piece piece = ball_on_cap();
    for (const char* name : {"irb6640-185-2.8.toml", "kr120-r2500-pro-rotary.toml", "gantry-3axis.toml"}) {
        const Cell cell = ready_cell(name);
        const SetupChoice choice = choose_setup(piece, cell);
        const ReachableSetup result = reachable_setup(piece, choice, cell);
        expect_held_at_its_place(result, piece, cell);
        EXPECT_LE(result.reachability.remedy, Remedy::block_shift) << name;
        EXPECT_EQ(result.choice.setups.front().access, choice.setups.front().access) << name;
    }
}

TEST(ReachableSetup, LeavesOutDirectionsThatAreNotHeld) {
    const Piece piece = ball_on_cap();
    const Cell cell = with_wall("kr60-ha.toml", 1400);
    ReachableSetupOptions options;
    options.setup.base = 1;
    const SetupChoice choice = choose_setup(piece, cell, options.setup);
    ASSERT_FALSE(place_block(choice.setups.front(), *piece.mesh, cell).holds()) << "the wall is where a tool leans";
    const ReachableSetup result = reachable_setup(piece, choice, cell, options);
    expect_held_at_its_place(result, piece, cell);
    EXPECT_EQ(result.reachability.remedy, Remedy::orientations);
    EXPECT_EQ(result.choice.setups.front().base_number, 1);
    EXPECT_NE(result.choice.setups.front().access.orientations, choice.setups.front().access.orientations);
    EXPECT_NE(describe_reachability("A", result.reachability).find("needed: take other tool orientations"),
              std::string::npos);
}

TEST(ReachableSetup, RefusesWithThePairAndWhatIsLeftToDo) {
    const Piece piece = ball_on_cap();
    Cell cell = ready_cell("kr60-ha.toml");
    cell.machine->obstacles.push_back({"press", {{500, -900, 320}, {1900, 900, 900}}});
    const ReachableSetup result = held(piece, cell);
    EXPECT_FALSE(result.reachability.holds());
    EXPECT_EQ(result.reachability.remedy, Remedy::cut) << "all bases were tried";
    const std::string words = describe_reachability("A", result.reachability);
    EXPECT_NE(words.find("piece A cannot be carved: "), std::string::npos) << words;
    EXPECT_NE(words.find("press"), std::string::npos) << words;
    EXPECT_NE(words.find("to do: cut the piece otherwise"), std::string::npos) << words;
    ReachableSetupOptions ordered;
    ordered.setup.base = 1;
    EXPECT_EQ(held(piece, cell, ordered).reachability.remedy, Remedy::base) << "the operator's order leaves others";
}

TEST(ReachableSetup, IsNotAskedOfAPieceWithoutABlock) {
    const Piece large = standing_box({-900, -900, 0}, {900, 900, 900}, 1, 2);
    const ReachableSetup result = held(large, ready_cell("kr60-ha.toml"));
    EXPECT_EQ(result.reachability, MachineReachability{});
}

TEST(FirstPlace, IsHeldAndIsFoundWhereTheSearchFindsOne) {
    const Piece piece = ball_on_cap();
    for (const bool has_wall : {false, true}) {
        for (const char* name : {"kr60-ha.toml", "kr120-r2500-pro-rotary.toml"}) {
            const Cell cell = has_wall ? with_wall(name) : ready_cell(name);
            SetupChoice choice = choose_setup(piece, cell);
            auto& setup = choice.setups.front();
            const std::vector<OrientationPoses> poses = milling_poses(setup, *piece.mesh, cell);
            const std::optional<BlockPlacement> found = first_place(setup, poses, cell);
            const MachineReachability searched = place_block(setup, poses, cell);
            EXPECT_TRUE(searched.holds() || !found) << name;
            if (!found) continue;
            setup.placement = *found;
            EXPECT_TRUE(holds_at_placement(setup, poses, cell)) << name;
            const std::vector<OrientationPoses> one{poses.front()};
            EXPECT_TRUE(first_place(setup, one, cell)) << "fewer directions ask less";
            EXPECT_EQ(first_place(setup, poses, cell, *found)->x, found->x) << "that place is tried first";
        }
    }
}

TEST(ChooseSetup, TakesOnlyAllowedDirections) {
    const Piece piece = ball_on_cap();
    const Cell cell = ready_cell("irb6640-185-2.8.toml");
    const SetupChoice free = choose_setup(piece, cell);
    ASSERT_GT(free.setups.front().access.orientations.size(), 2U);
    const Vec3 refused = free.setups.front().access.orientations[1].tool_axis;
    SetupOptions options;
    options.is_allowed = [&](Vec3 direction) { return dot(direction, refused) < 1 - 1e-9; };
    const SetupChoice without = choose_setup(piece, cell, options);
    for (const ToolOrientation& d : without.setups.front().access.orientations)
        EXPECT_LT(dot(d.tool_axis, refused), 1 - 1e-9);
    options.is_allowed = [](Vec3) { return false; };
    EXPECT_EQ(choose_setup(piece, cell, options).setups.front().access.orientations.size(), 1U)
        << "straight up is left";
}

}  // namespace
}  // namespace qchopper

#include "app/store/decisions.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

Cut cut(std::int32_t number, const std::string& piece) {
    Cut c;
    c.number = number;
    c.piece = piece;
    return c;
}

TEST(Decisions, AreDescribed) {
    EXPECT_EQ(describe(cut(3, "B")), "cut 3 on piece B");
    EXPECT_EQ(describe(WeightsChange{}), "change of weights");
    EXPECT_EQ(describe(Reset{}), "reset");
}

TEST(Decisions, TheLastSetupOfAPieceIsInForceUntilThePieceIsGone) {
    using Orders = std::vector<SetupOrder>;
    History h;
    decide(h, SetupOrder{"B", 2, {}});
    decide(h, SetupOrder{"A", {}, 3});
    decide(h, SetupOrder{"B", 1, 4});
    EXPECT_EQ(describe(*to_undo(h)), "setup of piece B");
    EXPECT_EQ(committed_setup_orders(h), (Orders{{"A", {}, 3}, {"B", 1, 4}}));
    h.committed = 2;
    EXPECT_EQ(committed_setup_orders(h), (Orders{{"A", {}, 3}, {"B", 2, {}}}));
    h.committed = 3;
    decide(h, SetupOrder{"A", {}, {}});
    EXPECT_EQ(committed_setup_orders(h), (Orders{{"B", 1, 4}})) << "the program chooses again";
    decide(h, SetupOrder{"A", {}, {}, {3, 4}});
    EXPECT_EQ(committed_setup_orders(h), (Orders{{"A", {}, {}, {3, 4}}, {"B", 1, 4}})) << "tools alone are an order";
    decide(h, SetupOrder{"A", {}, {}});
    decide(h, cut(1, "B"));
    EXPECT_EQ(committed_setup_orders(h), Orders{});
    EXPECT_EQ(committed_cuts(h).size(), 1U);
    h.committed = 4;
    decide(h, Reset{});
    EXPECT_EQ(committed_setup_orders(h), Orders{});
}

TEST(Decisions, WhatStandsFollowsFromThoseInForce) {
    History h;
    h.weights_at_start = {1, 1, 1, 1};
    decide(h, cut(1, "A"));
    decide(h, WeightsChange{{2, 2, 2, 2}});
    decide(h, cut(2, "B"));
    decide(h, Reset{});
    decide(h, cut(1, "A"));
    EXPECT_EQ(committed_cuts(h), (std::vector<Cut>{cut(1, "A")}));
    EXPECT_EQ(committed_weights(h), (Weights{2, 2, 2, 2})) << "a reset keeps the weights";
    h.committed = 3;
    EXPECT_EQ(committed_cuts(h), (std::vector<Cut>{cut(1, "A"), cut(2, "B")}));
    h.committed = 1;
    EXPECT_EQ(committed_weights(h), (Weights{1, 1, 1, 1}));
    EXPECT_EQ(describe(*to_undo(h)), "cut 1 on piece A");
    EXPECT_EQ(describe(*to_redo(h)), "change of weights");
    h.committed = 0;
    EXPECT_EQ(to_undo(h), nullptr);
    EXPECT_TRUE(committed_cuts(h).empty());
}

TEST(Decisions, ThoseUndoneAreKeptUntilSomethingNewIsDecided) {
    History h;
    decide(h, cut(1, "A"));
    decide(h, cut(2, "B"));
    h.committed = 1;
    EXPECT_EQ(h.decisions.size(), 2U);
    decide(h, cut(2, "C"));
    EXPECT_EQ(h.decisions.size(), 2U);
    EXPECT_EQ(to_redo(h), nullptr);
    EXPECT_EQ(describe(*to_undo(h)), "cut 2 on piece C");
}

TEST(Decisions, FollowASearchThatTurnsToAnotherBranch) {
    History h;
    decide(h, cut(1, "A"));
    decide(h, WeightsChange{{2, 2, 2, 2}});
    follow(h, {cut(1, "A"), cut(2, "B")});
    follow(h, {cut(1, "A"), cut(2, "C"), cut(3, "D")});
    EXPECT_EQ(committed_cuts(h), (std::vector<Cut>{cut(1, "A"), cut(2, "C"), cut(3, "D")}));
    EXPECT_EQ(h.decisions.size(), 4U) << "the branch that was given up is gone";
    const History before = h;
    follow(h, committed_cuts(h));
    EXPECT_EQ(h, before) << "nothing new, nothing decided";
}

TEST(Replaced, ACutKeepsItsPlaceAndUndoGivesItBack) {
    const auto made = [](std::int32_t number, const char* piece, std::vector<std::string> pieces, double offset) {
        Cut c;
        c.number = number;
        c.piece = piece;
        c.pieces = std::move(pieces);
        c.chosen.plane.offset = offset;
        return c;
    };
    History h;
    decide(h, made(1, "A", {"B", "C"}, 0));
    decide(h, made(2, "B", {"D", "E"}, 0));
    decide(h, made(3, "C", {"F", "G"}, 0));
    const std::vector<Cut> before = committed_cuts(h);
    decide(h, Replacement{made(2, "B", {"D", "E", "F"}, 7)});
    EXPECT_TRUE(are_replacements_possible(h));
    const std::vector<Cut> after = committed_cuts(h);
    ASSERT_EQ(after.size(), 3U);
    EXPECT_EQ(after[0], before[0]);
    EXPECT_EQ(after[1].chosen.plane.offset, 7);
    EXPECT_EQ(after[2], made(3, "C", {"G", "H"}, 0)) << "the next names";
    EXPECT_EQ(describe(*to_undo(h)), "replacement of cut 2 on piece B");
    --h.committed;
    EXPECT_EQ(committed_cuts(h), before);
    decide(h, Replacement{made(1, "A", {"B", "C"}, 7)});
    EXPECT_FALSE(are_replacements_possible(h)) << "B and C are cut";
}

}  // namespace
}  // namespace qchopper

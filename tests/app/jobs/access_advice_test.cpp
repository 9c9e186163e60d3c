#include "app/jobs/access_advice.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Cell cell() {
    Cell cell;
    CellMachine machine;
    machine.tools.resize(2);
    machine.tools[0].name = "short-6";
    machine.tools[0].diameter = 6;
    machine.tools[0].stick_out = 60;
    machine.tools[1].name = "long-20";
    machine.tools[1].diameter = 20;
    machine.tools[1].stick_out = 150;
    cell.machine = machine;
    return cell;
}

AdviceInput input() {
    AdviceInput input;
    input.access.area_mm2 = 1000;
    input.access.orientations.resize(8);
    input.access.orientations[3].depth_mm = 431.7;
    input.folder = "p.qch";
    input.piece = "B";
    return input;
}

AccessAdvice first(const AdviceInput& input) {
    const std::vector<AccessAdvice> advice = access_advice(input, cell());
    EXPECT_FALSE(advice.empty());
    return advice.empty() ? AccessAdvice{} : advice.front();
}

// The key is told too.
bool says(const Sentence& sentence, const std::string& part) {
    return (sentence.text + " " + sentence.key).find(part) != std::string::npos;
}

TEST(AccessAdvice, OfEachKindNamesItsRemedy) {
    struct Row {
        const char* name;
        void (*set)(AdviceInput&);
        AccessFault fault;
        double share;
        const char* remedy;
    };
    const std::vector<Row> table{
        {"holder", [](AdviceInput& i) { i.access.holder_mm2 = 30; }, AccessFault::holder, 0.03,
         "long-20 reaches 150 mm to its holder, while surface in sight lies up to 432 mm deep"},
        {"chosen directions", [](AdviceInput& i) { i.access.hidden_mm2 = 40; }, AccessFault::few_orientations, 0.04,
         "more tool orientations: 12 more_orientations"},
        {"none worth it", [](AdviceInput& i) { i.access.hidden_mm2 = 40, i.access.orientations.resize(4); },
         AccessFault::few_orientations, 0.04, "by hand"},
        {"limited by a decision",
         [](AdviceInput& i) {
             i.access.hidden_mm2 = 40, i.access.orientations.resize(3), i.max_directions = 3, i.is_limited = true;
         },
         AccessFault::few_orientations, 0.04,
         "by hand: it is limited to 3 tool orientations by its setup see_setup_limit"},
        {"tilt", [](AdviceInput& i) { i.access.hidden_mm2 = 40, i.access.all_directions_share = 0.05; },
         AccessFault::tilt, 0.04, "a larger tilt than 60 degrees, or another cut larger_tilt"},
        {"flat tool",
         [](AdviceInput& i) { i.access.hidden_mm2 = 40, i.access.all_directions_share = 1, i.tilt_deg = 90; },
         AccessFault::tilt, 0.04, "another cut another_cut"},
        {"inside",
         [](AdviceInput& i) { i.access.hidden_mm2 = 40, i.access.all_directions_share = 0.035, i.inside_share = 0.03; },
         AccessFault::inside, 0.03, "a mask, if it may stay mask"},
        {"narrow", [](AdviceInput& i) { i.access.too_narrow_mm2 = 20, i.access.narrow_counts = true; },
         AccessFault::narrow, 0.02, "a smaller tool than that of 6 mm"},
        {"steep", [](AdviceInput& i) { i.access.steep_mm2 = 20, i.access.all_directions_share = 0.02; },
         AccessFault::tilt, 0.02, "a larger tilt"},
    };
    for (const Row& row : table) {
        AdviceInput in = input();
        row.set(in);
        const AccessAdvice advice = first(in);
        EXPECT_EQ(advice.fault, row.fault) << row.name << ": " << to_word(advice.fault);
        EXPECT_NEAR(advice.share, row.share, 1e-12) << row.name;
        EXPECT_TRUE(says(advice.remedies, row.remedy)) << row.name << ": " << advice.remedies.text;
    }
}

TEST(AccessAdvice, ALargerTiltIsNoRemedyWhereTheToolLiesFlat) {
    AdviceInput in = input();
    in.access.hidden_mm2 = 40;
    in.access.all_directions_share = 1;
    in.tilt_deg = 90;
    EXPECT_FALSE(says(first(in).remedies, "tilt"));
}

TEST(AccessAdvice, BeginsWithTheLargestPartAndTellsNoMoreThanIsOutOfReach) {
    AdviceInput in = input();
    in.access.holder_mm2 = 30;
    in.access.hidden_mm2 = 50;
    in.access.steep_mm2 = 5;
    in.access.too_narrow_mm2 = 100;  // not counted
    in.access.all_directions_share = 0.03;
    in.inside_share = 0.01;
    const std::vector<AccessAdvice> advice = access_advice(in, cell());
    ASSERT_EQ(advice.size(), 4U);
    EXPECT_TRUE(std::is_sorted(advice.begin(), advice.end(), [](auto& a, auto& b) { return a.share > b.share; }));
    const double sum =
        std::accumulate(advice.begin(), advice.end(), 0.0, [](double s, auto& a) { return s + a.share; });
    EXPECT_NEAR(sum, in.access.unreachable_share(), 1e-12);
    EXPECT_TRUE(access_advice(input(), cell()).empty()) << "nothing is out of reach";
}

TEST(AccessAdvice, OnlyTheWallOfACavityIsInside) {
    EXPECT_EQ(inside_share(piece_of(shapes::ball({0, 0, 0}, 50))), 0);
    const TriangleMesh hollow =
        shapes::joined({shapes::ball({0, 0, 0}, 60), shapes::turned_inside_out(shapes::ball({0, 0, 0}, 30))});
    EXPECT_NEAR(inside_share(piece_of(hollow)), 0.2, 0.01) << "30 x 30 of 60 x 60 + 30 x 30";
}

}  // namespace
}  // namespace qchopper

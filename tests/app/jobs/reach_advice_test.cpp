#include "app/jobs/reach_advice.h"

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
    input.reach.area_mm2 = 1000;
    input.reach.directions.resize(8);
    input.reach.directions[3].depth_mm = 431.7;
    input.segment_command = "SEGMENT";
    input.setup_command = "SETUP";
    return input;
}

ReachAdvice first(const AdviceInput& input) {
    const std::vector<ReachAdvice> advice = reach_advice(input, cell());
    EXPECT_FALSE(advice.empty());
    return advice.empty() ? ReachAdvice{} : advice.front();
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ReachAdvice, OfEachKindNamesItsCure) {
    struct Row {
        const char* name;
        void (*set)(AdviceInput&);
        ReachFault fault;
        double share;
        const char* cure;
    };
    const std::vector<Row> table{
        {"holder", [](AdviceInput& i) { i.reach.holder_mm2 = 30; }, ReachFault::holder, 0.03,
         "long-20 reaches 150 mm to its holder, while surface in sight lies up to 432 mm deep"},
        {"chosen directions", [](AdviceInput& i) { i.reach.hidden_mm2 = 40; }, ReachFault::few_directions, 0.04,
         "SETUP --directions 12"},
        {"none worth it", [](AdviceInput& i) { i.reach.hidden_mm2 = 40, i.reach.directions.resize(4); },
         ReachFault::few_directions, 0.04, "by hand"},
        {"tilt", [](AdviceInput& i) { i.reach.hidden_mm2 = 40, i.reach.all_directions_share = 0.05; }, ReachFault::tilt,
         0.04, "a larger tilt than 60 degrees, or another cut: SEGMENT"},
        {"flat tool",
         [](AdviceInput& i) { i.reach.hidden_mm2 = 40, i.reach.all_directions_share = 1, i.tilt_deg = 90; },
         ReachFault::tilt, 0.04, "another cut: SEGMENT"},
        {"inside",
         [](AdviceInput& i) { i.reach.hidden_mm2 = 40, i.reach.all_directions_share = 0.035, i.inside_share = 0.03; },
         ReachFault::inside, 0.03, "--ignore-inside, or --ignore-surface FILE"},
        {"narrow", [](AdviceInput& i) { i.reach.too_narrow_mm2 = 20, i.reach.narrow_counts = true; },
         ReachFault::narrow, 0.02, "a smaller tool than that of 6 mm"},
        {"steep", [](AdviceInput& i) { i.reach.steep_mm2 = 20, i.reach.all_directions_share = 0.02; }, ReachFault::tilt,
         0.02, "a larger tilt"},
    };
    for (const Row& row : table) {
        AdviceInput in = input();
        row.set(in);
        const ReachAdvice advice = first(in);
        EXPECT_EQ(advice.fault, row.fault) << row.name << ": " << to_word(advice.fault);
        EXPECT_NEAR(advice.share, row.share, 1e-12) << row.name;
        EXPECT_TRUE(says(advice.cures, row.cure)) << row.name << ": " << advice.cures;
    }
}

TEST(ReachAdvice, ALargerTiltIsNoCureWhereTheToolLiesFlat) {
    AdviceInput in = input();
    in.reach.hidden_mm2 = 40;
    in.reach.all_directions_share = 1;
    in.tilt_deg = 90;
    EXPECT_FALSE(says(first(in).cures, "tilt"));
}

TEST(ReachAdvice, BeginsWithTheLargestPartAndTellsNoMoreThanIsOutOfReach) {
    AdviceInput in = input();
    in.reach.holder_mm2 = 30;
    in.reach.hidden_mm2 = 50;
    in.reach.steep_mm2 = 5;
    in.reach.too_narrow_mm2 = 100;  // not counted
    in.reach.all_directions_share = 0.03;
    in.inside_share = 0.01;
    const std::vector<ReachAdvice> advice = reach_advice(in, cell());
    ASSERT_EQ(advice.size(), 4U);
    EXPECT_TRUE(std::is_sorted(advice.begin(), advice.end(), [](auto& a, auto& b) { return a.share > b.share; }));
    const double sum =
        std::accumulate(advice.begin(), advice.end(), 0.0, [](double s, auto& a) { return s + a.share; });
    EXPECT_NEAR(sum, in.reach.unreachable_share(), 1e-12);
    EXPECT_TRUE(reach_advice(input(), cell()).empty()) << "nothing is out of reach";
}

TEST(ReachAdvice, OnlyTheWallOfACavityIsInside) {
    EXPECT_EQ(inside_share(piece_of(shapes::ball({0, 0, 0}, 50))), 0);
    const TriangleMesh hollow =
        shapes::joined({shapes::ball({0, 0, 0}, 60), shapes::turned_inside_out(shapes::ball({0, 0, 0}, 30))});
    EXPECT_NEAR(inside_share(piece_of(hollow)), 0.2, 0.01) << "30 x 30 of 60 x 60 + 30 x 30";
}

}  // namespace
}  // namespace qchopper

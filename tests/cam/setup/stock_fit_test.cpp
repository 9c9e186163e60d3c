#include "cam/setup/stock_fit.h"
#include "cam/setup/choose_setup.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

StockFit report_for(Vec3 size, const Cell& in) {
    return check_stock_fit(choose_setup(standing_box({0, 0, 0}, size, 0), in).setups.front(), in);
}

// A setup that was chosen for the whole cell: in `in` it would be turned until it fits.
StockFit report_for_the_same_setup(const Cell& in) {
    return check_stock_fit(choose_setup(standing_box({0, 0, 0}, {80, 40, 30}, 0), cell()).setups.front(), in);
}

TEST(StockFit, EveryMarginIsThatOfTheDrawing) {
    const Cell in = cell();
    const StockFit report = report_for({80, 40, 30}, in);  // in 100 x 60 x 50 on a table 100 high
    const std::map<std::string, double> wanted{{"piece in block, length", 10},
                                               {"piece in block, width", 10},
                                               {"piece in block, height", 15},
                                               {"block to reach, -x", 1000 - 50 - 10},
                                               {"block to reach, +x", 1000 - 50 - 10},
                                               {"block to reach, -y", 1000 - 30 - 10},
                                               {"block to reach, +y", 1000 - 30 - 10},
                                               {"block top to reach ceiling", 1000 - 100 - 50 - 20},
                                               {"table to reach floor", 100},
                                               {"block on table, x", 700},
                                               {"block on table, y", 570}};
    EXPECT_EQ(report.margins.size(), wanted.size());
    for (const Margin& margin : report.margins) {
        ASSERT_TRUE(wanted.contains(margin.name)) << margin.name;
        EXPECT_NEAR(margin.mm, wanted.at(margin.name), 1e-9) << margin.name;
    }
    EXPECT_TRUE(report.fits());
    EXPECT_EQ(describe_stock_fit("B", report), "piece B fits, tightest: piece in block, length 10 mm");
}

TEST(StockFit, APieceThatFillsItsBlockFits) {
    const StockFit report = report_for({90, 50, 45}, cell());
    EXPECT_TRUE(report.fits());
    EXPECT_NEAR(report.worst().mm, 0, 1e-9);
}

TEST(StockFit, ATooHighPieceIsNamedWithItsMargin) {
    const StockFit report = report_for({150, 150, 427}, cell());
    EXPECT_FALSE(report.fits());
    EXPECT_EQ(describe_stock_fit("B", report),
              "piece B does not fit: 32 mm too high for block tall (200 x 200 x 400 mm)");
}

TEST(StockFit, EachWallOfTheCellCanBeTheOneInTheWay) {
    struct Case {
        const char* name;
        void (*spoil)(Cell&);
    };
    const std::vector<Case> cases{
        {"block to reach, -x", [](Cell& c) { c.workspace.min.x = -59; }},
        {"block to reach, +x", [](Cell& c) { c.workspace.max.x = 59; }},
        {"block to reach, -y", [](Cell& c) { c.workspace.min.y = -39; }},
        {"block to reach, +y", [](Cell& c) { c.table.centre_y = 961; }},
        {"block top to reach ceiling", [](Cell& c) { c.clearance = 851; }},
        {"table to reach floor", [](Cell& c) { c.workspace.min.z = 101; }},
        {"block on table, x", [](Cell& c) { c.table.size_x = 98; }},
        {"block on table, y", [](Cell& c) { c.table.size_y = 58; }},
    };
    for (const Case& one : cases) {
        Cell in = cell();
        one.spoil(in);
        const StockFit report = report_for_the_same_setup(in);
        EXPECT_FALSE(report.fits()) << one.name;
        EXPECT_EQ(report.worst().name, one.name);
        EXPECT_NEAR(report.worst().mm, -1, 1e-9) << one.name;
        EXPECT_NE(describe_stock_fit("B", report).find("does not fit: 1 mm " + report.worst().problem),
                  std::string::npos);
    }
}

TEST(StockFit, ATenthTooMuchIsNotCalledZero) {
    Cell in = cell();
    in.table.size_x = 99.9;
    EXPECT_NE(describe_stock_fit("B", report_for_the_same_setup(in)).find("0.1 mm of its block beyond the table"),
              std::string::npos);
}

}  // namespace
}  // namespace qchopper

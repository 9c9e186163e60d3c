// What foam stands, the highest of discs and the limits that follow for roughing: against plain loops and rays.

#include "cam/stock/in_process_stock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cam/stock/cl_surface.h"
#include "cam/stock/roughing_limit.h"
#include "segment/raster/disc_dilation.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::flat_tool;
using test_pieces::random_map;
using test_pieces::setup_of;

TEST(DilateByDisc, IsThatOfAPlainLoop) {
    const HeightField map = random_map(31, 23, 0.7, 1);
    for (const double radius : {0.0, 0.5, 0.7, 2.1, 5.3, 40.0}) {
        const HeightField found = dilate_by_disc(map, radius);
        for (std::size_t r = 0; r < map.rows; ++r) {
            for (std::size_t c = 0; c < map.columns; ++c) {
                float most = HeightField::nothing;
                for (std::size_t v = 0; v < map.rows; ++v) {
                    for (std::size_t u = 0; u < map.columns; ++u) {
                        const double x = static_cast<double>(u) - static_cast<double>(c);
                        const double y = static_cast<double>(v) - static_cast<double>(r);
                        if (x * x + y * y <= (radius / 0.7) * (radius / 0.7)) most = std::max(most, map.at(u, v));
                    }
                }
                ASSERT_EQ(found.at(c, r), most) << radius;
                const double x = 0.7 * (static_cast<double>(c) + 0.5);
                const double y = 0.7 * (static_cast<double>(r) + 0.5);
                ASSERT_GE(dilation_at(map, x, y, radius + 1e-9), most);
                const auto highest = static_cast<double>(dilation_at(map, x, y, radius));
                ASSERT_TRUE(is_dilation_above(map, x, y, radius, highest - 0.01));
                ASSERT_FALSE(is_dilation_above(map, x, y, radius, highest));
            }
        }
    }
}

TEST(MarkedWithin, IsWhereTheHighestOfDiscsIsMarked) {
    for (const std::size_t columns : {1U, 63U, 64U, 65U, 150U}) {
        HeightField map = random_map(columns, 23, 1, 5);
        std::vector<std::uint8_t> marks(map.height.size());
        std::mt19937 random(3);
        for (std::size_t i = 0; i < marks.size(); ++i) {
            marks[i] = random() % 40 == 0 && i / columns % 7 != 3 ? 1 : 0;
            map.height[i] = marks[i];
        }
        for (const double cells : {0.0, 1.0, 2.9, 12.0, 64.0, 130.5}) {
            const HeightField highest = dilate_by_disc(map, cells);
            const std::vector<std::uint8_t> found = marked_within(marks, columns, 23, cells);
            for (std::size_t i = 0; i < marks.size(); ++i) {
                ASSERT_EQ(found[i], highest.height[i] == 1 ? 1 : 0) << columns << ' ' << cells << ' ' << i;
            }
        }
    }
}

// A way of a tool in the map of a direction, and whether it removes a point.
struct Way {
    std::size_t orientation;
    CuttingTool tool;
    Vec3 from, to;
    bool removes(Vec3 p) const {
        for (int i = 0; i <= 400; ++i) {
            const Vec3 tip = from + (i / 400.0) * (to - from);
            const double r = std::hypot(p.x - tip.x, p.y - tip.y);
            if (p.z - tip.z >= tool_profile(tool, r)) return true;
        }
        return false;
    }
};

class StockOfRandomWays {
 public:
    StockOfRandomWays(const Setup& setup, const TriangleMesh& mesh, unsigned seed) : setup_(setup), stock(setup) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        for (std::size_t d = 0; d < 2; ++d) {
            HeightField frame = piece_height_field(setup, mesh, d, {1.3, 0, 15});
            HeightField removed = frame;
            std::fill(removed.height.begin(), removed.height.end(), std::numeric_limits<float>::infinity());
            HeightField other = removed;
            for (int k = 0; k < 6; ++k) {
                const auto place = [&] {
                    return Vec3{unit(random) * 1.3 * static_cast<double>(frame.columns),
                                unit(random) * 1.3 * static_cast<double>(frame.rows), 40 * unit(random) - 20};
                };
                ways.push_back({d, k % 2 == 0 ? ball_tool(12) : flat_tool(20), place(), place()});
                ToolSweep(ways.back().tool, 1.3).move(removed, other, ways.back().from, ways.back().to);
            }
            stock.remove_above(d, removed);
            frames.push_back(frame);
        }
    }
    bool is_stock(Vec3 p) const {
        return std::none_of(ways.begin(), ways.end(), [&](const Way& way) {
            return way.removes(setup_to_field(setup_, frames[way.orientation], p));
        });
    }

 private:
    const Setup& setup_;

 public:
    InProcessStock stock;
    std::vector<Way> ways;
    std::vector<HeightField> frames;
};

TEST(InProcessStock, NeverTellsLessFoamThanThereIs) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        StockOfRandomWays milled(setup, mesh, seed);
        std::vector<HeightField> highest;
        std::vector<HeightField> lowest;
        for (std::size_t d = 0; d < 2; ++d) highest.push_back(milled.stock.highest(d, milled.frames[d]));
        for (std::size_t d = 0; d < 2; ++d) lowest.push_back(milled.stock.lowest(d, milled.frames[d]));
        InProcessStock wide(setup);
        for (const RemovedFoam& removed : milled.stock.removed(4)) {
            EXPECT_NEAR(removed.down_to.cell, 4 * 1.3, 1e-9);
            wide.remove_above(removed.orientation, removed.down_to);
        }
        std::size_t foam = 0;
        std::size_t told = 0;
        for (int k = 0; k < 20000; ++k) {
            const Vec3 size = setup.block.size;
            const Vec3 p{(unit(random) - 0.5) * size.x, (unit(random) - 0.5) * size.y,
                         unit(random) * size.z - setup.spoil};
            told += milled.stock.may_be_stock(p) ? 1 : 0;
            if (!milled.is_stock(p)) continue;
            ++foam;
            ASSERT_TRUE(milled.stock.may_be_stock(p));
            ASSERT_TRUE(wide.may_be_stock(p));
            for (std::size_t d = 0; d < 2; ++d) {
                const Vec3 q = setup_to_field(setup, highest[d], p);
                const auto c = static_cast<std::size_t>(q.x / 1.3);
                const auto r = static_cast<std::size_t>(q.y / 1.3);
                ASSERT_GE(static_cast<double>(highest[d].at(c, r)), q.z - 1e-3) << seed << " direction " << d;
                ASSERT_LE(static_cast<double>(lowest[d].at(c, r)), q.z + 1e-3) << seed << " direction " << d;
            }
        }
        EXPECT_GT(foam, 1000U);
        EXPECT_LT(static_cast<double>(told), 1.35 * static_cast<double>(foam)) << "but not much more either";
    }
}

// The lowest point of a tool over a cell, at many places of a line.
double lowest_over(const CuttingTool& tool, double x, double y, double beside, Vec3 from, Vec3 to) {
    const double radius = 0.5 * tool.diameter;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 4000; ++i) {
        const Vec3 tip = from + (i / 4000.0) * (to - from);
        const double r = std::hypot(x - tip.x, y - tip.y) + beside;
        if (r <= radius) least = std::min(least, tip.z + tool_profile(tool, r));
    }
    return least;
}

TEST(ToolSweep, LowersCellsAsPlacesAlongTheWayDo) {
    constexpr double cell = 0.8;
    constexpr double slack = 0.2;
    const double beside = slack + cell * std::sqrt(0.5);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int k = 0; k < 30; ++k) {
        const CuttingTool tool = k % 3 == 0 ? flat_tool(8) : ball_tool(12);
        const auto place = [&] { return Vec3{40 * unit(random) - 4, 36 * unit(random) - 4, 40 * unit(random)}; };
        const Vec3 from = place();
        Vec3 to = k % 4 == 0 ? from + Vec3{unit(random), 0.1 * unit(random), 10 * unit(random)} : place();
        if (k % 5 == 0) to.x = from.x;
        if (k % 10 == 0) to.y = from.y;
        if (k % 3 == 0 && k % 2 == 0) to.z = from.z;
        HeightField map = random_map(41, 35, cell, 1);
        std::fill(map.height.begin(), map.height.end(), std::numeric_limits<float>::infinity());
        HeightField other = map;
        ToolSweep(tool, cell, slack).move(map, other, from, to);
        EXPECT_EQ(map.height, other.height);
        // Places a cell apart, where the tool is flat and the way is not.
        const double slope = std::abs(to.z - from.z) / std::max(cell, std::hypot(to.x - from.x, to.y - from.y));
        const double more = k % 3 == 0 ? 1e-3 + slope * cell : 0.06;
        for (std::size_t row = 0; row < map.rows; ++row) {
            for (std::size_t column = 0; column < map.columns; ++column) {
                const double x = cell * (static_cast<double>(column) + 0.5);
                const double y = cell * (static_cast<double>(row) + 0.5);
                const auto found = static_cast<double>(map.at(column, row));
                ASSERT_GE(found,
                          lowest_over(tool, x, y, beside, from, to) + slack - 2e-3 - std::abs(to.z - from.z) / 4000)
                    << k;
                // The rim of the tool lies between places.
                ASSERT_LE(found, lowest_over(tool, x, y, beside + 0.1, from, to) + slack + more) << k;
            }
        }
    }
}

// Down or up through the centre of a cell in steps of a cell, to the first point that may be foam; none: nothing.
float first_of_stock(const InProcessStock& stock, const Setup& setup, const HeightField& frame, Vec3 begin,
                     double end) {
    const double step = end > begin.z ? frame.cell : -frame.cell;
    for (int k = 0; std::abs(step) * k < std::abs(end - begin.z); ++k) {
        const double z = begin.z + step * k;
        if (!stock.may_be_stock(field_to_setup(setup, frame, {begin.x, begin.y, z}))) continue;
        return static_cast<float>(k == 0 ? begin.z : z - step);
    }
    return HeightField::nothing;
}

bool are_near(float a, float b) {
    return a == b || std::abs(a - b) < 1e-4F;
}

// The tilted direction has removed all above the piece, and its map is many squares wide.
TEST(InProcessStock, AlongRaysIsThatOfAPlainLoop) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    InProcessStock stock(setup, StockCells::centres);
    stock.remove_above(1, piece_height_field(setup, mesh, 1, {0.7, 0, 15}));
    const HeightField frame = piece_height_field(setup, mesh, 0, {0.7, 0, 15});
    const HeightField highest = stock.highest(0, frame);
    const HeightField lowest = stock.lowest(0, frame);
    const double bottom = setup_to_field(setup, frame, {0, 0, -setup.spoil}).z;
    const double top = bottom + setup.block.size.z;
    std::size_t between = 0;
    for (std::size_t row = 0; row < frame.rows; ++row) {
        for (std::size_t column = 0; column < frame.columns; ++column) {
            const double x = frame.cell * (static_cast<double>(column) + 0.5);
            const double y = frame.cell * (static_cast<double>(row) + 0.5);
            const float from_above = first_of_stock(stock, setup, frame, {x, y, top}, bottom);
            ASSERT_TRUE(are_near(highest.at(column, row), from_above)) << column << ' ' << row;
            const float from_below = first_of_stock(stock, setup, frame, {x, y, bottom}, top);
            ASSERT_TRUE(are_near(lowest.at(column, row), from_below)) << column << ' ' << row;
            if (from_above != HeightField::nothing && static_cast<double>(from_above) < top - 1) ++between;
        }
    }
    EXPECT_GT(between, 1000U);
}

// The stock that is asked after every removal, and one that is asked once.
TEST(InProcessStock, RaysGoOnWhereTheyMetFoam) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const StockCells kind : {StockCells::whole, StockCells::centres}) {
        InProcessStock asked(setup, kind);
        InProcessStock plain(setup, kind);
        for (std::size_t k = 0; k < 12; ++k) {
            const std::size_t d = k % 3 == 2 ? 0 : k % 2;
            HeightField removed = piece_height_field(setup, mesh, d, {1.3, 0, 15});
            const double low = 40 * unit(random);
            const std::size_t first = static_cast<std::size_t>(unit(random) * static_cast<double>(removed.rows));
            for (std::size_t i = 0; i < removed.height.size(); ++i) {
                const bool is_in = i / removed.columns >= first && i / removed.columns < first + 12;
                removed.height[i] = is_in ? static_cast<float>(low - 20) : std::numeric_limits<float>::infinity();
            }
            asked.remove_above(d, removed);
            plain.remove_above(d, removed);
            for (std::size_t other = 0; other < 2; ++other) {
                const HeightField frame = piece_height_field(setup, mesh, other, {1.3, 0, 15});
                InProcessStock fresh = plain;
                ASSERT_EQ(asked.highest(other, frame).height, fresh.highest(other, frame).height) << k;
                ASSERT_EQ(asked.highest(other, frame).height, fresh.highest(other, frame).height) << k;
            }
        }
    }
}

TEST(InProcessStock, OfAWholeBlockIsItsTop) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8);
    const HeightField frame = piece_height_field(setup, mesh, 0, {1, 0, 5});
    const HeightField top = InProcessStock(setup).highest(0, frame);
    const Vec3 middle = setup_to_field(setup, frame, {0, 0, 38});
    EXPECT_NEAR(top.at(static_cast<std::size_t>(middle.x), static_cast<std::size_t>(middle.y)), middle.z, 1e-4);
    EXPECT_EQ(top.at(0, 0), HeightField::nothing);
}

TEST(InProcessStock, OfAWholeBlockTheLowestFoamOfATiltedRayIsOnItsFarSide) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    const HeightField frame = piece_height_field(setup, mesh, 1, {1, 0, 15});
    const HeightField lowest = InProcessStock(setup, StockCells::centres).lowest(1, frame);
    const Vec3 half{0.5 * setup.block.size.x, 0.5 * setup.block.size.y, 0};
    std::size_t on_bottom = 0;
    std::size_t on_sides = 0;
    for (std::size_t row = 0; row < frame.rows; ++row) {
        for (std::size_t column = 0; column < frame.columns; ++column) {
            const auto z = static_cast<double>(lowest.at(column, row));
            if (lowest.at(column, row) == HeightField::nothing) continue;
            const Vec3 p =
                field_to_setup(setup, frame, {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, z});
            const double beside = std::max(std::abs(p.x) - half.x, std::abs(p.y) - half.y);
            const double above = p.z + setup.spoil;
            EXPECT_NEAR(std::min(std::abs(beside), std::abs(above)), 0, 1e-3);
            ++(std::abs(beside) < std::abs(above) ? on_sides : on_bottom);
        }
    }
    EXPECT_GT(on_bottom, 500U);
    EXPECT_GT(on_sides, 500U);
}

TEST(StayNearStock, KeepsTheTipAtMostALevelBelowTheLowestFoamUnderTheTool) {
    const HeightField before = random_map(40, 30, 1, 3);
    HeightField lowest = random_map(40, 30, 1, 4);
    for (std::size_t i = 0; i < lowest.height.size(); ++i) {
        lowest.height[i] += 20;
        if (i % 40 > 12) lowest.height[i] = HeightField::nothing;  // no foam there
    }
    HeightField tip = before;
    stay_near_stock(tip, lowest, flat_tool(2), 5);
    std::size_t raised = 0;
    for (std::size_t row = 0; row < tip.rows; ++row) {
        for (std::size_t column = 0; column < tip.columns; ++column) {
            const float was = before.at(column, row);
            raised += tip.at(column, row) > was ? 1 : 0;
            float least = std::numeric_limits<float>::infinity();
            for (std::size_t r = 0; r < tip.rows; ++r) {
                for (std::size_t c = 0; c < tip.columns; ++c) {
                    const double far = std::hypot(static_cast<double>(c) - static_cast<double>(column),
                                                  static_cast<double>(r) - static_cast<double>(row));
                    if (far <= 1 && lowest.at(c, r) != HeightField::nothing) least = std::min(least, lowest.at(c, r));
                }
            }
            if (least < std::numeric_limits<float>::infinity()) {
                EXPECT_LE(tip.at(column, row), std::max(was, least - 5)) << "the foam under the tool is reached";
            } else if (column > 20) {
                EXPECT_EQ(tip.at(column, row), was) << "far from all foam";
            }
            EXPECT_GE(tip.at(column, row), was);
        }
    }
    EXPECT_GT(raised, 20U);
}

}  // namespace
}  // namespace qchopper

// How deep a line cuts at once: the section of the stock at the line, known by construction or by the definition,
// beside what the replay measures of it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim/replay/mill_stock.h"
#include "sim/replay/stock/tool_axis_frame.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

constexpr double cell = 0.25;
constexpr double flute = 100;
constexpr double radius = 10;
const Box block{{-200, -200, -300}, {200, 200, 0}};
const Cutter flat{ToolShape::flat, radius, 0, 0, 1};
const Cutter ball{ToolShape::ball, radius, radius, 0, 1};

Vec3 tilted(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::sin(angle), 0, std::cos(angle)};
}

// Lines of a flat tool of 20 mm along one direction, in coordinates of a point on the block's top: `side` at right
// angles to the direction and to y, `y`, and `height` along the direction above the point.
class Lines {
 public:
    explicit Lines(double tilt_degrees) : job_(box_job("kr60-ha")), out_(tilted(tilt_degrees)) {
        job_.cell.machine->tools[1].flute_length = flute;
        scene_.cell = &job_.cell;
        scene_.orientations.push_back({out_, 0, {}});
        scene_.block = block;
        scene_.spoil = 300;
    }
    void go(double side, double y, double height, double to_y, double step = 1e9) {
        const auto count = static_cast<int>(std::ceil(std::abs(to_y - y) / step));
        for (int i = 0; i < std::max(1, count); ++i) {
            const auto at = [&](int k) { return y + (to_y - y) * k / std::max(1, count); };
            TipLine line;
            line.from = point(side, at(i), height);
            line.to = point(side, at(i + 1), height);
            line.place = {0, static_cast<std::uint32_t>(path_.lines.size() + 1)};
            line.tool = 1;
            line.feed = 100;
            line.follows_line = i > 0;
            line.signals = {true, true, 15000, true};
            path_.order.push_back({true, path_.lines.size()});
            path_.lines.push_back(line);
        }
    }
    void lack_a_centre() { job_.cell.machine->tools[1].is_centre_cutting = false; }
    // From one height to another.
    void go_down(double height, double to_height, double to_y) {
        go(0, 0, height, to_y);
        path_.lines.back().to = point(0, to_y, to_height);
    }
    std::size_t deep_cuts() const { return count(FindingKind::deep_cut); }
    std::size_t plunges() const { return count(FindingKind::plunge); }
    // Height of the block's top over the point.
    double top(double side) const { return side * out_.x / out_.z; }

 private:
    std::size_t count(FindingKind kind) const {
        FindingLog log;
        StockModel stock_model(block, {out_}, cell);
        mill_stock(stock_model, path_, scene_, false, log, {});
        return log.count(kind);
    }
    Vec3 point(double side, double y, double height) const {
        return Vec3{0, y, 0} + side * Vec3{out_.z, 0, -out_.x} + height * out_;
    }

    BoxJob job_;
    Vec3 out_;
    ReplayScene scene_;
    ToolPath path_;
};

class DeepCut : public testing::TestWithParam<double> {
 protected:
    Lines lines{GetParam()};
    // The tip of a tool at this side whose highest foam stands so high above it.
    double tip(double side, double depth) const { return lines.top(side + radius) - depth; }
};

TEST_P(DeepCut, ASlotAsDeepAsTheFluteIsNone) {
    lines.go(0, -220, tip(0, flute - 0.1), 220);
    EXPECT_EQ(lines.deep_cuts(), 0U);
}

TEST_P(DeepCut, ADeeperSlotIsFoundInOneLineAndInMany) {
    // The slope of the block's top leaves but a part of the tool's width above the flute.
    const double depth = flute + 3 + 20 * std::tan(GetParam() * std::numbers::pi / 180);
    lines.go(0, -220, tip(0, depth), 220);
    EXPECT_EQ(lines.deep_cuts(), 1U);
    Lines many(GetParam());
    many.go(0, -220, tip(0, depth), 220, 1);
    EXPECT_GT(many.deep_cuts(), 300U);
}

// A wall beside a slot, of which the next line takes a skin: 103 mm of it stand above the tip, 3 more than the flute is
// long. Over 300 mm of way a skin of 0.2 mm has 60 mm2, but on the way of one diameter 4.
TEST_P(DeepCut, AThinSkinOnALongWallIsNoneAndAThickOneIs) {
    for (const double skin : {0.2, 3.0}) {
        Lines beside(GetParam());
        const double end = tip(skin, flute + 3);
        for (double height = tip(0, 60); height > end; height -= 30) beside.go(0, -220, height, 220);
        beside.go(0, -220, end, 220);
        beside.go(skin, -150, end, 150);
        EXPECT_EQ(beside.deep_cuts(), skin < 1 ? 0U : 1U) << skin;
    }
}

// Straight down, on a ramp of 20 degrees and of 30, and down once more where it is free.
TEST_P(DeepCut, APlungeIsFoundOfAToolWhoseCentreDoesNotCut) {
    const double down = tip(0, 10);
    const auto plunges = [&](double to_y, bool lacks_a_centre, bool is_milled) {
        Lines own(GetParam());
        if (is_milled) own.go(0, -220, down, 220);
        if (lacks_a_centre) own.lack_a_centre();
        own.go_down(tip(0, -1), down, to_y);
        return own.plunges();
    };
    EXPECT_EQ(plunges(0, true, false), 1U);
    EXPECT_EQ(plunges(11 / 0.577, true, false), 1U);
    EXPECT_EQ(plunges(11 / 0.364, true, false), 0U);
    EXPECT_EQ(plunges(0, false, false), 0U);
    EXPECT_EQ(plunges(0, true, true), 0U);
}

INSTANTIATE_TEST_SUITE_P(Tilts, DeepCut, testing::Values(0, 35));

// By the definition: at the middle of each cell the foam that stands before the move, and of the tool's places over it
// the one with the lowest tip.
struct Section {
    double sure = 0;   // of what lies well inside of the tool
    double depth = 0;  // of all that it may touch
};

Section section_of(const StockModel& stock_model, std::size_t orientation, const Cutter& cutter, Vec3 from, Vec3 to,
                   double size) {
    const Pose& frame = stock_model.frame_in_block(orientation);
    const Vec3 a = apply_inverse(frame, from);
    const Vec3 move = apply_inverse(frame, to) - a;
    constexpr int places = 4000;
    Section section;
    const auto first = [&](double x) { return (std::floor(x / size) + 0.5) * size; };
    for (double x = first(std::min(a.x, a.x + move.x) - radius); x < std::max(a.x, a.x + move.x) + radius; x += size) {
        for (double y = first(std::min(a.y, a.y + move.y) - radius); y < std::max(a.y, a.y + move.y) + radius;
             y += size) {
            double surface = 1e9;
            double tip = 1e9;
            double nearest = 1e9;
            for (int i = 0; i <= places; ++i) {
                const double s = static_cast<double>(i) / places;
                const double r = std::hypot(x - a.x - s * move.x, y - a.y - s * move.y);
                nearest = std::min(nearest, r);
                if (r > radius) continue;
                tip = std::min(tip, a.z + s * move.z);
                surface = std::min(surface, a.z + s * move.z + profile_height(cutter, r));
            }
            if (tip > 1e8) continue;
            const auto column = stock_model.on_line(apply(frame, {x, y, 0}), rotate(frame, {0, 0, 1}), surface, 1000);
            if (column.empty()) continue;
            section.depth = std::max(section.depth, column.back().high - tip);
            const bool is_sure = nearest < radius - 0.05 && column.back().high - surface > 0.05;
            if (is_sure) section.sure = std::max(section.sure, column.back().high - tip);
        }
    }
    return section;
}

TEST(DeepCutOfAMove, IsThatOfTheDefinition) {
    constexpr double size = 2;
    const Box small{{-60, -50, 0}, {60, 50, 80}};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> in(0, 1);
    const auto point = [&] { return Vec3{-50 + 100 * in(random), -40 + 80 * in(random), 10 + 80 * in(random)}; };
    std::size_t touched = 0;
    for (int i = 0; i < 12; ++i) {
        StockModel stock_model(small, {{0, 0, 1}, tilted(50)}, size);
        for (int k = 0; k < 6; ++k) {
            const std::size_t orientation = k % 2;
            const Cutter& cutter = in(random) < 0.5 ? flat : ball;
            const Vec3 from = point();
            Vec3 to = from + 0.3 * (point() - from);
            if (k == 3) to = from - 15 * rotate(stock_model.frame_in_block(orientation), {0, 0, 1});
            const Section expected = section_of(stock_model, orientation, cutter, from, to, size);
            const CutResult cut = stock_model.cut(orientation, cutter, 20, from, to);
            if (cut.touches) ++touched;
            // Where the rim comes to a middle is known to one of 4000 places.
            EXPECT_GE(cut.depth, expected.sure - 0.05) << i << " " << k;
            if (cut.touches) {
                EXPECT_LE(cut.depth, expected.depth + 0.05) << i << " " << k;
            }
        }
    }
    EXPECT_GT(touched, 40U);
}

}  // namespace
}  // namespace qchopper

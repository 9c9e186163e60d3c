#include "sim/replay/stock/stock_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim/replay/stock/tool_axis_frame.h"
#include "sim/replay/volumes.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

const Box block{{-50, -30, 0}, {50, 30, 30}};
const Cutter flat{ToolShape::flat, 10, 0, 0, 1};
const Cutter ball{ToolShape::ball, 6, 6, 0, 1};
constexpr double long_flute = 1000;

double top_at(const StockModel& stock_model, double x, double y) {
    const std::vector<Dexel> dexels = stock_model.on_line({x, y, 0}, {0, 0, 1}, -100, 100);
    return dexels.empty() ? 0 : dexels.back().high;
}

TEST(StockModel, AFlatSlotHasItsVolume) {
    StockModel stock_model(block, {{0, 0, 1}}, 0.5);
    const CutResult cut = stock_model.cut(0, flat, 9, {-70, 0, 20}, {70, 0, 20});
    EXPECT_TRUE(cut.touches);
    EXPECT_NEAR(cut.volume, 100 * 20 * 10, 0.01);
    EXPECT_NEAR(cut.depth, 10, 1e-5);
    EXPECT_NEAR(cut.deep_mm2, 20 * 20, 20 * 0.5) << "on a way of one diameter";
    // The second time there is nothing left, and a move that only slides along the wall removes nothing.
    EXPECT_FALSE(stock_model.cut(0, flat, 9, {-70, 0, 20}, {70, 0, 20}).touches);
    EXPECT_EQ(stock_model.cut(0, flat, 9, {-70, 0, 20}, {70, 0, 20}).volume, 0);
}

TEST(StockModel, ARampIsAsDeepAsTheTipWas) {
    StockModel stock_model(block, {{0, 0, 1}}, 0.5);
    stock_model.cut(0, flat, long_flute, {-40, 0.25, 30}, {40, 0.25, 10});
    for (const double x : {-20.25, 0.25, 20.25}) {
        // The lowest place at which the flat end covers the point is its radius ahead.
        EXPECT_NEAR(top_at(stock_model, x, 0.25), 30 - 20 * (x + 10 + 40) / 80, 1e-4);
    }
}

// Slots of a U-shaped prism along x: faces across it do not matter for vertical lines.
TriangleMesh slotted_block(double depth) {
    const std::vector<std::array<double, 2>> outline{{-30, 0},         {30, 0},           {30, 30},  {10, 30},
                                                     {10, 30 - depth}, {-10, 30 - depth}, {-10, 30}, {-30, 30}};
    TriangleMesh mesh;
    for (const auto& [y, z] : outline) {
        mesh.points.push_back({-50, y, z});
        mesh.points.push_back({50, y, z});
    }
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count;
        mesh.triangles.push_back({2 * i, 2 * j, 2 * i + 1});
        mesh.triangles.push_back({2 * i + 1, 2 * j, 2 * j + 1});
    }
    return mesh;
}

VolumeFigures volumes_of(const StockModel& stock_model, const TriangleMesh& target, const BoxJob& job) {
    ReplayScene scene = job.scene();
    scene.block = block;
    scene.target = &target;
    VolumeOptions options;
    options.around = 0;
    return measure_volumes(stock_model, scene, options, {});
}

TEST(StockModel, ASlotTwoMillimetresTooShallowLeavesItsVolume) {
    const BoxJob job = box_job("kr60-ha");
    const TriangleMesh target = slotted_block(10);
    StockModel shallow(block, {{0, 0, 1}}, 0.5);
    shallow.cut(0, flat, long_flute, {-70, 0, 22}, {70, 0, 22});
    EXPECT_NEAR(volumes_of(shallow, target, job).leftover_mm3, 2 * 20 * 100, 1);
    EXPECT_NEAR(volumes_of(shallow, target, job).gouge_mm3, 0, 1);
    StockModel deep(block, {{0, 0, 1}}, 0.5);
    deep.cut(0, flat, long_flute, {-70, 0, 17}, {70, 0, 17});
    EXPECT_NEAR(volumes_of(deep, target, job).leftover_mm3, 0, 1);
    EXPECT_NEAR(volumes_of(deep, target, job).gouge_mm3, 3 * 20 * 100, 1);
    // Of 3 mm all but the first quarter of a millimetre lies deeper than the tolerance.
    EXPECT_NEAR(volumes_of(deep, target, job).beyond_mm3, 2.75 * 19.5 * 100, 260);
}

// Height over a cylinder of radius `rho` along x (negative: a trough) of the ridge between two passes of a ball.
double ridge(const std::vector<Vec3>& tool_axes, std::size_t orientation, double rho, double step) {
    const double cell = 0.25;
    const Box big{{-60, -60, -60}, {60, 60, 60}};
    StockModel stock_model(big, tool_axes, cell);
    const Pose frame = stock_model.frame_in_block(orientation);
    const double middle = 0.5 * cell;  // the ridge is over the middle of a cell
    for (const double side : {-0.5, 0.5}) {
        const double y = side * step;
        const double centre = rho > 0 ? std::sqrt((rho + 6) * (rho + 6) - y * y) - rho
                                      : -rho - std::sqrt((-rho - 6) * (-rho - 6) - y * y);
        const double z = rho == 0 ? 0 : centre - 6;
        stock_model.cut(orientation, ball, long_flute, apply(frame, {-20, y + middle, z}),
                        apply(frame, {20, y + middle, z}));
    }
    const Vec3 from = apply(frame, {middle, middle, 0});
    return stock_model.on_line(from, tool_axes[orientation], -50, 50).back().high;
}

TEST(StockModel, ScallopsHaveTheHeightOfTheFormula) {
    const double tilt = 40 * std::numbers::pi / 180;
    const std::vector<Vec3> tool_axes{{0, 0, 1}, {std::sin(tilt), 0, std::cos(tilt)}};
    for (const std::size_t orientation : {0U, 1U}) {
        const double s = 3;
        EXPECT_NEAR(ridge(tool_axes, orientation, 0, s), 6 - std::sqrt(36 - s * s / 4), 1e-3);
        const double convex = std::sqrt(31.0 * 31 - s * s / 4) - std::sqrt(36 - s * s / 4) - 25;
        EXPECT_NEAR(convex, 0.154, 5e-4);
        EXPECT_NEAR(ridge(tool_axes, orientation, 25, s), convex, 1e-3);
        const double bowl = 25 - std::sqrt(19.0 * 19 - s * s / 4) - std::sqrt(36 - s * s / 4);
        EXPECT_NEAR(ridge(tool_axes, orientation, -25, s), bowl, 1e-3);
    }
}

struct Stroke {
    std::size_t orientation = 0;
    Cutter cutter;
    Vec3 from;
    Vec3 to;
};

// By the definition: the least over many places of the tool along the stroke.
bool removes(const Stroke& stroke, const Pose& frame, Vec3 point) {
    const Vec3 p = apply_inverse(frame, point);
    const Vec3 a = apply_inverse(frame, stroke.from);
    const Vec3 b = apply_inverse(frame, stroke.to);
    for (int i = 0; i <= 400; ++i) {
        const Vec3 q = p - (a + (i / 400.0) * (b - a));
        const double r = std::hypot(q.x, q.y);
        if (r <= stroke.cutter.radius && q.z >= profile_height(stroke.cutter, r)) return true;
    }
    return false;
}

// Short strokes one after the other, some of which go on where the last one ended.
std::vector<Stroke> random_strokes(std::size_t count, const std::vector<Pose>& frames) {
    const std::vector<Cutter> cutters{ball, flat, {ToolShape::bull, 6, 2, 0, 1}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> in(0, 1);
    std::vector<Stroke> strokes;
    Vec3 tip;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t orientation = i / 12 % frames.size();
        const Cutter& cutter = cutters[i / 6 % cutters.size()];
        const auto height = [&] { return 12 + 14 * in(random); };
        if (i % 6 == 0) tip = apply(frames[orientation], {-20 + 40 * in(random), -15 + 30 * in(random), height()});
        const Vec3 from = apply_inverse(frames[orientation], tip);
        const double rise = i % 3 == 0 ? 0 : 3 * in(random)-2;
        const Vec3 to{from.x + 8 * in(random)-4, from.y + 8 * in(random)-4, from.z + rise};
        strokes.push_back({orientation, cutter, tip, apply(frames[orientation], to)});
        tip = strokes.back().to;
    }
    return strokes;
}

const std::vector<Vec3> three_axes{{0, 0, 1}, normalized(Vec3{0, 0.7, 1}), normalized(Vec3{0.9, -0.3, 1})};

// A move in the air between two strokes lets the second one begin anew.
TEST(StockModel, StrokesThatGoOnRemoveWhatTheyRemoveApart) {
    StockModel together(block, three_axes, 0.5);
    StockModel apart(block, three_axes, 0.5);
    std::vector<Pose> frames;
    for (std::size_t d = 0; d < three_axes.size(); ++d) frames.push_back(together.frame_in_block(d));
    for (const Stroke& s : random_strokes(300, frames)) {
        const CutResult one = together.cut(s.orientation, s.cutter, 3, s.from, s.to);
        const CutResult other = apart.cut(s.orientation, s.cutter, 3, s.from, s.to);
        apart.cut(s.orientation, s.cutter, 3, {0, 0, 500}, {1, 0, 500});
        ASSERT_NEAR(one.volume, other.volume, 1e-3);
        ASSERT_EQ(one.touches, other.touches);
        ASSERT_NEAR(one.depth, other.depth, 1e-4);
    }
    EXPECT_EQ(together.record(), apart.record());
}

TEST(StockModel, CutsAfterTheEndOfMillingRemoveWhatTheyWouldHaveRemoved) {
    StockModel ended(block, three_axes, 0.5);
    StockModel other(block, three_axes, 0.5);
    std::vector<Pose> frames;
    for (std::size_t d = 0; d < three_axes.size(); ++d) frames.push_back(ended.frame_in_block(d));
    std::size_t strokes = 0;
    for (const Stroke& s : random_strokes(200, frames)) {
        const CutResult one = ended.cut(s.orientation, s.cutter, 3, s.from, s.to);
        ASSERT_NEAR(one.volume, other.cut(s.orientation, s.cutter, 3, s.from, s.to).volume, 1e-3);
        ASSERT_EQ(ended.disc_contact(s.orientation, 12, 2, s.from, s.to),
                  other.disc_contact(s.orientation, 12, 2, s.from, s.to));
        if (++strokes % 20 == 0) ended.end_milling();
    }
    EXPECT_EQ(ended.record(), other.record());
}

// Sum over the columns about a stroke, each asked of all directions.
double foam_about(const StockModel& stock_model, const Stroke& s, double cell) {
    const Pose& frame = stock_model.frame_in_block(s.orientation);
    const Vec3 from = apply_inverse(frame, s.from);
    const auto first = [&](double at) { return (std::floor(at / cell) + 0.5) * cell; };
    double length = 0;
    for (double x = first(from.x - 16); x < from.x + 16; x += cell) {
        for (double y = first(from.y - 16); y < from.y + 16; y += cell) {
            const Vec3 axis = three_axes[s.orientation];
            for (const Dexel& foam : stock_model.on_line(apply(frame, {x, y, 0}), axis, -200, 200)) {
                length += foam.high - foam.low;
            }
        }
    }
    return length * cell * cell;
}

TEST(StockModel, AStrokeRemovesTheFoamThatAllDirectionsLeftThere) {
    constexpr double cell = 0.5;
    StockModel stock_model(block, three_axes, cell);
    std::vector<Pose> frames;
    for (std::size_t d = 0; d < three_axes.size(); ++d) frames.push_back(stock_model.frame_in_block(d));
    double all = 0;
    for (const Stroke& s : random_strokes(150, frames)) {
        const double before = foam_about(stock_model, s, cell);
        const double volume = stock_model.cut(s.orientation, s.cutter, long_flute, s.from, s.to).volume;
        ASSERT_NEAR(volume, before - foam_about(stock_model, s, cell), 0.01);
        all += volume;
    }
    EXPECT_GT(all, 10'000) << "the strokes meet foam";
}

// Two directions mill deep slots, of which whole slabs of a third one's columns are gone; it comes down in steps.
TEST(StockModel, AColumnIsWhatIsLeftBetweenDeepSlotsOfOthers) {
    constexpr double cell = 0.5;
    const Box tall{{-60, -60, -80}, {60, 60, 40}};
    const std::vector<Vec3> axes{{0, 0, 1}, {1, 0, 0}, normalized(Vec3{0.2, 1, 0.3})};
    StockModel stock_model(tall, axes, cell);
    const auto cut_along = [&](std::size_t d, Vec3 from, Vec3 to) {
        const Pose& frame = stock_model.frame_in_block(d);
        return stock_model.cut(d, flat, long_flute, apply(frame, from), apply(frame, to)).volume;
    };
    for (const double y : {-30.0, -12.0, 25.0}) cut_along(1, {y, -70, -50}, {y, 30, -40});
    for (const double x : {-20.0, 15.0}) cut_along(2, {x, -70, -10}, {x, 60, 5});
    const auto foam = [&] {
        double length = 0;
        for (double x = -59.75; x < 60; x += cell) {
            for (double y = -59.75; y < 60; y += cell) {
                for (const Dexel& part : stock_model.on_line({x, y, 0}, {0, 0, 1}, -100, 100)) {
                    length += part.high - part.low;
                }
            }
        }
        return length * cell * cell;
    };
    double left = foam();
    EXPECT_LT(left, 0.8 * 120 * 120 * 120) << "the slots are there";
    for (const double z : {35.0, 33.0, 20.0, -5.0, -6.0, -55.0}) {
        double removed = 0;
        for (const double y : {-35.0, -18.0, 0.0, 17.0, 40.0}) {
            removed += cut_along(0, {-70, y, z}, {10, y + 4, z});
            removed += cut_along(0, {10, y + 4, z}, {70, y, z - 3});
        }
        const double now = foam();
        EXPECT_NEAR(removed, left - now, 1e-5 * left) << z;
        EXPECT_GT(removed, 1000);
        left = now;
    }
}

TEST(StockModel, TwoDirectionsTogetherLeaveWhatNeitherRemoves) {
    const double tilt = 40 * std::numbers::pi / 180;
    const std::vector<Vec3> tool_axes{{0, 0, 1}, {0, std::sin(tilt), std::cos(tilt)}};
    const double cell = 0.5;
    StockModel stock_model(block, tool_axes, cell);
    const std::vector<Stroke> strokes{{0, flat, {-30, 0, 15}, {20, 5, 12}},
                                      {1, ball, {-20, 10, 10}, {20, 0, 14}},
                                      {0, ball, {0, -10, 8}, {0, 20, 20}},
                                      {1, flat, {-10, 20, 9}, {10, 22, 12}}};
    double volume = 0;
    for (const Stroke& s : strokes) volume += stock_model.cut(s.orientation, s.cutter, long_flute, s.from, s.to).volume;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> in(0, 1);
    std::size_t removed = 0;
    std::size_t wrong = 0;
    constexpr std::size_t points = 20'000;
    for (std::size_t i = 0; i < points; ++i) {
        const Vec3 p{-50 + 100 * in(random), -30 + 60 * in(random), 30 * in(random)};
        bool is_removed = false;
        for (const Stroke& s : strokes) is_removed |= removes(s, stock_model.frame_in_block(s.orientation), p);
        removed += is_removed ? 1 : 0;
        wrong += is_removed == stock_model.is_in_stock(p) ? 1 : 0;
    }
    // Points next to a wall may be taken for their cell's middle.
    EXPECT_LT(static_cast<double>(wrong), 0.01 * points);
    const double expected = 100.0 * 60 * 30 * static_cast<double>(removed) / points;
    EXPECT_NEAR(volume, expected, 0.03 * expected);
}

TEST(StockModel, DistanceToTheNearestRemovedPointIsNeverTooSmall) {
    StockModel stock_model(block, {{0, 0, 1}}, 0.25);
    stock_model.cut(0, flat, long_flute, {-70, 0, 20}, {70, 0, 20});
    for (const Vec3 p : {Vec3{0, 0, 19}, Vec3{3, 10.4, 25}, Vec3{3, -12, 21}, Vec3{-8, 11, 18}}) {
        const double beside = std::max(0.0, std::abs(p.y) - 10);
        const double below = std::max(0.0, 20 - p.z);
        const double exact = std::hypot(beside, below);
        std::size_t nearest = 0;
        EXPECT_GE(stock_model.distance_to_removed(p, 20, nearest), exact - 1e-5);
        EXPECT_LE(stock_model.distance_to_removed(p, 20, nearest), exact + 0.71 * 0.25);
    }
}

Vec3 tilted(double tilt_deg, double azimuth_deg) {
    const double tilt = tilt_deg * std::numbers::pi / 180;
    const double azimuth = azimuth_deg * std::numbers::pi / 180;
    return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

TEST(StockModel, DistanceDoesNotDependOnTheOrientationThatIsAskedFirst) {
    StockModel stock_model(block, {{0, 0, 1}, tilted(40, 20), tilted(30, 200)}, 0.25);
    stock_model.cut(0, flat, long_flute, {-70, 0, 20}, {70, 0, 20});
    stock_model.cut(1, flat, long_flute, {10, -40, 12}, {10, 40, 12});
    std::mt19937 random(3);
    int of_second = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto number = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const Vec3 p{number(-40, 40), number(-20, 20), number(5, 28)};
        const double most = i % 3 == 0 ? 20 : number(0.2, 3);
        std::size_t nearest = 0;
        const double distance = stock_model.distance_to_removed(p, most, nearest);
        for (std::size_t first = 0; first < 3; ++first) {
            std::size_t found = first;
            EXPECT_EQ(stock_model.distance_to_removed(p, most, found), distance) << i;
        }
        of_second += nearest == 1 ? 1 : 0;
    }
    EXPECT_GT(of_second, 50);
}

TEST(StockModel, AHolderMeetsWhatStandsHigher) {
    StockModel stock_model(block, {{0, 0, 1}}, 0.5);
    stock_model.cut(0, flat, long_flute, {-70, 0, 5}, {70, 0, 5});
    // The disc is 5 mm wider than the slot, 20 mm above the tip: 25, and the foam stands at 30.
    EXPECT_NEAR(stock_model.disc_contact(0, 15, 20, {-20, 0, 5}, {20, 0, 5}), 5, 1e-4);
    EXPECT_EQ(stock_model.disc_contact(0, 15, 25.1, {-20, 0, 5}, {20, 0, 5}), 0);
    EXPECT_EQ(stock_model.disc_contact(0, 9, 1, {-20, 0, 5}, {20, 0, 5}), 0);
}

}  // namespace
}  // namespace qchopper

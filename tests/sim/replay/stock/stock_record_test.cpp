#include "sim/replay/stock/stock_record.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "sim/replay/replay.h"
#include "sim/replay/stock/stock_model.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

const Box block{{-50, -30, 0}, {50, 30, 30}};
const std::vector<Vec3> tool_axes{{0, 0, 1}, {0, 0.6, 0.8}};
const Cutter ball{ToolShape::ball, 6, 6, 0, 1};

void cut_first(StockModel& stock_model) {
    stock_model.cut(0, ball, 100, {-60, -5, 12.3456}, {60, 3, 17.8912});
    stock_model.cut(1, ball, 100, {-60, 20, 20.123}, {60, 10, 18.77});
}

CutResult cut_second(StockModel& stock_model) {
    CutResult all = stock_model.cut(0, ball, 100, {-60, 4, 15.111}, {60, -6, 13.3});
    const CutResult other = stock_model.cut(1, ball, 100, {-60, 8, 14.5}, {60, 12, 19.5});
    all.volume += other.volume;
    return all;
}

StockRecord some_stock() {
    StockModel stock_model(block, tool_axes, 0.5);
    cut_first(stock_model);
    StockRecord stock = stock_model.record();
    stock.tools = {{1, 0}, {2, 0}, {2, 1}};
    return stock;
}

TEST(Stock, BytesGiveItBack) {
    const StockRecord stock = some_stock();
    const Bytes bytes = to_bytes(stock);
    EXPECT_EQ(read_stock(bytes, "stock.bin"), stock);
    EXPECT_EQ(to_bytes(some_stock()), bytes);
    EXPECT_LT(bytes.size(), 100'000U);
}

TEST(Stock, AnyOtherBytesAreAnErrorOrAStock) {
    const Bytes bytes = to_bytes(some_stock());
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 20) {
        EXPECT_THROW(read_stock({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}, "x"), InputError);
    }
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_THROW(read_stock(longer, "x"), InputError);
    std::mt19937 random(14);
    std::size_t refused = 0;
    for (int i = 0; i < 300; ++i) {
        Bytes changed = bytes;
        changed[random() % (i % 2 == 0 ? 200 : changed.size())] ^= static_cast<std::uint8_t>(1 + random() % 255);
        try {
            EXPECT_EQ(to_bytes(read_stock(changed, "x")), changed);
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 50U);
}

TEST(Stock, CarvingGoesOnFromItWithAtMostAHundredthMore) {
    StockModel whole(block, tool_axes, 0.5);
    cut_first(whole);
    StockModel later(block, tool_axes, 0.5);
    later.start_from(some_stock());
    EXPECT_EQ(later.record(), whole.record()) << "rounded once, rounded for good";
    const double volume = cut_second(whole).volume;
    EXPECT_NEAR(cut_second(later).volume, volume, 0.01 * 100 * 60);
    for (double x = -45; x < 50; x += 7.5) {
        for (double y = -25; y < 30; y += 4.5) {
            const auto top = [&](const StockModel& stock_model) {
                const std::vector<Dexel> there = stock_model.on_line({x, y, 0}, {0, 0, 1}, -100, 100);
                return there.empty() ? 0 : there.back().high;
            };
            EXPECT_GE(top(later), top(whole) - 2e-4) << x << " " << y;
            EXPECT_LE(top(later), top(whole) + 0.0127) << x << " " << y;  // 0.01 / 0.8: of the sloping direction
        }
    }
}

TEST(Stock, OfAnotherBlockIsRefused) {
    const StockRecord stock = some_stock();
    const auto refuses = [&](const Box& other, const std::vector<Vec3>& directions, double cell) {
        StockModel stock_model(other, directions, cell);
        EXPECT_THROW(stock_model.start_from(stock), InputError);
    };
    refuses({{-50, -30, 0}, {50, 30, 31}}, tool_axes, 0.5);
    refuses(block, {tool_axes[1], tool_axes[0]}, 0.5);
    refuses(block, {tool_axes[0]}, 0.5);
    refuses(block, tool_axes, 0.25);
}

// The chunks of a job each as a program of its own.
TEST(Stock, APartIsReplayedFromWhatThePartBeforeLeft) {
    const BoxJob whole = box_job("kr60-ha");
    ReplayOptions options;
    options.cell = 0.5;
    const ReplayReport undivided = replay(read_back(whole, whole.files()), whole.scene(), options);
    BoxJob first = whole;
    first.job.chunks.pop_back();
    BoxJob last = whole;
    last.job.chunks.erase(last.job.chunks.begin());
    ReplayScene scene = first.scene();
    scene.is_last = false;
    const ReplayReport before = replay(read_back(first, first.files()), scene, options);
    EXPECT_TRUE(before.is_good) << "the piece need not be there yet";
    EXPECT_EQ(before.left.tools, (std::vector<StockTool>{{2, 0}}));
    scene = last.scene();
    scene.before = &before.left;
    const ReplayReport after = replay(read_back(last, last.files()), scene, options);
    EXPECT_TRUE(after.is_good);
    EXPECT_NEAR(after.share_within(), undivided.share_within(), 1e-3);
    EXPECT_NEAR(after.leftover.largest, undivided.leftover.largest, 0.011);
    EXPECT_NEAR(after.share_reachable(), undivided.share_reachable(), 1e-9);
    EXPECT_FALSE(replay(read_back(last, last.files()), last.scene(), options).is_good) << "from the whole block";
}

}  // namespace
}  // namespace qchopper

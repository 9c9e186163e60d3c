#include "sim/replay/stages/stock_before_chunk.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

ReplayOptions coarse() {
    ReplayOptions options;
    options.cell = 0.5;
    return options;
}

// What a job leaves, in the block or in the stock before.
StockRecord left_of(const BoxJob& job, const StockRecord* before) {
    ReplayScene scene = job.scene();
    scene.before = before;
    scene.is_last = false;
    return replay(read_back(job, job.files()), scene, coarse()).left;
}

BoxJob only(const BoxJob& job, std::size_t chunk) {
    BoxJob one = job;
    one.job.chunks = {job.job.chunks.at(chunk)};
    return one;
}

TEST(StockBeforeChunk, IsWhatAProgramLeavesThatEndsBeforeIt) {
    const BoxJob whole = box_job("kr60-ha");
    const ParsedProgram program = read_back(whole, whole.files());
    const StockRecord begin = stock_before_chunk(program, whole.scene(), 0, coarse());
    EXPECT_TRUE(begin.tools.empty());
    EXPECT_TRUE(begin.maps.at(0).tiles.empty()) << "the whole block";
    const StockRecord stock = stock_before_chunk(program, whole.scene(), 1, coarse());
    EXPECT_EQ(stock, left_of(only(whole, 0), nullptr));
    EXPECT_NE(stock, begin);
    EXPECT_THROW(stock_before_chunk(program, whole.scene(), 2, coarse()), InputError);
}

TEST(StockBeforeChunk, CarvingGoesOnFromItToTheStockOfTheWholeProgram) {
    for (const char* cell : {"kr60-ha", "kr120-r2500-pro-rotary"}) {
        const BoxJob whole = box_job(cell);
        const StockRecord stock = stock_before_chunk(read_back(whole, whole.files()), whole.scene(), 1, coarse());
        const StockRecord end = left_of(whole, nullptr);
        EXPECT_NE(stock.maps, end.maps) << cell;
        EXPECT_EQ(left_of(only(whole, 1), &stock), end) << cell;
        ReplayScene scene = only(whole, 1).scene();
        scene.before = &stock;
        EXPECT_TRUE(replay(read_back(whole, only(whole, 1).files()), scene, coarse()).is_good) << cell;
    }
}

// The chunk in which the machine stood is carved once more: of its foam nothing is missing in the model.
TEST(StockBeforeChunk, AChunkThatWasCarvedInPartIsCarvedOnceMore) {
    const BoxJob whole = box_job("kr60-ha");
    const StockRecord stock = stock_before_chunk(read_back(whole, whole.files()), whole.scene(), 1, coarse());
    BoxJob stopped = only(whole, 1);
    stopped.job.chunks[0].moves.resize(stopped.job.chunks[0].moves.size() / 2);
    stopped.job.chunks[0].moves.back().is_rounded = false;
    const StockRecord real = left_of(stopped, &stock);
    EXPECT_NE(real, stock);
    EXPECT_EQ(left_of(only(whole, 1), &real), left_of(only(whole, 1), &stock));
}

}  // namespace
}  // namespace qchopper

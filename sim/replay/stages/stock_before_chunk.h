// The stock in which a chunk of a program begins: what a restart from that chunk is replayed from.
//
// mm, setup coordinates. The same as what replay() leaves of a program that ends before the chunk. A replay that goes
// on from it with the chunk and those behind it ends with the stock of the whole program
// (tests/sim/replay/stages/stock_before_chunk_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/replay.h"
#include "sim/replay/scene.h"
#include "sim/replay/stock/stock_record.h"

namespace qchopper {

// `chunk` is an index in ReplayScene::chunks: of 0 it is the whole block, or the stock before. Faults of the chunks
// before are not looked for: they are those of the program, which replay() finds. Throws InputError (use) if the
// program has no such chunk, and what replay() throws. Costs the replay of the chunks before, without the measurement
// of what is left.
StockRecord stock_before_chunk(ParsedProgram program, const ReplayScene& scene, std::size_t chunk,
                               const ReplayOptions& options = {}, const Context& context = {});

}  // namespace qchopper

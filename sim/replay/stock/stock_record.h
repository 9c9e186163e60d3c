// What a program left of its block, so that the next part of it can be replayed from there.
//
// Heights of the maps of stock_model.h, in 0.01 mm and rounded up: stock is not less than it is (to 0.0001 mm), and at
// most 0.01 mm more. Tiles that no tool came to are left out. Bytes are little-endian: "QCSTOCK1"; block, cell and
// counts; what was used; per direction its tiles in ascending order, each with its cells row by row, as differences and
// runs. Same stock, same bytes (tests/sim/replay/stock/stock_record_test.cpp).

#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/box.h"
#include "base/files/file.h"

namespace qchopper {

struct StockTile {
    static constexpr std::int32_t not_cut = std::numeric_limits<std::int32_t>::max();
    std::int32_t tx = 0;
    std::int32_t ty = 0;
    std::vector<std::int32_t> height;  // of DexelTile::cells, 0.01 mm
    bool operator==(const StockTile&) const = default;
};

struct StockMap {
    Vec3 tool_axis;  // of its direction
    std::vector<StockTile> tiles;
    bool operator==(const StockMap&) const = default;
};

// A tool that was used along a direction.
struct StockTool {
    std::uint16_t tool = 0;  // CuttingTool::number
    std::uint32_t orientation = 0;
    auto operator<=>(const StockTool&) const = default;
};

struct StockRecord {
    Box block;
    double cell = 0;
    std::vector<StockTool> tools;  // ascending, each once
    std::vector<StockMap> maps;    // per direction
    bool operator==(const StockRecord&) const = default;
};

Bytes to_bytes(const StockRecord& stock);

// Throws InputError (mesh) naming `source` if the bytes are not exactly what to_bytes writes.
StockRecord read_stock(const Bytes& bytes, const std::string& source);

}  // namespace qchopper

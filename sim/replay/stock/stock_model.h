// The block while it is milled: what has been removed along each direction, and what foam is left on a line.
//
// mm. For each direction one map of square cells at right angles to it, in a frame whose z is the tool axis: the
// lowest height to which the centre of the cell was cleared. A tool clears everything above what it cuts, so that a
// point is foam if it lies in the block and, in the frame of every direction, below the map. Heights at the centres of
// cells are exact; between them a wall is known to half a cell. While one direction is milled, each column of its cells
// is a list of intervals of foam (dexels), from which the removals of the other directions are taken where the tool
// comes (dexel_columns.h). Cells come in tiles of 64 x 64, which exist from when a tool comes there.
// tests/sim/replay/stock/stock_model_test.cpp.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/dexel.h"
#include "sim/replay/stock/stock_record.h"

namespace qchopper {

// What a move of the tool did to the foam.
struct CutResult {
    bool touches = false;  // removed more than 0.01 mm: with a tool whose surface lies 0.01 mm deeper inside
    double volume = 0;     // mm3
    // Largest height of foam that was removed above the tip, at the tip's lowest while the tool is over it: exact at
    // the centres of cells. No foam meets the tool higher, and on level and rising moves some does there.
    double depth = 0;
    // Of the cells where that is more than `flute`, at most within one diameter of the way. A wall is known to half a
    // cell, so that the width of a strip along the way is wrong by up to one cell.
    double deep_mm2 = 0;
};

class DexelColumns;
class DexelMap;

class StockModel {
 public:
    // `tool_axes` are unit vectors in the frame of the block. Precondition: cell > 0.
    StockModel(const Box& block, const std::vector<Vec3>& tool_axes, double cell);
    ~StockModel();
    StockModel(const StockModel&) = delete;
    StockModel& operator=(const StockModel&) = delete;

    // Removes what the tool sweeps from tip to tip along a direction. A move that begins where the last one ended, with
    // the same cutter along the same direction, costs less and removes the same.
    CutResult cut(std::size_t orientation, const Cutter& cutter, double flute, Vec3 from, Vec3 to);
    // Largest height by which foam stands above the underside of a disc that moves along a direction, its middle at
    // height `above` over the tip; 0 or less: it is clear.
    double disc_contact(std::size_t orientation, double radius, double above, Vec3 from, Vec3 to);
    // When no more is cut: gives back the memory of the columns, most of all. A cut after it is as any other, but takes
    // longer.
    void end_milling();
    // Whether foam is at a point.
    bool is_in_stock(Vec3 point) const;
    // The intervals of foam on the line from + t * along, for t of [low, high], ascending; `along` of length 1.
    std::vector<Dexel> on_line(Vec3 from, Vec3 along, double low, double high) const;
    // Distance from a point to the nearest point that was removed or lies outside of the block, at most `most`; points
    // of cells count at their centres, so that it is too large by at most 0.71 cells. Not for the block's underside.
    // `nearest` is the orientation along which it was removed where there is one; the one before is asked first.
    double distance_to_removed(Vec3 point, double most, std::size_t& nearest) const;

    // What is left, without the tools that were used.
    StockRecord record() const;
    // Goes on from there. Precondition: nothing has been cut. Throws InputError (mesh) if it is the stock of another
    // block, other directions or other cells.
    void start_from(const StockRecord& stock);

    const Pose& frame_in_block(std::size_t orientation) const;
    const Box& block() const { return block_; }
    double cell() const { return cell_; }

 private:
    DexelColumns& columns_along(std::size_t orientation);  // to be milled

    Box block_;
    std::vector<Vec3> tool_axes_;
    double cell_;
    std::vector<std::unique_ptr<DexelMap>> maps_;
    std::vector<std::unique_ptr<DexelColumns>> columns_;  // per map
    std::size_t milled_ = 0;                              // the orientation that is milled
    // Where the last move of cut() ended: what is about there was removed by it.
    struct LastMove {
        std::size_t orientation = 0;
        Cutter cutter;
        Vec3 to;
    };
    std::optional<LastMove> last_move_;
};

}  // namespace qchopper

// The saw list of an order: how each block is cut from its stock, which of its faces are glue faces, and to which
// pieces they are glued.
//
// mm. Blocks that are taken as they are do not stand in it. Nothing is packed: each block is cut from a stock of its
// own, and the offcuts are listed. Same blocks, same bytes, whatever their order
// (tests/cam/job/sheet/saw_list_test.cpp). docs/developer/formats/project-folder.md holds the grammar.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cam/job/glue_faces.h"
#include "cam/setup/saw_cuts.h"

namespace qchopper {

struct SawnBlock {
    std::string piece;
    std::optional<std::string> job;  // name of its file; nothing: the saw alone makes the piece
    std::size_t stock_number = 0;    // in the cell's list, from 0
    Stock stock;
    Vec3 size;                         // as it stands, along x, y and z; of a piece without a job the piece's own
    FlushFaces flush{};                // along axes with one the size is to 0.1 mm
    std::vector<SawCuts> cuts;         // in order
    std::vector<GlueFace> glue_faces;  // by BlockFace
    std::vector<std::string> at_base;  // pieces that are glued to the base
    bool operator==(const SawnBlock&) const = default;
};

// Nothing for a block that is not sawn. `is_only_sawn`: the piece has no job, and its base is sawn too.
std::optional<SawnBlock> sawn_block(const std::string& piece, const std::optional<std::string>& job, const Setup& setup,
                                    std::span<const JobCap> caps, const Cell& cell);

struct SawList {
    std::string order;              // what people call it
    double accuracy = 0.5;          // mm, Saw::accuracy
    std::vector<SawnBlock> blocks;  // by stock, then by the settings of the saw in their order, then by piece
};

SawList saw_list(std::string order, double accuracy, std::vector<SawnBlock> blocks);

// HTML in the style of the sheets; JSON text.
std::string saw_list_html(const SawList& list);
std::string saw_list_json(const SawList& list);

}  // namespace qchopper

// The passes that one tool finishes along one direction, and what of them waits for foam to be removed.
//
// mm, in the frame of the maps of the direction. Maps are computed in tiles near the points that are left and face the
// tool, as far as the passes there depend on them; elsewhere the CL surface is a bound, which keeps links off. The
// result does not depend on the number of threads (tests/cam/toolpath/finishing_operation_test.cpp).

#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/finishing/finishing_region.h"
#include "cam/toolpath/packed_heights.h"
#include "cam/toolpath/pass.h"
#include "cam/toolpath/toolpath.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/field_tiles.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// What an operation finishes, with what, and over what. All of it must outlive what is made of it.
struct FinishingInput {
    const Setup& setup;
    const TriangleMesh& mesh;
    const CellMachine& machine;
    const ToolpathSettings& settings;
    const HeightField& piece;  // along the direction, over the base plane, in the cells of foam
    double border = 0;         // of maps beyond the projection of the block
    // The foam at the centres of the cells of `piece`, of a direction that goes no deeper than it lets the tool;
    // nothing: other passes may remove what is in the way.
    const HeightField* stock = nullptr;
    bool is_whole = false;  // leaves points alone over which it cannot take all foam (RestMaterial::take)
};

// Where its maps are computed: what remains of the surface, and the tip of the tool.
struct FinishingTiles {
    FieldTiles surface;
    FieldTiles tip;
};

// A finishing tool over the map of the piece. It stays where it is.
struct ToolOverPiece {
    ToolOverPiece(HeightField map, const CuttingTool& of);
    HeightField piece;
    ToolDilation tool;
};

// Passes of an operation that are not milled yet, over its CL surface.
struct PassesLeft {
    Operation operation;  // without runs
    std::unique_ptr<ToolOverPiece> over_piece;
    HeightField cl;
    FinishingTiles tiles;
    std::vector<Pass> passes;
    std::size_t take = 0;     // of RestMaterial; 0: the surface was given back
    bool has_surface = true;  // false: nothing is left of the piece for it, and its passes go along the floor alone
    PackedHeights packed_piece = {};  // between pack() and unpack(), in which over_piece->piece and cl are empty
    PackedHeights packed_cl = {};

    // While it waits among others. O(cells).
    void pack();
    void unpack();
};

// All passes of an operation that has its kind, tool, direction and feeds; stepover, scallop and rounding are set here.
// What it finishes is taken from `rest`. Throws as finishing_passes() and piece_height_field().
PassesLeft finishing_operation(Operation operation, const FinishingInput& input, RestMaterial& rest,
                               const Context& context);

// Marks surface under passes that stay blocked by the foam of the input as left again; whether there is any. Twice it
// does nothing.
bool give_back(PassesLeft& left, const FinishingInput& input, RestMaterial& rest);

}  // namespace qchopper

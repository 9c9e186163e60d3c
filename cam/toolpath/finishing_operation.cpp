// The points that are left and face the tool say in which tiles maps are made (FieldTiles); of those the CL surface of
// the ball, raised for holder and spindle; what remains under it is compared with what is left so far, and gets passes.
//
// A direction takes only surface that it can finish with holder and spindle clear of what finishing leaves, scallops
// and clearance included, not only clear of the piece; else its deepest pass lies exactly on the limit and never
// becomes free.
//
// Of four operations on a piece of the bunny at 1.5 m the tiles were 1 to 23 % of the map. Cost: O(points) for the
// tiles, that of cl_surface() and finishing_passes() in them.

#include "cam/toolpath/finishing_operation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cam/setup/holder_clearance.h"
#include "cam/toolpath/clipped_passes.h"
#include "cam/toolpath/finishing/finishing.h"
#include "cam/toolpath/finishing_limit.h"

namespace qchopper {
namespace {

// Edges are cut into by at most 0.11 mm by its border, which with what paths between cells cut is below 0.25 mm.
constexpr DilationOptions finishing_dilation_options{0, 0.075};
// Of a stepover, by which regions of different operations overlap.
constexpr double region_overlap = 0.25;

const CuttingTool& tool_of(const Operation& operation, const FinishingInput& input) {
    return input.machine.tools[operation.tool];
}

double lowest_of(const HeightField& cl, const FieldTiles& tiles) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < cl.rows; ++row) {
        for (const CellSpan& span : tiles.spans(row)) {
            const float* own = &cl.height[row * cl.columns];
            lowest = std::min(lowest, static_cast<double>(*std::min_element(own + span.first, own + span.end)));
        }
    }
    return lowest;
}

// Foam up to so much is as good as none.
double near(const Operation& operation, const FinishingInput& input) {
    return operation.scallop + input.settings.cell;
}

// A fine tool goes on where others have left more than so much.
double worth(const Operation& operation, const FinishingInput& input) {
    return operation.kind == OperationKind::fine_finishing ? near(operation, input) : 0;
}

// The floor within a tool's width of the piece.
FinishingRegion floor_band(const HeightField& piece, double width, const Setup& setup) {
    FinishingRegion floor(piece.height.size(), not_finished);
    add_floor_band(floor, piece, width, setup);
    return floor;
}

// Those that what the operation may finish depends on, and what is near to the floor if there is one.
FinishingTiles finishing_tiles(const Operation& operation, const FinishingInput& input, const HeightField& piece,
                               const FinishingRegion& floor, const FinishingOptions& options,
                               const RestMaterial& rest) {
    const auto cells = [&](double length) { return static_cast<std::size_t>(std::ceil(length / piece.cell)); };
    const double examined = RestMaterial::examined(near(operation, input));
    FieldTiles places = rest.places(piece, near(operation, input), worth(operation, input));
    const FieldTiles surface = places.grown(cells(examined) + 1);
    for (std::size_t i = 0; i < floor.size(); ++i) {
        if (floor[i] < not_finished) places.add(i);
    }
    const CuttingTool& tool = tool_of(operation, input);
    const double margin =
        std::max(finishing_margin(tool, options, piece.cell) + touching, examined + 0.5 * tool.diameter + piece.cell);
    return {surface, places.grown(cells(margin) + 1)};
}

// Raises a CL surface for holder and spindle over the piece.
void raise_over_piece(HeightField& cl, const Operation& operation, const FinishingInput& input,
                      const HeightField& piece, const FieldTiles& tiles) {
    const ToolBody body = tool_body(tool_of(operation, input), input.machine);
    raise_to_holder(cl, piece, body, input.setup.piece_in_setup);
    const double foam_left = operation.scallop + input.settings.path_tolerance;
    const HolderGap gap = finishing_gap(input.setup, input.piece.cell);
    raise_to_limit(cl, limit_over_finished(input.piece, foam_left, body, gap, lowest_of(cl, tiles)), tiles);
}

// The same over the foam that stands, for the flute too.
void raise_over_stock(HeightField& cl, const Operation& operation, const FinishingInput& input,
                      const FieldTiles& tiles) {
    const CuttingTool& tool = tool_of(operation, input);
    raise_to_limit(cl,
                   limit_over_stock(*input.stock, tool, tool_body(tool, input.machine),
                                    finishing_gap(input.setup, input.piece.cell), lowest_of(cl, tiles)),
                   tiles);
}

}  // namespace

ToolOverPiece::ToolOverPiece(HeightField map, const CuttingTool& of)
    : piece(std::move(map)), tool(piece, of, finishing_dilation_options) {}

void PassesLeft::pack() {
    const auto packed = [](HeightField& map) {
        PackedHeights result(map.height);
        map.height = std::vector<float>();  // = {} would keep the memory
        return result;
    };
    packed_piece = packed(over_piece->piece);
    packed_cl = packed(cl);
}

void PassesLeft::unpack() {
    over_piece->piece.height = packed_piece.unpacked();
    cl.height = packed_cl.unpacked();
    packed_piece = packed_cl = {};
}

PassesLeft finishing_operation(Operation operation, const FinishingInput& input, RestMaterial& rest,
                               const Context& context) {
    const Setup& setup = input.setup;
    const CuttingTool& tool = tool_of(operation, input);
    FinishingOptions options;
    options.scallop = input.settings.scallop;
    options.path_tolerance = input.settings.path_tolerance;
    options.rounding = input.settings.rounding;
    operation.stepover = finishing_stepover(tool, options);
    operation.scallop = options.scallop;
    operation.rounding = options.rounding;
    const double floor_z = finishing_floor(setup, setup.tool_axis(operation.orientation), 0.5 * tool.diameter);
    auto over_piece = std::make_unique<ToolOverPiece>(
        piece_height_field(setup, input.mesh, operation.orientation, {input.settings.cell, floor_z, input.border}),
        tool);
    const bool has_floor =
        operation.orientation == 0 && operation.kind == OperationKind::finishing && input.stock == nullptr;
    const FinishingRegion floor = has_floor ? floor_band(over_piece->piece, tool.diameter, setup) : FinishingRegion();
    FinishingTiles tiles = finishing_tiles(operation, input, over_piece->piece, floor, options, rest);
    HeightField own_cl = cl_surface(over_piece->tool, tiles.tip);  // without holder and spindle
    HeightField cl = own_cl;
    raise_over_piece(cl, operation, input, over_piece->piece, tiles.tip);
    if (input.stock != nullptr) raise_over_stock(cl, operation, input, tiles.tip);
    const FinishingRegion region =
        rest.take(remaining_surface(cl, tool, tiles.surface), near(operation, input),
                  region_overlap * operation.stepover, worth(operation, input), input.is_whole);
    const bool has_surface = std::any_of(region.begin(), region.end(), [](float low) { return low != not_finished; });
    std::vector<Pass> passes;
    if (has_surface || has_floor) {
        if (has_floor) options.floor = &floor;
        options.tool = &over_piece->tool;
        options.tiles = &tiles.tip;
        passes = finishing_passes(cl, tool, region, options, context);
        passes = clear_of_sawn_faces(near_surface(passes, own_cl), own_cl, tool, setup);
    }
    own_cl = {};
    return {std::move(operation), std::move(over_piece), std::move(cl), std::move(tiles),
            std::move(passes),    rest.takes(),          has_surface};
}

bool give_back(PassesLeft& left, const FinishingInput& input, RestMaterial& rest) {
    if (left.take == 0) return false;
    HeightField cl = left.cl;
    raise_over_stock(cl, left.operation, input, left.tiles.tip);
    const HeightField remaining = remaining_surface(cl, tool_of(left.operation, input), left.tiles.surface);
    const bool is_any = rest.give_back(left.take, remaining, near(left.operation, input));
    left.take = 0;
    return is_any;
}

}  // namespace qchopper

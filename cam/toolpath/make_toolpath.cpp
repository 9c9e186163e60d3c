// One operation at a time: maps of its direction, passes, runs; then the stock learns what the runs removed.
//
// Passes that foam blocks are taken up again. Finishing passes are divided into free and blocked parts
// (clipped_passes.h). After the free ones the limit of holder and spindle is computed again over the foam that stands
// then, until nothing more becomes free. What stays blocked waits, with its CL surface, for the other directions and
// is tried again in rounds until a round mills nothing. The same holds for passes that would cut foam above the flute.
// Clipping once, at the start, lost what later became free: of a piece twice as high as its tools are long 16 % of the
// reachable surface kept too much foam. Passes are not sorted strictly from above, which would cost a link for each.
//
// Passes that stay blocked all the same, 200 mm or more of an operation in parts of 20 mm, give their surface back, at
// most twice for each kind of finishing, to the directions that reach it better. The finest tool roughs before it
// finishes. What one operation finishes: finishing_operation.cpp.
//
// Foam is known in cells by the finest tool's radius (stock_cell_of()): a small tool lowers larger cells hardly at all.
// Links and holder count a cell as foam until all of it is cut; for the flute the height at its middle is known too
// (StockCells), because a skin that roughing leaves on a wall is as thick as a cell.
//
// Cost: that of the passes; per operation with blocked passes a CL surface is kept, 4 bytes a cell of finishing, and
// the foam is held twice. Tests: tests/cam/toolpath/make_toolpath_test.cpp, PassesThatFoamBlocksAreTakenUpAgain...,
// SurfaceThatStaysBlockedIsLeftToAnotherDirection, FinishesAWallDownToWhereTheHolderMeetsItsTop.

#include "cam/toolpath/make_toolpath.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cam/setup/holder_clearance.h"
#include "cam/stock/cl_surface.h"
#include "cam/stock/in_process_stock.h"
#include "cam/stock/roughing_limit.h"
#include "cam/toolpath/clipped_passes.h"
#include "cam/toolpath/cutting_parts.h"
#include "cam/toolpath/finishing/finishing_region.h"
#include "cam/toolpath/finishing_limit.h"
#include "cam/toolpath/finishing_operation.h"
#include "cam/toolpath/pass_stretches.h"
#include "cam/toolpath/roughing.h"
#include "cam/toolpath/run_motion.h"
#include "cam/toolpath/toolpath_linker.h"
#include "cam/toolpath/unused_tools.h"
#include "cam/toolpath/worthwhile_tools.h"

namespace qchopper {
namespace {

// Of the maps of foam, mm: a quarter of the finest tool's radius between 0.5 and 1, and a sixth of it from there on.
// What others cost and leave: docs/measurements/performance.md.
double stock_cell_of(const CuttingTool& finest) {
    const double radius = 0.5 * finest.diameter;
    return std::max(std::clamp(radius / 4, 0.5, 1.0), radius / 6);
}

// Of the scallop height, foam that finishing leaves rather than come for it: lower than what it leaves between passes.
constexpr double film_share = 0.8;
constexpr double worth_a_round = 50;   // mm of passes that were blocked and are free now
constexpr int max_given_back = 2;      // times, of each kind of finishing
constexpr double long_blocked = 20;    // mm of a pass; shorter ones lie between free ones
constexpr double worth_another = 200;  // mm of such passes that are worth another direction
constexpr double border_cells = 6;
constexpr double surface_spacing = 1;     // mm, between points that are asked what is left over them
constexpr double thinner = 0.75;          // of the diameter of the tool before: it roughs where that did not come
constexpr double depth_per_diameter = 3;  // of a cut at most
constexpr double worthwhile_rate = 0.3;   // of a tool's, removed by roughing what others left
constexpr double skin_beyond = 4.2;       // mm beyond the allowance: a narrower rim of foam is left to finishing

class ToolpathMaker {
 public:
    ToolpathMaker(const Setup& setup, const TriangleMesh& mesh, const Cell& cell, const ToolpathSettings& settings,
                  const OperationCheck& check, const Context& context)
        : setup_(setup),
          mesh_(mesh),
          cell_(cell),
          machine_(*cell.machine),
          settings_(settings),
          check_(check),
          context_(context),
          tools_(choose_tools(machine_, settings)),
          stock_(setup),
          centre_stock_(setup, StockCells::centres),
          left_(mesh, setup, surface_spacing),
          coarse_pieces_(setup.access.orientations.size()) {
        check_settings(settings, machine_, tools_);
        if (settings.finishing_tools.empty()) {
            tools_.finishing = worthwhile_tools(setup, mesh, cell, tools_.finishing, settings, context);
        }
        stock_cell_ = stock_cell_of(machine_.tools[tools_.finishing.back()]);
        double widest = 0;
        for (const CuttingTool& tool : machine_.tools) widest = std::max(widest, 0.5 * tool.diameter);
        border_ = widest + border_cells * stock_cell_;
    }

    Toolpath make() {
        const std::size_t directions = setup_.access.orientations.size();
        total_ = (1 + 2 * tools_.finishing.size()) * directions;
        for (std::size_t d = 0; d < directions; ++d) rough_along(d, tools_.roughing);
        std::size_t before = tools_.roughing;
        for (const std::size_t tool : tools_.finishing) {
            // What a tool of nearly the same width could not rough is as deep as finishing cuts.
            const bool is_thinner = machine_.tools[tool].diameter < thinner * machine_.tools[before].diameter;
            for (std::size_t d = 0; d < directions && is_thinner; ++d) rough_along(d, tool);
            finish(tool);
            before = tool;
        }
        for (bool goes_on = tools_.finishing.size() > 1; goes_on;) {
            goes_on = std::ranges::all_of(tools_.finishing, [&](std::size_t tool) { return retry(tool); });
        }
        report();
        if (toolpath_.operations.empty()) {
            throw InputError(InputFault::use, "the toolpath is empty: no tool has anything to cut",
                             "check the block, the tools and the base of the piece");
        }
        toolpath_.unused = unused_tools(machine_, tools_, setup_.access.orientations.size(), toolpath_, is_empty_);
        toolpath_.cell = settings_.cell;
        toolpath_.path_tolerance = settings_.path_tolerance;
        return std::move(toolpath_);
    }
    InProcessStock take_stock() { return std::move(stock_); }

 private:
    void report() {
        context_.check_cancelled();
        total_ = std::max(total_, done_);
        context_.progress("operations of the toolpath", done_++, total_);
    }

    HeightField target(std::size_t orientation, double cell, double floor_z) const {
        return piece_height_field(setup_, mesh_, orientation, {cell, floor_z, border_});
    }

    // In the cells of foam, over the base plane.
    const HeightField& coarse_piece(std::size_t orientation) {
        HeightField& map = coarse_pieces_[orientation];
        if (map.height.empty()) map = target(orientation, stock_cell_, 0);
        return map;
    }

    ToolBody body_of(std::size_t tool) const { return tool_body(machine_.tools[tool], machine_); }

    // Fills what is the same for all kinds of operation.
    MillingSpace space_of(const HeightField& frame, const Operation& operation) {
        MillingSpace space;
        space.stock = stock_.highest(operation.orientation, frame);
        space.centre_stock = centre_stock_.highest(operation.orientation, frame);
        space.removed = frame;
        std::fill(space.removed.height.begin(), space.removed.height.end(), std::numeric_limits<float>::infinity());
        space.centre_removed = space.removed;
        space.retract = operation.retract + setup_to_field(setup_, frame, {}).z;
        return space;
    }

    // Foam that finishing cuts, up to its deepest cut, stays; with `is_whole` all that is higher than a level goes.
    void rough_along(std::size_t orientation, std::size_t tool_index, bool is_whole = false) {
        report();
        const CuttingTool& tool = machine_.tools[tool_index];
        const bool is_first = orientation == 0 && tool_index == tools_.roughing;
        const bool is_large = tool_index == tools_.roughing;
        const CuttingTool& finishing = is_large ? machine_.tools[tools_.finishing.front()] : tool;
        Operation operation = new_operation(orientation, tool_index, OperationKind::roughing);
        operation.stepover = stepover_of(tool, settings_);
        operation.stepdown = stepdown_of(tool, settings_);
        operation.allowance = is_large ? settings_.allowance : settings_.fine_allowance;
        operation.rounding = settings_.rounding;
        const HeightField& piece = coarse_piece(orientation);
        HeightField cl = cl_surface(piece, tool, {operation.allowance});
        raise_to_holder(cl, piece, body_of(tool_index), setup_.piece_in_setup);
        stay_near_stock(cl, stock_.lowest(orientation, cl), tool, operation.stepdown);
        if (settings_.beside_block) {
            InProcessStock block(setup_, StockCells::centres);
            close_beside_stock(cl, block.highest(orientation, cl), *settings_.beside_block);
        }
        MillingSpace space = space_of(piece, operation);
        space.cl_limit = &cl;
        space.is_limit_between = false;
        RoughingOptions options;
        if (is_first) {
            options.deepest = deepest_cut(tool);
        } else {
            // A level cuts what stands above it by the skin too.
            const double left = std::min(deepest_cut(tool), deepest_cut(finishing)) - operation.stepdown;
            options.skin_height = std::max(operation.stepdown, is_whole ? 0 : left);
            options.skin_width = settings_.allowance + skin_beyond;
        }
        RoughingRuns found = rough(space, tool, body_of(tool_index), operation, options, context_);
        if (is_first || is_whole || found.deepest > deepest_cut(finishing, 1) || is_worthwhile(found, operation)) {
            add(std::move(operation), space, std::move(found.runs));
        }
    }

    // Finishing cuts a little foam, no deeper than it may, in less time than a roughing that goes a long way for it.
    bool is_worthwhile(const RoughingRuns& found, const Operation& operation) const {
        double seconds = 0;
        for (const PathRun& run : found.runs) seconds += seconds_at_feed(run, operation);
        return found.removed_mm3 >= worthwhile_rate * machine_.tools[operation.tool].removal_mm3_per_s * seconds;
    }

    // From all directions; then surface that stays blocked for one is left to the others.
    void finish(std::size_t tool) {
        const OperationKind kind =
            tool == tools_.finishing.front() ? OperationKind::finishing : OperationKind::fine_finishing;
        const std::size_t directions = setup_.access.orientations.size();
        for (std::size_t d = 0; d < directions; ++d) {
            report();
            finish_along(d, tool, kind, false);
        }
        retry(tool);
        if (blocked_length(tool) >= worth_another) clear_for(tool);
        for (int k = 0; k < max_given_back && directions > 1 && give_blocked_back(tool); ++k) {
            for (std::size_t d = 0; d < directions; ++d) finish_along(d, tool, kind, true);
            retry(tool);
        }
    }

    // What one finishes along a direction; with `stock` no deeper than that lets it.
    FinishingInput finishing_input(std::size_t orientation, std::size_t tool, const HeightField* stock) {
        return {setup_, mesh_, machine_, settings_, coarse_piece(orientation), border_, stock, is_followed_twice(tool)};
    }

    HeightField standing_stock(std::size_t orientation) {
        return centre_stock_.highest(orientation, coarse_piece(orientation));
    }

    // With `over_stock` it goes no deeper than the foam that stands lets it.
    void finish_along(std::size_t orientation, std::size_t tool_index, OperationKind kind, bool over_stock) {
        const HeightField stock = over_stock ? standing_stock(orientation) : HeightField();
        PassesLeft left = finishing_operation(new_operation(orientation, tool_index, kind),
                                              finishing_input(orientation, tool_index, over_stock ? &stock : nullptr),
                                              left_, context_);
        if (!left.has_surface && !over_stock) is_empty_.insert({tool_index, orientation});
        if (left.passes.empty()) return;
        mill(left);
        if (left.passes.empty()) return;
        left.pack();
        blocked_.push_back(std::move(left));
    }

    static double lowest_of(const std::vector<Pass>& passes) {
        double lowest = std::numeric_limits<double>::infinity();
        for (const Pass& pass : passes) {
            for (const PassPoint& point : pass.points) lowest = std::min(lowest, point.tip.z);
        }
        return lowest;
    }

    // Carves what foam does not block, again and again, because passes free others; the rest is left. The length in mm
    // of what was milled.
    double mill(PassesLeft& left) {
        const CuttingTool& tool = machine_.tools[left.operation.tool];
        const ToolBody body = body_of(left.operation.tool);
        MillingSpace space = space_of(coarse_piece(left.operation.orientation), left.operation);
        space.cl_limit = &left.cl;
        space.tool = &left.over_piece->tool;
        if (!setup_.flush_caps.empty()) {
            space.is_beside_sawn_face = BesideSawnFaces(setup_, left.cl, 0.5 * tool.diameter);
        }
        LinkOptions links;
        links.within = settings_.path_tolerance;
        links.film = film_share * left.operation.scallop;
        ToolpathLinker runs(space, tool, left.operation, links);
        double milled = 0;
        while (!left.passes.empty()) {
            context_.check_cancelled();
            space.holder_clearance_height =
                holder_clearance_over(space.centre_stock, body, finishing_gap(setup_, stock_cell_),
                                      std::min(lowest_of(left.passes), runs.end_height()));
            ClippedPasses parts = clipped(left.passes, space, tool);
            left.passes = std::move(parts.blocked);
            const double length = length_of(parts.free);
            milled += length;
            runs.add(cutting_parts(parts.free, space.centre_stock, tool, links.film));
            if (length < worth_a_round) break;
        }
        add(left.operation, space, runs.finish());
        return milled;
    }

    // Takes up the passes of a tool that foam has blocked, until a round over the directions mills nothing. Whether
    // any did.
    bool retry(std::size_t tool) {
        bool has_milled = false;
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (PassesLeft& left : blocked_) {
                if (left.operation.tool != tool) continue;
                left.unpack();
                if (mill(left) >= worth_a_round) goes_on = true;
                left.pack();
            }
            std::erase_if(blocked_, [](const PassesLeft& left) { return left.passes.empty(); });
            has_milled = has_milled || goes_on;
        }
        return has_milled;
    }

    // mm of passes of a tool that foam blocks.
    double blocked_length(std::size_t tool) const {
        double length = 0;
        for (const PassesLeft& left : blocked_) {
            if (left.operation.tool == tool) length += length_of(left.passes);
        }
        return length;
    }

    // Foam that was left to finishing keeps holders and flutes from its own passes: it is roughed after all, by the
    // tool in the spindle.
    void clear_for(std::size_t tool) {
        for (std::size_t d = 0; d < setup_.access.orientations.size(); ++d) rough_along(d, tool, true);
        retry(tool);
    }

    // Marks surface under passes that stay blocked as left again. Whether there is any.
    bool give_blocked_back(std::size_t tool) {
        bool is_any = false;
        for (PassesLeft& left : blocked_) {
            if (left.operation.tool != tool || left.take == 0) continue;
            double length = 0;
            for (const Pass& pass : left.passes) length += length_of(pass) < long_blocked ? 0 : length_of(pass);
            if (length < worth_another) continue;
            context_.check_cancelled();
            const HeightField stock = standing_stock(left.operation.orientation);
            left.unpack();
            if (give_back(left, finishing_input(left.operation.orientation, tool, &stock), left_)) is_any = true;
            left.pack();
        }
        return is_any;
    }

    // Whether two more tools finish after it. The last but one clears for the last what neither of them finishes.
    bool is_followed_twice(std::size_t tool) const {
        return std::ranges::find(tools_.finishing, tool) + 2 < tools_.finishing.end();
    }

    // The most foam that the tool cuts at once in its whole width at its least feed and a share of its rate, at most
    // three times its diameter.
    double deepest_cut(const CuttingTool& tool, double share = used_rate) const {
        const double by_rate = share * tool.removal_mm3_per_s / (tool.diameter * tool.feed_min_mm_per_s);
        return std::min({by_rate, depth_per_diameter * tool.diameter, tool.flute_length});
    }

    Operation new_operation(std::size_t orientation, std::size_t tool, OperationKind kind) const {
        Operation operation = operation_of(machine_, tool, kind, orientation);
        const CuttingTool& cutter = machine_.tools[tool];
        const auto share = settings_.feed_shares.find(cutter.number);
        if (share != settings_.feed_shares.end()) {
            operation.feed = std::max(cutter.feed_min_mm_per_s, share->second * operation.feed);
            operation.approach_feed = std::min(operation.approach_feed, operation.feed);
        }
        operation.retract = retract_height(setup_, setup_.tool_axis(orientation), cell_.clearance);
        return operation;
    }

    // An operation without runs is left out.
    void add(Operation operation, const MillingSpace& space, std::vector<PathRun> runs) {
        if (runs.empty()) return;
        for (PathRun& run : runs) {
            run.start = field_to_setup(setup_, space.stock, run.start);
            for (PathMove& move : run.moves) move.tip = field_to_setup(setup_, space.stock, move.tip);
        }
        operation.runs = std::move(runs);
        stock_.remove_above(operation.orientation, space.removed);
        centre_stock_.remove_above(operation.orientation, space.centre_removed);
        toolpath_.operations.push_back(std::move(operation));
        if (check_) check_(toolpath_.operations);
    }

    const Setup& setup_;
    const TriangleMesh& mesh_;
    const Cell& cell_;
    const CellMachine& machine_;
    const ToolpathSettings& settings_;
    const OperationCheck& check_;
    const Context& context_;
    ToolChoice tools_;
    InProcessStock stock_;
    InProcessStock centre_stock_;
    RestMaterial left_;
    std::vector<PassesLeft> blocked_;
    ToolsAlong is_empty_;  // tools that have nothing to finish along a direction
    double stock_cell_ = 1;
    std::vector<HeightField> coarse_pieces_;  // of each direction; empty until it is asked for
    double border_ = 0;
    std::size_t done_ = 0;
    std::size_t total_ = 0;
    Toolpath toolpath_;
};

}  // namespace

double retract_height(const Setup& setup, Vec3 tool_axis, double clearance) {
    const Vec3 corner = setup.milled_box().max;
    return std::abs(tool_axis.x) * corner.x + std::abs(tool_axis.y) * corner.y + std::max(0.0, tool_axis.z) * corner.z +
           clearance;
}

Toolpath make_toolpath(const Setup& setup, const TriangleMesh& mesh, const Cell& cell, const ToolpathSettings& settings,
                       const Context& context, InProcessStock* left, const OperationCheck& check) {
    assert(!setup.access.orientations.empty());
    if (!cell.machine) {
        throw InputError(InputFault::config, "the cell file describes no machine",
                         "give a cell file with spindle and tools, docs/user/cell-file.md");
    }
    ToolpathMaker maker(setup, mesh, cell, settings, check, context);
    Toolpath toolpath = maker.make();
    if (left != nullptr) *left = maker.take_stock();
    return toolpath;
}

}  // namespace qchopper

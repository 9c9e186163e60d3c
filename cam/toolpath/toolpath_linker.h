// Joins passes to runs: which pass comes next, and how the tool comes to it.
//
// mm, in the frame of the height fields of one direction. A link at its own feed touches no foam: the whole tool must
// be clear of all that may be foam. Where that is not known, the way is driven at the feed of cuts
// (tests/cam/toolpath/passes_and_links_test.cpp).
//
// The tool comes to a pass straight, where the way is clear or may be cut; else over what stands between; else through
// the retract plane. It comes down at the feed of links to just above the foam. A pass of roughing is entered on a ramp
// along itself, unless it begins beside the foam. Plunges, at the feed of approaches: in finishing, through what
// roughing left, and in roughing where a pass is shorter than min_ramp. A tool whose centre does not cut goes to and
// fro on ramps as long as it is wide, and a pass of roughing that is shorter is left out where foam would have to be
// entered.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/stock/cl_surface.h"
#include "cam/stock/in_process_stock.h"
#include "cam/toolpath/pass.h"
#include "cam/toolpath/toolpath.h"
#include "segment/raster/height_field.h"

namespace qchopper {

constexpr double min_ramp = 3;  // mm

// What is around the tool in one direction. All maps have the frame of the passes; those of foam and holder have the
// same cells.
struct MillingSpace {
    const HeightField* cl_limit = nullptr;  // least height of the tip
    bool is_limit_between = true;           // the limit holds between centres of cells too; else each cell has its own
    const ToolDilation* tool = nullptr;     // if known: what made the limit, which may have been raised since
    HeightField stock;                      // highest foam; runs lower it
    HeightField removed;                    // down to where runs removed everything, infinite elsewhere; runs lower it
    HeightField centre_stock;               // at the centres of cells; runs lower it
    HeightField centre_removed;             // likewise
    HeightField holder_clearance_height;    // least height of the tip over what the foam is, or was
    double retract = 0;                     // height of the retract plane
    // Whether the tool touches a sawn face there (BesideSawnFaces); nothing: there is none.
    std::function<bool(Vec3)> is_beside_sawn_face = {};
};

// Within so much of its rim, a tool may graze foam that is higher than its flute: no centre of a cell may lie there.
constexpr double flute_rim = 0.25;  // mm

struct LinkOptions {
    bool has_ramps = false;  // of roughing
    double stay_down = 300;  // longest straight line to the next pass that is looked at
    double gap = 2;          // above foam, where an approach begins
    double clearance = 3;    // above what a link goes over
    double slack = 0.36;     // how far a controller that rounds corners may pass beside the way
    double film = 0;  // foam so high is none: a pass that cuts no more is left out (cutting_parts.h); 0: all are made
    double within = 0.1;  // the same within a pass of finishing that does not say itself what may be rounded
};

class ToolpathLinker {
 public:
    // The space, the tool and the operation, whose feeds and rounding are looked at, must outlive it.
    ToolpathLinker(MillingSpace& space, const CuttingTool& tool, const Operation& operation, LinkOptions options);

    // Adds passes, of roughing the nearest first, of finishing in short_order(). O(short_order() + length of the links
    // / cell * (radius / cell)^2).
    void add(const std::vector<Pass>& passes);

    // The runs in map coordinates, at most about 650 moves each where a link goes high anyway, never more than 1000.
    std::vector<PathRun> finish();

    // Of the tip where the last pass has ended: the next link begins there, and may lie no lower than that or the next
    // pass. Infinite before the first pass of a run.
    double end_height() const { return run_.moves.empty() ? std::numeric_limits<double>::infinity() : at_.z; }

    // By all moves so far.
    double removed_mm3() const { return all_removed_mm3_; }

 private:
    struct Way;
    // What is known of the corner at the end of a move: nothing; it lies within a pass; the pass has it rounded; all
    // around is clear as far as LinkOptions::clearance.
    enum class Corner : std::uint8_t { joint, inner, rounded, clear };
    void add_roughing(const std::vector<Pass>& passes);
    void add_pass(const Pass& pass);
    void begin_run(Vec3 at);
    void end_run();
    void go_to(const Pass& pass);
    void hop_to(Vec3 to, double height);
    void enter(const Pass& pass);
    void ramp(const Pass& pass, double top);
    void move(Vec3 tip, MoveKind kind, Corner corner = Corner::joint);
    double rounding_before(Vec3 to, MoveKind kind) const;
    bool is_round_way_clear(Vec3 to, MoveKind kind, double rounding) const;
    Way way_to(Vec3 to) const;

    double stock_near(Vec3 at, double radius) const;
    double over_flute(Vec3 at) const;
    double limit_at(Vec3 p) const;
    double highest_limit_around(Vec3 p) const;
    double limit_spacing() const;
    double holder_at(double x, double y) const;
    bool needs_ramp(Vec3 at) const;
    // Of a pass that is entered on a ramp.
    double least_length() const { return tool_->is_centre_cutting ? min_ramp : std::max(min_ramp, tool_->diameter); }
    // More than roughing leaves to finishing, were the tool a cylinder.
    bool removes_foam(Vec3 at) const;

    MillingSpace* space_;
    const CuttingTool* tool_;
    const Operation* operation_;
    LinkOptions options_;
    ToolSweep sweep_;
    ToolSweep centre_sweep_;
    double outer_ = 0;  // radius within which a cell may hold foam that the tool touches
    double inner_ = 0;  // radius within which all of a cell lies under the tool
    Vec3 at_;
    Vec3 before_;                    // where the last move of the run begins
    Corner corner_ = Corner::joint;  // at its end
    PathRun run_;
    std::vector<double> removed_mm3_;  // by each of its moves
    double all_removed_mm3_ = 0;
    std::vector<PathRun> runs_;
};

}  // namespace qchopper

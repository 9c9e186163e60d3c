// Where tools can come to on the target: its closing by tool and holder along a direction, computed here.
//
// mm. Per direction the highest points of the target and of the floor of the spoil layer on square cells; the least
// heights at which a tool may stand, its holder and the spindle clear; and the lowest surface that it then leaves. The
// flute asks for nothing of its own: above it a tool is as thick as below, and foam that is higher is removed in
// levels. O(cells * (radius / cell)^2) (tests/sim/replay/reach/reachable_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/context.h"
#include "sim/replay/reach/surface_map.h"
#include "sim/replay/scene.h"

namespace qchopper {

struct ClosingOptions {  // mm
    double cell = 1;
    double around = 0;            // that the map goes on beside the target; never less than twice the tool's radius
    double holder_clearance = 0;  // that holder and spindle keep from the target, beside it and above it
};

// The closing along a direction by a tool. Throws Cancelled.
SurfaceMap closing_of(const ReplayScene& scene, std::size_t orientation, const CuttingTool& tool,
                      const ClosingOptions& options, const Context& context);

// The tools that the program uses along each direction, and those that parts before it used: ascending, each once.
std::vector<StockTool> used_tools(const ReplayScene& scene);

// Indices in CellMachine::tools, along a direction.
using ToolsOf = std::function<std::vector<std::size_t>(std::size_t orientation)>;

// A tool that comes to a point, and the direction from which it does.
struct ReachingTool {
    std::size_t tool = 0;         // index in CellMachine::tools
    std::size_t orientation = 0;  // index in ReplayScene::orientations
};

// Of each point of the setup the first of the closings, in the order of directions and of the tools of Closings::along,
// that comes as near to it as `within`; nothing: none does. The same as to ask them one after the other, but for what
// is not computed because nobody asks for it (tests/sim/replay/given_up_test.cpp). Throws Cancelled.
std::vector<std::optional<ReachingTool>> first_reach(const ReplayScene& scene, const std::vector<Vec3>& points,
                                                     const ToolsOf& tools_of, double cell, double within,
                                                     const Context& context);

// The closing by one tool along one direction.
struct Closing {
    std::size_t tool = 0;         // index in CellMachine::tools
    std::size_t orientation = 0;  // index in ReplayScene::orientations
    SurfaceMap map;
};

// Closings by the same options, each computed once. Not for several threads at once.
class Closings {
 public:
    // The scene must outlive it.
    Closings(const ReplayScene& scene, const ClosingOptions& options) : scene_(scene), options_(options) {}
    // What the tools of these indices reach together along a direction: the closing by the finest of each shape, and,
    // where its holder keeps it away, those by coarser ones whose holder does not. Others add nothing: a larger ball
    // fits in only where a smaller one does, a wider flat end where a narrower one does; of bulls and cones all are
    // closed. Of tools of several shapes only the ball-ended ones count, which finish; where none is, all but drills.
    // Valid while this object lives. Throws Cancelled.
    std::vector<const Closing*> along(std::size_t orientation, std::vector<std::size_t> tools, const Context& context);

 private:
    const Closing& of(std::size_t orientation, std::size_t tool, const Context& context);

    const ReplayScene& scene_;
    ClosingOptions options_;
    std::map<std::pair<std::size_t, std::size_t>, Closing> known_;  // by direction and tool
};

// How many of ReplayScene::orientations, the first ones, are those of the setup, from which the target is to be milled.
std::size_t milling_orientations(const ReplayScene& scene);
// What may be used: indices of the tools of the cell, but for those that the operator left out (ReplayScene::tools).
std::vector<std::size_t> allowed_tools(const ReplayScene& scene);
// Indices of those that the program uses along a direction, parts before included.
std::vector<std::size_t> tools_along(const ReplayScene& scene, std::size_t orientation);

}  // namespace qchopper

// Each hole is asked for its drill, and for what stands in the way of drill and holder: points on discs above the cap,
// up to the top of the block. Foam is what may be foam (in_process_stock.h), so that there is never more in the way.
// O(holes * points of drill and holder * directions).

#include "cam/toolpath/drilling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/text.h"
#include "cam/setup/holder_clearance.h"
#include "cam/toolpath/make_toolpath.h"
#include "cam/toolpath/toolpath_settings.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr double stock_step = 0.5;  // mm, along the axis over the mouth
constexpr double holder_step = 4;   // mm, between points of holder and spindle
constexpr double peck_diameters = 2;
constexpr double same_direction = 1e-6;  // between unit vectors

class HolePlanner {
 public:
    HolePlanner(const Setup& setup, const TriangleMesh& mesh, const Cell& cell, const InProcessStock& stock,
                const DrillOptions& options)
        : setup_(setup),
          mesh_(mesh),
          tree_(mesh),
          cell_(cell),
          machine_(*cell.machine),
          stock_(stock),
          options_(options) {}

    // The index of the drill. Fills in the reason, or the run.
    std::optional<std::size_t> plan(DrillHole& hole, PathRun& run) const {
        std::optional<std::size_t> drill;
        for (std::size_t i = 0; i < machine_.tools.size() && !drill; ++i) {
            const CuttingTool& tool = machine_.tools[i];
            if (is_drill(tool) && std::abs(tool.diameter - hole.diameter) <= options_.diameter) drill = i;
        }
        if (!drill) {
            hole.by_hand = "the cell has no drill of " + fixed(hole.diameter, 1) + " mm";
            return std::nullopt;
        }
        const CuttingTool& tool = machine_.tools[*drill];
        const double top = top_of_stock(hole);
        hole.by_hand = reason(hole, tool, top);
        if (!hole.by_hand.empty()) return std::nullopt;
        run = run_of(hole, tool, top);
        return drill;
    }

 private:
    static Vec3 at_height(const DrillHole& hole, double height) { return hole.mouth + height * hole.tool_axis; }

    double height_of_retract(const DrillHole& hole) const {
        return retract_height(setup_, hole.tool_axis, cell_.clearance) - dot(hole.mouth, hole.tool_axis);
    }

    std::string reason(const DrillHole& hole, const CuttingTool& tool, double top) const {
        const std::string name = "drill " + std::to_string(tool.number);
        if (point_height(tool) > hole.wall) {
            return "the point of " + name + " goes " + fixed(point_height(tool), 1) + " mm below the hole, where " +
                   fixed(hole.wall, 1) + " mm of foam are to stay";
        }
        if (is_under_piece(hole)) return "the piece stands over it";
        const double deep = hole.depth + point_height(tool);
        if (deep + top > tool.flute_length) {
            return "the flute of " + name + " is " + fixed(tool.flute_length, 0) + " mm long, and " +
                   fixed(deep + top, 0) + " mm are needed with the foam over the cap";
        }
        if (is_holder_in_stock(hole, tool, deep)) return "holder or spindle of " + name + " would come into the foam";
        return {};
    }

    // Whether the piece comes nearer to the drill above the cap than it may. Around the mouth itself the joint keeps
    // its wall.
    bool is_under_piece(const DrillHole& hole) const {
        const double radius = 0.5 * hole.diameter + options_.clear;
        const double highest = height_of_retract(hole);
        for (double height = radius + 0.01; height < highest; height += 1) {
            if (tree_.is_any_nearer(mesh_, at_height(hole, height), radius)) return true;
        }
        return false;
    }

    // Calls visit with points of a disc around the axis until it returns true; whether it did.
    template <class Visit>
    static bool any_on_disc(const DrillHole& hole, double height, double radius, double step, const Visit& visit) {
        const PlaneFrame frame = frame_across(hole.tool_axis);
        const Vec3 middle = at_height(hole, height);
        if (visit(middle)) return true;
        const int rings = std::max(1, static_cast<int>(std::ceil(radius / step)));
        for (int ring = 1; ring <= rings; ++ring) {
            const double r = radius * ring / rings;
            const int around = std::max(8, static_cast<int>(std::ceil(2 * std::numbers::pi * r / step)));
            for (int i = 0; i < around; ++i) {
                const double angle = 2 * std::numbers::pi * i / around;
                if (visit(middle + r * std::cos(angle) * frame.u + r * std::sin(angle) * frame.v)) return true;
            }
        }
        return false;
    }

    // Height above the mouth; 0: the cap is clear.
    double top_of_stock(const DrillHole& hole) const {
        double top = 0;
        const double highest = height_of_retract(hole);
        const auto is_stock = [&](Vec3 p) { return stock_.may_be_stock(p); };
        for (double height = stock_step; height < highest; height += stock_step) {
            if (any_on_disc(hole, height, 0.5 * hole.diameter, 1, is_stock)) top = height;
        }
        return top;
    }

    // With the tip as deep as it goes; higher up the same room is needed and less. Not by holder_clearance.h: no map
    // has the axis of the hole.
    bool is_holder_in_stock(const DrillHole& hole, const CuttingTool& tool, double deep) const {
        const ToolBody body = tool_body(tool, machine_);
        const double highest = height_of_retract(hole);
        const auto is_stock = [&](Vec3 p) { return stock_.may_be_stock(p); };
        double from = body.stick_out - deep - options_.clear;
        for (const HolderStep& step : body.steps) {
            const double to = &step == &body.steps.back() ? highest : std::min(highest, from + step.length);
            for (double height = from; height < to; height += holder_step) {
                if (any_on_disc(hole, height, 0.5 * step.diameter + options_.clear, holder_step, is_stock)) return true;
            }
            from += step.length;
        }
        return from < 0;
    }

    PathRun run_of(const DrillHole& hole, const CuttingTool& tool, double top) const {
        const double begin = top + options_.gap;
        const double deepest = -(hole.depth + point_height(tool));
        PathRun run;
        run.hole = hole.number;
        run.start = at_height(hole, height_of_retract(hole));
        run.moves.push_back({at_height(hole, begin), MoveKind::link});
        const auto pecks =
            std::max(1, static_cast<int>(std::ceil((top - deepest) / (peck_diameters * hole.diameter) - 1e-9)));
        for (int peck = 1; peck <= pecks; ++peck) {
            const double to = top + (deepest - top) * peck / pecks;
            run.moves.push_back({at_height(hole, to), MoveKind::cut});
            run.moves.push_back({at_height(hole, begin), MoveKind::cut});
        }
        run.moves.push_back({run.start, MoveKind::retract});
        return run;
    }

    const Setup& setup_;
    const TriangleMesh& mesh_;
    TriangleTree tree_;
    const Cell& cell_;
    const CellMachine& machine_;
    const InProcessStock& stock_;
    const DrillOptions& options_;
};

// The index of a direction in those of the setup and then in those of the drilling, which it joins if it is new.
std::size_t orientation_index(const Setup& setup, Vec3 tool_axis, std::vector<DrillOrientation>& drilling) {
    const std::vector<ToolOrientation>& own = setup.access.orientations;
    for (std::size_t d = 0; d < own.size(); ++d) {
        if (norm(setup.tool_axis(d) - tool_axis) <= same_direction) return d;
    }
    const auto found = std::find_if(drilling.begin(), drilling.end(), [&](const DrillOrientation& d) {
        return norm(d.tool_axis - tool_axis) <= same_direction;
    });
    const auto index = static_cast<std::size_t>(found - drilling.begin());
    if (found == drilling.end()) drilling.push_back({tool_axis, 0});
    return own.size() + index;
}

}  // namespace

Drilling drill_holes(std::span<const DrillHole> holes, const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                     const InProcessStock& stock, const DrillOptions& options) {
    assert(cell.machine);
    Drilling drilling;
    drilling.holes.assign(holes.begin(), holes.end());
    const HolePlanner planner(setup, mesh, cell, stock, options);
    for (DrillHole& hole : drilling.holes) {
        PathRun run;
        const auto tool = hole.by_hand.empty() ? planner.plan(hole, run) : std::nullopt;
        if (!tool) continue;
        const std::size_t orientation = orientation_index(setup, hole.tool_axis, drilling.orientations);
        const auto place = std::find_if(
            drilling.operations.begin(), drilling.operations.end(),
            [&](const Operation& o) { return std::pair(o.tool, o.orientation) >= std::pair(*tool, orientation); });
        if (place != drilling.operations.end() && place->tool == *tool && place->orientation == orientation) {
            place->runs.push_back(std::move(run));
            continue;
        }
        Operation operation = operation_of(*cell.machine, *tool, OperationKind::drilling, orientation);
        operation.retract = retract_height(setup, hole.tool_axis, cell.clearance);
        operation.runs.push_back(std::move(run));
        drilling.operations.insert(place, std::move(operation));
    }
    return drilling;
}

}  // namespace qchopper

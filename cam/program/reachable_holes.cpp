// Each hole is a run of its own and is asked for alone: a few dozen poses for each arm configuration.

#include "cam/program/reachable_holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cam/program/posture_search.h"
#include "cam/program/sampled_path.h"
#include "cam/setup/placement/stated_angle.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int table_steps = 24;  // 15 degrees apart
constexpr double upright = 1e-3;

DrillHole& hole_of(Drilling& drilling, std::size_t number) {
    return *std::find_if(drilling.holes.begin(), drilling.holes.end(),
                         [&](const DrillHole& hole) { return hole.number == number; });
}

// Angles of the table to try for a direction, each once.
std::vector<double> angles_for(const Setup& setup, const Cell& cell, Vec3 tool_axis) {
    if (!cell.machine->rotary_table) return {0};
    std::vector<double> angles;
    const auto add = [&](double angle) {
        const double turned = std::remainder(angle, 2 * pi);
        const bool is_known = std::any_of(angles.begin(), angles.end(), [&](double own) {
            return std::abs(std::remainder(own - turned, 2 * pi)) < 1e-9;
        });
        if (!is_known) angles.push_back(turned);
    };
    const auto azimuth = [](Vec3 v) { return std::atan2(v.y, v.x); };
    const std::size_t count = setup.access.orientations.size();
    for (std::size_t d = 0; d < count; ++d) {
        const Vec3 own = setup.tool_axis(d);
        if (std::hypot(own.x, own.y) < upright || std::hypot(tool_axis.x, tool_axis.y) < upright) continue;
        add(setup.placement.table_angle(d) + azimuth(own) - azimuth(tool_axis));
    }
    for (std::size_t d = 0; d < count; ++d) add(setup.placement.table_angle(d));
    for (int i = 0; i < table_steps; ++i) add(i * 2 * pi / table_steps);
    return angles;
}

// What refuses a hole; empty: the arm holds it.
std::string refusal_of(const PathRun& run, const Operation& operation, const Setup& setup,
                       const MachineReachability& reachability, const Cell& cell) {
    PostureSearch search(setup, reachability, cell, operation);
    const std::vector<PathRun> alone{run};
    return search.longest(alone, sampled_path(alone)).runs == 1 ? std::string() : search.refusal();
}

std::size_t count_reachable(const Drilling& drilling, std::size_t orientation, const Setup& setup,
                            const MachineReachability& reachability, const Cell& cell, std::size_t& all) {
    std::size_t held = 0;
    all = 0;
    for (const Operation& operation : drilling.operations) {
        if (operation.orientation != orientation) continue;
        all += operation.runs.size();
        for (const PathRun& run : operation.runs) held += refusal_of(run, operation, setup, reachability, cell).empty();
    }
    return held;
}

void turn_table(Drilling& drilling, std::size_t index, const Setup& setup, const MachineReachability& reachability,
                const Cell& cell) {
    DrillOrientation& orientation = drilling.orientations[index];
    std::size_t most = 0;
    double best = 0;
    for (const double angle : angles_for(setup, cell, orientation.tool_axis)) {
        orientation.table_angle = stated_angle(angle);
        std::size_t all = 0;
        const std::size_t held =
            count_reachable(drilling, setup.access.orientations.size() + index,
                            with_drill_orientations(setup, drilling.orientations), reachability, cell, all);
        if (held > most || all == held) best = orientation.table_angle, most = held;
        if (held == all) break;
    }
    orientation.table_angle = best;
}

// Directions that no operation uses go, and the others close up.
void drop_unused(Drilling& drilling, std::size_t own_directions) {
    for (std::size_t d = drilling.orientations.size(); d-- > 0;) {
        const std::size_t index = own_directions + d;
        const bool is_used = std::any_of(drilling.operations.begin(), drilling.operations.end(),
                                         [&](const Operation& o) { return o.orientation == index; });
        if (is_used) continue;
        drilling.orientations.erase(drilling.orientations.begin() + static_cast<std::ptrdiff_t>(d));
        for (Operation& operation : drilling.operations) {
            if (operation.orientation > index) --operation.orientation;
        }
    }
}

}  // namespace

void keep_reachable_holes(Drilling& drilling, const Setup& setup, const MachineReachability& reachability,
                          const Cell& cell, const Context& context) {
    if (cell.machine->rotary_table) {
        for (std::size_t i = 0; i < drilling.orientations.size(); ++i) {
            context.check_cancelled();
            turn_table(drilling, i, setup, reachability, cell);
        }
    }
    const Setup with_all = with_drill_orientations(setup, drilling.orientations);
    std::vector<std::pair<std::size_t, std::string>> refused;
    for (const Operation& operation : drilling.operations) {
        context.check_cancelled();
        for (const PathRun& run : operation.runs) {
            const std::string refusal = refusal_of(run, operation, with_all, reachability, cell);
            if (!refusal.empty()) refused.emplace_back(run.hole, "the arm does not hold it: " + refusal);
        }
    }
    for (const auto& [number, reason] : refused) leave_to_hand(drilling, number, reason, setup);
}

void leave_to_hand(Drilling& drilling, std::size_t number, const std::string& reason, const Setup& setup) {
    hole_of(drilling, number).by_hand = reason;
    for (Operation& operation : drilling.operations) {
        std::erase_if(operation.runs, [&](const PathRun& run) { return run.hole == number; });
    }
    std::erase_if(drilling.operations, [](const Operation& operation) { return operation.runs.empty(); });
    drop_unused(drilling, setup.access.orientations.size());
}

}  // namespace qchopper

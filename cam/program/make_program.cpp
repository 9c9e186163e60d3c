// Operations are held one beside the other on several threads; then operations are joined in their order: of whole
// turns of the axes the nearest, and the ways between.
//
// What no arm configuration takes is left out. The work envelope judges the extreme poses of a setup, and a toolpath
// goes farther in places: a radius below the base plane, and beside the block. A run that no configuration takes is
// divided; where that does not help, its moves are left out up to the next place from which an arm posture takes a cut,
// and the tool comes down again there. At most a fiftieth of the length of an operation's cuts is left out
// (max_left_out); more refuses the program, and holes are drilled as a whole or not at all. What was left out, and why,
// stands in the manifest, on the sheet and in the verdict. What it means for the piece is not judged here: the proof
// replays the program and measures the foam that stays, against a reachable surface that knows nothing of the arm.
//
// Moves that come near to foam that now stays go at the least feed (left_out_foam.h). Cost: more foam for finishing may
// make the proof refuse the job. A reserve in the work envelope would refuse placements that are good but for a corner;
// raising the CL surface where the arm does not hold it would need the arm, and an answer for every cell, while the
// toolpath is made. Test: tests/cam/program/make_program_test.cpp, LeavesOutTheLittleThatNoConfigurationTakes.

#include "cam/program/make_program.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "base/shared_progress.h"
#include "cam/cell/reach_map.h"
#include "cam/program/check_toolpath.h"
#include "cam/program/left_out_foam.h"
#include "cam/program/posture_search.h"
#include "cam/program/ptp_planner.h"
#include "cam/program/sampled_path.h"
#include "cam/program/split_run.h"
#include "cam/setup/block_placement.h"

namespace qchopper {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr std::size_t lines_around = 80;  // of a chunk, beside its runs
constexpr std::size_t fewest_lines = 20;  // of a run
constexpr double max_left_out = 0.02;     // of the cuts of an operation, as a share of their length

using JointExtents = std::array<AngleRange, axes_of_arm>;

struct PlannedOperation {
    ProgramOperation operation;
    JointExtents extents;  // of all its poses
};

JointExtents extents_of(const std::vector<Joints>& all) {
    JointExtents extents;
    for (std::size_t axis = 0; axis < axes_of_arm && !all.empty(); ++axis) {
        const auto [least, most] = std::minmax_element(
            all.begin(), all.end(), [&](const Joints& a, const Joints& b) { return a[axis] < b[axis]; });
        extents[axis] = {(*least)[axis], (*most)[axis]};
    }
    return extents;
}

// Lines of an operation at most: a part of a piece holds whole operations, and takes a few of them.
std::size_t operation_lines(const Cell& cell) {
    constexpr std::size_t bytes_per_line = 50;
    return cell.machine->program.memory_bytes / 4 / bytes_per_line;
}

// Lines of a run at most.
std::size_t max_lines(const Cell& cell) {
    const std::size_t lines = cell.machine->program.lines_per_chunk;
    const std::size_t most = std::min(lines, operation_lines(cell));
    return std::max(fewest_lines, most > lines_around ? most - lines_around : 0);
}

// Where lowered speeds change so often that the lines to state them exceed what a chunk holds: the lowest of each kind
// for all moves of the run.
void limit_speed_changes(ProgramRun& run, std::size_t lines) {
    const auto needed = [&run] {
        std::size_t count = 1;
        double rounding = 0;
        for (std::size_t i = 0; i < run.moves.size(); ++i) {
            const ProgramMove& move = run.moves[i];
            count += 1 + (i > 0 && move.speed != run.moves[i - 1].speed ? 1 : 0);
            if (move.rounding == 0 || move.rounding == rounding) continue;
            rounding = move.rounding;
            ++count;
        }
        return count;
    };
    // Twice as many neighbours at a time get the lowest speed among those of their kind.
    for (std::size_t at_once = 2; needed() > lines && at_once < 2 * run.moves.size(); at_once *= 2) {
        for (std::size_t first = 0; first < run.moves.size(); first += at_once) {
            const std::size_t end = std::min(run.moves.size(), first + at_once);
            std::array<double, 4> lowest;  // by MoveKind
            lowest.fill(std::numeric_limits<double>::infinity());
            for (std::size_t i = first; i < end; ++i) {
                double& own = lowest[static_cast<std::size_t>(run.moves[i].kind)];
                own = std::min(own, run.moves[i].speed);
            }
            for (std::size_t i = first; i < end; ++i) {
                run.moves[i].speed = lowest[static_cast<std::size_t>(run.moves[i].kind)];
            }
        }
    }
}

// One operation.
class OperationHolder {
 public:
    OperationHolder(const Setup& setup, const MachineReachability& reachability, const Cell& cell,
                    const Operation& operation, const Context& context)
        : search_(setup, reachability, cell, operation),
          operation_(operation),
          context_(context),
          tool_radius_(0.5 * cell.machine->tools[operation.tool].diameter),
          max_lines_(operation_lines(cell)),
          max_lines_of_run_(max_lines(cell)),
          runs_(split_long_runs(operation.runs, max_lines_of_run_, search_.tool_axis(), operation.retract)) {}

    // What operations() left out: the length of cuts, what holds the foam that they would have removed, and why no
    // configuration takes the first of them.
    double left_out() const { return left_out_; }
    const std::vector<Capsule>& left_out_foam() const { return left_out_foam_; }
    const std::string& left_out_because() const { return left_out_because_; }

    std::vector<PlannedOperation> operations(const std::string& where) {
        std::vector<PlannedOperation> planned;
        for (std::size_t first = 0; first < runs_.size();) {
            context_.check_cancelled();
            const std::span<const PathRun> rest = section_from(first);
            const SampledPath path = sampled_path(rest);
            const ReachablePath longest = search_.longest(rest, path);
            if (longest.runs == 0) {
                refusal_ = search_.refusal();
                if (divide(first, path, longest) || leave_out(first, path, longest)) continue;
                throw ProgramRefused(
                    where + ", run " + std::to_string(first + 1) + ": no arm posture reaches it: " + refusal_,
                    "place the block otherwise, or take other tool orientations",
                    RefusedRun{operation_.orientation, runs_[first]});
            }
            planned.push_back({search_.operation(rest, path, longest), extents_of(longest.joints)});
            for (ProgramRun& run : planned.back().operation.runs) limit_speed_changes(run, max_lines_of_run_);
            first += longest.runs;
        }
        return planned;
    }

 private:
    // The runs of one operation: at least one.
    std::span<const PathRun> section_from(std::size_t first) const {
        std::size_t count = 0;
        for (std::size_t lines = 0; first + count < runs_.size(); ++count) {
            lines += lines_of(runs_[first + count]) + 1;
            if (count > 0 && lines > max_lines_) break;
        }
        return {runs_.data() + first, count};
    }

    // Divides a run that no configuration takes where one carries its first part.
    bool divide(std::size_t at, const SampledPath& path, const ReachablePath& longest) {
        const PathRun run = runs_[at];
        for (std::size_t count = moves_within(run, path, longest.poses); count > 0; count = count * 3 / 4) {
            if (!has_cut(run, count)) return false;
            if (count >= run.moves.size()) continue;
            auto [head, tail] = split_run(run, count, search_.tool_axis(), operation_.retract);
            const std::vector<PathRun> alone{head};
            const SampledPath head_path = sampled_path(alone);
            if (search_.longest(alone, head_path).runs == 0) continue;
            runs_[at] = std::move(head);
            runs_.insert(runs_.begin() + static_cast<std::ptrdiff_t>(at) + 1, std::move(tail));
            return true;
        }
        return false;
    }

    // Leaves out what of a run no configuration takes, up to a place from which one carries a further cut. False if
    // that would be too much.
    bool leave_out(std::size_t at, const SampledPath& path, const ReachablePath& longest) {
        if (operation_.kind == OperationKind::drilling) return false;
        const PathRun run = runs_[at];
        const std::size_t first = moves_within(run, path, longest.poses);
        std::size_t end = std::min(first + 1, run.moves.size());
        std::optional<PathRun> tail;
        for (; end < run.moves.size() && !tail; ++end) {
            context_.check_cancelled();
            PathRun from_here = split_run(run, end, search_.tool_axis(), operation_.retract).second;
            if (begins_held(from_here)) tail = std::move(from_here);
        }
        if (tail) --end;
        double length = 0;
        for (std::size_t i = first; i < end; ++i) {
            const Vec3 from = i > 0 ? run.moves[i - 1].tip : run.start;
            if (run.moves[i].kind == MoveKind::cut) length += norm(run.moves[i].tip - from);
        }
        // Without a cut less, the same run would be asked for again.
        if (!tail && length == 0) return false;
        if (left_out_ + length > max_left_out * cut_length(operation_.runs)) return false;
        if (left_out_ == 0) left_out_because_ = refusal_;
        left_out_ += length;
        for (std::size_t i = first; i < end; ++i) add_left_out(i > 0 ? run.moves[i - 1].tip : run.start, run.moves[i]);
        std::vector<PathRun> kept;
        if (has_cut(run, first)) {
            PathRun head = run;
            if (first < run.moves.size()) head = split_run(run, first, search_.tool_axis(), operation_.retract).first;
            kept.push_back(std::move(head));
        }
        if (tail) kept.push_back(std::move(*tail));
        const auto place = runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(at));
        runs_.insert(place, kept.begin(), kept.end());
        return true;
    }

    void add_left_out(Vec3 from, const PathMove& move) {
        if (move.kind != MoveKind::cut && move.kind != MoveKind::approach) return;
        const std::vector<Capsule> bodies =
            bodies_of_cut(from, move.tip, search_.tool_axis(), tool_radius_, operation_.retract);
        left_out_foam_.insert(left_out_foam_.end(), bodies.begin(), bodies.end());
    }

    // Whether an arm posture takes a run up to a part of its first cut.
    bool begins_held(const PathRun& run) {
        const std::vector<PathRun> alone{run};
        const SampledPath path = sampled_path(alone);
        return has_cut(run, moves_within(run, path, search_.longest(alone, path).poses));
    }

    static bool has_cut(const PathRun& run, std::size_t count) {
        return std::any_of(run.moves.begin(), run.moves.begin() + static_cast<std::ptrdiff_t>(count),
                           [](const PathMove& move) { return move.kind == MoveKind::cut; });
    }

    static double cut_length(const std::vector<PathRun>& runs) {
        double length = 0;
        for (const PathRun& run : runs) {
            Vec3 from = run.start;
            for (const PathMove& move : run.moves) {
                if (move.kind == MoveKind::cut) length += norm(move.tip - from);
                from = move.tip;
            }
        }
        return length;
    }

    // Moves of the first run whose ends are among the first poses.
    static std::size_t moves_within(const PathRun& run, const SampledPath& path, std::size_t poses) {
        std::size_t end = path.first.front();
        Vec3 tip = run.start;
        for (std::size_t i = 0; i < run.moves.size(); ++i) {
            end += sample_steps(tip, run.moves[i].tip);
            tip = run.moves[i].tip;
            if (end >= poses) return i;
        }
        return run.moves.size();
    }

    PostureSearch search_;
    const Operation& operation_;
    const Context& context_;
    double tool_radius_ = 0;
    std::size_t max_lines_ = 0;  // of an operation
    std::size_t max_lines_of_run_ = 0;
    std::vector<PathRun> runs_;
    std::string refusal_;  // of the last run that no arm posture reached
    double left_out_ = 0;
    std::vector<Capsule> left_out_foam_;
    std::string left_out_because_;
};

std::string name_of_operation(std::size_t number) {
    return "operation " + std::to_string(number) + " of the toolpath";
}

struct PlannedOperations {
    std::vector<PlannedOperation> all;  // of all operations, in their order
    double left_out = 0;
    std::string left_out_because;  // the first one
};

PlannedOperations planned_operations(const Toolpath& toolpath, const Setup& setup,
                                     const MachineReachability& reachability, const Cell& cell,
                                     const Context& context) {
    const std::size_t count = toolpath.operations.size();
    std::vector<std::vector<PlannedOperation>> by_operation(count);
    std::vector<std::exception_ptr> refused(count);
    std::vector<std::pair<double, std::string>> left_out(count);
    std::vector<std::vector<Capsule>> foam(count);
    SharedProgress progress(context, "operations held", count);
    parallel_for(0, count, [&](std::size_t i) {
        const std::string where = name_of_operation(i + 1);
        try {
            OperationHolder holder(setup, reachability, cell, toolpath.operations[i], context);
            by_operation[i] = holder.operations(where);
            left_out[i] = {holder.left_out(), where + ": " + holder.left_out_because()};
            foam[i] = holder.left_out_foam();
        } catch (const ProgramRefused&) {
            refused[i] = std::current_exception();
        }
        progress.add(1);
    });
    PlannedOperations all_planned;
    std::vector<Capsule> standing;  // of this operation and those before it
    for (std::size_t i = 0; i < count; ++i) {
        if (refused[i]) std::rethrow_exception(refused[i]);
        standing.insert(standing.end(), foam[i].begin(), foam[i].end());
        const Operation& operation = toolpath.operations[i];
        for (PlannedOperation& planned : by_operation[i]) {
            const std::size_t slowed =
                slow_moves_near(standing, cell.machine->tools[operation.tool], operation.retract, planned.operation);
            planned.operation.lowered_moves += slowed;
            if (slowed > 0) {
                for (ProgramRun& run : planned.operation.runs) limit_speed_changes(run, max_lines(cell));
            }
            planned.operation.toolpath_operation = i;
            planned.operation.kind = operation.kind;
            all_planned.all.push_back(std::move(planned));
        }
        if (left_out[i].first > 0 && all_planned.left_out == 0) all_planned.left_out_because = left_out[i].second;
        all_planned.left_out += left_out[i].first;
    }
    return all_planned;
}

// Where a setup's direction has the table, -pi..pi.
double table_angle(const Setup& setup, const Cell& cell, std::size_t orientation) {
    if (!cell.machine->rotary_table) return 0;
    return std::remainder(setup.placement.table_angle(orientation), full_turn);
}

// The orientation of the program's tool frame: that of tip_frame(), with the axes that the cell file gives the spindle.
Pose tool_orientation(const Spindle& spindle, const CuttingTool& tool, Vec3 tool_axis, double turn) {
    const Pose tip_in_flange = tool_arm(Robot{}, spindle, tool).tip_in_flange;
    Pose tool_in_tip = inverse(tip_in_flange) * spindle.spindle_in_flange;
    tool_in_tip.shift = {};
    return tip_frame({}, tool_axis, turn) * tool_in_tip;
}

// Turns whole operations so that they begin near home, and finds the ways there and back.
class SectionJoiner {
 public:
    SectionJoiner(const Setup& setup, const Cell& cell) : setup_(setup), cell_(cell) {
        for (std::size_t i = 0; i < cell.machine->tools.size(); ++i) {
            planners_.push_back(std::make_unique<PtpPlanner>(setup, cell, i));
        }
    }

    void join(std::vector<PlannedOperation>& all, const Context& context) {
        double angle = 0;
        context.progress("paths to operations found", 0, all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            context.check_cancelled();
            ProgramOperation& own = all[i].operation;
            turn_near_home(all[i]);
            turn_table(own, angle);
            angle = own.table_angle;
            own.entry = ptp_path(own, {own.runs.front().start, own.runs.front().start_joints, &own});
            own.runs.front().link_speed = own.entry.retract_speed;
            own.exit = ptp_path(own, {own.runs.back().moves.back().tip, own.runs.back().end_joints, &own});
            own.exit.targets.pop_back();
            std::reverse(own.exit.targets.begin(), own.exit.targets.end());
            own.exit.targets.push_back(cell_.machine->start.joints);
            find_restarts(own);
            context.progress("paths to operations found", i + 1, all.size());
        }
        if (!all.empty()) turn_table(all.back().operation, 0);
    }

 private:
    // Of whole turns of each axis the one that begins nearest to home, where the operation as a whole stays in the
    // range.
    void turn_near_home(PlannedOperation& planned) const {
        const CellMachine& machine = *cell_.machine;
        const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[planned.operation.tool]);
        Joints shift{};
        const Joints& start = planned.operation.runs.front().start_joints;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            const double turns = full_turn * std::nearbyint((machine.start.joints[axis] - start[axis]) / full_turn);
            const double low = arm.ranges[axis].min + arm.margin;
            const double high = arm.ranges[axis].max - arm.margin;
            const bool fits = planned.extents[axis].min + turns >= low && planned.extents[axis].max + turns <= high;
            if (fits) shift[axis] = turns;
        }
        for (ProgramRun& run : planned.operation.runs) {
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                run.start_joints[axis] += shift[axis];
                run.end_joints[axis] += shift[axis];
            }
        }
    }

    // The runs at which a person may start again from home.
    void find_restarts(ProgramOperation& operation) const {
        constexpr std::size_t runs_at_once = 16;
        parallel_ranges(0, operation.runs.size(), runs_at_once, [&](std::size_t first, std::size_t last) {
            PtpPlanner planner(setup_, cell_, operation.tool);
            for (std::size_t r = first; r < last; ++r) {
                ProgramRun& run = operation.runs[r];
                run.starts_from_home = planner.starts_clear({run.start, run.start_joints, &operation});
            }
        });
    }

    void turn_table(const ProgramOperation& operation, double from) {
        PtpPlanner& planner = *planners_[operation.tool];
        if (planner.turns_clear(from, operation.table_angle)) return;
        throw ProgramRefused("home is not clear while the table turns for orientation " +
                                 std::to_string(operation.orientation + 1) + ": " + planner.refusal(),
                             "choose another start pose");
    }

    PtpPath ptp_path(const ProgramOperation& operation, const OperationEnd& end) {
        PtpPlanner& planner = *planners_[operation.tool];
        std::optional<PtpPath> found = planner.from_home(end);
        if (found) return std::move(*found);
        throw ProgramRefused("no joint move between home and orientation " + std::to_string(operation.orientation + 1) +
                                 " with tool " + std::to_string(cell_.machine->tools[operation.tool].number) +
                                 " is clear: " + planner.refusal(),
                             "choose another start pose, or place the block otherwise");
    }

    const Setup& setup_;
    const Cell& cell_;
    std::vector<std::unique_ptr<PtpPlanner>> planners_;  // by tool
};

Program empty_program(const Setup& setup, const Cell& cell) {
    const CellMachine& machine = *cell.machine;
    Program program;
    program.has_arm = machine.robot.has_value();
    program.home = machine.start.joints;
    const Pose on_table = setup_in_table(setup.placement, setup.spoil);
    if (machine.rotary_table) {
        program.external_axis = machine.rotary_table->external_axis;
        program.base = on_table;
    } else {
        program.base = table_in_cell(cell, 0) * on_table;
        if (machine.robot) program.base = inverse(machine.robot->base_in_cell) * program.base;
    }
    for (const CuttingTool& tool : machine.tools) {
        const Vec3 tip = tool_arm(Robot{}, machine.spindle, tool).tip_in_flange.shift;
        program.tools.push_back({{machine.spindle.spindle_in_flange.row, tip}, load_data(machine.spindle, tool)});
    }
    return program;
}

}  // namespace

Program make_program(const Toolpath& toolpath, const Setup& setup, const MachineReachability& reachability,
                     const Cell& cell, const Context& context) {
    assert(cell.machine);
    check_toolpath(toolpath, setup, cell);
    PlannedOperations operations = planned_operations(toolpath, setup, reachability, cell, context);
    std::vector<PlannedOperation>& all = operations.all;
    for (PlannedOperation& planned : all) {
        ProgramOperation& operation = planned.operation;
        operation.table_angle = table_angle(setup, cell, operation.orientation);
        operation.tool_in_setup = tool_orientation(cell.machine->spindle, cell.machine->tools[operation.tool],
                                                   operation.tool_axis, operation.redundancy_angle);
    }
    if (cell.machine->robot) SectionJoiner(setup, cell).join(all, context);
    Program program = empty_program(setup, cell);
    program.left_out_mm = operations.left_out;
    program.left_out_because = std::move(operations.left_out_because);
    for (PlannedOperation& planned : all) program.operations.push_back(std::move(planned.operation));
    return program;
}

void check_operation(const Operation& operation, std::size_t number, const Setup& setup,
                     const MachineReachability& reachability, const Cell& cell, const Context& context) {
    OperationHolder(setup, reachability, cell, operation, context).operations(name_of_operation(number));
}

Program outlined_program(const std::vector<OutlinedOperation>& operations, const Setup& setup, const Cell& cell) {
    assert(cell.machine);
    Program program = empty_program(setup, cell);
    for (const OutlinedOperation& own : operations) {
        ProgramOperation operation;
        operation.tool = own.tool;
        operation.orientation = own.orientation;
        operation.tool_axis = setup.tool_axis(own.orientation);
        operation.table_angle = table_angle(setup, cell, own.orientation);
        program.operations.push_back(std::move(operation));
    }
    return program;
}

}  // namespace qchopper

// Operations are held one beside the other on several threads; then sections are joined in their order: of whole turns
// of the axes the nearest, and the ways between.

#include "cam/program/make_program.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "cam/cell/reach_map.h"
#include "cam/program/check_toolpath.h"
#include "cam/program/hold_search.h"
#include "cam/program/joint_ways.h"
#include "cam/program/sampled_path.h"
#include "cam/program/split_run.h"
#include "cam/setup/block_placement.h"

namespace qchopper {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr std::size_t lines_around = 80;  // of a chunk, beside its runs
constexpr std::size_t fewest_lines = 20;  // of a run

using JointExtents = std::array<AngleRange, axes_of_arm>;

struct HeldSection {
    ProgramSection section;
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

// Lines of a section at most: a part of a piece holds whole sections, and takes a few of them.
std::size_t section_lines(const Cell& cell) {
    constexpr std::size_t bytes_per_line = 50;
    return cell.machine->program.memory_bytes / 4 / bytes_per_line;
}

// Lines of a run at most.
std::size_t most_lines(const Cell& cell) {
    const std::size_t lines = cell.machine->program.lines_per_chunk;
    const std::size_t most = std::min(lines, section_lines(cell));
    return std::max(fewest_lines, most > lines_around ? most - lines_around : 0);
}

// One operation.
class OperationHolder {
 public:
    OperationHolder(const Setup& setup, const WorkEnvelope& envelope, const Cell& cell, const Operation& operation,
                    const Context& context)
        : search_(setup, envelope, cell, operation),
          operation_(operation),
          context_(context),
          most_lines_(section_lines(cell)),
          runs_(split_long_runs(operation.runs, most_lines(cell), search_.out(), operation.retract)) {}

    std::vector<HeldSection> sections(const std::string& where) {
        std::vector<HeldSection> held;
        for (std::size_t first = 0; first < runs_.size();) {
            context_.check_cancelled();
            const std::span<const PathRun> rest = section_from(first);
            const SampledPath path = sampled_path(rest);
            const HeldPath longest = search_.longest(rest, path);
            if (longest.runs == 0) {
                divide(where, first, path, longest);
                continue;
            }
            held.push_back({search_.section(rest, path, longest), extents_of(longest.joints)});
            first += longest.runs;
        }
        return held;
    }

 private:
    // The runs of one section: at least one.
    std::span<const PathRun> section_from(std::size_t first) const {
        std::size_t count = 0;
        for (std::size_t lines = 0; first + count < runs_.size(); ++count) {
            lines += lines_of(runs_[first + count]) + 1;
            if (count > 0 && lines > most_lines_) break;
        }
        return {runs_.data() + first, count};
    }

    // Divides a run that no hold carries where one carries its first part.
    void divide(const std::string& where, std::size_t at, const SampledPath& path, const HeldPath& longest) {
        const std::string refusal = search_.refusal();
        const PathRun run = runs_[at];
        for (std::size_t count = moves_within(run, path, longest.poses); count > 0; count = count * 3 / 4) {
            if (count >= run.moves.size()) continue;
            auto [head, tail] = split_run(run, count, search_.out(), operation_.retract);
            const std::vector<PathRun> alone{head};
            const SampledPath head_path = sampled_path(alone);
            if (search_.longest(alone, head_path).runs == 0) continue;
            runs_[at] = std::move(head);
            runs_.insert(runs_.begin() + static_cast<std::ptrdiff_t>(at) + 1, std::move(tail));
            return;
        }
        throw ProgramRefused(where + ", run " + std::to_string(at + 1) + ": no hold of the arm carries it: " + refusal,
                             "place the block otherwise, or carve from other directions");
    }

    // Moves of the first run whose ends are among the first poses; an approach alone removes nothing.
    static std::size_t moves_within(const PathRun& run, const SampledPath& path, std::size_t poses) {
        std::size_t end = path.first.front();
        Vec3 tip = run.start;
        for (std::size_t i = 0; i < run.moves.size(); ++i) {
            end += sample_steps(tip, run.moves[i].tip);
            tip = run.moves[i].tip;
            if (end >= poses) return i > 1 ? i : 0;
        }
        return run.moves.size() - 1;
    }

    HoldSearch search_;
    const Operation& operation_;
    const Context& context_;
    std::size_t most_lines_ = 0;  // of a section
    std::vector<PathRun> runs_;
};

// All sections of all operations, in their order.
std::vector<HeldSection> held_sections(const Toolpath& toolpath, const Setup& setup, const WorkEnvelope& envelope,
                                       const Cell& cell, const Context& context) {
    const std::size_t count = toolpath.operations.size();
    std::vector<std::vector<HeldSection>> by_operation(count);
    std::vector<std::exception_ptr> refused(count);
    std::mutex mutex;
    std::size_t done = 0;
    context.progress("operations held", 0, count);
    parallel_for(0, count, [&](std::size_t i) {
        const std::string where = "operation " + std::to_string(i + 1) + " of the toolpath";
        try {
            OperationHolder holder(setup, envelope, cell, toolpath.operations[i], context);
            by_operation[i] = holder.sections(where);
        } catch (const ProgramRefused&) {
            refused[i] = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        context.progress("operations held", ++done, count);
    });
    std::vector<HeldSection> all;
    for (std::size_t i = 0; i < count; ++i) {
        if (refused[i]) std::rethrow_exception(refused[i]);
        for (HeldSection& held : by_operation[i]) {
            held.section.operation = i;
            all.push_back(std::move(held));
        }
    }
    return all;
}

// Where a setup's direction has the table, -pi..pi.
double table_angle(const Setup& setup, const Cell& cell, std::size_t direction) {
    if (!cell.machine->rotary_table) return 0;
    return std::remainder(setup.placement.table_angle(direction), full_turn);
}

// The orientation of the program's tool frame: that of tip_frame(), with the axes that the cell file gives the spindle.
Pose tool_orientation(const Spindle& spindle, const CarvingTool& tool, Vec3 out, double turn) {
    const Pose tip_in_flange = tool_arm(Robot{}, spindle, tool).tip_in_flange;
    Pose tool_in_tip = inverse(tip_in_flange) * spindle.spindle_in_flange;
    tool_in_tip.shift = {};
    return tip_frame({}, out, turn) * tool_in_tip;
}

// Turns whole sections so that they begin near home, and finds the ways there and back.
class SectionJoiner {
 public:
    SectionJoiner(const Setup& setup, const Cell& cell) : cell_(cell) {
        for (std::size_t i = 0; i < cell.machine->tools.size(); ++i) {
            ways_.push_back(std::make_unique<JointWays>(setup, cell, i));
        }
    }

    void join(std::vector<HeldSection>& all, const Context& context) {
        double angle = 0;
        context.progress("ways to sections found", 0, all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            context.check_cancelled();
            ProgramSection& own = all[i].section;
            turn_near_home(all[i]);
            turn_table(own, angle);
            angle = own.table_angle;
            own.entry = way(own, {own.runs.front().start, own.runs.front().start_joints, &own});
            own.exit = way(own, {own.runs.back().moves.back().tip, own.runs.back().end_joints, &own});
            own.exit.targets.pop_back();
            std::reverse(own.exit.targets.begin(), own.exit.targets.end());
            own.exit.targets.push_back(cell_.machine->start.joints);
            context.progress("ways to sections found", i + 1, all.size());
        }
        if (!all.empty()) turn_table(all.back().section, 0);
    }

 private:
    // Of whole turns of each axis the one that begins nearest to home, where the section as a whole stays in the range.
    void turn_near_home(HeldSection& held) const {
        const CellMachine& machine = *cell_.machine;
        const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[held.section.tool]);
        Joints shift{};
        const Joints& start = held.section.runs.front().start_joints;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            const double turns = full_turn * std::nearbyint((machine.start.joints[axis] - start[axis]) / full_turn);
            const double low = arm.ranges[axis].min + arm.margin;
            const double high = arm.ranges[axis].max - arm.margin;
            const bool fits = held.extents[axis].min + turns >= low && held.extents[axis].max + turns <= high;
            if (fits) shift[axis] = turns;
        }
        for (ProgramRun& run : held.section.runs) {
            for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
                run.start_joints[axis] += shift[axis];
                run.end_joints[axis] += shift[axis];
            }
        }
    }

    void turn_table(const ProgramSection& section, double from) {
        JointWays& ways = *ways_[section.tool];
        if (ways.turns_clear(from, section.table_angle)) return;
        throw ProgramRefused("home is not clear while the table turns for direction " +
                                 std::to_string(section.direction + 1) + ": " + ways.refusal(),
                             "choose another start pose");
    }

    JointWay way(const ProgramSection& section, const SectionEnd& end) {
        JointWays& ways = *ways_[section.tool];
        std::optional<JointWay> found = ways.from_home(end);
        if (found) return std::move(*found);
        throw ProgramRefused("no joint move between home and direction " + std::to_string(section.direction + 1) +
                                 " with tool " + std::to_string(cell_.machine->tools[section.tool].number) +
                                 " is clear: " + ways.refusal(),
                             "choose another start pose, or place the block otherwise");
    }

    const Cell& cell_;
    std::vector<std::unique_ptr<JointWays>> ways_;  // by tool
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
    for (const CarvingTool& tool : machine.tools) {
        const Vec3 tip = tool_arm(Robot{}, machine.spindle, tool).tip_in_flange.shift;
        program.tools.push_back({{machine.spindle.spindle_in_flange.row, tip}, load_data(machine.spindle, tool)});
    }
    return program;
}

}  // namespace

Program make_program(const Toolpath& toolpath, const Setup& setup, const WorkEnvelope& envelope, const Cell& cell,
                     const Context& context) {
    assert(cell.machine);
    check_toolpath(toolpath, setup, cell);
    std::vector<HeldSection> all = held_sections(toolpath, setup, envelope, cell, context);
    for (HeldSection& held : all) {
        ProgramSection& section = held.section;
        section.table_angle = table_angle(setup, cell, section.direction);
        section.tool_in_setup =
            tool_orientation(cell.machine->spindle, cell.machine->tools[section.tool], section.out, section.tool_turn);
    }
    if (cell.machine->robot) SectionJoiner(setup, cell).join(all, context);
    Program program = empty_program(setup, cell);
    for (HeldSection& held : all) program.sections.push_back(std::move(held.section));
    return program;
}

}  // namespace qchopper

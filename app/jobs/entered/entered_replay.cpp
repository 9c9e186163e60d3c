// States of a program are shared by its chunks: one that has to change for a tool is copied, because another tool may
// be as long. O(steps) but for the copy of the cell.

#include "app/jobs/entered/entered_replay.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "app/jobs/job_scene.h"
#include "base/units.h"
#include "cam/setup/block_placement.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/scene.h"
#include "sim/replay/turn.h"

namespace qchopper {
namespace {

// Within which the replay takes a stated frame for the planned one (sim/replay/state_check.cpp).
constexpr double stated_shift = 0.01;
constexpr double stated_turn = 0.01 * degree;

bool is_as_stated(const Pose& planned, const ProgramFrame& stated) {
    const Pose said = pose_of(stated);
    return norm(said.shift - planned.shift) <= stated_shift && turn_between(said, planned).angle <= stated_turn;
}

Vec3 tool_axis_in_flange(const Spindle& spindle) {
    return column(spindle.spindle_in_flange, spindle.tool_axis == ToolAxis::z ? 2 : 0);
}

// The states of a program with the frames of tools as entered.
class ToolStates {
 public:
    ToolStates(const EnteredValues& values, const Cell& planned, ParsedProgram& program)
        : spindle_(planned.machine->spindle), program_(program) {
        for (const EnteredLength& entered : values.lengths) {
            if (const auto length = other_length(entered, planned)) {
                moved_[entered.tool] = {*length, entered.length - *length};
            }
        }
    }

    // What `state` is while the tool is in the spindle.
    std::uint32_t with_tool(std::uint32_t state, std::uint16_t tool) {
        const auto moved = moved_.find(tool);
        if (moved == moved_.end() || !program_.states[state].tool) return state;
        const auto [known, is_new] = copies_.try_emplace({state, tool}, state);
        if (!is_new) return known->second;
        ModalState copy = program_.states[state];
        const Vec3 axis = tool_axis_in_flange(spindle_);
        Pose planned = spindle_.spindle_in_flange;
        planned.shift = planned.shift + moved->second.planned * axis;
        if (!is_as_stated(planned, *copy.tool)) return state;
        copy.tool->shift = copy.tool->shift + moved->second.off * axis;
        known->second = static_cast<std::uint32_t>(program_.states.size());
        program_.states.push_back(copy);
        return known->second;
    }

 private:
    struct Moved {
        double planned = 0;
        double off = 0;
    };
    const Spindle& spindle_;
    ParsedProgram& program_;
    std::map<std::uint16_t, Moved> moved_;
    std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> copies_;
};

}  // namespace

Cell cell_with(const EnteredValues& values, const Cell& cell) {
    Cell entered = cell;
    for (const EnteredLength& length : values.lengths) {
        const std::optional<double> planned = other_length(length, cell);
        if (!planned) continue;
        const auto tool = std::ranges::find(entered.machine->tools, length.tool, &CuttingTool::number);
        tool->stick_out += length.length - *planned;
        tool->flute_length = std::min(tool->flute_length, tool->stick_out);
    }
    return entered;
}

void enter_in_program(const EnteredValues& values, const ProofInput& planned, ParsedProgram& program) {
    const Pose base = planned_base(planned.cell, planned.setup, planned.setup_in_cell);
    if (other_base(values, base)) {
        const Vec3 deg = values.base->abc_deg;
        const ProgramFrame entered{values.base->shift, {radians(deg.x), radians(deg.y), radians(deg.z)}};
        for (ModalState& state : program.states) {
            if (state.base && is_as_stated(base, *state.base)) state.base = entered;
        }
    }
    std::map<std::string, std::uint16_t> tool_of_file;
    for (const JobChunk& chunk : planned.program.chunks) tool_of_file[chunk.file] = chunk.tool;
    ToolStates states(values, planned.cell, program);
    std::uint16_t tool = 0;  // of the chunk, or of the chunk before
    for (const ProgramChunk& chunk : program.chunks) {
        const auto named = tool_of_file.find(program.files[chunk.file]);
        if (named != tool_of_file.end()) tool = named->second;
        for (std::size_t i = chunk.first; i < chunk.end; ++i) {
            ProgramStep& step = program.steps[i];
            step.state = states.with_tool(step.state, tool);
        }
    }
}

void enter_in_scene(const EnteredValues& values, const ProofInput& planned, const Cell& entered, ReplayScene& scene) {
    scene.cell = &entered;
    for (const EnteredLength& length : values.lengths) {
        if (const auto other = other_length(length, planned.cell)) scene.planned_lengths[length.tool] = *other;
    }
    const Pose of_plan = planned_base(planned.cell, planned.setup, planned.setup_in_cell);
    const std::optional<Pose> base = other_base(values, of_plan);
    if (!base) return;
    scene.entered_turn = turn_between(of_plan, *base).angle;
    const bool turns = planned.cell.machine->rotary_table.has_value();
    for (SceneOrientation& orientation : scene.orientations) {
        const Pose carrier =
            turns ? table_in_cell(planned.cell, orientation.table_angle) : planned.cell.machine->robot->base_in_cell;
        orientation.setup_in_cell = carrier * *base;
    }
}

}  // namespace qchopper

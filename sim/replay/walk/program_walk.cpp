// Step by step, O(steps) but for what the machine does.

#include "sim/replay/walk/program_walk.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "sim/program/program_line.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name_in_dialog = 45;

// What a comment or message of a program can hold of a name.
std::string as_comment(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~' || c == '"'; }, '_');
    return text;
}

bool is_of_signal(StepKind kind) {
    return kind == StepKind::output || kind == StepKind::analog_output || kind == StepKind::wait_input;
}

}  // namespace

ToolPath ProgramWalk::run(const Context& context) {
    std::size_t next = 0;
    std::size_t done = 0;
    for (const ProgramChunk& chunk : program_.chunks) {
        is_in_chunk_ = !chunk.is_main;
        if (is_in_chunk_) chunk_ = static_cast<std::uint32_t>(next++);
        if (is_in_chunk_) enter(chunk);
        for (std::size_t i = chunk.first; i < chunk.end; ++i, ++done) {
            if (done % 1024 == 0) {
                context.check_cancelled();
                context.progress("steps of the program followed", done, program_.steps.size());
            }
            take(program_.steps[i]);
        }
    }
    check_end({program_.chunks.back().file, program_.chunks.back().end_line});
    check_retract();
    if (path_.uses.empty()) use_tool(ProgramChunk().operation);
    if (next != scene_.chunks.size()) {
        log_.add(
            FindingKind::chunk_order, {},
            "the program calls " + counted(next, "chunk") + ", the job has " + std::to_string(scene_.chunks.size()));
    }
    return std::move(path_);
}

void ProgramWalk::enter(const ProgramChunk& chunk) {
    signals_.enter_chunk();
    free_from_home_ = {chunk.file, chunk.free_from_home};
    const SourcePlace place{chunk.file, 1};
    const std::string stem = lower_case(program_.files[chunk.file].substr(0, program_.files[chunk.file].find('.')));
    const bool is_known = chunk_ < scene_.chunks.size() && lower_case(scene_.chunks[chunk_].name) == stem;
    if (!is_known) {
        log_.add(FindingKind::chunk_order, place, "the job does not say that this chunk comes here");
        chunk_ = std::min(chunk_, static_cast<std::uint32_t>(scene_.chunks.size() - 1));
        for (std::size_t i = 0; i < scene_.chunks.size(); ++i) {
            if (lower_case(scene_.chunks[i].name) == stem) chunk_ = static_cast<std::uint32_t>(i);
        }
    }
    direction_ = static_cast<std::uint32_t>(scene_.chunks[chunk_].orientation);
    take_tool(scene_.chunks[chunk_].tool, place);
    use_tool(chunk.operation);
}

void ProgramWalk::use_tool(const std::string& operation) {
    const ToolUse use{operation, tool_};
    const auto found = std::find(path_.uses.begin(), path_.uses.end(), use);
    use_ = static_cast<std::uint32_t>(found - path_.uses.begin());
    if (found == path_.uses.end()) path_.uses.push_back(use);
    if (std::exchange(is_changed_, false)) path_.tool_changes.push_back({use_, path_.order.size()});
}

// A person is told which tool it is, and how long it must be.
void ProgramWalk::check_asked(const CuttingTool& tool, SourcePlace place) {
    const std::string name = "tool " + std::to_string(tool.number);
    const bool was_called = asked_tool_ && *asked_tool_ == tool.number;
    const bool was_asked = !machine_.program.tool_change_call && asked_.find(name + " ") != std::string::npos;
    if (!was_called && !was_asked) {
        log_.add(FindingKind::tool_change, place, tool.number, 0,
                 [&] { return name + " is needed, and nobody was asked for it"; });
    }
    if (!was_asked) return;
    const bool is_dialog = machine_.program.dialect == Dialect::krl;
    const std::string name_there = as_comment(is_dialog ? tool.name.substr(0, longest_name_in_dialog) : tool.name);
    for (const std::string& words : {"(" + name_there + ")", fixed(scene_.planned_length(tool), 2) + " mm"}) {
        if (asked_.find(" " + lower_case(words)) != std::string::npos) continue;
        log_.add(FindingKind::tool_change, asked_place_, tool.number, 0, [&] {
            std::string text = "who is asked for ";
            return text.append(name).append(" is not told what it is, expected: ").append(words);
        });
    }
}

// The person or the program that was asked has changed the tool to that of the chunk.
void ProgramWalk::take_tool(std::uint16_t number, SourcePlace place) {
    std::uint32_t index = 0;
    while (index + 1 < machine_.tools.size() && machine_.tools[index].number != number) ++index;
    is_changed_ = !has_tool_ || index != tool_;
    if (is_changed_) check_asked(machine_.tools[index], place);
    has_tool_ = true;
    tool_ = index;
    asked_.clear();
}

void ProgramWalk::take(const ProgramStep& step) {
    switch (step.kind) {
        case StepKind::joint_move:
        case StepKind::rapid_move:
            return take_rapid(step);
        case StepKind::linear_move:
            return take_line(step);
        case StepKind::output:
        case StepKind::analog_output:
        case StepKind::wait_input:
        case StepKind::spindle:
        case StepKind::dwell:
            return signals_.take(step, is_of_signal(step.kind) ? signal_of(program_, step) : std::string());
        case StepKind::tool_change:
            return take_tool_change(step);
        case StepKind::halt:
            return take_halt(step);
        case StepKind::call:
            return take_call(step);
    }
}

void ProgramWalk::take_halt(const ProgramStep& step) {
    asked_ = lower_case(program_.texts[step.text]) + " ";
    asked_place_ = step.place;
    check_stop(step.place);
}

void ProgramWalk::take_call(const ProgramStep& step) {
    const std::string& name = program_.texts[step.text];
    const std::optional<std::string>& change = machine_.program.tool_change_call;
    if (change && lower_case(*change) == name) {
        asked_tool_ = static_cast<std::uint16_t>(std::clamp(step.value, 0.0, 65535.0));
        check_stop(step.place);
    }
    signals_.take(step, name);
}

// Where somebody comes to the spindle, or a program changes the tool.
void ProgramWalk::check_stop(SourcePlace place) {
    signals_.check_off(FindingKind::tool_change, place, "at this stop");
    if (is_home(false)) return;
    log_.add(FindingKind::not_home, place, "the machine is not at home at this stop");
}

// Where a signal has fallen the tool leaves the foam the way that it came.
void ProgramWalk::check_retract() {
    if (!program_.retract) return;
    const bool is_x = machine_.spindle.tool_axis == ToolAxis::x;
    const double along = is_x ? program_.retract->x : program_.retract->z;
    if (along < 0 && norm(*program_.retract) == -along) return;
    log_.add(
        FindingKind::tool_axis, program_.retract_place,
        std::string("the tool is not retracted along its axis, expected: ") + (is_x ? "-X" : "-Z") + " of its frame");
}

void ProgramWalk::check_end(SourcePlace place) {
    signals_.check_off(FindingKind::left_on, place, "at the end");
    if (is_home(true)) return;
    log_.add(FindingKind::not_home, place,
             "the program does not end at home, expected before: a move to the start of the cell file");
}

}  // namespace qchopper

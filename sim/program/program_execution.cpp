// Equal texts and states in a row are kept once.

#include "sim/program/program_execution.h"

#include <charconv>

#include "sim/program/program_line.h"

namespace qchopper {

void ProgramExecution::begin_chunk(bool is_main) {
    hole_ = 0;
    program_.chunks.push_back({place_.file, program_.steps.size(), program_.steps.size(), is_main, end_line_});
}

ProgramStep& ProgramExecution::add(StepKind kind) {
    if (!(program_.states.back() == state_)) program_.states.push_back(state_);
    ProgramStep step;
    step.kind = kind;
    step.place = place_;
    step.state = static_cast<std::uint32_t>(program_.states.size() - 1);
    step.hole = hole_;
    program_.steps.push_back(step);
    return program_.steps.back();
}

ProgramStep& ProgramExecution::add_named(StepKind kind, const std::string& name) {
    const std::uint32_t number = text(name);
    ProgramStep& step = add(kind);
    step.text = number;
    return step;
}

std::uint32_t ProgramExecution::text(const std::string& words) {
    const auto [found, is_new] = text_numbers_.insert({words, static_cast<std::uint32_t>(program_.texts.size())});
    if (is_new) program_.texts.push_back(words);
    return found->second;
}

void ProgramExecution::take_comment(std::string_view words) {
    constexpr std::uint32_t max_holes = 10'000;
    constexpr std::string_view before = "hole ";
    const std::string lower = lower_case(words);
    if (lower == "start from home: free") program_.chunks.back().free_from_home = place_.line;
    for (const char* operation : {"roughing", "finishing", "fine finishing", "drilling"}) {
        if (lower == std::string("operation ") + operation) program_.chunks.back().operation = operation;
    }
    if (!lower.starts_with(before)) return;
    std::uint32_t number = 0;
    const char* const last = lower.data() + lower.size();
    const auto [end, error] = std::from_chars(lower.data() + before.size(), last, number);
    if (error == std::errc() && end == last && number < max_holes) hole_ = number;
}

}  // namespace qchopper

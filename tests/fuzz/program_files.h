// For fuzzers of the readers of robot programs: files out of an input, and what holds of every program that is
// accepted.

#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sim/program/chunk_summary.h"
#include "sim/program/parsed_program.h"
#include "tests/fuzz/demand.h"

namespace qchopper {

// Every step has finite numbers and indices that exist.
inline void demand_complete(const ParsedProgram& program, bool has_arm) {
    for (const ProgramStep& step : program.steps) {
        demand(step.place.file < program.files.size() && step.place.line > 0);
        demand(step.state < program.states.size());
        for (const double value : step.values) demand(std::isfinite(value));
        const bool has_signal =
            step.kind == StepKind::output || step.kind == StepKind::analog_output || step.kind == StepKind::wait_input;
        if (step.kind == StepKind::halt || step.kind == StepKind::call || (has_signal && step.number == 0)) {
            demand(step.text < program.texts.size());
        }
        if (step.kind != StepKind::linear_move) continue;
        const ModalState& state = program.states[step.state];
        demand(state.feed > 0);
        if (has_arm) demand(state.tool && state.base && state.acceleration > 0);
        if (!has_arm) demand(state.tool_number > 0 || state.length_register > 0);
        demand(step.e1.has_value() == (state.base_machine != 0));
    }
    std::size_t next = 0;
    for (const ProgramChunk& chunk : program.chunks) {
        demand(chunk.first == next && chunk.end >= chunk.first);
        next = chunk.end;
    }
    demand(next == program.steps.size());
    for (const ChunkSummary& summary : summarise_chunks(program)) demand(std::isfinite(summary.length));
}

// A main program named m and, after each zero byte, a chunk named c1, c2 and so on. `make` gives the text of a file of
// its name and the bytes for it.
inline std::vector<ProgramFile> program_files(
    const std::string& text, const std::string& ending,
    const std::function<std::string(const std::string& name, const std::string& body)>& make) {
    std::vector<ProgramFile> files;
    for (std::size_t at = 0; at <= text.size() && files.size() < 20;) {
        const std::size_t end = std::min(text.find('\0', at), text.size());
        const std::string name = files.empty() ? "m" : "c" + std::to_string(files.size());
        files.push_back({name + ending, make(name, text.substr(at, end - at))});
        at = end + 1;
    }
    return files;
}

// As it is.
inline std::string as_given(const std::string& /*name*/, const std::string& body) {
    return body;
}

// Ends of lines become CR LF.
inline std::string with_line_ends(const std::string& body) {
    std::string text;
    for (const char c : body) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return text + "\r\n";
}

}  // namespace qchopper

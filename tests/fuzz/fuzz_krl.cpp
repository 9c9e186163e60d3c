// Robot programs in KRL: the input is a main program and, after each zero byte, a chunk; every step of what is accepted
// has finite numbers and indices that exist. Bytes are given as they are, and once more with the ends of lines made
// right and the heads added.

#include <cmath>

#include "sim/program/chunk_summary.h"
#include "sim/program/krl_reader.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

void demand_complete(const ParsedProgram& program) {
    for (const ProgramStep& step : program.steps) {
        demand(step.place.file < program.files.size() && step.place.line > 0);
        demand(step.state < program.states.size());
        for (const double value : step.values) demand(std::isfinite(value));
        if (step.kind == StepKind::halt || step.kind == StepKind::call) demand(step.text < program.texts.size());
        if (step.kind != StepKind::linear_move) continue;
        const ModalState& state = program.states[step.state];
        demand(state.tool && state.base && state.feed > 0 && state.acceleration > 0);
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

std::string with_head(const std::string& name, const std::string& body) {
    std::string text = "&ACCESS RVP\r\n&REL 1\r\nDEF " + name + "( )\r\n";
    for (const char c : body) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return text + "\r\nEND\r\n";
}

void try_files(const std::string& text, bool is_plain) {
    std::vector<ProgramFile> files;
    for (std::size_t at = 0; at <= text.size() && files.size() < 20;) {
        const std::size_t end = std::min(text.find('\0', at), text.size());
        const std::string name = files.empty() ? "m" : "c" + std::to_string(files.size());
        const std::string body = text.substr(at, end - at);
        files.push_back({name + ".src", is_plain ? body : with_head(name, body)});
        at = end + 1;
    }
    or_refused(InputFault::mesh, [&] { demand_complete(read_krl(files, "m", {{"change_tool"}})); });
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = qchopper::text_of(data, size);
    qchopper::try_files(text, true);
    qchopper::try_files(text, false);
    return 0;
}

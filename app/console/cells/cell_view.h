// A cell as the page shows it, as a value and as JSON.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/enum_names.h"
#include "base/json_fields.h"
#include "devices/wire/codes.h"
#include "devices/wire/packml.h"

namespace qchopper {

enum class CellKind { unknown, real, simulated };
enum class CellLinkState { never, connected, lost };

// As the page shows it.
struct CellView {
    std::string id;
    std::string name;
    std::string address;
    CellKind kind = CellKind::unknown;
    PackState state = PackState::undefined;
    bool asks = false;  // a person at the cell is asked for consent
    std::optional<std::string> job;
    JobState job_state = JobState::none;
    std::optional<double> progress;  // share
    std::optional<double> elapsed_s;
    std::optional<double> remaining_s;
    std::optional<std::uint32_t> program_chunk;  // where the program is; nothing of a job without a program
    std::optional<std::uint32_t> program_line;   // in the file of the chunk, from 1
    std::optional<std::uint16_t> tool;           // number
    std::optional<double> read_ms_ago;
    CellLinkState link = CellLinkState::never;
};

constexpr auto names_of(CellKind) {
    return EnumNames<CellKind, 3>{
        {{CellKind::unknown, "unknown"}, {CellKind::real, "real"}, {CellKind::simulated, "simulated"}}};
}

constexpr auto names_of(CellLinkState) {
    return EnumNames<CellLinkState, 3>{
        {{CellLinkState::never, "never"}, {CellLinkState::connected, "connected"}, {CellLinkState::lost, "lost"}}};
}

template <class V, Of<CellView> T>
void fields(V& v, T& view) {
    v("id", view.id);
    v("name", view.name);
    v("address", view.address);
    v("kind", view.kind);
    v.written("state", [&] { return std::string(name(view.state)); });
    v("asks", view.asks);
    v("job", view.job);
    v.written("job_state", [&] { return std::string(name(view.job_state)); });
    v("progress", view.progress);
    v("elapsed_s", view.elapsed_s);
    v("remaining_s", view.remaining_s);
    v("program_chunk", view.program_chunk);
    v("program_line", view.program_line);
    v("tool", view.tool);
    v("read_ms_ago", view.read_ms_ago);
    v("link", view.link);
}

}  // namespace qchopper

// What the sources of the machine share. Not for others.

#pragma once

#include "sim/cell_hooks.h"
#include "sim/cell_state.h"

namespace qchopper::cell {

constexpr std::int64_t lease_ms = 5000;
constexpr std::int64_t watchdog_ms = 2500;
constexpr std::int64_t token_ms = 120000;
constexpr std::size_t most_senders = 256;
constexpr std::uint32_t most_epoch_jump = 1U << 20;

void log(CellState& cell, const CellHooks& hooks, const std::string& line);
bool save(const CellMemory& memory, const CellHooks& hooks);
std::uint32_t random_number(CellState& cell);  // never 0

// machine_time.cpp
void enter_state(CellState& cell, PackState to, std::int64_t at_ms);
double run_so_far_s(const CellState& cell, CellTime now);
// The job is over: remembered, and shown until it is cleared.
void end_job(CellState& cell, JobState state, JobResult result, CellTime now, const CellHooks& hooks);
// Token and consent die; what waited for a person or a rehearsal is answered with `why`.
void drop_preparation(CellState& cell, AckResult why);
void settle(CellState& cell, AckResult result, std::uint32_t detail = 0);

// machine_commands.cpp
struct Answer {
    AckResult result = AckResult::ok;
    std::uint32_t detail = 0;
};
Answer job_command(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks);
Answer start_job(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks);

}  // namespace qchopper::cell

// What the sources of the machine share: its time limits and the functions that each defines for the others.
//
// For machine.cpp, machine_time.cpp and machine_commands.cpp only.

#pragma once

#include "sim/cell/cell_state.h"

namespace qchopper::cell {

constexpr std::int64_t lease_ms = 5000;     // of a lease without a heartbeat
constexpr std::int64_t watchdog_ms = 2500;  // until the watchdog expires
constexpr std::int64_t token_ms = 120000;   // of a start token
constexpr std::size_t max_senders = 256;
constexpr std::uint32_t max_epoch_jump = 1U << 20;

// machine.cpp
void log(CellState& cell, const CellHooks& hooks, const std::string& line);
// Gives the memory a new mark and writes it. False: it could not be written, or power is gone.
bool save(CellState& cell, CellMemory& memory, const CellHooks& hooks);
bool holds_lease(const CellState& cell, std::uint32_t owner, std::uint32_t epoch);
std::uint32_t random_number(CellState& cell);                // never 0
std::uint64_t unix_ms(const CellState& cell, CellTime now);  // after the jumps of the clock

// machine_time.cpp
// Precondition: `to` is a state, not `undefined`.
void enter_state(CellState& cell, PackState to, std::int64_t at_ms);
// Of the job, in seconds: of its program, or of its estimated time if it has none.
double run_so_far_s(const CellState& cell, CellTime now);
double whole_run_s(const CellState& cell);
// From now on faults come at what the job has not yet passed.
void pass_run(CellState& cell, CellTime now);
// The block stays as the job has carved it by now.
void note_carved(CellState& cell, CellTime now);
// Ends the job: writes it to the memory, and STATUS shows it until CLEAR_RESULT. Precondition: it was started.
void end_job(CellState& cell, JobState state, JobResult result, CellTime now, const CellHooks& hooks);
// Removes token and consent, and settles what waits for consent or for a rehearsal with `why`.
void drop_preparation(CellState& cell, AckResult why);
// An alarm: a started job ends with `result`, a preparation is gone, the machine aborts.
void raise_alarm(CellState& cell, const CellAlarm& alarm, JobResult result, CellTime now, const CellHooks& hooks);
// BLOCK_NO: the line of the program (program_block.h); of a job without one, ten blocks are counted for each second.
std::uint32_t block_now(const CellState& cell, CellTime now);
// Why the job cannot be prepared or rehearsed as it was received, if it cannot.
std::optional<CommandAnswer> unfit_job(const CellState& cell);
// Ends cell.pending, if any, with this result in its acknowledgement. Precondition: `result` is not PENDING.
void settle(CellState& cell, AckResult result, std::uint32_t detail = 0);

}  // namespace qchopper::cell

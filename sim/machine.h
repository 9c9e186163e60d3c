// The simulated cell's controller: what each write, each moment and each consent changes in it.
//
// Pure: functions on a value (cell_state.h), with the time given by the caller and the outside world behind CellHooks.
// A refused command changes nothing but the acknowledgement, and at most one start is ever done for a job id
// (tests/sim/machine_test.cpp, tests/sim/packml_test.cpp).

#pragma once

#include <cstdint>
#include <span>

#include "sim/cell_hooks.h"
#include "sim/cell_state.h"

namespace qchopper {

// A controller that has just been switched on. A job that the memory calls running was cut off: it is aborted for
// good, and the machine stands in Aborted; otherwise it stands in Stopped. Nothing starts by itself.
CellState boot(const CellLimits& limits, CellMemory memory, std::uint64_t seed, CellTime now, const CellHooks& hooks);

// What time alone does: acting states end, the job goes on, lease and token run out, automatic consent is given.
void pass_time(CellState& cell, CellTime now, const CellHooks& hooks);

// The answers to cell.pending, by its number.
void consent_given(CellState& cell, std::uint64_t number, bool yes, CellTime now, const CellHooks& hooks);
void file_checked(CellState& cell, std::uint64_t number, const FileCheck& check, CellTime now, const CellHooks& hooks);

// One COMMAND block as it came.
void take_command(CellState& cell, std::span<const std::uint16_t> block, CellTime now, const CellHooks& hooks);
void take_heartbeat(CellState& cell, std::span<const std::uint16_t> block, CellTime now);
void take_chunk(CellState& cell, const Chunk& chunk);

Status status_of(const CellState& cell, CellTime now);

}  // namespace qchopper

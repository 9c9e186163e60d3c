// The simulated cell's controller: how each write, the time and each consent change its state.
//
// Functions on a value (cell_state.h). The time is an argument and never decreases from call to call; store, log and
// files are behind CellHooks. A refused command changes nothing but the acknowledgement, and a job id is started at
// most once, power cuts included (tests/sim/cell/start_test.cpp, tests/sim/cell/packml_test.cpp). Not thread-safe.

#pragma once

#include <cstdint>
#include <span>

#include "sim/cell/cell_state.h"

namespace qchopper {

// The state after power on. A job that is running in `memory` was interrupted by a power cut: it becomes aborted, and
// the machine is in Aborted; otherwise it is in Stopped. Nothing starts by itself. A memory without store id gets one;
// one whose mark is neither of those that the hooks read gets another. `seed` is for
// tokens, receipts and that id.
CellState boot(const CellLimits& limits, CellMemory memory, std::uint64_t seed, CellTime now, const CellHooks& hooks);

// The effects of time: acting states end, the job advances, lease and token expire, automatic consent is given.
void pass_time(CellState& cell, CellTime now, const CellHooks& hooks);

// The answer to cell.pending. Ignored if `number` is not that of cell.pending.
void consent_given(CellState& cell, std::uint64_t number, bool yes, CellTime now, const CellHooks& hooks);
void file_checked(CellState& cell, std::uint64_t number, const FileCheck& check, CellTime now, const CellHooks& hooks);

// A COMMAND block with any content. A damaged or old one is counted in bad_frames; one of zeros has no effect; the same
// frame again gets the same acknowledgement and has no further effect.
void receive_command(CellState& cell, std::span<const std::uint16_t> block, CellTime now, const CellHooks& hooks);
// A HEARTBEAT block with any content. Extends the lease if it is of its holder and the counter has changed.
void receive_heartbeat(CellState& cell, std::span<const std::uint16_t> block, CellTime now);
// Appends the data to the job's file if the checksum is right and the offset is its end; the result is in
// cell.transfer_result.
void receive_chunk(CellState& cell, const Chunk& chunk);

// CELL_HB if it does not stand still.
std::uint16_t heartbeat_of(const CellState& cell, CellTime now);
Status status_of(const CellState& cell, CellTime now);
Identity identity_of(const CellState& cell);

}  // namespace qchopper

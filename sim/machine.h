// The simulated cell's controller: what each write, each moment and each consent changes in it.
//
// Pure: functions on a value (cell_state.h), with the time given by the caller and the outside world behind CellHooks.
// A refused command changes nothing but the acknowledgement, and at most one start is ever done for a job id
// (tests/sim/machine_test.cpp, tests/sim/packml_test.cpp).

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "sim/cell_state.h"

namespace qchopper {

struct FileCheck {
    enum class End { ok, missing, io_error };
    End end = End::missing;
    std::uint64_t size = 0;
    Sha256 sha256{};
};

struct CellHooks {
    // Puts the memory where a power cut cannot reach it; false: it could not, and the command is refused. May be empty.
    std::function<bool(const CellMemory&)> save;
    std::function<void(const std::string&)> log;  // may be empty
    // Lets copies of finished jobs go until so many bytes are free, or none is left; returns how many KiB are free
    // then. May be empty: nothing is let go.
    std::function<std::uint32_t(const CellMemory&, std::uint64_t bytes)> make_room;
};

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

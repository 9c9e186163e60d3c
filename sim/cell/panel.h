// What a person at the simulated cell does, and how faults and power cuts come to it.
//
// Functions on a CellState, as those of machine.h, with the same rules for time (tests/sim/cell/panel_test.cpp).

#pragma once

#include "sim/cell/machine.h"
#include "sim/cell/script.h"

namespace qchopper {

// Opening the door or pressing the emergency stop takes every consent back. The emergency stop aborts the machine in
// any state; the door does so where something moves, but not in Held or Suspended. Closing and releasing start nothing.
void open_door(CellState& cell, bool is_open, CellTime now, const CellHooks& hooks);
void press_e_stop(CellState& cell, bool is_pressed, CellTime now, const CellHooks& hooks);
// A tool that breaks while a job runs aborts it with the result "tool"; later, PREPARE is refused.
void set_tool_broken(CellState& cell, bool is_broken, CellTime now, const CellHooks& hooks);
// The program stops where it is: the spindle loses its speed, result "tool"; the input that it waits for does not come,
// result "aborted". Nothing while no job runs.
void lose_spindle_speed(CellState& cell, CellTime now, const CellHooks& hooks);
void miss_input(CellState& cell, std::uint32_t input, CellTime now, const CellHooks& hooks);
// Under local control every command that acts on machine or job is refused, and a consent is taken back.
void set_local_control(CellState& cell, bool is_local, const CellHooks& hooks);
void set_block(CellState& cell, BlockOnTable block, const CellHooks& hooks);

// What a line of a script does to the machine; nothing for those of consent, power, clock, waiting, show and quit.
void perform(CellState& cell, const ScriptLine& line, CellTime now, const CellHooks& hooks);
// Is it so that `wait for` waits for? `choice` is the place of its word (script.h).
bool holds(const CellState& cell, std::size_t choice);

// A fault from now on; those of clock, heartbeat and power act at once or at their event.
void arm(CellState& cell, const ArmedFault& fault, CellTime now);
// No fault is armed any more, and the heartbeat goes on.
void disarm_all(CellState& cell);

// How far the block is carved now: to be called when somebody looks at it, and when power goes, after which it stays so
// and the controller's retentive memory keeps the line.
void note_block(CellState& cell, CellTime now);
// After a power cut: what the store holds then, and the cell that starts with it. Faults and surroundings stay.
CellMemory memory_after(PowerCut::Store store, const CellMemory& saved);
CellState power_on(const CellState& before, CellMemory memory, std::uint64_t seed, CellTime now,
                   const CellHooks& hooks);

}  // namespace qchopper

// The states and commands of the machine, and what each command does in each state.
//
// States, their numbers, the commands 1..10 and their transitions follow PackML (ISA-TR88.00.02, numbers of
// PackTags 3.0); the commands from 100 on are of this register map. The same tables serve the simulated cell and
// docs/developer/formats/registers.md. That the machine follows them in all 17 states for all 21 commands is tested
// against a table written by hand (tests/sim/cell/packml_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace qchopper {

enum class PackState : std::uint16_t {
    undefined = 0,
    clearing = 1,
    stopped = 2,
    starting = 3,
    idle = 4,
    suspended = 5,
    execute = 6,
    stopping = 7,
    aborting = 8,
    aborted = 9,
    holding = 10,
    held = 11,
    unholding = 12,
    suspending = 13,
    unsuspending = 14,
    resetting = 15,
    completing = 16,
    complete = 17
};

enum class CellCommand : std::uint16_t {
    none = 0,
    reset = 1,
    start = 2,
    stop = 3,
    hold = 4,
    unhold = 5,
    suspend = 6,
    unsuspend = 7,
    abort = 8,
    clear = 9,
    complete = 10,
    claim = 100,
    release = 101,
    store = 102,
    verify = 103,
    prepare = 104,
    cancel = 105,
    query = 106,
    clear_result = 107,
    rehearse = 108,
    set_mode = 109,
    query_file = 110
};

// All but `none`, in the order of docs/developer/formats/registers.md.
constexpr std::array<CellCommand, 21> all_commands{
    CellCommand::reset,     CellCommand::start,        CellCommand::stop,      CellCommand::hold,
    CellCommand::unhold,    CellCommand::suspend,      CellCommand::unsuspend, CellCommand::abort,
    CellCommand::clear,     CellCommand::complete,     CellCommand::claim,     CellCommand::release,
    CellCommand::store,     CellCommand::verify,       CellCommand::prepare,   CellCommand::cancel,
    CellCommand::query,     CellCommand::clear_result, CellCommand::rehearse,  CellCommand::set_mode,
    CellCommand::query_file};

constexpr std::uint16_t last_pack_state = 17;

// The effect of a command in a state, if its sender and its job are right.
enum class TransitionKind : std::uint8_t {
    refused,  // WRONG_STATE
    moves,    // the machine goes to `to`
    already,  // the effect is in place: ALREADY
    allowed   // a job command: accepted, the state stays as it is
};
struct Transition {
    TransitionKind kind = TransitionKind::refused;
    PackState to = PackState::undefined;  // of `moves`
};
// Any numbers; `refused` for those that are no state or no command.
Transition transition(PackState from, CellCommand command);

// The state that follows an acting one by itself ("state complete"); undefined for a waiting state.
PackState after_done(PackState acting);

// A job runs or is interrupted: Starting, Execute, Completing, Stopping, and the states of Hold and Suspend.
bool has_active_job(PackState state);

// "unknown" for a number that is no state or no command.
const char* name(PackState state);
const char* name(CellCommand command);

}  // namespace qchopper

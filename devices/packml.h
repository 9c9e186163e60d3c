// The states and commands of the machine (PackML, ISA-TR88.00.02) and which command does what in which state.
//
// Numbers are those of PackTags 3.0. One table serves the simulated cell, the tests and docs/registers.md; that the
// machine obeys it in all 17 states for all 20 commands is held by tests/sim/packml_test.cpp.

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
    set_mode = 109
};

constexpr std::array<CellCommand, 20> all_commands{
    CellCommand::reset,  CellCommand::start,        CellCommand::stop,      CellCommand::hold,
    CellCommand::unhold, CellCommand::suspend,      CellCommand::unsuspend, CellCommand::abort,
    CellCommand::clear,  CellCommand::complete,     CellCommand::claim,     CellCommand::release,
    CellCommand::store,  CellCommand::verify,       CellCommand::prepare,   CellCommand::cancel,
    CellCommand::query,  CellCommand::clear_result, CellCommand::rehearse,  CellCommand::set_mode};

constexpr std::uint16_t last_pack_state = 17;

// What a command meets in a state, once sender and job are right.
enum class TransitionKind : std::uint8_t {
    refused,  // WRONG_STATE
    moves,    // the machine goes to `to`
    already,  // the wanted effect is in place: ALREADY
    allowed   // a job command: taken, the machine stays where it is
};
struct Transition {
    TransitionKind kind = TransitionKind::refused;
    PackState to = PackState::undefined;
};
Transition transition(PackState from, CellCommand command);

// Where an acting state goes when it is done by itself ("state complete"); undefined for a waiting state.
PackState after_done(PackState acting);

// A job is in motion or could go on moving: from Starting until it has ended.
bool has_active_job(PackState state);

const char* name(PackState state);
const char* name(CellCommand command);

}  // namespace qchopper

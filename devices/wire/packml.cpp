// Transitions of PackML (ISA-TR88.00.02, Machine and Unit States) as tables that are searched linearly: O(rows), of
// which there are 28.

#include "devices/wire/packml.h"

#include <algorithm>
#include <iterator>

namespace qchopper {
namespace {

using enum PackState;

struct TransitionRow {
    PackState from;
    CellCommand command;
    PackState to;
};

// The base model of PackML with its optional transitions to Holding.
constexpr TransitionRow moves[] = {
    {aborted, CellCommand::clear, clearing},           {stopped, CellCommand::reset, resetting},
    {complete, CellCommand::reset, resetting},         {idle, CellCommand::start, starting},
    {execute, CellCommand::complete, completing},      {execute, CellCommand::hold, holding},
    {execute, CellCommand::suspend, suspending},       {held, CellCommand::unhold, unholding},
    {suspended, CellCommand::unsuspend, unsuspending}, {starting, CellCommand::hold, holding},
    {suspending, CellCommand::hold, holding},          {suspended, CellCommand::hold, holding},
    {unsuspending, CellCommand::hold, holding},        {unholding, CellCommand::hold, holding},
};

// The effect of the command is in place.
constexpr TransitionRow in_place[] = {
    {clearing, CellCommand::clear, clearing},        {stopped, CellCommand::clear, stopped},
    {resetting, CellCommand::reset, resetting},      {idle, CellCommand::reset, idle},
    {holding, CellCommand::hold, holding},           {held, CellCommand::hold, held},
    {unholding, CellCommand::unhold, unholding},     {suspending, CellCommand::suspend, suspending},
    {suspended, CellCommand::suspend, suspended},    {unsuspending, CellCommand::unsuspend, unsuspending},
    {completing, CellCommand::complete, completing}, {stopping, CellCommand::stop, stopping},
    {aborting, CellCommand::abort, aborting},        {aborted, CellCommand::abort, aborted},
};

// State complete.
struct CompletionRow {
    PackState acting;
    PackState to;
};
constexpr CompletionRow completions[] = {
    {clearing, stopped},     {starting, execute}, {execute, completing},  {stopping, stopped},
    {aborting, aborted},     {holding, held},     {unholding, execute},   {suspending, suspended},
    {unsuspending, execute}, {resetting, idle},   {completing, complete},
};

bool job_command_allowed(PackState from, CellCommand command) {
    switch (command) {
        case CellCommand::claim:
        case CellCommand::release:
        case CellCommand::query:
        case CellCommand::query_file:
            return true;
        case CellCommand::store:
        case CellCommand::verify:
        case CellCommand::prepare:
        case CellCommand::rehearse:
            return from == idle;
        case CellCommand::cancel:  // also after an Abort before its start
            return from == idle || from == aborting || from == aborted || from == clearing || from == stopped ||
                   from == resetting;
        case CellCommand::clear_result:
            return from == complete || from == stopped || from == aborted || from == idle || from == resetting ||
                   from == clearing;
        case CellCommand::set_mode:
            return from == stopped || from == idle || from == aborted;
        default:
            return false;
    }
}

}  // namespace

bool has_active_job(PackState state) {
    constexpr PackState active[] = {starting,  execute,    completing, holding,      held,
                                    unholding, suspending, suspended,  unsuspending, stopping};
    return std::find(std::begin(active), std::end(active), state) != std::end(active);
}

Transition transition(PackState from, CellCommand command) {
    if (from == undefined || static_cast<std::uint16_t>(from) > last_pack_state) return {};
    for (const TransitionRow& row : moves) {
        if (row.from == from && row.command == command) return {TransitionKind::moves, row.to};
    }
    for (const TransitionRow& row : in_place) {
        if (row.from == from && row.command == command) return {TransitionKind::already, row.to};
    }
    // The job has started: a second Start has no effect.
    if (command == CellCommand::start && has_active_job(from)) return {TransitionKind::already, from};
    if (command == CellCommand::stop && has_active_job(from)) return {TransitionKind::moves, stopping};
    if (command == CellCommand::abort) return {TransitionKind::moves, aborting};
    if (job_command_allowed(from, command)) return {TransitionKind::allowed, from};
    return {};
}

PackState after_done(PackState acting) {
    for (const CompletionRow& row : completions) {
        if (row.acting == acting) return row.to;
    }
    return undefined;
}

const char* name(PackState state) {
    constexpr const char* names[] = {"Undefined", "Clearing",   "Stopped",      "Starting",  "Idle",       "Suspended",
                                     "Execute",   "Stopping",   "Aborting",     "Aborted",   "Holding",    "Held",
                                     "Unholding", "Suspending", "Unsuspending", "Resetting", "Completing", "Complete"};
    const auto number = static_cast<std::uint16_t>(state);
    return number <= last_pack_state ? names[number] : "unknown";
}

const char* name(CellCommand command) {
    constexpr const char* machine[] = {"none",    "Reset",     "Start", "Stop",  "Hold",    "Unhold",
                                       "Suspend", "Unsuspend", "Abort", "Clear", "Complete"};
    constexpr const char* job[] = {"CLAIM", "RELEASE",      "STORE",    "VERIFY",   "PREPARE",   "CANCEL",
                                   "QUERY", "CLEAR_RESULT", "REHEARSE", "SET_MODE", "QUERY_FILE"};
    const std::size_t number = static_cast<std::size_t>(command);
    constexpr auto first_of_job = static_cast<std::size_t>(CellCommand::claim);
    if (number < std::size(machine)) return machine[number];
    return number >= first_of_job && number - first_of_job < std::size(job) ? job[number - first_of_job] : "unknown";
}

}  // namespace qchopper

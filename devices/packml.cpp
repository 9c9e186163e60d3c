#include "devices/packml.h"

#include <algorithm>
#include <iterator>

namespace qchopper {
namespace {

using enum PackState;
using Command = CellCommand;

struct Row {
    PackState from;
    Command command;
    PackState to;
};

// The base model of PackML with the optional ways to Holding.
constexpr Row moves[] = {
    {aborted, Command::clear, clearing},           {stopped, Command::reset, resetting},
    {complete, Command::reset, resetting},         {idle, Command::start, starting},
    {execute, Command::complete, completing},      {execute, Command::hold, holding},
    {execute, Command::suspend, suspending},       {held, Command::unhold, unholding},
    {suspended, Command::unsuspend, unsuspending}, {starting, Command::hold, holding},
    {suspending, Command::hold, holding},          {suspended, Command::hold, holding},
    {unsuspending, Command::hold, holding},        {unholding, Command::hold, holding},
};

// A command that asks for what is so already.
constexpr Row in_place[] = {
    {clearing, Command::clear, clearing},        {stopped, Command::clear, stopped},
    {resetting, Command::reset, resetting},      {idle, Command::reset, idle},
    {holding, Command::hold, holding},           {held, Command::hold, held},
    {unholding, Command::unhold, unholding},     {suspending, Command::suspend, suspending},
    {suspended, Command::suspend, suspended},    {unsuspending, Command::unsuspend, unsuspending},
    {completing, Command::complete, completing}, {stopping, Command::stop, stopping},
    {aborting, Command::abort, aborting},        {aborted, Command::abort, aborted},
};

struct Done {
    PackState acting;
    PackState to;
};
constexpr Done done_rows[] = {
    {clearing, stopped},     {starting, execute}, {execute, completing},  {stopping, stopped},
    {aborting, aborted},     {holding, held},     {unholding, execute},   {suspending, suspended},
    {unsuspending, execute}, {resetting, idle},   {completing, complete},
};

bool job_command_allowed(PackState from, Command command) {
    switch (command) {
        case Command::claim:
        case Command::release:
        case Command::query:
            return true;
        case Command::store:
        case Command::verify:
        case Command::prepare:
        case Command::rehearse:
            return from == idle;
        case Command::cancel:  // a job that has not started; it may have been overtaken by Abort
            return from == idle || from == aborting || from == aborted || from == clearing || from == stopped ||
                   from == resetting;
        case Command::clear_result:
            return from == complete || from == stopped || from == aborted || from == idle || from == resetting ||
                   from == clearing;
        case Command::set_mode:
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
    for (const Row& row : moves) {
        if (row.from == from && row.command == command) return {TransitionKind::moves, row.to};
    }
    for (const Row& row : in_place) {
        if (row.from == from && row.command == command) return {TransitionKind::already, row.to};
    }
    // Start again, while the job runs: it has started, and once is enough.
    if (command == Command::start && has_active_job(from)) return {TransitionKind::already, from};
    if (command == Command::stop && has_active_job(from)) return {TransitionKind::moves, stopping};
    if (command == Command::abort) return {TransitionKind::moves, aborting};
    if (job_command_allowed(from, command)) return {TransitionKind::allowed, from};
    return {};
}

PackState after_done(PackState acting) {
    for (const Done& row : done_rows) {
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
    constexpr const char* job[] = {"CLAIM",  "RELEASE", "STORE",        "VERIFY",   "PREPARE",
                                   "CANCEL", "QUERY",   "CLEAR_RESULT", "REHEARSE", "SET_MODE"};
    const std::size_t number = static_cast<std::size_t>(command);
    constexpr auto first_of_job = static_cast<std::size_t>(Command::claim);
    if (number < std::size(machine)) return machine[number];
    return number >= first_of_job && number - first_of_job < std::size(job) ? job[number - first_of_job] : "unknown";
}

}  // namespace qchopper

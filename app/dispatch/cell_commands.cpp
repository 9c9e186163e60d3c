// One exchange with the cell or with the dispatcher that runs. O(rows of the journal).

#include "app/dispatch/cell_commands.h"

#include <memory>

#include "app/dispatch/left_open.h"
#include "base/error.h"
#include "devices/hand_off/cell_control.h"
#include "devices/hand_off/journal_history.h"
#include "devices/hand_off/operator_text.h"
#include "devices/hand_off/request_socket.h"
#include "devices/hand_off/seen_store.h"
#include "devices/wire/device_error.h"

namespace qchopper {
namespace {

constexpr const char* no_emergency_stop =
    "This is no emergency stop: it goes through network and controller. Danger is ended by the red button at the cell.";
constexpr const char* consent_needed = "Nothing moves before the operator at the cell has consented.";

struct CellAction {
    const char* name;
    CellCommand command;
};
constexpr CellAction actions[] = {
    {"hold", CellCommand::hold},       {"unhold", CellCommand::unhold}, {"stop", CellCommand::stop},
    {"abort", CellCommand::abort},     {"clear", CellCommand::clear},   {"reset", CellCommand::reset},
    {"take-over", CellCommand::claim},
};

CellCommand command_of(const std::string& name) {
    for (const CellAction& action : actions) {
        if (name == action.name) return action.command;
    }
    throw InputError(InputFault::use, name + " is no command to a cell",
                     Sentence::with_key("help_of_cell", {}, "give one of the commands to a cell"));
}

// What the operator must know of the command beside its end. `before` is STATUS as it was then, `own` our OWNER number
// of an earlier dispatch, 0 without one.
std::string note_of(CellCommand command, ControlEnd::Kind end, const Status& before, std::uint32_t own) {
    const bool is_done = end == ControlEnd::Kind::done;
    switch (command) {
        case CellCommand::stop:
        case CellCommand::abort:
            return no_emergency_stop;
        case CellCommand::unhold:
        case CellCommand::clear:
            return is_done ? "" : consent_needed;
        case CellCommand::claim:
            if (!is_done) return {};
            if (before.owner_held == 0) return "No dispatcher had a lease of the cell.";
            if (before.owner_held == own) return "The lease was that of an earlier dispatch of this computer.";
            return "The lease of " + dispatcher_name(before.owner_held) +
                   " has ended; a job that it started runs on: qchopper cell stop ends it.";
        default:
            return {};
    }
}

CellControlReport report_of(const std::string& action, const ContactedCell& cell) {
    CellControlReport report;
    report.endpoint = cell.endpoint;
    report.action = action;
    report.simulated = cell.status.has(flag::simulated);
    report.state = name(cell.status.state);
    return report;
}

const char* word_of(CommandEnd end) {
    constexpr const char* words[] = {"done", "refused", "unknown"};  // in the order of CommandEnd
    return words[static_cast<std::size_t>(end)];
}

CellControlReport ended(CellControlReport report, const char* end, const std::string& why) {
    report.end = end;
    report.why = why;
    return report;
}

CellControlReport ended(CellControlReport report, const ControlEnd& end) {
    report.to_do = end.to_do;
    if (end.result != AckResult::none) report.result = name(end.result);
    report.state = name(end.status.state);
    return ended(std::move(report), word_of(end.kind), end.why);
}

// A dispatcher of this user holds the cell: it passes on Unhold and Clear, for the others it has to end.
CellControlReport ask_running(const std::string& action, CellCommand command, const ContactedCell& cell,
                              const InputError& busy) {
    if (command != CellCommand::unhold && command != CellCommand::clear) throw busy;
    constexpr double margin_s = 15;
    const RequestAnswer answer = ask_dispatcher(cell.journal_folder, command, HandOffTimings{}.consent_s + margin_s);
    CellControlReport report =
        ended(report_of(action, cell), word_of(answer.end), "passed on by the running dispatcher: " + describe(answer));
    report.state.clear();
    if (answer.end != CommandEnd::done) {
        report.to_do = Sentence::with_key("look_at_cell", {cell.endpoint}, "Look at the cell.");
    }
    return report;
}

}  // namespace

bool is_to_stand(const std::string& action) {
    return action == "hold" || action == "stop" || action == "abort";
}

CellStatusReport cell_status(ContactedCell& cell) {
    CellStatusReport report;
    report.endpoint = cell.endpoint;
    report.status = cell.status;
    report.store = read_store(cell.bus);
    std::error_code error;
    report.has_journal = std::filesystem::exists(cell.journal_folder / "journal.sqlite", error);
    if (report.has_journal) {
        const JournalHistory history = history_of(read_journal(cell.journal_folder).rows);
        if (history.store && report.store) report.store_loss = loss_between(*history.store, *report.store);
        if (history.store_is_lost && report.store_loss.empty()) report.store_loss = "nobody has accepted its memory";
    }
    return report;
}

CellControlReport send_command(ContactedCell& cell, const std::string& action, std::uint32_t takeover_code,
                               const Context& context) {
    ControlOrder order;
    order.command = command_of(action);
    order.takeover_code = takeover_code;
    order.address = cell.endpoint;
    std::unique_ptr<Journal> journal;
    if (needs_lease(order.command) && !cell.status.has(flag::local_control)) {
        try {
            journal = std::make_unique<Journal>(cell.journal_folder, cell.journal_cell);
        } catch (const InputError& error) {
            if (error.fault != InputFault::busy) throw;
            return ask_running(action, order.command, cell, error);
        }
        order.past = past_of(history_of(journal->content().rows), nullptr, cell.status.owner_held);
        order.journal = [&](const JournalEvent& event) { journal->append(event); };
    }
    const ControlEnd end = control_cell(cell.bus, cell.status, order, context);
    CellControlReport report = report_of(action, cell);
    report.note = note_of(order.command, end.kind, cell.status, order.past.owner);
    return ended(std::move(report), end);
}

CellControlReport accept_store(ContactedCell& cell, bool is_confirmed, const Operator& person,
                               const ProjectContext& context) {
    const std::optional<SeenStore> now = read_store(cell.bus);
    if (!now) throw DeviceError(DeviceFault::protocol, "the IDENTITY of the cell cannot be read", "Try again.");
    Journal journal(cell.journal_folder, cell.journal_cell);
    const JournalHistory history = history_of(journal.content().rows);
    CellControlReport report = report_of("accept-store", cell);
    const std::string loss = history.store ? loss_between(*history.store, *now) : "the journal knows no memory of it";
    if (loss.empty() && !history.store_is_lost) {
        return ended(report, "done", "the cell has the memory that the journal knows; nothing was changed");
    }
    for (JournalJob job : history.jobs) {
        if (!job.is_open()) continue;
        job.is_settled = true;
        const std::string open =
            left_open(job) +
            " With its memory gone nothing can be asked any more: look for the piece or a block that is cut.";
        context.warn(Sentence::with_key("open_job_is_lost", {open},
                                        open + " The next dispatch starts this file only if that is asked for."));
        report.note =
            Sentence::with_key("open_jobs_are_settled", {},
                               "What was open is not asked for any more, and carved only if that is asked for.");
    }
    const bool is_real = !cell.status.has(flag::simulated);
    if (is_real && !is_confirmed &&
        !person.confirm("The cell lost its memory (" + loss + "). Have you looked at the cell, and is it free?")) {
        return ended(report, "refused", "not confirmed: nothing was changed");
    }
    JournalEvent event;
    event.kind = JournalKind::store_accepted;
    event.store = *now;
    journal.append(event);
    return ended(report, "done", "the memory of the cell is accepted: " + loss);
}

}  // namespace qchopper

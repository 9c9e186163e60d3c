// Commands to a cell outside of a dispatch, and its status.

#include "devices/hand_off/cell_control.h"

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/left_open.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/cell_control_report.h"
#include "base/error.h"
#include "cam/cell/cell.h"
#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/journal_history.h"
#include "devices/hand_off/operator_words.h"
#include "devices/hand_off/request_socket.h"
#include "devices/hand_off/seen_store.h"

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

struct Reached {
    explicit Reached(const std::string& to) : endpoint(to), bus(parse_tcp_address(to)) {}
    std::string endpoint;
    ModbusTcpBus bus;
    Status status;
    JournalCell cell;
    std::filesystem::path folder;
};

std::unique_ptr<Reached> reach(const CellControlArguments& arguments, Terminal& terminal) {
    std::optional<Cell> cell;
    if (arguments.cell) cell = read_cell(*arguments.cell);
    const std::optional<std::string> to = arguments.to ? arguments.to : cell ? cell->link.to : std::nullopt;
    if (!to) throw InputError(InputFault::use, "no cell address is known", "pass --to HOST:PORT, or --cell FILE");
    auto reached = std::make_unique<Reached>(*to);
    reached->status = first_status(reached->bus, *to, terminal);
    const Status& status = reached->status;
    const bool is_simulated = status.has(flag::simulated);
    if (cell && status.cell_id != cell->id && !(is_simulated && status.cell_id == any_cell_id)) {
        throw DeviceError(DeviceFault::refused,
                          "this is cell " + std::to_string(status.cell_id) + ", not cell " + std::to_string(cell->id) +
                              "; nothing was sent",
                          "Check the address, or the cell id in the cell file.");
    }
    reached->cell = journal_cell(status.cell_id, is_simulated, reached->bus.peer());
    reached->folder = journal_folder(reached->cell);
    return reached;
}

CellControlReport report_of(const CellControlArguments& arguments, const Reached& reached) {
    CellControlReport report;
    report.endpoint = reached.endpoint;
    report.action = arguments.action;
    report.simulated = reached.status.has(flag::simulated);
    report.state = name(reached.status.state);
    return report;
}

int show(const CellControlReport& report, Terminal& terminal) {
    terminal.show(lines(report), document(report));
    return report.end == "done" ? exit_done : exit_demand_broken;
}

int show_end(CellControlReport report, const ControlEnd& end, Terminal& terminal) {
    constexpr const char* ends[] = {"done", "refused", "unknown"};  // in the order of ControlEnd::Kind
    report.end = ends[static_cast<std::size_t>(end.kind)];
    report.why = end.why;
    report.to_do = end.to_do;
    if (end.result != AckResult::none) report.result = name(end.result);
    report.state = name(end.status.state);
    return show(report, terminal);
}

int show_status(Reached& reached, Terminal& terminal) {
    CellStatusReport report;
    report.endpoint = reached.endpoint;
    report.status = reached.status;
    report.store = read_store(reached.bus);
    std::error_code error;
    report.has_journal = std::filesystem::exists(reached.folder / "journal.sqlite", error);
    if (report.has_journal) {
        const JournalHistory history = history_of(read_journal(reached.folder).rows);
        if (history.store && report.store) report.store_loss = loss_between(*history.store, *report.store);
        if (history.store_is_lost && report.store_loss.empty()) report.store_loss = "nobody has accepted its memory";
    }
    terminal.show(lines(report), document(report));
    return exit_done;
}

// What was open is settled with it: what became of these jobs only the operator knows.
int accept_store(const CellControlArguments& arguments, Reached& reached, Terminal& terminal) {
    const std::optional<SeenStore> now = read_store(reached.bus);
    if (!now) throw DeviceError(DeviceFault::protocol, "the IDENTITY of the cell cannot be read", "Try again.");
    Journal journal(reached.folder, reached.cell);
    const JournalHistory history = history_of(journal.content().rows);
    CellControlReport report = report_of(arguments, reached);
    const std::string loss = history.store ? loss_between(*history.store, *now) : "the journal knows no memory of it";
    if (loss.empty() && !history.store_is_lost) {
        report.end = "done";
        report.why = "the cell has the memory that the journal knows; nothing was changed";
        return show(report, terminal);
    }
    for (JournalJob job : history.jobs) {
        if (!job.is_open()) continue;
        job.is_settled = true;
        terminal.warn(left_open(job) +
                      " With its memory gone nothing can be asked any more: look for the piece or a "
                      "block that is cut. The next dispatch starts this file only with --again.");
        report.note = "What was open is not asked for any more, and carved only with --again.";
    }
    const bool is_real = !reached.status.has(flag::simulated);
    if (is_real && !arguments.yes &&
        !is_confirmed("The cell lost its memory (" + loss + "). Have you looked at the cell, and is it free?")) {
        report.end = "refused";
        report.why = "not confirmed: nothing was changed";
        return show(report, terminal);
    }
    JournalEvent event;
    event.kind = JournalKind::store_accepted;
    event.store = *now;
    journal.append(event);
    report.end = "done";
    report.why = "the memory of the cell is accepted: " + loss;
    return show(report, terminal);
}

// A dispatcher of this user holds the cell: it passes on Unhold and Clear, for the others it has to end.
int ask_running(const CellControlArguments& arguments, const CellAction& action, const Reached& reached,
                Terminal& terminal, const InputError& busy) {
    if (action.command != CellCommand::unhold && action.command != CellCommand::clear) throw busy;
    constexpr double margin_s = 15;
    const std::string answer = ask_dispatcher(reached.folder, action.command, HandOffTimings{}.consent_s + margin_s);
    CellControlReport report = report_of(arguments, reached);
    report.end = answer == "OK" ? "done" : answer.starts_with("refused") ? "refused" : "unknown";
    report.why = "passed on by the running dispatcher: " + answer;
    report.state.clear();
    if (report.end != "done") report.to_do = "Look at the cell: " + cell_command(reached.endpoint, "status");
    return show(report, terminal);
}

int send(const CellControlArguments& arguments, const CellAction& action, Reached& reached, Terminal& terminal) {
    ControlOrder order;
    order.command = action.command;
    order.takeover_code = arguments.code.value_or(0);
    order.address = reached.endpoint;
    std::unique_ptr<Journal> journal;
    if (needs_lease(action.command) && !reached.status.has(flag::local_control)) {
        try {
            journal = std::make_unique<Journal>(reached.folder, reached.cell);
        } catch (const InputError& error) {
            if (error.fault != InputFault::busy) throw;
            return ask_running(arguments, action, reached, terminal, error);
        }
        order.past = past_of(history_of(journal->content().rows), nullptr, reached.status.owner_held);
        order.journal = [&](const JournalEvent& event) { journal->append(event); };
    }
    const ControlEnd end = control_cell(reached.bus, reached.status, order, terminal.context());
    CellControlReport report = report_of(arguments, reached);
    report.note = note_of(action.command, end.kind, reached.status, order.past.owner);
    return show_end(std::move(report), end, terminal);
}

}  // namespace

int run(const CellControlArguments& arguments, Terminal& terminal) {
    const bool is_to_stand = arguments.action == "hold" || arguments.action == "stop" || arguments.action == "abort";
    terminal.set_unchanged(is_to_stand
                               ? "Nothing was sent to the cell: what runs there runs on. In danger press the red "
                                 "button at the cell."
                               : "Nothing was sent to the cell.");
    const std::unique_ptr<Reached> reached = reach(arguments, terminal);
    if (arguments.action == "status") return show_status(*reached, terminal);
    if (arguments.action == "accept-store") return accept_store(arguments, *reached, terminal);
    for (const CellAction& action : actions) {
        if (arguments.action == action.name) return send(arguments, action, *reached, terminal);
    }
    throw InputError(InputFault::use, arguments.action + " is no command to a cell", "see qchopper cell --help");
}

}  // namespace qchopper

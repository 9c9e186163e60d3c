// Commands to a cell outside of a dispatch, and its status.

#include "devices/cell_control.h"

#include <memory>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/project/left_open.h"
#include "app/project/state_folder.h"
#include "app/report/cell_control_report.h"
#include "base/error.h"
#include "cam/cell/cell.h"
#include "devices/first_contact.h"
#include "devices/journal_history.h"
#include "devices/request_socket.h"
#include "devices/seen_store.h"

namespace qchopper {
namespace {

constexpr const char* no_emergency_stop =
    "This is no emergency stop: it goes through network and controller. Danger is ended by the red button at the cell.";
constexpr const char* consent_needed = "Nothing moves before the operator at the cell has consented.";

struct CellAction {
    const char* name;
    CellCommand command;
    const char* note;
};
constexpr CellAction actions[] = {
    {"hold", CellCommand::hold, ""},
    {"unhold", CellCommand::unhold, consent_needed},
    {"stop", CellCommand::stop, no_emergency_stop},
    {"abort", CellCommand::abort, no_emergency_stop},
    {"clear", CellCommand::clear, consent_needed},
    {"reset", CellCommand::reset, consent_needed},
    {"take-over", CellCommand::claim, "The other dispatcher has lost its lease; a job that it started runs on."},
};

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
    const std::optional<Status> status = first_status(reached->bus, *to, terminal);
    if (!status) return nullptr;
    reached->status = *status;
    const bool is_simulated = status->has(flag::simulated);
    if (cell && status->cell_id != cell->id && !(is_simulated && status->cell_id == any_cell_id)) {
        throw DeviceError(DeviceFault::refused,
                          "this is cell " + std::to_string(status->cell_id) + ", not cell " + std::to_string(cell->id) +
                              "; nothing was sent",
                          "Check the address, or the cell id in the cell file.");
    }
    reached->cell = journal_cell(status->cell_id, is_simulated, *to);
    reached->folder = journal_folder(reached->cell);
    return reached;
}

CellControlReport report_of(const CellControlArguments& arguments, const Reached& reached, const char* note) {
    CellControlReport report;
    report.endpoint = reached.endpoint;
    report.action = arguments.action;
    report.note = note;
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
    if (end.result != AckResult::none) report.result = name(end.result);
    report.state = name(end.status.state);
    return show(report, terminal);
}

int show_status(Reached& reached, Terminal& terminal) {
    CellStatusReport report;
    report.endpoint = reached.endpoint;
    report.status = reached.status;
    report.store = read_store(reached.bus, reached.status);
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
    const std::optional<SeenStore> now = read_store(reached.bus, reached.status);
    if (!now) throw DeviceError(DeviceFault::protocol, "the IDENTITY of the cell cannot be read", "Try again.");
    Journal journal(reached.folder, reached.cell);
    const JournalHistory history = history_of(journal.content().rows);
    CellControlReport report = report_of(arguments, reached, "");
    const std::string loss = history.store ? loss_between(*history.store, *now) : "the journal knows no memory of it";
    if (loss.empty() && !history.store_is_lost) {
        report.end = "done";
        report.why = "the cell has the memory that the journal knows; nothing was changed";
        return show(report, terminal);
    }
    for (const JournalJob& job : history.jobs) {
        const std::string open = job.is_open() ? left_open(job) : "";
        if (!open.empty())
            terminal.message(open + " No dispatch will ask for it again" +
                             (job.is_started ? "." : ", and the next one starts its piece anew."));
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
    CellControlReport report = report_of(arguments, reached, action.note);
    report.end = answer == "OK" ? "done" : answer.starts_with("refused") ? "refused" : "unknown";
    report.why = "passed on by the running dispatcher: " + answer;
    report.state.clear();
    return show(report, terminal);
}

int send(const CellControlArguments& arguments, const CellAction& action, Reached& reached, Terminal& terminal) {
    ControlOrder order;
    order.command = action.command;
    order.takeover_code = arguments.code.value_or(0);
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
    return show_end(report_of(arguments, reached, action.note), end, terminal);
}

}  // namespace

int run(const CellControlArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was sent to the cell.");
    const std::unique_ptr<Reached> reached = reach(arguments, terminal);
    if (!reached) return Terminal::cancel_code();
    if (arguments.action == "status") return show_status(*reached, terminal);
    if (arguments.action == "accept-store") return accept_store(arguments, *reached, terminal);
    for (const CellAction& action : actions) {
        if (arguments.action == action.name) return send(arguments, action, *reached, terminal);
    }
    throw InputError(InputFault::use, arguments.action + " is no command to a cell", "see qchopper cell --help");
}

}  // namespace qchopper

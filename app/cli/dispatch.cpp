// Hands the jobs of a project to a cell; asks before a real one is set in motion.

#include "devices/hand_off/dispatch.h"

#include <unistd.h>

#include <chrono>
#include <iostream>
#include <thread>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/standard_input_lines.h"
#include "app/dispatch/left_open.h"
#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/hand_over_report.h"
#include "base/printable.h"
#include "cam/cell/cell.h"
#include "cam/cell/cell_check.h"
#include "devices/hand_off/drop_folder.h"
#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/request_socket.h"
#include "devices/wire/codec.h"
#include "devices/wire/device_error.h"

namespace qchopper {
namespace {

constexpr const char* dispatch_schema = "qchopper-dispatch-1";
constexpr const char* nothing_started = "The project is unchanged, and this dispatch started no job.";

// What is assumed may be planned and simulated with, never carved with.
void refuse_uncertain(const Cell& cell) {
    const CellCheck check = check_cell(cell);
    if (check.may_be_dispatched()) return;
    throw InputError(InputFault::config,
                     "no job goes to a real cell by the cell file of this project: " + check.against_dispatch.front() +
                         (check.against_dispatch.size() > 1 ? ", and more" : ""),
                     "see qchopper cells check, measure, correct the cell file and prepare the scan again");
}

// All jobs are looked at before the first one is sent. What speaks against one is an answer and not an error: the exit
// code is that of a demand that is not met.
bool refuse(const std::vector<std::string>& sentences, std::size_t jobs, Terminal& terminal) {
    if (sentences.empty()) return false;
    for (const std::string& sentence : sentences) terminal.error(sentence);
    const HandOverReport report{{}, jobs, false, sentences, {}};
    terminal.show({"no job was sent"}, document(report, dispatch_schema));
    return true;
}

bool refuse_unreachable(const std::vector<PieceJob>& jobs, Terminal& terminal) {
    std::vector<std::string> sentences = unreachable_jobs(jobs);
    for (std::string& sentence : sentences) {
        sentence += "; pass --accept-unreachable if the foam that stays there may stay";
    }
    return refuse(sentences, jobs.size(), terminal);
}

// Asks where there is somebody to answer.
bool refuse_unheld(const std::vector<PieceJob>& jobs, Terminal& terminal) {
    std::vector<std::string> sentences = unheld_jobs(jobs);
    if (sentences.empty()) return false;
    if (::isatty(STDIN_FILENO) != 0) {
        terminal.warn(sentences);
        if (is_confirmed("Send " + std::to_string(jobs.size()) + " jobs, these among them?")) return false;
    }
    for (std::string& sentence : sentences) {
        sentence += "; pass --accept-workholding if the piece is held by more than that";
    }
    return refuse(sentences, jobs.size(), terminal);
}

// The cell may be running a job of an earlier dispatch: the message of an error before it is asked says so.
void set_unchanged(const Cell& cell, const std::string& where, Terminal& terminal) {
    const std::string open = left_open(cell.id, where);
    terminal.set_unchanged(nothing_started + (open.empty() ? "" : " " + open));
}

Status contact(ModbusTcpBus& bus, const std::string& where, const Cell& cell, Terminal& terminal) {
    try {
        return first_status(bus, where, terminal);
    } catch (const DeviceError&) {
        set_unchanged(cell, where, terminal);
        throw;
    }
}

void check_drop_folder(const std::filesystem::path& drop, const Cell& cell, const std::string& where,
                       Terminal& terminal) {
    const std::string fault = fault_of_drop_folder(drop);
    if (fault.empty()) return;
    set_unchanged(cell, where, terminal);
    throw InputError(InputFault::create, fault,
                     "mount its share or make it, or name the one of the cell with --drop DIR; small files can go over "
                     "the link with --chunks");
}

DispatchOptions options_of(const DispatchArguments& arguments, const Cell& cell, const Status& status) {
    DispatchOptions options;
    options.want_simulated = status.has(flag::simulated);
    // A simulated cell without an id of its own accepts every one; a real cell must have the id of the project's cell.
    options.cell_id = options.want_simulated && status.cell_id == any_cell_id ? any_cell_id : cell.id;
    options.again = arguments.again;
    options.rehearse = arguments.rehearse;
    options.takeover_code = arguments.takeover_code.value_or(0);
    options.owner_held = status.owner_held;
    return options;
}

}  // namespace

bool is_confirmed(const std::string& question) {
    if (::isatty(STDIN_FILENO) == 0) {
        throw InputError(InputFault::use,
                         "a real cell is set in motion only after a question, and there is no terminal for the answer",
                         "pass --yes if that is meant");
    }
    std::cerr << printable(question) << " [y/N] " << std::flush;
    StandardInputLines input;
    while (!Terminal::is_cancelled()) {
        if (const std::optional<std::string> line = input.next()) return *line == "y" || *line == "Y" || *line == "yes";
        if (input.has_ended()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    throw Cancelled();
}

Status first_status(ModbusTcpBus& bus, const std::string& where, Terminal& terminal) {
    bus.connect();
    const std::optional<Status> status = read_first_status(bus, where, terminal.context());
    if (!status) throw Cancelled();
    return *status;
}

int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options, Journal& journal,
              const std::string& schema, const std::string& next, Terminal& terminal) {
    const HandOverReport report{
        hand_over(jobs, bus, options, journal, terminal.context()), jobs.size(), options.want_simulated, {}, next};
    terminal.show(lines(report), document(report, schema));
    if (report.is_cancelled()) return Terminal::cancel_code();
    return report.is_complete() ? exit_done : exit_demand_broken;
}

int run(const DispatchArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged(nothing_started);
    const ProjectJobs ordered = jobs_of(arguments.project, arguments.piece, terminal.context());
    const auto& [folder, cell, cell_sha256, jobs, is_finished] = ordered;
    if (refuse(unproven_jobs(ordered, false), jobs.size(), terminal)) return exit_demand_broken;
    if (!arguments.accept_unreachable && refuse_unreachable(jobs, terminal)) return exit_demand_broken;
    if (!arguments.accept_workholding && refuse_unheld(jobs, terminal)) return exit_demand_broken;
    const std::optional<std::string> to = arguments.to ? arguments.to : cell.link.to;
    const std::optional<std::filesystem::path> drop = arguments.drop ? arguments.drop : cell.link.drop;
    if (!to) throw InputError(InputFault::use, "no cell address is known", "pass --to HOST:PORT");
    if (!drop && !arguments.chunks) {
        throw InputError(InputFault::use, "no drop folder is known", "pass --drop DIR, or --chunks");
    }
    ModbusTcpBus bus(parse_tcp_address(*to));
    if (!arguments.chunks) check_drop_folder(*drop, cell, *to, terminal);
    // Read before anything is sent, so that a real cell is never taken for a simulated one.
    const Status status = contact(bus, *to, cell, terminal);
    DispatchOptions options = options_of(arguments, cell, status);
    options.address = *to;
    if (!arguments.chunks) options.drop_folder = *drop;
    if (options.want_simulated) {
        terminal.message("the cell at " + *to + " is SIMULATED: nothing moves");
        for (const std::string& sentence : simulated_only_jobs(ordered))
            terminal.warn(sentence + "; a real cell would not get it");
    } else {
        refuse_uncertain(cell);
        if (refuse(unproven_jobs(ordered, true), jobs.size(), terminal)) return exit_demand_broken;
    }
    if (!options.want_simulated && !arguments.yes &&
        !is_confirmed("Hand " + std::to_string(jobs.size()) + " jobs to the REAL cell \"" + cell.name + "\" at " + *to +
                      "?")) {
        refuse({"not confirmed: nothing was sent"}, jobs.size(), terminal);
        return exit_demand_broken;
    }
    const JournalCell of = journal_cell(options.cell_id, options.want_simulated, bus.peer());
    Journal journal(journal_folder(of), of);
    RequestSocket requests(journal_folder(of));
    options.request = [&] { return requests.next(); };
    options.answer_request = [&](const std::string& answer) { requests.answer(answer); };
    return hand_over(jobs, bus, options, journal, dispatch_schema, {}, terminal);
}

}  // namespace qchopper

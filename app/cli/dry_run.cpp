// Hands the jobs of a project to a simulated cell in this process, over TCP.

#include "app/cli/commands.h"
#include "app/cli/simulated_limits.h"
#include "app/dispatch/proven_jobs.h"
#include "base/files/temporary_folder.h"
#include "base/shell_word.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/cell_sim.h"

namespace qchopper {
namespace {

// "" if dispatch would refuse a job. What the cell file does not tell stands in capitals, for a person to fill in.
std::string dispatch_of(const ProjectJobs& ordered, const DryRunArguments& arguments) {
    if (!unproven_jobs(ordered, false).empty() || !unreachable_jobs(ordered.jobs).empty()) return {};
    const Link& link = ordered.cell.link;
    std::error_code error;
    std::string command = "qchopper dispatch " + shell_word(arguments.project);
    if (arguments.piece) command += " --piece " + *arguments.piece;
    if (!link.to) command += " --to HOST:PORT";
    if (!link.drop || !std::filesystem::is_directory(*link.drop, error)) command += " --drop DIR";
    return command;
}

}  // namespace

int run(const DryRunArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const ProjectJobs ordered = jobs_of(arguments.project, arguments.piece, terminal.context(), true);
    const auto& [folder, cell, cell_sha256, jobs, is_finished] = ordered;
    if (!is_finished) {
        terminal.warn(folder.string() + " is not finished: of its jobs the " + std::to_string(jobs.size()) +
                      " that are written so far are rehearsed");
    }
    for (const std::string& sentence : unproven_jobs(ordered, true)) {
        terminal.warn(sentence + "; dispatch to a real cell refuses it");
    }
    for (const std::string& sentence : unreachable_jobs(jobs)) {
        terminal.warn(sentence + "; dispatch asks for --accept-unreachable");
    }
    for (const std::string& sentence : unheld_jobs(jobs)) {
        terminal.warn(sentence + "; dispatch asks before it sends it");
    }
    const TemporaryFolder drop("qchopper-dry-run-");
    CellSimOptions options;
    options.drop_folder = drop.path();
    options.limits = simulated_limits(cell);
    options.limits.consent = Consent::automatic;
    options.limits.speed = arguments.speed;
    options.limits.acting_ms = 20;
    CellSim sim(options);
    sim.start();
    terminal.message("dry run: a simulated cell inside this program, over TCP on 127.0.0.1:" +
                     std::to_string(sim.port()) + "; consent is given at once, nothing moves");
    ModbusTcpBus bus({"127.0.0.1", sim.port()});
    DispatchOptions dispatch;
    dispatch.cell_id = cell.id;
    dispatch.want_simulated = true;
    dispatch.drop_folder = drop.path();
    dispatch.timings.poll_s = 0.02;
    // Of this run alone: the user's journals are never touched.
    const TemporaryFolder state("qchopper-dry-run-journal-");
    Journal journal(state.path(), {cell.id, true, "dry-run"});
    return hand_over(jobs, bus, dispatch, journal, "qchopper-dry-run-1", dispatch_of(ordered, arguments), terminal);
}

}  // namespace qchopper

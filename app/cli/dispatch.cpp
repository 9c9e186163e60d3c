#include "devices/dispatch.h"

#include <unistd.h>

#include <iostream>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/hand_over_report.h"
#include "cam/cell/cell.h"
#include "devices/codec.h"
#include "devices/first_contact.h"
#include "devices/modbus_tcp.h"

namespace qchopper {
namespace {

bool is_confirmed(const std::string& question) {
    if (::isatty(STDIN_FILENO) == 0) {
        throw InputError(InputFault::use,
                         "a real cell is only set in motion after a question, and nobody can answer here",
                         "pass --yes if that is meant");
    }
    std::cerr << question << " [y/N] " << std::flush;
    std::string line;
    std::getline(std::cin, line);
    return line == "y" || line == "Y" || line == "yes";
}

}  // namespace

int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
              const std::string& schema, Terminal& terminal) {
    const auto on_complete = [&](std::size_t count) {  // what an error in the next job has to say of those before it
        terminal.unchanged = "The " + std::to_string(count) + " jobs before it ended complete; it was not started.";
    };
    const HandOverReport report{hand_over(jobs, bus, options, on_complete, terminal.context()), jobs.size(),
                                options.want_simulated};
    terminal.show(lines(report));
    terminal.json(document(report, schema));
    if (report.is_cancelled()) return Terminal::cancel_code();
    return report.is_complete() ? exit_done : exit_demand_broken;
}

int run(const DispatchArguments& arguments, Terminal& terminal) {
    terminal.unchanged = "The project is unchanged, and no job was started.";
    const auto [cell, jobs] = jobs_of(arguments.project, arguments.piece);
    const std::optional<std::string> to = arguments.to ? arguments.to : cell.link.to;
    const std::optional<std::filesystem::path> drop = arguments.drop ? arguments.drop : cell.link.drop;
    if (!to) throw InputError(InputFault::use, "no cell address is known", "pass --to HOST:PORT");
    if (!drop) throw InputError(InputFault::use, "no drop folder is known", "pass --drop DIR");
    ModbusTcpBus bus(parse_tcp_address(*to));
    bus.connect();
    // Who answers there? Asked before anything is sent, so that a real cell is never taken for a simulated one.
    const std::optional<Status> answer = read_first_status(bus, *to, terminal.context());
    if (!answer) {
        terminal.say("stopped on request: nothing was sent");
        return Terminal::cancel_code();
    }
    const Status& status = *answer;
    DispatchOptions options;
    options.want_simulated = status.has(flag::simulated);
    // A simulated cell that was not told whom to play answers to every name; a real one must be the one asked for.
    options.cell_id = options.want_simulated && status.cell_id == any_cell_id ? any_cell_id : cell.id;
    options.drop_folder = *drop;
    if (options.want_simulated) {
        terminal.say("the cell at " + *to + " is SIMULATED: nothing moves");
    } else if (!arguments.yes && !is_confirmed("Hand " + std::to_string(jobs.size()) + " jobs to the REAL cell \"" +
                                               cell.name + "\" at " + *to + "?")) {
        terminal.say("not confirmed: nothing was sent");
        return exit_demand_broken;
    }
    return hand_over(jobs, bus, options, "qchopper-dispatch-1", terminal);
}

}  // namespace qchopper

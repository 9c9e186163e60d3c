// Runs a simulated cell until a signal or the command quit ends the program.

#include <chrono>
#include <iostream>
#include <mutex>
#include <thread>

#include "app/cli/arguments/check_arguments.h"
#include "app/cli/arguments/option_values.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/standard_input_lines.h"
#include "app/dispatch/block_picture.h"
#include "app/dispatch/executed_program.h"
#include "app/dispatch/signing.h"
#include "app/dispatch/simulated_limits.h"
#include "app/report/command_line_text.h"
#include "app/report/notices.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "cam/job/read_job.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/script_run.h"

namespace qchopper {
namespace {

// Before the cell works for hours.
void check_picture(const CellSimArguments& arguments, const Cell& cell) {
    if (!arguments.picture || cell.machine) return;
    throw InputError(InputFault::use, "the cell file describes no machine: what its programs carve is not known",
                     "leave --picture out");
}

// Of the block as the last job has carved it.
void write_picture(const CellSim& sim, const CellSimArguments& arguments, Terminal& terminal) {
    const std::optional<CarvedJob> carved = sim.carved_job();
    if (!carved) return terminal.message("no job was started: there is no picture of its block");
    const std::string name = carved->file.filename().string();
    write_file(*arguments.picture,
               block_picture(read_job(carved->file), name, read_cell(*arguments.cell), carved->run_s));
    terminal.message(arguments.picture->string() + ": the block after " +
                     duration(static_cast<std::uint32_t>(carved->run_s)) + " of " + name);
}

CellSimOptions options_of(const CellSimArguments& arguments, const TcpAddress& address) {
    CellSimOptions options;
    if (arguments.cell) {
        const Cell cell = read_cell(*arguments.cell);
        check_picture(arguments, cell);
        options.limits = simulated_limits(cell);
        options.read_program = program_reader(cell);
    }
    options.host = address.host;
    options.port = address.port;
    options.allow = checked_addresses(arguments.allow);
    options.drop_folder = arguments.drop;
    if (arguments.store) options.store_folder = *arguments.store;
    options.limits.speed = arguments.speed;
    options.limits.consent = arguments.consent == "auto"  ? Consent::automatic
                             : arguments.consent == "ask" ? Consent::ask
                                                          : Consent::never;
    return options;
}

std::vector<ScriptLine> script_of(const CellSimArguments& arguments) {
    if (!arguments.script) return {};
    const Bytes bytes = read_file(*arguments.script, record_limit);
    return parse_script({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, arguments.script->string());
}

// Adds what was typed since the last call; a line that is wrong is told, and the others go on.
void add_typed(StandardInputLines& input, std::size_t& count, ScriptRun& typed, Terminal& terminal) {
    while (const std::optional<std::string> line = input.next()) {
        try {
            if (const auto parsed = parse_script_line(*line, ++count, "standard input")) typed.add(*parsed);
        } catch (const InputError& fault) {
            terminal.error(std::string(fault.what()) + ". " + command_line_text(fault.to_do));
        }
    }
}

// Performs script and commands until one of them says quit, a signal comes, or the terminal is gone.
void serve(CellSim& sim, const std::vector<ScriptLine>& script, Terminal& terminal) {
    const auto show = [&](const std::string& line) { terminal.message(line); };
    const auto is_stopped = [] { return Terminal::is_cancelled(); };
    ScriptRun scripted(sim, show, is_stopped);
    ScriptRun typed(sim, show, is_stopped);
    scripted.add(script);
    StandardInputLines input;
    std::size_t count = 0;
    while (!is_stopped() && scripted.step() && typed.step() && !terminal.is_gone()) {
        add_typed(input, count, typed, terminal);
        // Nobody is there any more who could consent.
        if (input.has_ended() && scripted.is_idle() && typed.is_idle()) {
            sim.perform({0, Act::consent, 0, 0, {}});
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

}  // namespace

int run(const CellSimArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("No cell was started.");
    check_arguments(arguments);
    if (arguments.list_faults) {
        terminal.show(fault_lines(), fault_document());
        return exit_done;
    }
    const TcpAddress address = listen_address(arguments.listen);
    const std::vector<ScriptLine> script = script_of(arguments);
    CellSimOptions options = options_of(arguments, address);
    std::mutex terminal_mutex;  // the cell sends messages from its own threads
    options.on_message = [&](const std::string& line) {
        const std::lock_guard lock(terminal_mutex);
        terminal.message(line);
    };
    options.on_question = [&](const std::string& question) {
        const std::lock_guard lock(terminal_mutex);
        std::cerr << printable(question) << " [y/N] " << std::endl;
    };
    if (arguments.trusted) {
        read_trusted_keys(*arguments.trusted);  // a list that cannot be read is said now
        options.trusted_keys = cell_keys(*arguments.trusted, options.on_message);
    }
    CellSim sim(options);
    sim.start();
    const bool is_ipv6 = address.host.find(':') != std::string::npos;
    const std::string where = (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" + std::to_string(sim.port());
    terminal.show({"listening " + where}, listening_document(where));
    serve(sim, script, terminal);
    if (arguments.picture) write_picture(sim, arguments, terminal);
    sim.stop();
    terminal.message("simulated cell stopped");
    return exit_done;
}

}  // namespace qchopper

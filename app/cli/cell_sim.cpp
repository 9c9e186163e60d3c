// Runs a simulated cell until a signal ends the program.

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <mutex>
#include <thread>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/simulated_limits.h"
#include "app/report/notices.h"
#include "devices/modbus_tcp.h"
#include "sim/cell_sim.h"

namespace qchopper {
namespace {

// Waits for a line on stdin, or until the program is cancelled. End of input means no.
bool ask_on_terminal(const std::string& question) {
    std::cerr << question << " [y/N] " << std::flush;
    std::string line;
    while (!Terminal::is_cancelled()) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (::poll(&input, 1, 200) <= 0) continue;
        char c = 0;
        if (::read(STDIN_FILENO, &c, 1) <= 0) break;
        if (c == '\n') break;
        line += c;
    }
    return line == "y" || line == "Y" || line == "yes";
}

// An address as for a connection, but port 0 is allowed: any free port.
TcpAddress listen_address(const std::string& text) {
    if (!text.ends_with(":0")) return parse_tcp_address(text);
    TcpAddress address = parse_tcp_address(text.substr(0, text.size() - 2));
    address.port = 0;
    return address;
}

}  // namespace

int run(const CellSimArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("No cell was started.");
    const TcpAddress address = listen_address(arguments.listen);
    CellSimOptions options;
    if (arguments.cell) options.limits = simulated_limits(read_cell(*arguments.cell));
    options.listen_host = address.host;
    options.port = address.port;
    options.drop_folder = arguments.drop;
    if (arguments.store) options.store_folder = *arguments.store;
    options.limits.speed = arguments.speed;
    options.limits.consent = arguments.consent == "auto"  ? Consent::automatic
                             : arguments.consent == "ask" ? Consent::ask
                                                          : Consent::never;
    options.ask = ask_on_terminal;
    std::mutex terminal_mutex;  // the cell sends messages from its own threads
    options.on_message = [&](const std::string& line) {
        const std::lock_guard lock(terminal_mutex);
        terminal.message(line);
    };
    CellSim sim(options);
    sim.start();
    const bool is_ipv6 = address.host.find(':') != std::string::npos;
    const std::string where = (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" + std::to_string(sim.port());
    terminal.show({"listening " + where}, listening_document(where));
    while (!Terminal::is_cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    sim.stop();
    terminal.message("simulated cell stopped");
    return exit_done;
}

}  // namespace qchopper

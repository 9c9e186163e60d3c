// Takes a controller through the handshake. About 25 s, and as long as consent takes.

#include "app/cli/commands.h"
#include "app/cli/confirm.h"
#include "app/cli/exit_code.h"
#include "app/report/cell/cell_control_report.h"
#include "devices/wire/modbus_tcp.h"

namespace qchopper {

int run(const CellCheckArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("No START was sent to the cell.");
    ModbusTcpBus bus(parse_tcp_address(arguments.to));
    bus.connect();
    const Operator person = operator_at_terminal();
    LinkCheckOptions options;
    options.consent = [&](const std::string& question) {
        return arguments.yes || (person.can_answer && person.confirm(question));
    };
    terminal.message("checking " + arguments.to + "; no START is sent");
    const LinkCheckReport report{arguments.to, check_link(bus, options, terminal.context())};
    terminal.show(lines(report), document(report));
    return report.check.holds() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

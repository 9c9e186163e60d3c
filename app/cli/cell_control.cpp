// Commands to a cell outside of a dispatch, and its status.

#include "app/cli/commands.h"
#include "app/cli/confirm.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/cell_commands.h"
#include "app/report/cell/cell_control_report.h"

namespace qchopper {

int run(const CellControlArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged(is_to_stand(arguments.action)
                               ? "Nothing was sent to the cell: what runs there runs on. In danger press the red "
                                 "button at the cell."
                               : "Nothing was sent to the cell.");
    const std::unique_ptr<ContactedCell> cell = contact_cell({arguments.to, arguments.cell}, terminal.context());
    if (arguments.action == "status") {
        const CellStatusReport report = cell_status(*cell);
        terminal.show(lines(report), document(report));
        return exit_done;
    }
    const CellControlReport report =
        arguments.action == "accept-store"
            ? accept_store(*cell, arguments.yes, operator_at_terminal(), terminal.context())
            : send_command(*cell, arguments.action, arguments.code.value_or(0), terminal.context());
    terminal.show(lines(report), document(report));
    return report.end == "done" ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

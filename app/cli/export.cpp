// Writes pieces for other programs.

#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/export_report.h"
#include "app/store/project_folder.h"

namespace qchopper {

int run(const ExportArguments& arguments, Terminal& terminal) {
    OpenProject open(without_slash(arguments.project), terminal.context());
    const ExportedProject exported = export_pieces(open, arguments, version(), terminal.context());
    terminal.warn(warnings(exported, arguments, open.project()));
    terminal.show(lines(exported, open.project()), document(exported, arguments, open.project(), arguments.project));
    return exported.is_demand_met() ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

// Shows the setups of a project, or makes one of them the operator's choice.

#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/program_report.h"
#include "app/report/setup_report.h"
#include "app/store/project_folder.h"

namespace qchopper {

int run(const SetupArguments& a, Terminal& terminal) {
    SetupRequest request = a;
    request.tools = ascending(a.tools);
    const SetupAnswer answer = setup_project(without_slash(a.project), request, version(), terminal.context());
    if (answer.job) terminal.warn(program_warnings(*answer.job, answer.folder));
    terminal.warn(warnings(answer));
    terminal.show(lines(answer), document(answer));
    return exit_done;
}

}  // namespace qchopper

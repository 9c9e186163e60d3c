// Hands the jobs of a project to a cell; asks before a real one is set in motion.

#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/confirm.h"
#include "app/cli/exit_code.h"
#include "app/cli/passphrase.h"
#include "app/report/command_line_text.h"

namespace qchopper {

int show(const DispatchReport& report, const std::string& schema, Terminal& terminal) {
    for (const Sentence& why : report.refused) terminal.error(command_line_text(why));
    terminal.show(report.refused.empty() ? lines(report) : std::vector<std::string>{"no job was sent"},
                  document(report, schema));
    if (!report.refused.empty()) return exit_demand_broken;
    if (report.is_cancelled()) return Terminal::cancel_code();
    return report.is_complete() ? exit_done : exit_demand_broken;
}

int run(const DispatchArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged(nothing_started);
    DispatchRequest request = arguments;
    request.program_version = version();
    if (arguments.signing.key) {
        request.signing_key = open_own_key(*arguments.signing.key, arguments.signing.passphrase_fd);
    }
    const DispatchAnswer answer = dispatch_project(request, operator_at_terminal(), terminal.context());
    return show({answer.handed, answer.wanted, answer.is_simulated, answer.refused, {}, answer.restart},
                "qchopper-dispatch-2", terminal);
}

}  // namespace qchopper

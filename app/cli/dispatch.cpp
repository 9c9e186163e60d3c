// Hands the jobs of a project to a cell; asks before a real one is set in motion.

#include "app/cli/commands.h"
#include "app/cli/confirm.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/dispatch_project.h"

namespace qchopper {
namespace {

constexpr const char* dispatch_schema = "qchopper-dispatch-1";

DispatchRequest request_of(const DispatchArguments& arguments) {
    DispatchRequest request;
    request.project = arguments.project;
    request.piece = arguments.piece;
    request.to = arguments.to;
    request.drop = arguments.drop;
    request.chunks = arguments.chunks;
    request.is_confirmed = arguments.yes;
    request.accept_unreachable = arguments.accept_unreachable;
    request.accept_workholding = arguments.accept_workholding;
    request.again = arguments.again;
    request.rehearse = arguments.rehearse;
    request.takeover_code = arguments.takeover_code.value_or(0);
    return request;
}

}  // namespace

int show(const DispatchReport& report, const std::string& schema, Terminal& terminal) {
    for (const std::string& sentence : report.refused) terminal.error(sentence);
    terminal.show(report.refused.empty() ? lines(report) : std::vector<std::string>{"no job was sent"},
                  document(report, schema));
    if (!report.refused.empty()) return exit_demand_broken;
    if (report.is_cancelled()) return Terminal::cancel_code();
    return report.is_complete() ? exit_done : exit_demand_broken;
}

int run(const DispatchArguments& arguments, Terminal& terminal) {
    const DispatchAnswer answer = dispatch_project(request_of(arguments), operator_at_terminal(), terminal.context());
    return show({answer.handed, answer.wanted, answer.is_simulated, answer.refused, {}}, dispatch_schema, terminal);
}

}  // namespace qchopper

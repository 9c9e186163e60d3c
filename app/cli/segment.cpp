// Cuts a scan one decision at a time, or shows the state of its project.

#include "app/cli/arguments/check_arguments.h"
#include "app/cli/arguments/project_arguments.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/unusual_size.h"
#include "app/engine/segment_project.h"
#include "app/report/segment_report.h"

namespace qchopper {

int run(const SegmentArguments& a, Terminal& terminal) {
    check_arguments(a);
    ProjectChoices choices = choices_of(a, a.replayed ? "" : default_preset);  // a plan has settings of its own
    choices.plan = a.replayed;
    choices.on_unusual_size = unusual_size_check(a.size_ok);
    const SegmentAnswer answer =
        is_project_folder(a.input) ? segment_project(without_slash(a.input), a.cell, request_of(a), terminal.context())
                                   : segment_scan(choices, request_of(a), terminal.context());
    terminal.warn(answer.warnings);
    terminal.show(lines(answer), document(answer));
    return answer.is_demand_met ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

// From a scan to job files, or on with a project that is not finished yet.

#include "app/cli/arguments/check_arguments.h"
#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/project_arguments.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/unusual_size.h"
#include "app/engine/prepare_project.h"
#include "app/report/prepare_report.h"

namespace qchopper {

int run(const PrepareArguments& a, Terminal& terminal) {
    check_arguments(a);
    PrepareOptions options{version(), a.time_limit_s};
    options.has_items = a.items;
    if (a.programs || a.no_programs || a.items) options.has_programs = !a.no_programs;
    if (a.discard) options.discard = discard_from(*a.discard);
    ProjectChoices choices = choices_of(a);
    choices.on_unusual_size = unusual_size_check(a.size_ok);
    const PreparedProject prepared = is_project_folder(a.input)
                                         ? prepare_project(without_slash(a.input), a.cell, options, terminal.context())
                                         : prepare_scan(choices, options, terminal.context());
    return show(prepared, terminal);
}

int show(const PreparedProject& prepared, Terminal& terminal) {
    terminal.warn(warnings(prepared));
    terminal.show(table(prepared), document(prepared));
    return prepared.project.do_rules_hold() && prepared.all_fit() && prepared.are_programs_proven()
               ? exit_done
               : exit_demand_broken;
}

}  // namespace qchopper

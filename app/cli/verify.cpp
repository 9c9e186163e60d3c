// Verifies the jobs of a project, or one job file.

#include "app/cli/arguments/project_arguments.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/signing.h"
#include "app/dispatch/verify_jobs.h"
#include "app/report/verify_report.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/printable.h"

namespace qchopper {

int run(const VerifyArguments& a, Terminal& terminal) {
    terminal.set_unchanged("No verdict was changed.");
    const TrustedKeys trusted = read_trusted_keys(trusted_keys_file(a.trusted));
    VerifyAnswer answer;
    if (is_project_folder(a.input)) {
        if (!a.entered.is_empty()) {
            throw InputError(
                InputFault::use,
                a.input.string() +
                    " is a project, and --base and --tool are of one job: the block that "
                    "stands in the cell",
                "name its job file: qchopper verify " + shell_word(without_slash(a.input) / "jobs" / "NAME.qjob"));
        }
        if (a.cell) {
            throw InputError(InputFault::use, "a project has its own cell file",
                             "leave --cell out, or name a job file NAME.qjob");
        }
        answer = verify_project(without_slash(a.input), a.piece, version(), trusted, terminal.context());
    } else {
        if (a.piece) throw InputError(InputFault::use, "a job file holds one piece", "leave --piece out");
        answer.push_back(verify_job(a.input, a.cell, version(), trusted, terminal.context(), a.entered));
    }
    terminal.show(lines(answer), document(answer));
    return is_all_positive(answer) ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

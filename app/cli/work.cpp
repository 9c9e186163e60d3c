// Makes the programs of a shard of a project's pieces.

#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/report/program_report.h"
#include "app/store/project_folder.h"

namespace qchopper {

int run(const WorkArguments& a, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const Shard shard = a.shard ? *shard_from(*a.shard) : Shard{};
    const auto tell = [&](const WorkedPiece& piece) { terminal.message(worked_line(piece)); };
    const WorkAnswer answer = work_project(without_slash(a.project), shard, version(), tell, terminal.context());
    terminal.show(lines(answer), document(answer));
    return exit_done;
}

}  // namespace qchopper

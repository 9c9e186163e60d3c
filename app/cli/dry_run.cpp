// Hands the jobs of a project to a simulated cell in this process, over TCP.

#include "app/cli/commands.h"

namespace qchopper {

int run(const DryRunArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const DryRunAnswer answer = dry_run(arguments, terminal.context());
    return show({answer.handed, answer.wanted, true, {}, answer.next}, "qchopper-dry-run-2", terminal);
}

}  // namespace qchopper

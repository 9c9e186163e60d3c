// Writes the assembly guide of a finished project.

#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/engine/make_project.h"
#include "app/guide/write_guide.h"
#include "app/report/notices.h"

namespace qchopper {

int run(const GuideArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("The project is unchanged.");
    const std::filesystem::path folder = without_slash(arguments.project);
    if (!is_project_folder(folder)) {
        throw InputError(InputFault::missing, "there is no project " + folder.string(),
                         "name a folder that prepare has made");
    }
    LockedProject open(folder, std::nullopt, terminal.context());
    const WrittenGuide written = write_guide(open.project, version(), terminal.context());
    terminal.show(lines(written), document(written));
    return exit_done;
}

}  // namespace qchopper

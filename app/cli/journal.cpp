// Shows and verifies the journals of cells. O(rows).

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/journal_report.h"

namespace qchopper {

int run(const JournalArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    std::vector<JournalReport> reports;
    for (const std::filesystem::path& folder : journal_folders(arguments.folder)) {
        reports.push_back({folder.string(), read_journal(folder), arguments.shows});
    }
    terminal.show(lines(reports), document(reports));
    return exit_done;
}

}  // namespace qchopper

// Shows and verifies the journals of cells. O(rows).

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/journal_report.h"
#include "base/error.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

bool has_journal(const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / "journal.sqlite", error);
}

// All that are there, by name; or the one that is named, as a path or as a name in the state folder.
std::vector<fs::path> folders_of(const fs::path& wanted) {
    const fs::path state = state_folder();
    if (!wanted.empty()) return {has_journal(wanted) ? wanted : state / wanted};
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(state, error), end; !error && entry != end; entry.increment(error)) {
        if (has_journal(entry->path())) folders.push_back(entry->path());
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

}  // namespace

int run(const JournalArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    std::vector<JournalReport> reports;
    for (const fs::path& folder : folders_of(arguments.folder)) {
        reports.push_back({folder.string(), read_journal(folder), arguments.shows});
    }
    terminal.show(lines(reports), document(reports));
    return exit_done;
}

}  // namespace qchopper

// Shows and verifies the journals of cells, lists their jobs, and exports the rows of closed ones. O(rows).

#include "app/cli/arguments/option_values.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/dispatch/state_folder.h"
#include "app/report/cell/journal_jobs.h"
#include "app/report/cell/journal_report.h"
#include "base/error.h"
#include "base/text.h"
#include "devices/hand_off/journal_retention.h"

namespace qchopper {
namespace {

std::vector<std::filesystem::path> all_folders(const std::vector<std::filesystem::path>& wanted) {
    if (wanted.empty()) return journal_folders({});
    std::vector<std::filesystem::path> folders;
    folders.reserve(wanted.size());
    for (const std::filesystem::path& one : wanted) folders.push_back(journal_folders(one).at(0));
    return folders;
}

std::uint64_t past_ms(const std::string& text, const std::string& option) {
    const std::optional<std::uint64_t> ms = ms_from_utc(text);
    if (!ms) {
        throw InputError(InputFault::use, option + ": \"" + text + "\" is no day and no time",
                         "Write it as 2026-11-22, or \"2026-11-22 17:43:28\", in UTC.");
    }
    if (const std::uint64_t now = unix_ms(); *ms > now) {
        throw InputError(
            InputFault::use,
            option + ": " + text + " lies in the future; by the clock of this computer it is " + utc_text(now) + " UTC",
            "Give a time that has passed, or set the clock.");
    }
    return *ms;
}

}  // namespace

int run(const JournalArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    std::vector<JournalReport> reports;
    for (const std::filesystem::path& folder : journal_folders(arguments.folder)) {
        reports.push_back({folder.string(), read_journal(folder), arguments.shows});
    }
    terminal.show(lines(reports), document(reports));
    return exit_done;
}

int run(const JournalJobsArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was changed.");
    const std::uint64_t since_ms = arguments.since ? past_ms(*arguments.since, "--since") : 0;
    std::vector<JournalContent> journals;
    for (const std::filesystem::path& folder : all_folders(arguments.journals)) {
        journals.push_back(read_journal(folder));
    }
    const std::vector<JournalJobReport> jobs = jobs_of(journals, since_ms);
    terminal.show(arguments.is_csv ? job_csv(jobs) : job_lines(jobs), job_document(jobs));
    return exit_done;
}

int run(const JournalExportArguments& arguments, Terminal& terminal) {
    terminal.set_unchanged("Nothing was removed from the journal.");
    const std::uint64_t before_ms = past_ms(arguments.before, "--before");
    const std::filesystem::path folder = journal_folders(arguments.journal).at(0);
    Journal journal(folder, read_journal(folder).cell);
    const JournalExport plan = plan_export(journal.content(), before_ms);
    if (plan.head.number != 0) {
        write_exported(arguments.out, journal.content(), plan.head.number);
        if (read_journal(arguments.out).hash != plan.head.hash) {
            throw InputError(InputFault::io,
                             arguments.out.string() + ": the exported rows are not those of the journal");
        }
        journal.remove_exported(plan.head, plan.events);
    }
    const ExportedRows report{folder.string(), arguments.out.string(), plan.head, plan.jobs, plan.why_not_more};
    terminal.show(lines(report), document(report));
    return exit_done;
}

}  // namespace qchopper

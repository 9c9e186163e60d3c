// Every job file is read and hashed whole before the first one is sent. O(bytes), which are kept in memory, and O(jobs
// * rows of the journal).

#include "app/project/hand_over.h"

#include <algorithm>

#include "app/project/ordered_job.h"
#include "app/project/project_folder.h"
#include "app/project/shell_word.h"
#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/read_job.h"
#include "devices/codec.h"
#include "devices/journal_history.h"

namespace qchopper {
namespace {

// Nothing if prepare wrote no job for the piece, because it does not fit.
std::optional<PieceJob> job_of(const JobOrder& order) {
    std::error_code error;
    const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(order.file, error));
    if (written_job_of(order.project, order.piece) == nullptr) {
        if (is_there) refuse_unrecorded(order.folder, order.file);
        return std::nullopt;
    }
    if (!is_there) {
        throw InputError(InputFault::missing, order.file.string() + " is gone",
                         "write the jobs again: qchopper prepare " + shell_word(order.folder));
    }
    Bytes bytes = read_job(order.file);
    const ReadJob job = parse_job(bytes, order.file.string());
    check_ordered(job, order);
    const JobTicket ticket = job_ticket(job, order.file.filename().string());
    return PieceJob{order.piece, std::move(bytes), ticket, job.setup.reach.unreachable_share(), job.max_unreachable};
}

// The job of an earlier dispatcher, as it is named in this order or by its file.
HandedOver named(const std::vector<PieceJob>& jobs, const WireTicket& ticket) {
    for (const PieceJob& job : jobs) {
        if (job.ticket.file_sha256 == ticket.file_sha256) return {job.piece, {}, true};
    }
    return {ticket.file_name, {}, false};
}

// By its file: the parts of a piece have one name.
bool was_taken_up(const std::vector<HandedOver>& handed, const PieceJob& job, const JournalHistory& history) {
    return std::any_of(handed.begin(), handed.end(), [&](const HandedOver& one) {
        return std::any_of(history.jobs.begin(), history.jobs.end(), [&](const JournalJob& known) {
            return known.job_id == one.outcome.job_id && known.file_sha256 == job.ticket.file_sha256;
        });
    });
}

// False if one of them is no reason to go on: it is UNKNOWN, or did not run to its end.
bool take_up_open_jobs(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                       const Journal& journal, const ProjectContext& context, std::vector<HandedOver>& handed) {
    const JournalHistory before = history_of(journal.content().rows);
    for (const JournalJob& open : before.jobs) {
        if (!open.is_open()) continue;
        const Decoded<WireTicket> ticket = decode_ticket(open.ticket);
        if (!ticket.is_ok()) continue;
        const JournalHistory history = history_of(journal.content().rows);
        DispatchOptions adopted = options;
        adopted.past = past_of(history, &open);
        HandedOver one = named(jobs, ticket.value);
        context.message("an earlier dispatcher left the job " + to_text(open.job_id) + " (" + one.piece +
                        ") open; asking the cell");
        if (open.start_may_have_arrived || open.is_started) {
            context.saved("Whether the job " + to_text(open.job_id) + " of an earlier dispatcher has started is " +
                          (open.is_started ? "certain: STARTED." : "UNKNOWN: ask the cell."));
        }
        one.outcome = adopt_job(bus, ticket.value, adopted, context);
        const JobOutcome& outcome = one.outcome;
        if (outcome.verdict == StartVerdict::not_started && !outcome.cancelled && !outcome.store_is_lost) continue;
        handed.push_back(std::move(one));
        if (!handed.back().outcome.is_complete()) return false;
        context.saved("The jobs before it ended complete; it was not started.");
    }
    return true;
}

void check_part(const JournalHistory& history, const PieceJob& job) {
    WireTicket ticket;
    ticket.project_id = job.ticket.about.project_id;
    ticket.piece_no = job.ticket.about.piece_no;
    ticket.part = job.ticket.about.part;
    ticket.parts = job.ticket.about.parts;
    const std::string why = why_part_must_wait(history, ticket);
    if (!why.empty()) {
        throw InputError(InputFault::use, "piece " + job.piece + ": " + why, "dispatch the parts in their order");
    }
}

}  // namespace

ProjectJobs jobs_of(const std::filesystem::path& folder, const std::optional<std::string>& piece,
                    const Context& context) {
    const StageTimer stage(context, "jobs read");
    const Project project = load_project(folder);
    if (project.stage != Stage::done) {
        throw InputError(InputFault::use, folder.string() + " is not finished",
                         "finish it first: qchopper prepare " + shell_word(folder));
    }
    ProjectJobs found{read_cell(folder / "cell.toml"), {}};
    for (const SolidRecord& record : project.pieces) {
        if (piece && record.name != *piece) continue;
        const JobOrder order{project, record.name, found.cell, folder, folder / "jobs" / job_file_name(record.name)};
        if (std::optional<PieceJob> job = job_of(order)) {
            found.jobs.push_back(std::move(*job));
        } else if (piece) {  // without it the pieces that do not fit are left out
            throw InputError(InputFault::missing, "piece " + *piece + " has no job",
                             "it does not fit the cell; see the table that prepare printed");
        }
    }
    if (found.jobs.empty()) {
        throw InputError(piece ? InputFault::use : InputFault::missing,
                         piece ? "there is no piece " + *piece + " in " + folder.string()
                               : folder.string() + " holds no job that fits",
                         "see the table that prepare printed");
    }
    return found;
}

std::vector<std::string> unreachable_jobs(const std::vector<PieceJob>& jobs) {
    std::vector<std::string> sentences;
    for (const PieceJob& job : jobs) {
        if (!job.is_unreachable()) continue;
        sentences.push_back("piece " + job.piece + ": the tool does not reach " +
                            fixed(100 * job.unreachable_share, 2) + " % of its surface, and the limit is " +
                            fixed(100 * job.max_unreachable, 2) + " %");
    }
    return sentences;
}

std::vector<HandedOver> hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                                  Journal& journal, const ProjectContext& context) {
    const StageTimer stage(context, "jobs handed over");
    DispatchOptions kept = options;
    kept.journal = [&](const JournalEvent& event) {
        journal.append(event);
        if (options.journal) options.journal(event);
    };
    std::vector<HandedOver> handed;
    if (!take_up_open_jobs(jobs, bus, kept, journal, context, handed)) return handed;
    const std::vector<HandedOver> taken_up = handed;
    for (const PieceJob& job : jobs) {
        const JournalHistory history = history_of(journal.content().rows);
        if (was_taken_up(taken_up, job, history)) continue;
        kept.past = past_of(history, nullptr);
        check_part(history, job);
        context.message("piece " + job.piece + ": " + job.ticket.file_name + ", " + with_commas(job.ticket.file_size) +
                        " bytes");
        handed.push_back({job.piece, dispatch_job(bus, job.ticket, job.file, kept, context)});
        const JobOutcome& outcome = handed.back().outcome;
        if (!outcome.is_complete() && !outcome.carved_complete) break;
        context.saved("The " + std::to_string(handed.size()) + " jobs before it ended complete; it was not started.");
    }
    return handed;
}

}  // namespace qchopper

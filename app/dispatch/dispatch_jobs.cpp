// Every job file is read and hashed whole before the first one is sent. O(bytes), which are kept in memory, and O(jobs
// * rows of the journal).

#include "app/dispatch/dispatch_jobs.h"

#include <algorithm>
#include <iterator>

#include "app/dispatch/left_open.h"
#include "app/jobs/ordered_job.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/read_job.h"
#include "devices/hand_off/journal_history.h"
#include "devices/hand_off/operator_text.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

PieceJob described(const ReadJob& read, const std::filesystem::path& file, Bytes bytes) {
    PieceJob job;
    job.piece = read.piece;
    job.file = std::move(bytes);
    job.ticket = job_ticket(read, file.filename().string());
    if (read.program) {
        job.part = read.program->part.number;
        job.parts = read.program->part.count;
        job.chunks = read.program->chunks.size();
        job.restart = read.program->restart;
    }
    job.no_program_because = read.no_program_because;
    job.verdict = read_verdict(file);
    job.signature = read_signature(file);
    job.unreachable_share = read.setup.access.unreachable_share();
    job.max_unreachable = read.max_unreachable;
    job.is_unreachable = is_unreachable(read.setup, read.max_unreachable);
    if (const std::optional<Workholding>& workholding = read.setup.workholding; workholding && !workholding->passes()) {
        job.holding_problem = workholding_problem(*workholding) + "; " + workholding_remedy(*workholding);
    }
    return job;
}

PieceJob job_of(const JobOrder& order) {
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(order.file, error))) {
        throw InputError(InputFault::missing, order.file.string() + " is gone",
                         "write the jobs again: qchopper prepare " + shell_word(order.folder));
    }
    Bytes bytes = read_job(order.file);
    const ReadJob read = parse_job(bytes, order.file.string());
    check_ordered(read, order);
    return described(read, order.file, std::move(bytes));
}

// None if prepare wrote no job for the piece, because it does not fit or the saw alone makes it.
std::vector<PieceJob> jobs_of_piece(const std::filesystem::path& folder, const Project& project,
                                    const std::string& piece, const Cell& cell) {
    const std::vector<WrittenJob> written = written_jobs_of(project, piece);
    std::error_code error;
    const std::filesystem::path first = folder / "jobs" / job_file_name(piece);
    if (written.empty() && project.stage == Stage::done &&
        std::filesystem::exists(std::filesystem::symlink_status(first, error))) {
        refuse_unrecorded(folder, first);
    }
    std::vector<PieceJob> jobs;
    jobs.reserve(written.size());
    for (const WrittenJob& job : written) {
        jobs.push_back(job_of({project, piece, job, cell, folder, folder / "jobs" / job_file_name(piece, job.part)}));
    }
    return jobs;
}

// The job of an earlier dispatcher, as it is named in this order or by its file.
DispatchedJob named(const std::vector<PieceJob>& jobs, const WireTicket& ticket) {
    for (const PieceJob& job : jobs) {
        if (job.ticket.file_sha256 == ticket.file_sha256) return {job.piece, {}, true};
    }
    return {printable(ticket.file_name), {}, false};
}

// By its file: the parts of a piece have one name.
bool was_taken_up(const std::vector<DispatchedJob>& handed, const PieceJob& job, const JournalHistory& history) {
    return std::any_of(handed.begin(), handed.end(), [&](const DispatchedJob& one) {
        return std::any_of(history.jobs.begin(), history.jobs.end(), [&](const JournalJob& known) {
            return known.job_id == one.outcome.job_id && known.file_sha256 == job.ticket.file_sha256;
        });
    });
}

// Whether the job has ended in the cell and one of these goes on with it.
bool is_restarted(const std::vector<PieceJob>& jobs, const WireTicket& ticket, const JobOutcome& outcome) {
    return is_over(outcome.job_state) && !outcome.store_is_lost && std::ranges::any_of(jobs, [&](const PieceJob& job) {
               return job.restart && job.restart->of == ticket.file_sha256;
           });
}

// False if one of them is no reason to go on: it is UNKNOWN, or did not run to its end and no job goes on with it.
bool take_up_open_jobs(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                       const Journal& journal, const ProjectContext& context, std::vector<DispatchedJob>& handed) {
    const JournalHistory before = history_of(journal.content().rows);
    for (const JournalJob& open : before.jobs) {
        if (!open.is_open()) continue;
        const Decoded<WireTicket> ticket = decode<WireTicket>(open.ticket);
        if (!ticket.is_ok()) continue;
        const JournalHistory history = history_of(journal.content().rows);
        DispatchOptions adopted = options;
        adopted.past = past_of(history, &open, options.owner_held);
        DispatchedJob one = named(jobs, ticket.value);
        context.message("an earlier dispatcher left the job " + to_text(open.job_id) + " (" + one.piece +
                        ") open; asking the cell");
        if (const std::string left = left_open(open); !left.empty()) context.saved(left);
        one.outcome = adopt_job(bus, ticket.value, adopted, context);
        const JobOutcome& outcome = one.outcome;
        if (outcome.start_outcome == StartOutcome::not_started && !outcome.cancelled && !outcome.store_is_lost)
            continue;
        if (!outcome.is_complete() && is_restarted(jobs, ticket.value, outcome)) {
            context.message("it has ended: " + outcome.why + "; its restart follows");
            continue;
        }
        handed.push_back(std::move(one));
        if (!handed.back().outcome.is_complete()) return false;
        context.saved("The jobs before it ended complete; it was not started.");
    }
    return true;
}

// By the journal the file was started before, or may have been, and the cell does not know: its memory is younger.
std::optional<JobOutcome> milled_before(const JournalHistory& history, const PieceJob& job,
                                        const DispatchOptions& options) {
    const JournalJob* before = history.last_start_of(job.ticket.file_sha256);
    if (before == nullptr || options.again || !before->is_forgotten) return std::nullopt;
    JobOutcome outcome;
    outcome.start_outcome = StartOutcome::not_started;
    if (!before->is_started) {
        outcome.may_be_milled = true;
        outcome.why = "whether the cell has carved this file before is UNKNOWN: it lost its memory of job " +
                      to_text(before->job_id) + ", which may have started";
        outcome.to_do = Sentence::with_key(
            "look_for_piece", {},
            "Look for the piece or a block that is cut. Where neither is there, ask for it to be carved again.");
        return outcome;
    }
    outcome.milled_before = true;
    outcome.milled_complete = before->is_complete();
    const std::string end = before->is_complete() ? "ended complete"
                            : before->has_ended   ? "started and was aborted"
                                                  : "has started; its end is not known";
    outcome.why = "by the journal the cell has carved this file before: job " + to_text(before->job_id) + ", which " +
                  end + "; the cell itself no longer knows";
    outcome.to_do = carve_again();
    return outcome;
}

// What a ticket says of the order, the piece and the part.
WireTicket place_of(const PieceJob& job) {
    WireTicket ticket;
    ticket.project_id = job.ticket.about.project_id;
    ticket.piece_no = job.ticket.about.piece_no;
    ticket.part = job.ticket.about.part;
    ticket.parts = job.ticket.about.parts;
    return ticket;
}

// "B.r5.qjob (job 0123...)"
std::string name_of(const JournalJob& job) {
    return printable(decode<WireTicket>(job.ticket).value.file_name) + " (job " + to_text(job.job_id) + ")";
}

// The job of the piece or part was stopped, and another one carved it to its end since.
std::optional<JobOutcome> carved_since(const JournalHistory& history, const PieceJob& job,
                                       const DispatchOptions& options) {
    const JournalJob* const own = history.last_start_of(job.ticket.file_sha256);
    if (own == nullptr || own->is_complete() || options.again) return std::nullopt;
    const JournalJob* const last = history.last_start_at(place_of(job));
    if (last == nullptr || !last->is_complete()) return std::nullopt;
    JobOutcome outcome;
    outcome.start_outcome = StartOutcome::not_started;
    outcome.milled_before = true;
    outcome.milled_complete = true;
    outcome.why = "its job was stopped, and by the journal " + name_of(*last) + " has carved it to its end";
    outcome.to_do = carve_again();
    return outcome;
}

// By the journal the cell was stopped in the job that the restart goes on with, and nothing but restarts came after it.
void check_restart(const JournalHistory& history, const PieceJob& job, const DispatchOptions& options) {
    if (!job.restart || options.again) return;
    const auto refuse = [&](const std::string& why) {
        throw InputError(
            InputFault::use,
            "piece " + job.piece + ": the restart " + job.ticket.file_name + " is not sent: by the journal " + why,
            Sentence::with_key(
                "look_then_restart", {},
                "Look at the block and at the chunk in which the machine stood. If both are of this job, "
                "ask for it to be carved again."));
    };
    const JournalJob* const last = history.last_start_at(place_of(job));
    if (last == nullptr) return refuse("the cell has started no job of this piece");
    if (last->is_complete()) return refuse(name_of(*last) + " has carved it to its end");
    const JournalJob* const stopped = history.last_start_at(place_of(job), false);
    if (stopped != nullptr && stopped->file_sha256 == job.restart->of) return;
    refuse("the cell was stopped in another job than the one whose chunk this is: " +
           (stopped == nullptr ? name_of(*last) : name_of(*stopped)));
}

void check_part(const JournalHistory& history, const PieceJob& job) {
    const std::string why = why_part_must_wait(history, place_of(job));
    if (!why.empty()) {
        throw InputError(InputFault::use, "piece " + job.piece + ": " + why, "dispatch the parts in their order");
    }
}

}  // namespace

PieceJob piece_job(const std::filesystem::path& file, Bytes bytes) {
    const ReadJob read = parse_job(bytes, file.string());
    return described(read, file, std::move(bytes));
}

ProjectJobs jobs_of(const std::filesystem::path& folder, const std::optional<std::string>& piece,
                    const Context& context, bool may_be_unfinished) {
    const StageTimer stage(context, "jobs read");
    const Project project = load_project(folder);
    const bool is_finished = project.stage == Stage::done;
    if (!is_finished && !(may_be_unfinished && !project.jobs.empty())) {
        throw InputError(InputFault::use,
                         folder.string() + " is not finished" + (may_be_unfinished ? " and has no job yet" : ""),
                         std::filesystem::exists(items_folder(folder))
                             ? "make and gather its programs: qchopper submit " + shell_word(folder)
                             : "finish it first: qchopper prepare " + shell_word(folder));
    }
    ProjectJobs found{folder,
                      read_cell(folder / "cell.toml"),
                      sha256(read_file(folder / "cell.toml", settings_limit)),
                      {},
                      is_finished};
    for (const SolidRecord& record : project.pieces) {
        if (piece && record.name != *piece) continue;
        std::vector<PieceJob> jobs = jobs_of_piece(folder, project, record.name, found.cell);
        std::move(jobs.begin(), jobs.end(), std::back_inserter(found.jobs));
        if (jobs.empty() && piece) {  // without it the pieces that do not fit are left out
            throw InputError(
                InputFault::missing, "piece " + *piece + " has no job" + (is_finished ? "" : " yet"),
                is_finished ? "it does not fit the cell, or the saw alone makes it; see the table that prepare printed"
                            : "wait until prepare has written it");
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
        if (!job.is_unreachable) continue;
        sentences.push_back("piece " + job.piece + ": the tool does not reach " +
                            fixed(100 * job.unreachable_share, 2) + " % of its surface, and the limit is " +
                            fixed(100 * job.max_unreachable, 2) + " %");
    }
    return sentences;
}

std::vector<std::string> jobs_failing_workholding(const std::vector<PieceJob>& jobs) {
    std::vector<std::string> sentences;
    for (const PieceJob& job : jobs) {
        if (job.holding_problem.empty() || job.part > 1) continue;
        sentences.push_back("piece " + job.piece + " is not held safely: " + job.holding_problem);
    }
    return sentences;
}

std::vector<DispatchedJob> dispatch_jobs(const std::vector<PieceJob>& jobs, RegisterBus& bus,
                                         const DispatchOptions& options, Journal& journal,
                                         const ProjectContext& context) {
    const StageTimer stage(context, "jobs handed over");
    DispatchOptions kept = options;
    kept.journal = [&](const JournalEvent& event) {
        journal.append(event);
        if (options.journal) options.journal(event);
    };
    std::vector<DispatchedJob> handed;
    if (!take_up_open_jobs(jobs, bus, kept, journal, context, handed)) return handed;
    const std::vector<DispatchedJob> taken_up = handed;
    for (const PieceJob& job : jobs) {
        const JournalHistory history = history_of(journal.content().rows);
        if (was_taken_up(taken_up, job, history)) continue;
        kept.past = past_of(history, nullptr, options.owner_held);
        check_part(history, job);
        check_restart(history, job, options);
        std::optional<JobOutcome> before = carved_since(history, job, options);
        if (!before) before = milled_before(history, job, options);
        if (before) {
            context.message("piece " + job.piece + ": NOT STARTED: " + before->why);
            handed.push_back({job.piece, *std::move(before)});
            if (!handed.back().outcome.milled_complete) break;
            continue;
        }
        context.message("piece " + job.piece + ": " + job.ticket.file_name + ", " + with_commas(job.ticket.file_size) +
                        " bytes");
        handed.push_back({job.piece, dispatch_job(bus, job.ticket, job.file, kept, context)});
        const JobOutcome& outcome = handed.back().outcome;
        if (!outcome.is_complete() && !outcome.milled_complete) break;
        context.saved("The " + std::to_string(handed.size()) + " jobs before it ended complete; it was not started.");
    }
    return handed;
}

}  // namespace qchopper

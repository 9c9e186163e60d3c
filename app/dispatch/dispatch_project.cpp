// The checks cost O(bytes of the jobs), the hand-off as dispatch_jobs.h says.

#include "app/dispatch/dispatch_project.h"

#include "app/dispatch/contact_cell.h"
#include "app/dispatch/left_open.h"
#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/signing.h"
#include "app/dispatch/state_folder.h"
#include "base/error.h"
#include "cam/cell/cell_check.h"
#include "devices/hand_off/drop_folder.h"
#include "devices/hand_off/request_socket.h"
#include "devices/wire/codec.h"
#include "devices/wire/device_error.h"

namespace qchopper {
namespace {

// Each with what to do about it.
std::vector<Sentence> with(const std::vector<std::string>& sentences, Sentence (*remedy)(const std::string&)) {
    std::vector<Sentence> all;
    all.reserve(sentences.size());
    for (const std::string& sentence : sentences) all.push_back(remedy(sentence));
    return all;
}

std::vector<Sentence> plain_sentences(const std::vector<std::string>& sentences) {
    return {sentences.begin(), sentences.end()};
}

Sentence held_by_more(const std::string& problem) {
    return Sentence::with_key("accept_workholding", {problem},
                              problem + "; it may be sent if the piece is held by more than that");
}

Sentence foam_may_stay(const std::string& problem) {
    return Sentence::with_key("accept_unreachable", {problem},
                              problem + "; it may be sent if the foam that stays there may stay");
}

// Asks where there is somebody to answer.
std::vector<Sentence> why_not_held(const std::vector<PieceJob>& jobs, const Operator& person,
                                   const ProjectContext& context) {
    const std::vector<std::string> sentences = jobs_failing_workholding(jobs);
    if (sentences.empty()) return {};
    if (person.can_answer) {
        context.warn(sentences);
        if (person.confirm("Send " + std::to_string(jobs.size()) + " jobs, these among them?")) return {};
    }
    return with(sentences, held_by_more);
}

std::vector<Sentence> why_not_signed(const ProjectJobs& ordered, const DispatchRequest& request) {
    const TrustedKeys trusted = read_trusted_keys(trusted_keys_file(request.trusted));
    std::vector<Sentence> why = plain_sentences(wrongly_signed_jobs(ordered, trusted, unix_ms()));
    if (const auto key = why_not_signed_by(request.signing_key, ordered.cell, trusted)) why.push_back(*key);
    return why;
}

// Checks 1 to 3: all jobs are looked at before the cell is. Empty: they may go to a simulated cell.
std::vector<Sentence> why_not_any_cell(const ProjectJobs& ordered, const DispatchRequest& request,
                                       const Operator& person, const ProjectContext& context) {
    std::vector<Sentence> why = plain_sentences(unproven_jobs(ordered, false));
    if (why.empty()) why = why_not_signed(ordered, request);
    if (why.empty() && !request.accept_unreachable) {
        why = with(unreachable_jobs(ordered.jobs), foam_may_stay);
    }
    if (why.empty() && !request.accept_workholding) why = why_not_held(ordered.jobs, person, context);
    return why;
}

// Leaves the job that is named by its bytes alone. Empty: it is there, or none was named.
std::vector<Sentence> why_not_that_job(ProjectJobs& ordered, const DispatchRequest& request) {
    if (!request.job) return {};
    std::erase_if(ordered.jobs, [&](const PieceJob& job) { return job.ticket.file_sha256 != *request.job; });
    if (!ordered.jobs.empty()) return {};
    return {"no job of " + (request.piece ? "piece " + *request.piece : "the project") + " has the SHA-256 " +
            to_hex(*request.job) + ": it was made again since, or is one of another project"};
}

// Puts the restart in the place of the jobs, if one is asked for. Empty: it is proven, or none is asked for.
std::vector<Sentence> why_not_restarted(ProjectJobs& ordered, const DispatchRequest& request,
                                        const ProjectContext& context, DispatchAnswer& answer) {
    if (!request.from_chunk) return {};
    if (!request.piece) {
        throw InputError(InputFault::use, "a chunk is of one piece, and none is named",
                         Sentence::with_key("name_piece", {}, "name the piece"));
    }
    answer.restart = put_restart_in_place(ordered, *request.from_chunk, request.program_version, context);
    if (answer.restart->job.empty()) return answer.restart->refused;
    context.saved(std::string(nothing_started) + " The restart " + answer.restart->job + " lies beside its jobs.");
    return answer.restart->refused;
}

// Check 5.
std::vector<Sentence> why_not_this_cell(const DispatchRequest& request, bool is_simulated, const std::string& to) {
    if (request.expects_simulated.value_or(is_simulated) == is_simulated) return {};
    return {"the cell at " + to +
            (is_simulated ? " is SIMULATED, and a real one is expected" : " is REAL, and a simulated one is expected")};
}

// What is assumed may be planned and simulated with, never milled with.
void refuse_uncertain(const Cell& cell) {
    const CellCheck check = check_cell(cell);
    if (check.may_be_dispatched()) return;
    throw InputError(InputFault::config,
                     "no job goes to a real cell by the cell file of this project: " + check.against_dispatch.front() +
                         (check.against_dispatch.size() > 1 ? ", and more" : ""),
                     "see qchopper cells check, measure, correct the cell file and prepare the scan again");
}

// Check 6.
std::vector<Sentence> why_not_real_cell(const ProjectJobs& ordered, const DispatchRequest& request,
                                        const std::string& to, const Operator& person) {
    refuse_uncertain(ordered.cell);
    std::vector<Sentence> why = plain_sentences(unproven_jobs(ordered, true));
    if (!why.empty() || request.is_confirmed) return why;
    if (person.confirm("Hand " + std::to_string(ordered.jobs.size()) + " jobs to the REAL cell \"" + ordered.cell.name +
                       "\" at " + to + "?")) {
        return {};
    }
    return {"not confirmed: nothing was sent"};
}

// The cell may be running a job of an earlier dispatch: the message of an error before it is asked says so.
void say_what_is_open(const Cell& cell, const std::string& where, const ProjectContext& context) {
    const std::string open = left_open(cell.id, where);
    context.saved(nothing_started + (open.empty() ? "" : " " + open));
}

Status contact(ModbusTcpBus& bus, const std::string& where, const Cell& cell, const ProjectContext& context) {
    try {
        return first_status(bus, where, context);
    } catch (const DeviceError&) {
        say_what_is_open(cell, where, context);
        throw;
    }
}

void check_drop_folder(const std::filesystem::path& drop, const Cell& cell, const std::string& where,
                       const ProjectContext& context) {
    const std::string fault = fault_of_drop_folder(drop);
    if (fault.empty()) return;
    say_what_is_open(cell, where, context);
    throw InputError(InputFault::create, fault,
                     Sentence::with_key(
                         "drop_folder", {},
                         "mount its share or make it, or name the one of the cell; small files can go over the link"));
}

DispatchOptions options_of(const DispatchRequest& request, const Cell& cell, const Status& status) {
    DispatchOptions options;
    options.want_simulated = status.has(flag::simulated);
    // A simulated cell without an id of its own accepts every one; a real cell must have the id of the project's cell.
    options.cell_id = options.want_simulated && status.cell_id == any_cell_id ? any_cell_id : cell.id;
    options.again = request.again;
    options.rehearse = request.rehearse;
    options.takeover_code = request.takeover_code;
    options.owner_held = status.owner_held;
    options.signing_key = request.signing_key;
    return options;
}

// With the journal of the cell, and a socket for other programs of this user that want the cell to be told something.
std::vector<DispatchedJob> dispatch_with_journal(const std::vector<PieceJob>& jobs, ModbusTcpBus& bus,
                                                 DispatchOptions options, const ProjectContext& context) {
    const JournalCell cell = journal_cell(options.cell_id, options.want_simulated, bus.peer());
    Journal journal(journal_folder(cell), cell);
    RequestSocket requests(journal_folder(cell));
    options.request = [&] { return requests.next(); };
    options.answer_request = [&](const RequestAnswer& answer) { requests.answer(answer); };
    return dispatch_jobs(jobs, bus, options, journal, context);
}

}  // namespace

DispatchAnswer dispatch_project(const DispatchRequest& request, const Operator& person, const ProjectContext& context) {
    context.saved(nothing_started);
    ProjectJobs ordered = jobs_of(request.project, request.piece, context);
    const Cell& cell = ordered.cell;
    DispatchAnswer answer;
    answer.refused = why_not_restarted(ordered, request, context, answer);
    if (answer.refused.empty()) answer.refused = why_not_that_job(ordered, request);
    answer.wanted = ordered.jobs.size();
    if (answer.refused.empty()) answer.refused = why_not_any_cell(ordered, request, person, context);
    if (!answer.refused.empty()) return answer;
    const std::optional<std::string> to = request.to ? request.to : cell.link.to;
    const std::optional<std::filesystem::path> drop = request.drop ? request.drop : cell.link.drop;
    if (!to)
        throw InputError(InputFault::use, "no cell address is known",
                         Sentence::with_key("give_address", {}, "give its address"));
    if (!drop && !request.chunks) {
        throw InputError(InputFault::use, "no drop folder is known",
                         Sentence::with_key("give_drop_folder", {}, "give it, or send the files over the link"));
    }
    ModbusTcpBus bus(parse_tcp_address(*to));
    if (!request.chunks) check_drop_folder(*drop, cell, *to, context);
    const Status status = contact(bus, *to, cell, context);
    if (const std::string apart = clock_difference(status.cell_time_ms, unix_ms()); !apart.empty()) context.warn(apart);
    DispatchOptions options = options_of(request, cell, status);
    options.address = *to;
    if (!request.chunks) options.drop_folder = *drop;
    answer.refused = why_not_this_cell(request, options.want_simulated, *to);
    if (!answer.refused.empty()) return answer;
    if (options.want_simulated) {
        context.message("the cell at " + *to + " is SIMULATED: nothing moves");
        for (const std::string& sentence : simulated_only_jobs(ordered)) {
            context.warn(sentence + "; a real cell would not get it");
        }
    } else {
        answer.refused = why_not_real_cell(ordered, request, *to, person);
        if (!answer.refused.empty()) return answer;
    }
    answer.is_simulated = options.want_simulated;
    answer.handed = dispatch_with_journal(ordered.jobs, bus, options, context);
    return answer;
}

}  // namespace qchopper

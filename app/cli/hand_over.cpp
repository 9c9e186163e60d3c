#include "app/cli/hand_over.h"
#include "base/text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/cli/ordered_job.h"
#include "app/project/project.h"
#include "app/report/columns.h"
#include "app/report/shell_word.h"
#include "cam/job/job_file.h"

namespace qchopper {
namespace {

std::string hex(const Uuid& id) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < id.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += digits[id[i] >> 4];
        text += digits[id[i] & 15];
    }
    return text;
}

std::string ending(const JobOutcome& outcome) {
    return outcome.is_complete() ? "Ended, complete" : outcome.why;
}

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
    return PieceJob{order.piece, std::move(bytes), ticket};
}

}  // namespace

ProjectJobs jobs_of(const std::filesystem::path& folder, const std::optional<std::string>& piece) {
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
        } else if (piece) {  // prepare said which pieces do not fit, and only one of them was asked for
            throw InputError(InputFault::missing, "piece " + *piece + " has no job",
                             "prepare told why: it does not fit");
        }
    }
    if (found.jobs.empty()) {
        throw InputError(piece ? InputFault::use : InputFault::missing,
                         piece ? "there is no piece " + *piece + " in " + folder.string()
                               : folder.string() + " holds no job that fits",
                         "look at the table that prepare printed");
    }
    return found;
}

std::vector<HandedOver> hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                                  Terminal& terminal) {
    std::vector<HandedOver> handed;
    for (const PieceJob& job : jobs) {
        terminal.say("piece " + job.piece + ": " + job.ticket.file_name + ", " + with_commas(job.ticket.file_size) +
                     " bytes");
        handed.push_back({job.piece, dispatch_job(bus, job.ticket, job.file, options, terminal.context())});
        if (!handed.back().outcome.is_complete()) break;
        // What an error in the next job has to say of those before it.
        terminal.unchanged =
            "The " + std::to_string(handed.size()) + " jobs before it ended complete; it was not started.";
    }
    return handed;
}

int report(const std::vector<HandedOver>& handed, std::size_t wanted, const std::string& schema, bool simulated,
           Terminal& terminal) {
    std::vector<std::vector<std::string>> rows{{"piece", "job", "start", "STARTS", "end", "s"}};
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bool is_complete = handed.size() == wanted;
    bool is_cancelled = false;
    for (const auto& [piece, o] : handed) {
        is_complete = is_complete && o.is_complete();
        is_cancelled = is_cancelled || o.cancelled;
        rows.push_back({piece, hex(o.job_id), words(o.verdict), o.starts_known ? std::to_string(o.starts) : "?",
                        ending(o), fixed(o.took_s, 1)});
        list.push_back({{"piece", piece},
                        {"job_id", hex(o.job_id)},
                        {"verdict", words(o.verdict)},
                        {"job_state", static_cast<int>(o.job_state)},
                        {"job_result", static_cast<int>(o.job_result)},
                        {"ended_complete", o.is_complete()},
                        {"starts", o.starts_known ? nlohmann::ordered_json(o.starts) : nlohmann::ordered_json()},
                        {"elapsed_s", o.elapsed_s},
                        {"why", o.why},
                        {"to_do", o.to_do},
                        {"log", o.log}});
    }
    for (const std::string& line : columns(rows)) terminal.show(line);
    const std::string cell = simulated ? "the simulated cell" : "the cell";
    terminal.show(is_complete ? "all " + std::to_string(wanted) + " jobs ended complete on " + cell
                              : std::to_string(handed.size()) + " of " + std::to_string(wanted) +
                                    " jobs were handed to " + cell + "; not all ended complete");
    terminal.json(nlohmann::ordered_json{
        {"schema", schema},
        {"simulated", simulated},
        {"jobs_wanted", wanted},
        {"all_complete", is_complete},
        {"jobs",
         list}}.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    if (is_cancelled) return Terminal::cancel_code();
    return is_complete ? exit_done : exit_demand_broken;
}

}  // namespace qchopper

#include "cli/hand_over.h"
#include "cam/job/text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cam/job/job.h"
#include "cli/columns.h"
#include "cli/exit_code.h"
#include "cli/shell_word.h"
#include "segment/search/project.h"

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

}  // namespace

std::vector<PieceJob> jobs_of(const std::filesystem::path& folder, const std::optional<std::string>& piece) {
    const Project project = load_project(folder);
    if (project.stage != Stage::done) {
        throw InputError(InputFault::use, folder.string() + " is not finished",
                         "finish it first: qchopper prepare " + shell_word(folder));
    }
    std::vector<PieceJob> jobs;
    for (const SolidRecord& record : project.pieces) {
        if (piece && record.name != *piece) continue;
        const std::filesystem::path file = folder / "jobs" / job_file_name(record.name);
        if (!std::filesystem::exists(file)) {
            if (!piece) continue;  // a piece that does not fit has no job; prepare said so
            throw InputError(InputFault::missing, "piece " + *piece + " has no job",
                             "prepare told why: it does not fit");
        }
        jobs.push_back({record.name, file, job_ticket(file)});
    }
    if (jobs.empty()) {
        throw InputError(piece ? InputFault::use : InputFault::missing,
                         piece ? "there is no piece " + *piece + " in " + folder.string()
                               : folder.string() + " holds no job that fits",
                         "look at the table that prepare printed");
    }
    return jobs;
}

std::vector<HandedOver> hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
                                  Terminal& terminal) {
    std::vector<HandedOver> handed;
    for (const PieceJob& job : jobs) {
        terminal.say("piece " + job.piece + ": " + job.file.filename().string() + ", " +
                     with_commas(job.ticket.file_size) + " bytes");
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

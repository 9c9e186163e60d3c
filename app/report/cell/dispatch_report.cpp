// Text and JSON from a value.

#include "app/report/cell/dispatch_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/command_line_text.h"
#include "app/report/report_json.h"
#include "base/text.h"
#include "base/uuid.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::string ending(const JobOutcome& outcome) {
    return outcome.is_complete() ? "Ended, complete" : outcome.why;
}

Json job_json(const DispatchedJob& handed) {
    const JobOutcome& o = handed.outcome;
    Json json{{"piece", handed.piece},
              {"job_id", to_text(o.job_id)},
              {"start_outcome", describe(o.start_outcome)},
              {"is_ordered", handed.is_ordered},
              {"carved_before", o.milled_before},
              {"may_be_carved", o.may_be_milled},
              {"store_is_lost", o.store_is_lost},
              {"job_state", static_cast<int>(o.job_state)},
              {"job_result", static_cast<int>(o.job_result)},
              {"ended_complete", o.is_complete()},
              {"starts", o.starts_known ? Json(o.starts) : Json()},
              {"elapsed_s", o.elapsed_s},
              {"why", o.why}};
    add_to_do(json, o.to_do, o.to_do.text);
    json["log"] = o.log;
    return json;
}

Json restart_json(const MadeRestart& restart) {
    return {{"job_file", restart.job},
            {"of_sha256", to_hex(restart.of)},
            {"ordered_chunk", restart.ordered_chunk},
            {"from_chunk", restart.from_chunk},
            {"chunk_file", restart.chunk_file}};
}

// Of those that are wanted so many ended complete before, and were passed over now.
std::size_t milled_before(const DispatchReport& report) {
    return static_cast<std::size_t>(std::count_if(
        report.handed.begin(), report.handed.end(),
        [](const DispatchedJob& h) { return h.is_ordered && h.outcome.milled_complete && !h.outcome.is_complete(); }));
}

std::string summary(const DispatchReport& report) {
    const std::string cell = report.is_simulated ? "the simulated cell" : "the cell";
    const std::size_t before = milled_before(report);
    if (report.is_complete() && before == report.wanted) {
        return "nothing was started: " + counted(before, "job") + " ended complete on " + cell +
               " before. Pass --again to carve once more";
    }
    if (report.is_complete()) {
        return "all " + std::to_string(report.wanted) + " jobs ended complete on " + cell +
               (before > 0 ? ", " + std::to_string(before) + " of them before" : "");
    }
    std::size_t tried = 0;
    std::size_t complete = 0;
    for (const DispatchedJob& handed : report.handed) {
        if (!handed.is_ordered) continue;
        ++tried;
        complete += handed.outcome.is_complete() || handed.outcome.milled_complete ? 1 : 0;
    }
    std::string text =
        std::to_string(complete) + " of " + std::to_string(report.wanted) + " jobs ended complete on " + cell;
    if (tried < report.wanted) text += "; not tried: " + std::to_string(report.wanted - tried);
    return text;
}

}  // namespace

bool DispatchReport::is_complete() const {
    std::size_t ordered = 0;
    for (const DispatchedJob& h : handed) {
        if (!h.outcome.is_complete() && !h.outcome.milled_complete) return false;
        ordered += h.is_ordered ? 1 : 0;
    }
    return ordered == wanted && refused.empty();
}

bool DispatchReport::is_cancelled() const {
    return std::any_of(handed.begin(), handed.end(), [](const DispatchedJob& h) { return h.outcome.cancelled; });
}

std::vector<std::string> lines(const DispatchReport& report) {
    std::vector<std::vector<std::string>> rows{{"piece", "job", "start", "STARTS", "end", "s"}};
    for (const auto& [piece, o, is_ordered] : report.handed) {
        rows.push_back({is_ordered ? piece : piece + " (earlier)", o.job_id == Uuid{} ? "-" : to_text(o.job_id),
                        describe(o.start_outcome), o.starts_known ? std::to_string(o.starts) : "?", ending(o),
                        fixed(o.took_s, 1)});
    }
    std::vector<std::string> text = columns(rows);
    for (const DispatchedJob& handed : report.handed) {
        const JobOutcome& o = handed.outcome;
        const bool is_well = o.is_complete() || (o.milled_complete && report.is_complete());
        if (!o.to_do.empty() && !is_well)
            text.push_back("to do for " + handed.piece + ": " + command_line_text(o.to_do));
    }
    text.push_back(summary(report));
    if (report.is_complete() && !report.next.empty()) text.push_back("Next: " + command_line_text(report.next));
    return text;
}

Document document(const DispatchReport& report, const std::string& schema) {
    Json jobs = Json::array();
    for (const DispatchedJob& handed : report.handed) jobs.push_back(job_json(handed));
    Json json = {{"schema", schema},
                 {"simulated", report.is_simulated},
                 {"jobs_wanted", report.wanted},
                 {"all_complete", report.is_complete()},
                 {"jobs", jobs}};
    if (report.restart && !report.restart->job.empty()) json["restart"] = restart_json(*report.restart);
    if (!report.refused.empty()) {
        json["refused"] = list_of(report.refused, [](const Sentence& why) { return Json(why.text); });
    }
    return compose(json);
}

}  // namespace qchopper

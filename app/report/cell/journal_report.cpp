// Text and JSON from a value.

#include "app/report/cell/journal_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/uuid.h"
#include "devices/hand_off/journal_history.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

// A job in words for programs.
struct JournalJobReport {
    JournalJob job;
    WireTicket ticket;

    std::string state() const {
        if (job.has_ended) return "ended";
        if (job.is_settled || job.start_outcome == StartOutcome::unknown) return "unknown";
        return job.is_open() ? "open" : "not_started";
    }
};

template <class V, Of<JournalJobReport> T>
void fields(V& v, T& report) {
    const JournalJob& job = report.job;
    const auto time = [](std::uint64_t ms) { return ms == 0 ? std::optional<std::uint64_t>() : ms; };
    v.written("job_id", [&] { return to_text(job.job_id); });
    v.written("sha256", [&] { return to_hex(job.file_sha256); });
    v.written("file", [&] { return printable(report.ticket.file_name); });
    v.written("part", [&] { return report.ticket.part; });
    v.written("parts", [&] { return report.ticket.parts; });
    v.written("created_ms", [&] { return job.created_ms; });
    v.written("started_ms", [&] { return time(job.started_ms); });
    v.written("ended_ms", [&] { return time(job.ended_ms); });
    v.written("state", [&] { return report.state(); });
    v.written("result",
              [&] { return job.has_ended ? std::optional<std::string>(name(job.job_result)) : std::nullopt; });
}

using Json = nlohmann::ordered_json;

std::string job_text(const JournalEvent& event) {
    return event.job_id == Uuid{} ? "-" : to_text(event.job_id).substr(0, 8);
}

std::size_t open_jobs(const JournalReport& report) {
    std::size_t open = 0;
    for (const JournalJob& job : history_of(report.content.rows).jobs) open += job.is_open() ? 1 : 0;
    return open;
}

std::string verdict_line(const JournalReport& report) {
    return "the chain is whole: " + std::to_string(report.content.rows.size()) + " rows, " +
           std::to_string(history_of(report.content.rows).jobs.size()) + " jobs, " + std::to_string(open_jobs(report)) +
           " of them open; last hash " + report.content.hash.substr(0, 16);
}

std::vector<JournalJobReport> jobs_of(const JournalReport& report) {
    std::vector<JournalJobReport> jobs;
    for (const JournalJob& job : history_of(report.content.rows).jobs) {
        jobs.push_back({job, decode<WireTicket>(job.ticket).value});
    }
    return jobs;
}

Json row_json(const JournalRow& row) {
    return {{"number", row.number},
            {"unix_ms", row.unix_ms},
            {"kind", name(row.event.kind)},
            {"job_id", row.event.job_id == Uuid{} ? Json() : Json(to_text(row.event.job_id))},
            {"data", text_of(row.event)},
            {"meaning", describe(row.event)}};
}

}  // namespace

std::vector<std::string> lines(const std::vector<JournalReport>& reports) {
    std::vector<std::string> text;
    for (const JournalReport& report : reports) {
        text.push_back("journal of " + to_text(report.content.cell) + ", " + report.folder);
        if (report.shows) {
            std::vector<std::vector<std::string>> rows{{"row", "UTC", "job", "event", ""}};
            for (const JournalRow& row : report.content.rows) {
                rows.push_back({std::to_string(row.number), utc_text(row.unix_ms), job_text(row.event),
                                name(row.event.kind), describe(row.event)});
            }
            for (std::string& line : columns(rows)) text.push_back(std::move(line));
        }
        text.push_back(verdict_line(report));
    }
    if (reports.empty()) text.emplace_back("there is no journal yet; the first dispatch to a cell makes one");
    return text;
}

Document document(const std::vector<JournalReport>& reports) {
    Json journals = Json::array();
    for (const JournalReport& report : reports) {
        Json one = {{"folder", report.folder},
                    {"cell_id", report.content.cell.cell_id},
                    {"simulated", report.content.cell.simulated},
                    {"endpoint", printable(report.content.cell.endpoint)},
                    {"is_whole", true},
                    {"hash", report.content.hash},
                    {"row_count", report.content.rows.size()},
                    {"open_jobs", open_jobs(report)}};
        json_values::JsonWriter writer(one);
        writer("jobs", jobs_of(report));
        if (report.shows) {
            one["rows"] = Json::array();
            for (const JournalRow& row : report.content.rows) one["rows"].push_back(row_json(row));
        }
        journals.push_back(std::move(one));
    }
    return compose(Json{{"schema", "qchopper-journal-1"}, {"journals", journals}});
}

}  // namespace qchopper

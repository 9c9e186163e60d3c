// Text and JSON from a value.

#include "app/report/cell/journal_report.h"

#include <nlohmann/json.hpp>

#include "app/report/cell/journal_jobs.h"
#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/uuid.h"
#include "devices/hand_off/journal_history.h"

namespace qchopper {

template <class V, Of<ExportedRows> T>
void fields(V& v, T& report) {
    const bool is_some = report.head.number != 0;
    v.written("schema", [] { return "qchopper-journal-export-1"; });
    v("journal", report.journal);
    v.written("out", [&] { return is_some ? std::optional(report.out) : std::nullopt; });
    v.written("exported_rows", [&] { return report.head.number; });
    v.written("hash", [&] { return is_some ? std::optional(report.head.hash) : std::nullopt; });
    v("jobs", report.jobs);
    v("why_not_more", report.why_not_more);
}

namespace {

using Json = nlohmann::ordered_json;

std::string job_text(const JournalEvent& event) {
    return event.job_id == Uuid{} ? "-" : to_text(event.job_id).substr(0, 8);
}

std::size_t open_jobs(const JournalReport& report) {
    std::size_t open = 0;
    for (const JournalJob& job : history_of(report.content.rows).jobs) open += job.is_open() ? 1 : 0;
    return open;
}

std::string exported_text(const JournalContent& content) {
    if (content.head.number == 0) return {};
    return "; the rows up to " + std::to_string(content.head.number) + " were exported, the last with the hash " +
           content.head.hash.substr(0, 16);
}

std::string verdict_line(const JournalReport& report) {
    return "the chain is whole: " + std::to_string(report.content.rows.size()) + " rows, " +
           std::to_string(history_of(report.content.rows).jobs.size()) + " jobs, " + std::to_string(open_jobs(report)) +
           " of them open; last hash " + report.content.hash.substr(0, 16) + exported_text(report.content);
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

std::vector<std::string> lines(const ExportedRows& report) {
    std::vector<std::string> text;
    if (report.head.number == 0) {
        text.push_back("nothing was exported from " + report.journal);
    } else {
        text.push_back("the rows up to " + std::to_string(report.head.number) + ", of " +
                       counted(report.jobs, "closed job") + ", were exported to " + report.out + " and removed from " +
                       report.journal);
        text.push_back("the chain goes on from the hash " + report.head.hash);
    }
    if (!report.why_not_more.empty()) text.push_back(report.why_not_more);
    return text;
}

Document document(const ExportedRows& report) {
    return compose(json_of<ExportedRows, Json>(report));
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
        writer("jobs", jobs_of(report.content));
        if (report.content.head.number != 0) one["exported_rows"] = report.content.head.number;
        if (report.shows) {
            one["rows"] = Json::array();
            for (const JournalRow& row : report.content.rows) one["rows"].push_back(row_json(row));
        }
        journals.push_back(std::move(one));
    }
    return compose(Json{{"schema", "qchopper-journal-1"}, {"journals", journals}});
}

}  // namespace qchopper

// What was carved: the jobs of journals, as a table, as CSV and for programs, with sums by order. O(rows).
//
// An order is what has one PROJECT_ID in its tickets: the jobs of one project, however often they were handed over.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/report/document.h"
#include "app/report/report_json.h"
#include "base/printable.h"
#include "devices/hand_off/journal_history.h"
#include "devices/wire/blocks.h"

namespace qchopper {

struct JournalJobReport {
    JournalCell cell;
    JournalJob job;
    WireTicket ticket;

    // "ended", "open", "not_started", "unknown".
    std::string state() const;
    // How it ended, in words: "complete", "NOT STARTED", "power loss".
    std::string end() const;
    // Seconds between start and end; nothing if one of them is not known.
    std::optional<double> took_s() const;
    std::string order() const;  // PROJECT_ID
    // The latest of created, started and ended.
    std::uint64_t last_ms() const;
};

// The register map has no field for who consented at the panel.
constexpr const char* unknown_person = "unknown";

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
    v.written("end", [&] { return report.end(); });
    v.written("took_s", [&] { return report.took_s(); });
    v.written("order", [&] { return report.order(); });
    v.written("piece_number", [&] { return report.ticket.piece_no; });
    v.written("piece_count", [&] { return report.ticket.piece_count; });
    v.written("cell_id", [&] { return report.cell.cell_id; });
    v.written("simulated", [&] { return report.cell.simulated; });
    v.written("endpoint", [&] { return printable(report.cell.endpoint); });
    v.written("consent_by", [&] { return unknown_person; });
    v.written("exported", [&] { return job.is_exported; });
}

// The jobs of one journal, the oldest first.
std::vector<JournalJobReport> jobs_of(const JournalContent& content);

// The jobs of several journals by the time they were made, each once: of one that a journal has as exported and another
// with its rows, the latter. Those whose last event is before since_ms are left out.
std::vector<JournalJobReport> jobs_of(const std::vector<JournalContent>& journals, std::uint64_t since_ms);

// With sums by order. The CSV has a line for each job, without sums, its head first.
std::vector<std::string> job_lines(const std::vector<JournalJobReport>& jobs);
std::vector<std::string> job_csv(const std::vector<JournalJobReport>& jobs);
Document job_document(const std::vector<JournalJobReport>& jobs);

}  // namespace qchopper

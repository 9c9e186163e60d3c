// Text, CSV and JSON from a value; the CSV takes its columns from the keys of the JSON.

#include "app/report/cell/journal_jobs.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/report/columns.h"
#include "base/text.h"
#include "devices/wire/codec.h"

namespace qchopper {

using Json = nlohmann::ordered_json;

namespace {

struct OrderSum {
    std::string order;
    std::size_t jobs = 0;
    std::size_t complete = 0;
    std::size_t pieces_complete = 0;
    std::uint16_t piece_count = 0;
    double took_s = 0;
    std::size_t without_time = 0;      // jobs that started, and whose duration is not known
    std::set<std::uint16_t> pieces{};  // numbers of the complete ones
};

template <class V, Of<OrderSum> T>
void fields(V& v, T& sum) {
    v("order", sum.order);
    v("jobs", sum.jobs);
    v("complete", sum.complete);
    v("pieces_complete", sum.pieces_complete);
    v("piece_count", sum.piece_count);
    v("took_s", sum.took_s);
    v("without_time", sum.without_time);
}

struct JobsDocument {
    std::vector<JournalJobReport> jobs;
    std::vector<OrderSum> orders;
};

template <class V, Of<JobsDocument> T>
void fields(V& v, T& document) {
    v.written("schema", [] { return "qchopper-journal-jobs-1"; });
    v("jobs", document.jobs);
    v("orders", document.orders);
}

// In the order in which the orders first appear.
std::vector<OrderSum> sums_by_order(const std::vector<JournalJobReport>& jobs) {
    std::vector<OrderSum> sums;
    std::map<std::string, std::size_t> places;
    for (const JournalJobReport& report : jobs) {
        const auto [place, is_new] = places.try_emplace(report.order(), sums.size());
        if (is_new) sums.push_back({report.order()});
        OrderSum& sum = sums[place->second];
        ++sum.jobs;
        sum.piece_count = std::max(sum.piece_count, report.ticket.piece_count);
        sum.took_s += report.took_s().value_or(0);
        if (report.job.may_have_started() && !report.took_s()) ++sum.without_time;
        if (!report.job.is_complete()) continue;
        ++sum.complete;
        // Of a piece in parts the last part completes it.
        if (report.ticket.part == report.ticket.parts) sum.pieces.insert(report.ticket.piece_no);
        sum.pieces_complete = sum.pieces.size();
    }
    return sums;
}

std::string took_text(const std::optional<double>& took_s) {
    return took_s ? duration(static_cast<std::uint32_t>(*took_s)) : "unknown";
}

std::string cell_text(const JournalCell& cell) {
    return std::to_string(cell.cell_id) + (cell.simulated ? " simulated" : "");
}

std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string csv_value(const Json& value) {
    if (value.is_null()) return {};
    return quoted(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

std::string JournalJobReport::state() const {
    if (job.has_ended) return "ended";
    if (job.is_settled || job.start_outcome == StartOutcome::unknown) return "unknown";
    return job.is_open() ? "open" : "not_started";
}

std::string JournalJobReport::end() const {
    if (job.has_ended) return name(job.job_result);
    const std::string now = state();
    if (now == "unknown") return describe(StartOutcome::unknown);
    if (now == "not_started") return describe(StartOutcome::not_started);
    return job.is_started ? "open: the cell has started it" : "open: no end is known";
}

std::optional<double> JournalJobReport::took_s() const {
    if (job.started_ms == 0 || job.ended_ms < job.started_ms) return std::nullopt;
    return static_cast<double>(job.ended_ms - job.started_ms) / 1000;
}

std::string JournalJobReport::order() const {
    return to_text(ticket.project_id);
}

std::uint64_t JournalJobReport::last_ms() const {
    return std::max({job.created_ms, job.started_ms, job.ended_ms});
}

std::vector<JournalJobReport> jobs_of(const JournalContent& content) {
    std::vector<JournalJobReport> jobs;
    for (const JournalJob& job : history_of(content.rows).jobs) {
        jobs.push_back({content.cell, job, decode<WireTicket>(job.ticket).value});
    }
    return jobs;
}

std::vector<JournalJobReport> jobs_of(const std::vector<JournalContent>& journals, std::uint64_t since_ms) {
    std::map<Uuid, JournalJobReport> by_id;
    for (const JournalContent& content : journals) {
        for (JournalJobReport& report : jobs_of(content)) {
            if (report.last_ms() < since_ms && !report.job.is_open()) continue;
            const auto [known, is_new] = by_id.try_emplace(report.job.job_id, report);
            if (!is_new && known->second.job.is_exported) known->second = std::move(report);
        }
    }
    std::vector<JournalJobReport> jobs;
    jobs.reserve(by_id.size());
    for (auto& [id, report] : by_id) jobs.push_back(std::move(report));
    std::ranges::stable_sort(jobs, {}, [](const JournalJobReport& report) { return report.job.created_ms; });
    return jobs;
}

std::vector<std::string> job_lines(const std::vector<JournalJobReport>& jobs) {
    if (jobs.empty()) return {"no job"};
    std::vector<std::vector<std::string>> table{
        {"made, UTC", "cell", "job", "file", "order", "consent by", "took", "how it ended"}};
    for (const JournalJobReport& report : jobs) {
        table.push_back({utc_text(report.job.created_ms), cell_text(report.cell),
                         to_text(report.job.job_id).substr(0, 8), printable(report.ticket.file_name),
                         report.order().substr(0, 8), unknown_person, took_text(report.took_s()), report.end()});
    }
    std::vector<std::string> lines = columns(table);
    lines.emplace_back();
    table = {{"order", "jobs", "complete", "pieces", "carved for"}};
    for (const OrderSum& sum : sums_by_order(jobs)) {
        const std::string more =
            sum.without_time == 0 ? "" : ", and " + counted(sum.without_time, "started job") + " of unknown duration";
        table.push_back({sum.order.substr(0, 8), std::to_string(sum.jobs), std::to_string(sum.complete),
                         std::to_string(sum.pieces_complete) + " of " + std::to_string(sum.piece_count),
                         took_text(sum.took_s) + more});
    }
    for (std::string& line : columns(table)) lines.push_back(std::move(line));
    return lines;
}

std::vector<std::string> job_csv(const std::vector<JournalJobReport>& jobs) {
    const Json names = json_of<JournalJobReport, Json>({});  // kept: items() refers to it
    std::string head;
    for (const auto& [key, value] : names.items()) head += (head.empty() ? "" : ",") + key;
    std::vector<std::string> lines{head};
    for (const JournalJobReport& report : jobs) {
        const Json job = json_of<JournalJobReport, Json>(report);
        std::string line;
        for (const auto& [key, value] : job.items()) line += (key == "job_id" ? "" : ",") + csv_value(value);
        lines.push_back(std::move(line));
    }
    return lines;
}

Document job_document(const std::vector<JournalJobReport>& jobs) {
    return compose(json_of<JobsDocument, Json>({jobs, sums_by_order(jobs)}));
}

}  // namespace qchopper

// Text and JSON from a value.

#include "app/report/cell/cell_control_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/command_line_text.h"
#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/uuid.h"
#include "devices/hand_off/operator_text.h"
#include "devices/wire/program_block.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> flags_of(const Status& status) {
    std::vector<std::string> set;
    const std::span<const char* const> names = flag_names();
    for (std::size_t bit = 0; bit < names.size(); ++bit) {
        if ((status.flags >> bit & 1U) != 0) set.emplace_back(names[bit]);
    }
    return set;
}

std::string owner_text(const Status& status) {
    return status.owner_held == 0 ? "no dispatcher" : dispatcher_name(status.owner_held);
}

bool is_executed(const Status& status) {
    return has_started(status.job_state) && !is_over(status.job_state);
}

std::string job_text(const Status& status) {
    if (status.job_id == Uuid{}) return "none";
    return to_text(status.job_id) + " " + name(status.job_state) + " (" + name(status.job_result) + "), " +
           fixed(status.progress / 100.0, 1) + " %, " + std::to_string(status.elapsed_s) + " s" +
           (is_executed(status) ? ", " + program_place(status) : std::string());
}

std::string store_text(const CellStatusReport& report) {
    if (!report.store) return "its IDENTITY cannot be read";
    return to_text(report.store->store_id);
}

std::string memory_text(const CellStatusReport& report) {
    if (!report.store_loss.empty()) return "CELL_STORE_LOST: " + report.store_loss;
    return report.has_journal ? "the one that the journal knows" : "no journal of this cell here";
}

// Lengths in mm.
Json executed_json(const Status& status) {
    if (!is_executed(status)) return {};
    return {{"block_no", status.block_no},
            {"program_chunk", chunk_of_block(status.block_no)},
            {"program_line", line_of_block(status.block_no)},
            {"tool_in_spindle", status.tool_no},
            {"tip_mm", {status.tip[0] / 100.0, status.tip[1] / 100.0, status.tip[2] / 100.0}},
            {"remaining_s", status.remaining_s == Status::unknown_s ? Json() : Json(status.remaining_s)}};
}

Json store_json(const CellStatusReport& report) {
    if (!report.store) return {};
    return {{"store_id", to_text(report.store->store_id)},
            {"boot_count", report.store->boot_count},
            {"epoch_held", report.store->epoch_held},
            {"starts_total", report.store->starts_total}};
}

}  // namespace

std::vector<std::string> lines(const CellStatusReport& report) {
    const Status& s = report.status;
    std::string flags;
    for (const std::string& flag : flags_of(s)) flags += (flags.empty() ? "" : ", ") + flag;
    std::vector<std::vector<std::string>> rows{
        {"cell", std::to_string(s.cell_id) + (s.has(flag::simulated) ? " (SIMULATED)" : "") + " at " + report.endpoint},
        {"state", std::string(name(s.state)) + (s.has(flag::local_control) ? ", under local control" : "")},
        {"foam", std::string(foam_in(s.state)) + (s.has(flag::simulated) ? " (SIMULATED: nothing moves)" : "")},
        {"flags", flags.empty() ? "none" : flags},
        {"lease", owner_text(s) + ", EPOCH_HELD " + std::to_string(s.epoch_held)},
        {"job", job_text(s)},
        {"starts",
         std::to_string(s.starts_total) + " since its memory was made, BOOT_COUNT " + std::to_string(s.boot_count)},
        {"STORE_ID", store_text(report)},
        {"memory", memory_text(report)}};
    if (s.alarms > 0) {
        rows.push_back({"alarms", std::to_string(s.alarms) + ", first " + std::to_string(s.alarm_code) + " " +
                                      printable(s.alarm_text)});
    }
    return columns(rows);
}

Document document(const CellStatusReport& report) {
    const Status& s = report.status;
    return compose(Json{{"schema", "qchopper-cell-status-1"},
                        {"endpoint", report.endpoint},
                        {"cell_id", s.cell_id},
                        {"simulated", s.has(flag::simulated)},
                        {"state", name(s.state)},
                        {"flags", flags_of(s)},
                        {"local_control", s.has(flag::local_control)},
                        {"owner_held", s.owner_held},
                        {"epoch_held", s.epoch_held},
                        {"job_id", s.job_id == Uuid{} ? Json() : Json(to_text(s.job_id))},
                        {"job_state", name(s.job_state)},
                        {"job_result", name(s.job_result)},
                        {"progress", s.progress / 10000.0},
                        {"elapsed_s", s.elapsed_s},
                        {"executed", executed_json(s)},
                        {"alarms", s.alarms},
                        {"alarm_text", printable(s.alarm_text)},
                        {"store", store_json(report)},
                        {"has_journal", report.has_journal},
                        {"store_lost", report.store_loss.empty() ? Json() : Json(report.store_loss)}});
}

std::vector<std::string> lines(const CellControlReport& report) {
    std::vector<std::string> text{report.action + ": " + report.why +
                                  (report.simulated ? " (the cell is SIMULATED)" : "")};
    if (!report.state.empty()) text.push_back("the cell is in " + report.state);
    if (!report.note.empty()) text.push_back(command_line_text(report.note));
    if (!report.to_do.empty()) text.push_back("to do: " + command_line_text(report.to_do));
    return text;
}

Document document(const CellControlReport& report) {
    Json json{{"schema", "qchopper-cell-command-1"},
              {"endpoint", report.endpoint},
              {"action", report.action},
              {"end", report.end},
              {"result", report.result.empty() ? Json() : Json(report.result)},
              {"why", printable(report.why)},
              {"note", report.note.empty() ? Json() : Json(report.note.text)}};
    add_to_do(json, report.to_do, report.to_do.empty() ? std::nullopt : std::optional(report.to_do.text));
    json["simulated"] = report.simulated;
    json["state"] = report.state.empty() ? Json() : Json(report.state);
    return compose(std::move(json));
}

}  // namespace qchopper

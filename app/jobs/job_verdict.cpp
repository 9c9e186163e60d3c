// JSON of one object. O(findings).

#include "app/jobs/job_verdict.h"

#include <cassert>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json.h"

namespace qchopper {

using namespace json_values;

namespace {

constexpr const char* format_name = "qchopper verdict";
constexpr std::uint32_t schema = 2;

Json from_figure(const ProofFigure& figure) {
    return {{"key", figure.key},
            {"name", figure.name},
            {"value", figure.value},
            {"unit", figure.unit},
            {"decimals", figure.decimals}};
}

ProofFigure to_figure(const Json& json) {
    constexpr int max_decimals = 9;
    return {json_values::text(json, "key"), json_values::text(json, "name"), real(json, "value"),
            json_values::text(json, "unit"), static_cast<int>(whole_up_to(json, "decimals", max_decimals))};
}

Json from_finding(const VerdictFinding& finding) {
    return {{"kind", finding.kind}, {"file", finding.file}, {"line", finding.line}, {"text", finding.text}};
}

VerdictFinding to_finding(const Json& json) {
    return {json_values::text(json, "kind"), json_values::text(json, "file"), whole<std::uint32_t>(json, "line"),
            json_values::text(json, "text")};
}

JobVerdict to_verdict(const Json& json) {
    if (json_values::text(json, "format") != format_name) throw wrong("format", "is not a qchopper verdict");
    if (whole<std::uint32_t>(json, "schema") != schema) throw wrong("schema", "is not 2");
    JobVerdict verdict;
    verdict.piece = json_values::text(json, "piece");
    const Json& job = member(json, "job");
    verdict.job = json_values::text(job, "name");
    verdict.job_sha256 = {from_hex<32>(job, "sha256")};
    const Json& cell = member(json, "cell");
    verdict.cell = json_values::text(cell, "name");
    verdict.cell_sha256 = {from_hex<32>(cell, "sha256")};
    verdict.program_version = json_values::text(member(json, "program"), "version");
    verdict.is_positive = truth(json, "positive");
    for (const Json& figure : items(json, "figures")) verdict.figures.push_back(to_figure(figure));
    for (const Json& finding : items(json, "findings")) verdict.findings.push_back(to_finding(finding));
    verdict.notes = texts(json, "notes");
    verdict.findings_left_out = whole<std::uint32_t>(json, "findings_left_out");
    if (verdict.is_positive && !verdict.findings.empty()) throw wrong("positive", "contradicts the findings");
    return verdict;
}

}  // namespace

std::string describe(const VerdictFinding& finding) {
    if (finding.file.empty()) return finding.text;
    if (finding.line == 0) return finding.file + ": " + finding.text;
    return finding.file + " line " + std::to_string(finding.line) + ": " + finding.text;
}

std::string to_json(const JobVerdict& verdict) {
    assert(verdict.findings.size() <= max_listed_findings);
    Json figures = Json::array();
    for (const ProofFigure& figure : verdict.figures) figures.push_back(from_figure(figure));
    Json findings = Json::array();
    for (const VerdictFinding& finding : verdict.findings) findings.push_back(from_finding(finding));
    return written({{"format", format_name},
                    {"schema", schema},
                    {"piece", verdict.piece},
                    {"job", {{"name", verdict.job}, {"sha256", to_hex(verdict.job_sha256)}}},
                    {"cell", {{"name", verdict.cell}, {"sha256", to_hex(verdict.cell_sha256)}}},
                    {"program", {{"name", "qchopper"}, {"version", verdict.program_version}}},
                    {"positive", verdict.is_positive},
                    {"figures", figures},
                    {"findings", findings},
                    {"findings_left_out", verdict.findings_left_out},
                    {"notes", verdict.notes}});
}

JobVerdict job_verdict_from_json(std::string_view text, const std::string& source) {
    try {
        const Json json = parsed(text);
        JobVerdict verdict = to_verdict(json);
        check_form(json, text);
        return verdict;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + " is not a verdict: " + error.what(),
                         "make it again with qchopper verify");
    }
}

std::filesystem::path verdict_file(const std::filesystem::path& job) {
    std::filesystem::path file = job;
    return file.replace_extension(".verdict.json");
}

void write_verdict(const std::filesystem::path& job, const JobVerdict& verdict) {
    write_file(verdict_file(job), to_json(verdict));
}

std::optional<JobVerdict> read_verdict(const std::filesystem::path& job) {
    const std::filesystem::path file = verdict_file(job);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return std::nullopt;
    const Bytes bytes = read_file(file, record_limit);
    return job_verdict_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace qchopper

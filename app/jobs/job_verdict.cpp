// One table per object of the JSON. O(findings).

#include "app/jobs/job_verdict.h"

#include <cassert>

#include "app/jobs/time_fields.h"
#include "app/jobs/verdict_schema.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/json_fields.h"
#include "base/json_schema.h"

namespace qchopper {

using namespace json_values;

template <class V, Of<ProofFigure> T>
void fields(V& v, T& figure) {
    constexpr int max_decimals = 9;
    v("key", figure.key);
    v("name", figure.name);
    v("value", figure.value);
    v("unit", figure.unit);
    v("decimals", figure.decimals);
    v.check(figure.decimals >= 0 && figure.decimals <= max_decimals, "decimals", "is not a whole number in bounds");
}

template <class V, Of<ProofFinding> T>
void fields(V& v, T& finding) {
    v("kind", finding.kind);
    v("file", finding.file);
    v("line", finding.line);
    v("text", finding.text);
}

template <class V, Of<JobVerdict> T>
void fields(V& v, T& verdict) {
    v.constant("format", "qchopper verdict", "is not a qchopper verdict");
    v.version("schema", 3);
    v("piece", verdict.piece);
    v.object("job", [&](auto& job) {
        job("name", verdict.job);
        job("sha256", verdict.job_sha256);
    });
    v.object("cell", [&](auto& cell) {
        cell("name", verdict.cell);
        cell("sha256", verdict.cell_sha256);
    });
    v.object("program", [&](auto& program) {
        program.constant("name", "qchopper", "is not qchopper");
        program("version", verdict.program_version);
    });
    v("positive", verdict.is_positive);
    v("figures", verdict.figures);
    v("time", verdict.time);
    v("findings", verdict.findings);
    v("findings_left_out", verdict.findings_left_out);
    v("notes", verdict.notes);
    v.check(!verdict.is_positive || verdict.findings.empty(), "positive", "contradicts the findings");
}

std::string to_json(const JobVerdict& verdict) {
    assert(verdict.findings.size() <= max_listed_findings);
    return to_document(verdict);
}

std::string verdict_schema() {
    return schema_of_document<JobVerdict>("verdict of qchopper on a job");
}

JobVerdict job_verdict_from_json(std::string_view text, const std::string& source) {
    try {
        JobVerdict verdict;
        from_document(text, verdict);
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

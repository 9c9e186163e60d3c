// Text and JSON from values.

#include "app/report/verify_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/program_report.h"
#include "app/report/report_json.h"
#include "app/report/time_report.h"
#include "base/text.h"

namespace qchopper {

template <class V, Of<WrittenView> T>
void fields(V& v, T& view) {
    v("file", view.file);
    v("path_tolerance_mm", view.path_tolerance);
    v("surface_shift_mm", view.surface_shift);
}

template <class V, Of<EnteredBase> T>
void fields(V& v, T& base) {
    v("shift_mm", base.shift);
    v("abc_deg", base.abc_deg);
}

template <class V, Of<BaseDifference> T>
void fields(V& v, T& base) {
    v("entered", base.entered);
    v("planned", base.planned);
    v("off_mm", base.shift);
    v("off_deg", base.turn_deg);
}

template <class V, Of<LengthDifference> T>
void fields(V& v, T& length) {
    v("tool", length.tool);
    v("entered_mm", length.entered);
    v("planned_mm", length.planned);
}

template <class V, Of<EnteredDifference> T>
void fields(V& v, T& difference) {
    v("base", difference.base);
    v("lengths", difference.lengths);
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_shown = 5;  // findings of a job, for people

std::string figure_word(const ProofFigure& figure) {
    return figure.name + " " + fixed(figure.value, figure.decimals) + (figure.unit.empty() ? "" : " " + figure.unit);
}

// The figures that people look at first: "gouge 0.08 mm, 99.81 % within tolerance, 96.2 % reachable".
std::string figures_word(const JobVerdict& verdict) {
    std::string words;
    for (const ProofFigure& figure : verdict.figures) words += (words.empty() ? "" : ", ") + figure_word(figure);
    return words;
}

Json finding_json(const ProofFinding& finding) {
    return {{"kind", finding.kind}, {"file", finding.file}, {"line", finding.line}, {"text", finding.text}};
}

Json job_json(const VerifiedJob& job) {
    const JobVerdict& v = job.verdict;
    Json json{{"piece", v.piece},
              {"job", job.file.string()},
              {"sha256", to_hex(v.job_sha256)},
              {"cell", v.cell},
              {"cell_sha256", to_hex(v.cell_sha256)},
              {"positive", v.is_positive},
              {"figures", figures_json(v)},
              {"findings", list_of(v.findings, finding_json)},
              {"findings_left_out", v.findings_left_out},
              {"notes", v.notes},
              {"signature_fault", job.signature_fault}};
    if (!job.entered) json["verdict"] = verdict_file(job.file).string();
    if (job.entered) json["entered_values"] = json_of(*job.entered);
    if (job.view) {
        json["view"] = json_of(*job.view);
    }
    add_time(json, v.time);
    return json;
}

void add_findings(const JobVerdict& verdict, std::vector<std::string>& text) {
    const std::size_t shown = std::min(max_shown, verdict.findings.size());
    for (std::size_t i = 0; i < shown; ++i) text.push_back("  " + describe(verdict.findings[i]));
    const std::size_t more = verdict.findings.size() - shown + verdict.findings_left_out;
    if (more > 0) text.push_back("  and " + counted(more, "more finding"));
}

std::string view_line(const WrittenView& view) {
    std::string text = view.file.string() + ": path and surface for a viewer of GLB";
    if (view.path_tolerance > 0) text += ", the path within " + significant(view.path_tolerance, 2) + " mm";
    if (view.surface_shift > 0)
        text += ", points of the surface moved by up to " + significant(view.surface_shift, 2) + " mm";
    return text + ".";
}

// "base X 1000.00 Y 2.50 Z 310.00 A 0.000 B 0.000 C 0.000, 15.00 mm and 0.500 degrees from the planned one".
std::string base_word(const BaseDifference& base) {
    const EnteredBase& own = base.entered;
    return "base X " + fixed(own.shift.x, 2) + " Y " + fixed(own.shift.y, 2) + " Z " + fixed(own.shift.z, 2) + " A " +
           fixed(own.abc_deg.x, 3) + " B " + fixed(own.abc_deg.y, 3) + " C " + fixed(own.abc_deg.z, 3) + ", " +
           fixed(base.shift, 2) + " mm and " + fixed(base.turn_deg, 3) + " degrees from the planned one";
}

// "tool 1 of 151.50 mm, 1.50 mm longer than planned".
std::string length_word(const LengthDifference& length) {
    const double off = length.entered - length.planned;
    return "tool " + std::to_string(length.tool) + " of " + fixed(length.entered, 2) + " mm, " +
           fixed(std::abs(off), 2) + " mm " + (off < 0 ? "shorter" : "longer") + " than planned";
}

std::string entered_line(const EnteredDifference& difference) {
    std::string words;
    if (difference.base) words = base_word(*difference.base);
    for (const LengthDifference& length : difference.lengths) {
        words += (words.empty() ? "" : "; ") + length_word(length);
    }
    return "Entered values: " + words + ".";
}

std::vector<MachineTime> times_of(const VerifyAnswer& answer) {
    std::vector<MachineTime> rows;
    for (const VerifiedJob& job : answer) rows.insert(rows.end(), job.verdict.time.begin(), job.verdict.time.end());
    return merged(rows);
}

}  // namespace

bool is_all_positive(const VerifyAnswer& answer) {
    return std::all_of(answer.begin(), answer.end(),
                       [](const VerifiedJob& job) { return job.verdict.is_positive && job.signature_fault.empty(); });
}

std::vector<std::string> lines(const VerifyAnswer& answer) {
    std::vector<std::string> text;
    for (const VerifiedJob& job : answer) {
        text.push_back("piece " + job.verdict.piece + " (" + job.verdict.job +
                       "): " + (job.verdict.is_positive ? "verified" : "REFUSED"));
        if (job.entered) text.push_back("  " + entered_line(*job.entered));
        if (!job.verdict.figures.empty()) text.push_back("  " + figures_word(job.verdict));
        add_findings(job.verdict, text);
        if (!job.signature_fault.empty()) text.push_back("  Signature REFUSED: " + job.signature_fault + ".");
        for (const std::string& note : job.verdict.notes) text.push_back("  Note: " + note + ".");
        if (job.view) text.push_back("  " + view_line(*job.view));
    }
    if (const std::string line = time_line(times_of(answer)); !line.empty()) text.push_back(line);
    const auto positive = static_cast<std::size_t>(
        std::count_if(answer.begin(), answer.end(), [](const VerifiedJob& job) { return job.verdict.is_positive; }));
    const bool is_entered =
        std::any_of(answer.begin(), answer.end(), [](const VerifiedJob& job) { return job.entered.has_value(); });
    text.push_back(std::to_string(positive) + " of " + counted(answer.size(), "job") + " verified" +
                   (is_entered ? " with the entered values; no file was written, the verdict beside it is as it was."
                               : "; the verdict of each is written beside it."));
    return text;
}

Document document(const VerifyAnswer& answer) {
    Json json{{"schema", "qchopper-verify-1"},
              {"all_positive", is_all_positive(answer)},
              {"jobs", list_of(answer, job_json)}};
    add_time(json, times_of(answer));
    return compose(json);
}

}  // namespace qchopper

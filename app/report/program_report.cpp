// Text and JSON from a value; nothing is computed but sums.

#include "app/report/program_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/report_json.h"
#include "app/report/time_report.h"
#include "base/enum_names.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {

constexpr EnumNames<ProgramOutcome, 3> outcome_names{
    {{ProgramOutcome::proven, "proven"}, {ProgramOutcome::refused, "refused"}, {ProgramOutcome::none, "none"}}};
constexpr auto names_of(ProgramOutcome) {
    return outcome_names;
}

template <class V, Of<SeenAttempt> T>
void fields(V& v, T& seen) {
    v("ended", seen.has_ended);
    v("age_s", seen.age_s);
    v("stage", seen.attempt.stage);
    v("because", seen.attempt.because);
    v("host", seen.attempt.host);
    v("process", seen.attempt.process);
}

template <class V, Of<UnmadePiece> T>
void fields(V& v, T& piece) {
    v("piece", piece.piece);
    v("failures", piece.failures);
    v("bytes", piece.bytes);
    v("last", piece.last);
}

template <class V, Of<WorkedPiece> T>
void fields(V& v, T& piece) {
    v("piece", piece.name);
    v("outcome", piece.outcome);
    v("kept", piece.was_kept);
    v("time_s", piece.time_s);
    v.maybe("no_program_because", piece.none_because);
}

namespace {

using Json = nlohmann::ordered_json;

std::size_t count_of(const WorkAnswer& answer, ProgramOutcome outcome) {
    return static_cast<std::size_t>(std::count_if(answer.pieces.begin(), answer.pieces.end(),
                                                  [&](const WorkedPiece& piece) { return piece.outcome == outcome; }));
}

// Of all parts of a program.
std::size_t drilled_holes(const PieceReport& piece) {
    double holes = 0;
    for (const JobVerdict& verdict : piece.verdicts) holes += verdict.figure("holes_drilled");
    return static_cast<std::size_t>(holes);
}

Json verdict_json(const JobVerdict& verdict) {
    Json json{{"job", verdict.job},
              {"positive", verdict.is_positive},
              {"figures", figures_json(verdict)},
              {"findings", verdict.findings.size() + verdict.findings_left_out},
              {"notes", verdict.notes}};
    add_time(json, verdict.time);
    return json;
}

// What the proof says against the program of a piece; empty: nothing.
std::string refusal_word(const PieceReport& piece, const std::filesystem::path& folder) {
    const auto refused = std::find_if(piece.verdicts.begin(), piece.verdicts.end(),
                                      [](const JobVerdict& verdict) { return !verdict.is_positive; });
    if (refused == piece.verdicts.end()) return {};
    const std::string why = refused->findings.empty() ? "nothing was carved" : describe(refused->findings.front());
    return "piece " + piece.name + ": its program is not proven: " + why + "; see qchopper verify " +
           shell_word(folder) + " --piece " + piece.name;
}

}  // namespace

std::string program_word(const PieceReport& piece) {
    if (piece.verdicts.empty()) return "-";
    std::string word = duration(static_cast<std::uint32_t>(piece.time_s));
    if (piece.verdicts.size() > 1) word += " in " + std::to_string(piece.verdicts.size()) + " parts";
    if (const std::size_t holes = drilled_holes(piece); holes > 0) word += ", " + counted(holes, "hole");
    return word + (piece.is_proven() ? ", verified" : ", REFUSED");
}

std::string worked_line(const WorkedPiece& piece) {
    const std::string begin = "piece " + piece.name + ": ";
    if (piece.outcome == ProgramOutcome::none) return begin + "no programs, " + piece.none_because;
    return begin + "programs " + outcome_names(piece.outcome) + ", " +
           duration(static_cast<std::uint32_t>(piece.time_s)) + (piece.was_kept ? ", kept from an earlier run" : "");
}

std::string unmade_line(const UnmadePiece& piece) {
    const std::string line = "piece " + piece.piece + ": ";
    if (!piece.last) return line + "not begun";
    const WorkAttempt& attempt = piece.last->attempt;
    const std::string failed = counted(piece.failures, "attempt");
    const std::string where = attempt.host + ", process " + std::to_string(attempt.process) + ", at " +
                              (attempt.stage.empty() ? "the beginning" : attempt.stage);
    if (!piece.last->has_ended) {
        return line + "at work on " + where + "; sign of life " + fixed(piece.last->age_s, 0) + " s ago" +
               (piece.failures > 0 ? "; before, " + failed + " failed" : "");
    }
    if (piece.failures == 0) return line + "its result is missing or damaged";
    return line + failed + " failed, the last on " + where +
           (attempt.because.empty() ? "" : " (" + attempt.because + ")") + ", " +
           fixed(static_cast<double>(piece.bytes) / 1e6, 0) + " MB of memory at most";
}

std::string refused_line(const WorkedPiece& piece) {
    return "piece " + piece.name + ": " + piece.none_because +
           "; it has to be cut again, or milled from fewer orientations";
}

std::string json_lines(const std::vector<UnmadePiece>& pieces) {
    std::string text;
    for (const UnmadePiece& piece : pieces) text += json_values::to_document(piece, -1);
    return text;
}

std::vector<std::string> lines(const WorkAnswer& answer) {
    std::vector<std::string> text;
    const std::string shard =
        "Shard " + std::to_string(answer.shard.number) + " of " + std::to_string(answer.shard.count) + ": ";
    text.push_back((answer.shard.count > 1 ? shard : std::string()) + std::to_string(answer.pieces.size()) + " of " +
                   std::to_string(answer.piece_count) + " pieces are made, " +
                   std::to_string(count_of(answer, ProgramOutcome::proven)) + " proven, " +
                   std::to_string(count_of(answer, ProgramOutcome::refused)) + " refused, " +
                   std::to_string(count_of(answer, ProgramOutcome::none)) + " without programs.");
    for (const UnmadePiece& piece : answer.unmade) text.push_back(unmade_line(piece));
    if (answer.spent_s > 0) {
        text.push_back("CPU time " + duration(static_cast<std::uint32_t>(answer.spent_s)) + " spent, " +
                       duration(static_cast<std::uint32_t>(answer.left_s)) + " left as estimated.");
    }
    if (!answer.folder.empty()) {
        const char* when = answer.pieces.size() < answer.piece_count ? "Next, when all are made" : "Next";
        text.push_back(std::string(when) + ": qchopper gather " + shell_word(answer.folder));
    }
    return text;
}

Document document(const WorkAnswer& answer) {
    Json json;
    json_values::JsonWriter writer(json);
    writer("schema", std::string("qchopper-work-1"));
    writer("project", answer.folder.string());
    writer("shard", answer.shard.number);
    writer("shards", answer.shard.count);
    writer("piece_count", answer.piece_count);
    writer("pieces", answer.pieces);
    writer("unmade", answer.unmade);
    writer("spent_s", answer.spent_s);
    writer("left_s", answer.left_s);
    return compose(json);
}

std::vector<std::string> program_warnings(const PieceReport& piece, const std::filesystem::path& folder) {
    std::vector<std::string> sentences;
    const std::string refusal = refusal_word(piece, folder);
    if (!refusal.empty()) sentences.push_back(refusal);
    if (piece.verdicts.empty()) return sentences;
    for (const std::string& note : piece.verdicts.back().notes)
        sentences.push_back("piece " + piece.name + ": " + note);
    return sentences;
}

Json figures_json(const ProofResult& proof) {
    Json figures = Json::object();
    for (const ProofFigure& figure : proof.figures) figures[figure.key] = figure.value;
    return figures;
}

Json program_json(const PieceReport& piece) {
    if (piece.verdicts.empty()) return {{"parts", 0}, {"no_program_because", piece.no_program_because}};
    return {{"parts", piece.verdicts.size()},
            {"proven", piece.is_proven()},
            {"time_s", piece.time_s},
            {"length_mm", piece.length_mm},
            {"verdicts", list_of(piece.verdicts, verdict_json)}};
}

}  // namespace qchopper

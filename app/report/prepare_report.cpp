// Text and JSON from a value; nothing is computed but sums.

#include "app/report/prepare_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/report/cell/machine_reachability_report.h"
#include "app/report/columns.h"
#include "app/report/command_line_text.h"
#include "app/report/joint_report.h"
#include "app/report/program_report.h"
#include "app/report/report_json.h"
#include "app/report/segment_report.h"
#include "app/report/setup_report.h"
#include "app/report/time_report.h"
#include "app/report/workholding_report.h"
#include "app/store/project_lines.h"
#include "base/printable.h"
#include "base/text.h"
#include "cam/job/job.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::string lengths(Vec3 v) {
    return fixed(v.x, 0) + " x " + fixed(v.y, 0) + " x " + fixed(v.z, 0);
}

Json cut_json(const Cut& cut) {
    return {{"number", cut.number},
            {"piece", cut.piece},
            {"normal", json_of(cut.chosen.plane.normal)},
            {"offset_mm", cut.chosen.plane.offset},
            {"terms", json_of(cut.chosen.terms)},
            {"pieces", cut.pieces},
            {"fragments", cut.fragments}};
}

Json advice_json(const AccessAdvice& a) {
    return {{"kind", to_word(a.fault)}, {"share", a.share}, {"remedies", a.remedies.text}};
}

// ": 3.01 % because of the holder (a longer tool ...), 0.53 % ...": the two largest parts.
std::string advice_words(const std::vector<AccessAdvice>& advice) {
    std::string words;
    for (std::size_t i = 0; i < std::min<std::size_t>(advice.size(), 2); ++i) {
        const AccessAdvice& a = advice[i];
        words +=
            (i == 0 ? ": " : ", ") + share_word(a.share) + " " + a.what + " (" + command_line_text(a.remedies) + ")";
    }
    return words;
}

// Why no job of a cell that takes programs has one, once for all pieces of the same reason.
std::vector<std::string> missing_programs(const PreparedProject& prepared) {
    std::vector<std::string> sentences;
    std::set<std::string> reasons;
    for (const PieceReport& p : prepared.pieces) {
        if (p.job.empty() || p.no_program_because.empty() || !reasons.insert(p.no_program_because).second) continue;
        sentences.push_back("piece " + p.name + " has no robot program: " + p.no_program_because +
                            "; its job goes to a simulated cell only");
    }
    return sentences;
}

// Of all jobs, those that were kept too.
std::vector<MachineTime> times_of(const PreparedProject& prepared) {
    std::vector<MachineTime> rows;
    for (const PieceReport& piece : prepared.pieces) {
        for (const JobVerdict& verdict : piece.verdicts)
            rows.insert(rows.end(), verdict.time.begin(), verdict.time.end());
    }
    return merged(rows);
}

const char* next_command(const PreparedProject& prepared) {
    const WrittenItems& items = prepared.items;
    if (items.count > 0) return items.kept < items.count ? "work" : "gather";
    return prepared.project.jobs.empty() ? "setup" : "dry-run";
}

// "2 jobs", or "3 jobs of 2 pieces" where the program of a piece has several parts.
std::string job_count(const PreparedProject& prepared) {
    const std::vector<WrittenJob>& jobs = prepared.project.jobs;
    const auto pieces = std::count_if(prepared.pieces.begin(), prepared.pieces.end(),
                                      [](const PieceReport& p) { return !p.job.empty(); });
    const std::string of_pieces = " of " + counted(static_cast<std::size_t>(pieces), "piece");
    return counted(std::size(jobs), "job") + (std::ssize(jobs) == pieces ? "" : of_pieces);
}

// "sawn": the saw alone makes it, and it has no job; "none": it has none because it does not fit.
const char* state_word(const PieceReport& piece, double max_unreachable) {
    if (piece.is_only_sawn) return "sawn";
    if (!piece.fits()) return "none";
    return is_unreachable(piece.piece_setup.setup(), max_unreachable) ? "unreachable" : "ready";
}

const char* fits_word(const PieceReport& piece) {
    if (piece.is_only_sawn) return "sawn";
    return piece.fits() ? "yes" : "no";
}

Json piece_json(const PieceReport& piece, const PreparedProject& of) {
    const Cell& cell = of.cell;
    const Setup& s = piece.piece_setup.setup();
    Json json{{"name", piece.name},
              {"faces", piece.faces},
              {"volume_mm3", piece.volume_mm3},
              {"box_mm", json_of(s.box.size())}};
    add_setup(json, s, cell);
    json.update({{"piece_state", state_word(piece, of.max_unreachable)}, {"fits", piece.piece_setup.fits()}});
    add_margins(json, piece.piece_setup.stock_fit);
    json.update({{"work_envelope", json_of(piece.piece_setup.machine_reachability)},
                 {"out_of_reach", list_of(piece.advice, advice_json)},
                 {"job", piece.job.empty() ? Json() : Json(piece.job.string())},
                 {"program", program_json(piece)}});
    return json;
}

// What saw and robot have to do, where blocks are sawn: areas of caps by how they are made.
std::string caps_line(const PreparedProject& prepared) {
    double base_mm2 = 0;
    double flush_mm2 = 0;
    double milled_mm2 = 0;
    double to_mill_mm2 = 0;
    double foam_mm3 = 0;
    std::size_t flush = 0;
    for (const PieceReport& piece : prepared.pieces) {
        const Setup& setup = piece.piece_setup.setup();
        base_mm2 += setup.base_mm2;
        flush += setup.flush_caps.size();
        for (const FlushCap& cap : setup.flush_caps) flush_mm2 += cap.area_mm2;
        milled_mm2 += setup.milled_caps_mm2;
        to_mill_mm2 += setup.access.area_mm2;
        const Vec3 size = setup.milled_box().size();
        foam_mm3 += std::max(0.0, size.x * size.y * size.z - piece.volume_mm3);
    }
    constexpr double m2 = 1e6;     // mm2
    constexpr double litre = 1e6;  // mm3
    return "Caps: bases of " + fixed(base_mm2 / m2, 2) + " m2 are parted, " + counted(flush, "flush cap") + " of " +
           fixed(flush_mm2 / m2, 2) + " m2 sawn, " + fixed(milled_mm2 / m2, 2) + " m2 milled; with the skin " +
           fixed(to_mill_mm2 / m2, 2) + " m2 are to mill, and " + fixed(foam_mm3 / litre, 0) + " l of foam to remove.";
}

}  // namespace

std::vector<std::string> warnings(const PreparedProject& prepared) {
    std::vector<std::string> text;
    for (const PieceReport& p : prepared.pieces) {
        if (p.is_only_sawn) continue;
        const double share = p.piece_setup.setup().access.unreachable_share();
        if (!p.fits()) {
            text.push_back((p.piece_setup.stock_fit.fits()
                                ? describe_reachability(p.name, p.piece_setup.machine_reachability)
                                : describe_stock_fit(p.name, p.piece_setup.stock_fit)) +
                           "; it gets no job");
        } else if (p.piece_setup.setup().access.exceeds(prepared.max_unreachable)) {
            text.push_back(out_of_reach_sentence(p.name, share, prepared.max_unreachable) + advice_words(p.advice) +
                           "; see qchopper setup " + shell_word(prepared.folder) + " --piece " + p.name +
                           ", or dispatch it with --accept-unreachable");
        }
        const std::optional<Workholding>& workholding = p.piece_setup.setup().workholding;
        if (workholding && !workholding->passes() && p.fits()) {
            text.push_back("piece " + p.name + " is not held safely: " + workholding_problem(*workholding) + "; " +
                           workholding_remedy(*workholding) + "; dispatch asks before it sends it");
        }
        for (const std::string& sentence : program_warnings(p, prepared.folder)) text.push_back(sentence);
    }
    if (prepared.has_programs()) {
        for (const std::string& sentence : missing_programs(prepared)) text.push_back(sentence);
    }
    return text;
}

std::vector<std::string> table(const PreparedProject& prepared) {
    std::vector<std::vector<std::string>> rows{{"piece", "faces", "volume", "box mm", "block", "base", "orientations",
                                                "unreachable", "foam", "depth mm", "workholding", "fits"}};
    for (const PieceReport& p : prepared.pieces) {
        const Setup& s = p.piece_setup.setup();
        const bool is_mapped = s.access.method == AccessMethod::mapped;
        rows.push_back({p.name, with_commas(p.faces), describe_volume(p.volume_mm3), lengths(s.box.size()),
                        prepared.cell.stock[s.block.stock].name, base_word(s),
                        std::to_string(s.access.orientations.size()), share_word(s.access.unreachable_share()),
                        is_mapped ? describe_volume(s.access.foam_mm3) : "-",
                        is_mapped ? fixed(s.access.foam_depth_mm, 0) : "-", workholding_word(s), fits_word(p)});
        if (prepared.cell.machine) rows.back().push_back(margin_word(p.piece_setup.machine_reachability));
        if (prepared.has_programs()) rows.back().push_back(program_word(p));
    }
    if (prepared.cell.machine) rows.front().emplace_back("tightest margin");
    if (prepared.has_programs()) rows.front().emplace_back("program");
    std::vector<std::string> lines = columns(rows);
    lines.emplace_back(
        "unreachable: of the surface without base and sawn caps, in the tool orientations of the setup; foam: what "
        "they leave, "
        "and "
        "its depth; workholding: whether table, foam and base hold the piece while it is carved.");
    if (const std::string note = arm_note(prepared.cell); !note.empty()) lines.push_back(note);
    if (is_any_sawn(prepared.cell) && !prepared.pieces.empty()) lines.push_back(caps_line(prepared));
    for (const std::string& line : joint_lines(prepared.joints)) lines.push_back(line);
    for (const std::string& line : scan_lines(prepared.project)) lines.push_back(line);
    if (const std::string line = fragments_line(prepared.project); !line.empty()) lines.push_back(line);
    for (const std::string& line : discarded_lines(prepared.project)) lines.push_back(line);
    if (prepared.project.review) {
        for (const std::string& line : review_lines(*prepared.project.review)) lines.push_back(line);
    }
    if (const std::string line = time_line(times_of(prepared)); !line.empty()) lines.push_back(line);
    const auto only_sawn = std::count_if(prepared.pieces.begin(), prepared.pieces.end(),
                                         [](const PieceReport& p) { return p.is_only_sawn; });
    const std::string folder = prepared.folder.string();
    if (only_sawn > 0) {
        lines.push_back(counted(static_cast<std::size_t>(only_sawn), "piece") +
                        " made by the saw alone, without a job: see " + folder + "/saw-list.html.");
    }
    const std::string pieces =
        counted(prepared.pieces.size(), "piece") + " by " + counted(prepared.project.cuts.size(), "cut");
    if (prepared.items.count == 0) {
        lines.push_back(pieces + ", " + job_count(prepared) + " in " + folder + "/jobs, pictures in " + folder +
                        "/pictures.");
    } else {
        const auto seconds = [](double s) { return duration(static_cast<std::uint32_t>(std::ceil(s))); };
        const std::size_t kept = prepared.items.kept;
        const std::string made = kept > 0 ? ", " + std::to_string(kept) + " of which are kept" : std::string();
        lines.push_back(pieces + "; programs of " + std::to_string(prepared.items.count) + " of them" + made +
                        ", from " + folder + "/work/items, take about " + seconds(prepared.items.all_s) +
                        " of one processor, the largest " + seconds(prepared.items.largest_s) + ".");
    }
    lines.push_back(std::string("Next: qchopper ") + next_command(prepared) + " " + shell_word(prepared.folder));
    return lines;
}

Document document(const PreparedProject& prepared) {
    const Project& p = prepared.project;
    const auto piece_in_cell = [&](const PieceReport& piece) { return piece_json(piece, prepared); };
    Json json{{"schema", prepare_schema},
              {"project", prepared.folder.string()},
              {"scan",
               {{"path", p.scan.path.string()},
                {"sha256", to_hex(p.scan.sha256)},
                {"units", name_of(p.scan.unit)},
                {"scale", p.scan.scale},
                {"faces", p.scan.faces},
                {"volume_mm3", p.scan.volume_mm3}}},
              {"stop_rules_hold", p.do_rules_hold()},
              {"ended_because", p.ended_because},
              {"all_fit", prepared.all_fit()},
              {"max_unreachable", prepared.max_unreachable},
              {"arm_checked", prepared.cell.machine.has_value()},
              {"cuts", list_of(p.cuts, cut_json)},
              {"reviews", json_of(p.review.value_or(SetupReview()).cuts)},
              {"pieces", list_of(prepared.pieces, piece_in_cell)},
              {"joints", joints_json(prepared.joints)},
              {assembly_key, assembly_json(prepared.joints)},
              {"fragments", json_of(p.fragment_list)},
              {"discarded", discarded_json(p)},
              {"warnings", p.warnings}};
    if (prepared.has_programs()) add_time(json, times_of(prepared));
    add_scan(json, p);
    return compose(json);
}

}  // namespace qchopper

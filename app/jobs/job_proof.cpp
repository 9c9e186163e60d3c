// The texts are read once and replayed once, with corners rounded as far as the controller may: gouge is measured for
// exact and rounded corners alike, and what stays in a corner is more where it is rounded. The cost is that of the
// replay.

#include "app/jobs/job_proof.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/jobs/entered/entered_replay.h"
#include "base/error.h"
#include "base/hex.h"
#include "base/text.h"
#include "cam/cell/job_tools.h"
#include "cam/job/job_program.h"
#include "sim/program/chunk_summary.h"
#include "sim/program/program_line.h"
#include "sim/replay/reach/reachable.h"
#include "sim/replay/replay.h"

namespace qchopper {
namespace {

constexpr double agreement = 1e-6;  // mm: of what the manifest says of a chunk with what is read
constexpr const char* manifest = "manifest.json";

void add(JobProof& proof, const std::string& kind, const std::string& file, std::size_t line, const std::string& text) {
    if (proof.findings.size() < max_listed_findings) {
        proof.findings.push_back({kind, file, line, text});
    } else {
        ++proof.findings_left_out;
    }
}

std::optional<ParsedProgram> read(const ProofInput& input, JobProof& proof) {
    try {
        return program_read_back(input);
    } catch (const LineRefused& refused) {
        add(proof, "not_readable", refused.file, refused.line, refused.why);
        return std::nullopt;
    }
}

bool is_near(Vec3 a, Vec3 b) {
    return norm(a - b) <= agreement;
}

bool is_same(const JobChunk& stated, const ChunkSummary& read) {
    return stated.file == read.file && stated.moves == read.moves && std::abs(stated.length_mm - read.length) <= 1e-3 &&
           is_near(stated.box.min, read.box.min) && is_near(stated.box.max, read.box.max) &&
           is_near(stated.first, read.first) && is_near(stated.last, read.last);
}

// Chunks as read, with tool and direction of those that are stated.
void compare_chunks(const ProofInput& input, const ParsedProgram& program, JobProof& proof) {
    const std::vector<ChunkSummary> read = summarise_chunks(program);
    const std::vector<JobChunk>& stated = input.program.chunks;
    if (read.size() != stated.size()) {
        add(proof, "other_chunks", "", 0,
            "the manifest lists " + counted(stated.size(), "chunk") + ", and the program calls " +
                std::to_string(read.size()));
        return;
    }
    for (std::size_t i = 0; i < read.size(); ++i) {
        if (input.is_stated && !is_same(stated[i], read[i])) {
            add(proof, "other_chunks", read[i].file, 0, "the manifest describes another chunk in its place");
        }
        proof.chunks.push_back({read[i].file, stated[i].tool, stated[i].orientation, read[i].moves, read[i].length,
                                read[i].box, read[i].first, read[i].last});
    }
}

// Finishing is held against the cell file's scallop height; a program that claims another one was made for other
// tolerances.
void check_scallop(const ProofInput& input, JobProof& proof) {
    const double expected = input.cell.machine->program.scallop;
    if (input.program.scallop_mm == expected) return;
    add(proof, "other_scallop", manifest, 0,
        "scallop_mm is " + significant(input.program.scallop_mm, 6) + ", expected: " + significant(expected, 6) +
            " of the cell file");
}

// Of what must be milled and of what is not: none before the last part, when the piece is not there yet.
std::vector<ProofFigure> surface_figures(const ReplayReport& report, bool leaves_tools_out) {
    const double percent = 100;
    const LeftoverFigures& left = report.leftover;
    const auto points = [&](double mm2) { return percent * ReplayReport::ratio(mm2, left.area_mm2); };
    std::vector<ProofFigure> figures{
        {"within_tolerance_percent", "within tolerance, of the reachable surface", percent * report.share_within(), "%",
         2},
        {"reachable_percent", "reachable surface", percent * report.share_reachable(), "%", 1},
        {"given_up_percent", "given up, of the surface, by tools and orientations left out",
         points(left.given_up_mm2()), "%", 2},
        {"given_up_cm2", "surface given up by them", left.given_up_mm2() / 100, "cm2", 1}};
    if (leaves_tools_out) {
        figures.push_back({"not_allowed_percent", "given up, of the surface, for tools that the setup leaves out",
                           points(left.not_allowed_mm2()), "%", 2});
        figures.push_back({"not_allowed_cm2", "surface given up for them", left.not_allowed_mm2() / 100, "cm2", 1});
    }
    figures.push_back({"median_leftover_mm", "median of the foam left on it, by area", left.median, "mm", 2});
    figures.push_back({"leftover_99_mm", "foam left on 99 % of it, at most", left.percentile_99, "mm", 2});
    figures.push_back({"max_leftover_mm", "largest leftover on the reachable surface", left.largest, "mm", 2});
    figures.push_back(
        {"leftover_cm3", "foam that stays around the piece", report.volumes.leftover_mm3 * 1e-3, "cm3", 1});
    return figures;
}

std::vector<ProofFigure> hole_figures(const HoleFigures& holes) {
    if (holes.due == 0) return {};
    return {{"holes_due", "holes to be drilled by this program", static_cast<double>(holes.due), "", 0},
            {"holes_drilled", "of them drilled as ordered", static_cast<double>(holes.drilled), "", 0},
            {"max_hole_offset_mm", "largest distance from the axis of a hole", holes.largest_offset, "mm", 3}};
}

std::vector<ProofFigure> figures_of(const ReplayReport& report, const ReplayScene& scene, const JobProgram& program,
                                    double cell) {
    const auto count = [&](FindingKind kind) {
        return static_cast<double>(report.counts[static_cast<std::size_t>(kind)]);
    };
    std::vector<ProofFigure> figures{{"max_gouge_mm", "largest gouge", report.largest_gouge, "mm", 3},
                                     {"gouge_cm3", "gouged volume", report.volumes.gouge_mm3 * 1e-3, "cm3", 3}};
    const auto append = [&](const std::vector<ProofFigure>& more) {
        figures.insert(figures.end(), more.begin(), more.end());
    };
    if (scene.is_last) append(surface_figures(report, !scene.tools.empty()));
    append({{"rapids_in_foam", "rapid moves in foam", count(FindingKind::rapid_in_foam), "", 0},
            {"holder_contacts", "contacts of the holder", count(FindingKind::holder_contact), "", 0},
            {"air_percent", "length at feed that removes nothing", 100 * report.share_air(), "%", 1},
            {"path_m", "path", report.time.line_mm / 1000, "m", 1},
            {"time_s", "time", report.time.seconds, "s", 0},
            {"cell_mm", "cells of the replay", cell, "mm", 2}});
    if (program.moves_left_out.length_mm > 0) {
        append({{"moves_left_out_mm", "cuts left out, which no arm posture reaches", program.moves_left_out.length_mm,
                 "mm", 0}});
    }
    append(hole_figures(report.milling.holes));
    return figures;
}

// That the manifest says of each ball-ended tool that may be used why it is not, where it is not.
void check_left_out(const ReplayScene& scene, const JobProgram& program, JobProof& proof) {
    const std::vector<CuttingTool>& tools = scene.cell->machine->tools;
    const auto is_stated = [&](std::uint16_t tool, std::size_t orientation) {
        return std::any_of(program.left_out.begin(), program.left_out.end(), [&](const ToolLeftOut& stated) {
            return stated.tool.value_or(tool) == tool && stated.orientation.value_or(orientation) == orientation;
        });
    };
    for (std::size_t d = 0; d < milling_orientations(scene); ++d) {
        const std::vector<std::size_t> used = tools_along(scene, d);
        for (const std::size_t tool : allowed_tools(scene)) {
            const std::uint16_t number = tools[tool].number;
            if (tools[tool].shape != ToolShape::ball || is_stated(number, d)) continue;
            if (std::find(used.begin(), used.end(), tool) != used.end()) continue;
            add(proof, "left_out", "", 0,
                "the program does not use tool " + std::to_string(number) + " in orientation " + std::to_string(d + 1) +
                    ", and the manifest does not say why");
        }
    }
}

// What the manifest says of the program that is no fault of it. That of each kind of tool one stick-out is used
// (tool_sets()) is none: no tool is given up for that.
std::vector<std::string> notes_of(const JobProgram& program, const std::vector<std::uint16_t>& allowed,
                                  const std::vector<CuttingTool>& tools) {
    std::vector<std::string> notes;
    const std::vector<std::vector<std::uint16_t>> sets = tool_sets(tools);
    if (!allowed.empty() && std::find(sets.begin(), sets.end(), allowed) == sets.end()) {
        notes.push_back("of the cell's tools it is carved with " + describe_tools(allowed) + " alone");
    }
    if (const std::string moves = describe(program.moves_left_out); !moves.empty()) notes.push_back(moves);
    if (program.restart) {
        notes.push_back("it goes on behind " + counted(program.restart->chunks_before, "chunk") +
                        " of the job file with the SHA-256 " + to_hex(program.restart->of) +
                        ": what they leave counts in all volumes and in the foam left, and how deep they cut stands "
                        "in the verdict on that job");
    }
    return notes;
}

void add_findings(const ParsedProgram& program, const ReplayReport& report, JobProof& proof) {
    for (const Finding& finding : report.findings) {
        const std::string file = finding.place.line > 0 ? program.files[finding.place.file] : std::string();
        add(proof, to_word(finding.kind), file, finding.place.line, finding.text);
    }
    std::size_t all = 0;
    for (const std::size_t count : report.counts) all += count;
    proof.findings_left_out += all - std::min(all, report.findings.size());
}

}  // namespace

JobProof prove(const ProofInput& input, const Context& context) {
    JobProof proof;
    proof.notes = notes_of(input.program, input.setup.tools, input.cell.machine->tools);
    if (input.program.dialect != input.cell.machine->program.dialect) {
        add(proof, "not_readable", manifest, 0,
            std::string("the program is in the dialect ") + to_word(input.program.dialect) +
                ", expected: " + to_word(input.cell.machine->program.dialect) + " of the cell file");
        return proof;
    }
    std::optional<ParsedProgram> program = read(input, proof);
    if (!program) return proof;
    compare_chunks(input, *program, proof);
    if (input.cell.machine) check_scallop(input, proof);
    if (proof.chunks.empty()) return proof;
    ReplayOptions options;
    options.cell = input.replay_cell;
    try {
        ReplayScene scene = scene_of(input);
        std::optional<Cell> cell_as_entered;
        if (input.entered != nullptr) {
            cell_as_entered = cell_with(*input.entered, input.cell);
            enter_in_program(*input.entered, input, *program);
            enter_in_scene(*input.entered, input, *cell_as_entered, scene);
        }
        const std::optional<StockRecord> before = stock_before(input);
        if (before) scene.before = &*before;
        const ReplayReport report = replay(*program, scene, options, context);
        proof.figures = figures_of(report, scene, input.program, options.cell);
        proof.time = report.account;
        if (scene.is_last) check_left_out(scene, input.program, proof);
        if (!scene.is_last) proof.stock_left = to_bytes(report.left);
        proof.deviation = report.deviation;
        proof.is_given_up = report.leftover.is_given_up;
        proof.time_s = report.time.seconds;
        proof.length_mm = report.time.line_mm;
        add_findings(*program, report, proof);
    } catch (const InputError& error) {
        add(proof, "not_replayable", "", 0, error.what());
    }
    return proof;
}

}  // namespace qchopper

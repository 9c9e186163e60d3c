// Text and JSON from a value; nothing is computed but shares.

#include "app/report/setup_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/cell/machine_reachability_report.h"
#include "app/report/columns.h"
#include "app/report/program_report.h"
#include "app/report/report_json.h"
#include "app/report/workholding_report.h"
#include "app/store/project_lines.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/job_tools.h"
#include "cam/job/setup_fields.h"

namespace qchopper {

template <class V, Of<SurfaceAreas> T>
void fields(V& v, T& areas) {
    v("reached", areas.reached);
    v("too_narrow", areas.too_narrow);
    v("steep", areas.steep);
    v("holder", areas.holder);
    v("hidden", areas.hidden);
    v("ignored", areas.ignored);
    v("sawn", areas.sawn);
    v("base", areas.base);
}

namespace {

using Json = nlohmann::ordered_json;

std::string of_area(double mm2, const SurfaceAccess& access) {
    return access.area_mm2 > 0 ? share_word(mm2 / access.area_mm2) : "-";
}

std::string size_word(Vec3 v) {
    return fixed(v.x, 0) + " x " + fixed(v.y, 0) + " x " + fixed(v.z, 0);
}

const std::vector<std::string> setup_columns{"base",       "unreachable", "hidden",   "steep",         "holder",
                                             "too narrow", "foam",        "depth mm", "rest material", "orientations",
                                             "block mm",   "workholding", "fits"};

// `is_held`: whether the machine holds all poses, as far as it was asked.
std::vector<std::string> row_of(const Setup& setup, const Cell& cell, bool is_held) {
    const SurfaceAccess& r = setup.access;
    const bool is_mapped = r.method == AccessMethod::mapped;
    const std::string mark = is_mapped ? "" : "~";
    return {base_word(setup),
            mark + share_word(r.unreachable_share()),
            of_area(r.hidden_mm2, r),
            of_area(r.steep_mm2, r),
            of_area(r.holder_mm2, r),
            of_area(r.too_narrow_mm2, r),
            is_mapped ? describe_volume(r.foam_mm3) : "-",
            is_mapped ? fixed(r.foam_depth_mm, 0) : "-",
            is_mapped ? describe_volume(r.rest_material_mm3) : "-",
            std::to_string(r.orientations.size()),
            size_word(setup.block.size),
            workholding_word(setup),
            check_stock_fit(setup, with_tools(cell, setup.tools)).fits() && is_held ? "yes" : "no"};
}

// Degrees from x towards y of the setup, of the tool axis.
double azimuth_deg(const Setup& setup, const ToolOrientation& orientation) {
    const Vec3 d = setup.tool_axis(orientation);
    return degrees(std::atan2(d.y, d.x));
}

std::string direction_line(const Setup& setup, const ToolOrientation& d) {
    return "tilt " + fixed(d.tilt_deg, 0) + ", azimuth " + fixed(azimuth_deg(setup, d), 0) + " degrees";
}

void add_directions(const Setup& setup, std::vector<std::string>& lines) {
    std::vector<std::vector<std::string>> rows{{"orientation", "tilt", "azimuth", "reaches more", "depth mm"}};
    for (std::size_t i = 0; i < setup.access.orientations.size(); ++i) {
        const ToolOrientation& d = setup.access.orientations[i];
        rows.push_back({std::to_string(i + 1), fixed(d.tilt_deg, 0), i == 0 ? "-" : fixed(azimuth_deg(setup, d), 0),
                        share_word(d.gained_share), fixed(d.depth_mm, 0)});
    }
    for (const std::string& line : columns(rows)) lines.push_back(line);
}

void add_piece(const PieceSetups& p, const SetupAnswer& answer, std::vector<std::string>& lines) {
    const Setup& chosen = p.piece_setup.setup();
    lines.push_back("Piece " + p.piece + " lies on " + base_word(chosen) +
                    (p.order && p.order->base ? " by decision" : "") + "; all ways to lay it, the one in force first:");
    std::vector<std::vector<std::string>> rows{setup_columns};
    for (const Setup& setup : p.piece_setup.choice.setups) {
        rows.push_back(row_of(setup, answer.cell, &setup != &chosen || p.piece_setup.machine_reachability.holds()));
    }
    for (const std::string& line : columns(rows)) lines.push_back(line);
    lines.emplace_back("Shares are of the area without base and sawn caps; ~ marks those judged on samples alone.");
    lines.emplace_back("Tool orientations of the setup in force, in degrees:");
    add_directions(chosen, lines);
    const SurfaceAccess& access = chosen.access;
    if (access.ignored_mm2 > 0) {
        lines.push_back("Beside that " + fixed(access.ignored_mm2 / 100, 1) + " cm2 of the piece are ignored.");
    }
    lines.push_back("With all directions that can be held " + share_word(access.all_directions_share) +
                    " stays out of reach.");
    if (access.further) {
        lines.push_back("One more orientation (" + direction_line(chosen, *access.further) + ") would reach " +
                        share_word(access.further->gained_share) + " more.");
    }
    if (!chosen.tools.empty()) {
        lines.push_back("Of the cell's tools it is carved with " + describe_tools(chosen.tools) + " alone.");
    }
    if (chosen.workholding) {
        for (const std::string& line : qchopper::lines(*chosen.workholding)) lines.push_back(line);
    }
    for (const std::string& warning : chosen.warnings) lines.push_back("Note: " + warning + ".");
    for (const std::string& line : qchopper::lines(p.piece, p.piece_setup.machine_reachability)) lines.push_back(line);
    if (!p.piece_setup.stock_fit.fits()) {
        lines.push_back(describe_stock_fit(p.piece, p.piece_setup.stock_fit) + ".");
        lines.push_back("To do: cut it, qchopper segment " + shell_word(answer.folder) + " --piece " + p.piece +
                        " --step, or enter a larger block in the cell file.");
    }
}

const char* side_word(bool is_above) {
    return is_above ? "above" : "below";
}

// "; its program: 3 h 20 min, verified"; empty without one.
std::string program_words(const PieceReport& job) {
    return job.verdicts.empty() ? std::string() : "; its program: " + program_word(job);
}

Json setup_json(const Setup& setup, const Cell& cell) {
    Json json;
    add_setup(json, setup, cell);
    const StockFit fit = check_stock_fit(setup, with_tools(cell, setup.tools));
    json.update({{"fits", fit.fits()}});
    add_margins(json, fit);
    json.update({{"sawn", setup.block.is_sawn},
                 {"offcuts_mm", json_of(setup.block.offcuts)},
                 {"undercut_by_count", setup.undercut_by_count},
                 {"tools", setup.tools.empty() ? Json() : Json(setup.tools)}});
    return json;
}

std::vector<std::string> after_piece(const std::string& piece, std::vector<std::string> row) {
    row.insert(row.begin(), piece);
    return row;
}

// Of several pieces: a row each, with the setup that is taken.
std::vector<std::string> setups_table(const std::vector<PieceSetups>& pieces, const Cell& cell) {
    std::vector<std::vector<std::string>> rows{after_piece("piece", setup_columns)};
    for (const PieceSetups& p : pieces) {
        rows.push_back(
            after_piece(p.piece, row_of(p.piece_setup.setup(), cell, p.piece_setup.machine_reachability.holds())));
    }
    return columns(rows);
}

Json setups_json(const PieceSetups& p, const Cell& cell) {
    Json ordered;
    if (p.order) {
        ordered = Json{{"base_number", json_of(p.order->base)},
                       {"max_directions", json_of(p.order->max_directions)},
                       {"tools", p.order->tools.empty() ? Json() : Json(p.order->tools)}};
    }
    return {
        {"name", p.piece},
        {"ordered", ordered},
        {"setups", list_of(p.piece_setup.choice.setups, [&](const Setup& setup) { return setup_json(setup, cell); })},
        {"work_envelope", json_of(p.piece_setup.machine_reachability)}};
}

Json json_in_cell(const Cell& cell, double max_unreachable, Json pieces) {
    return {{"cell", cell.name}, {"max_unreachable", max_unreachable}, {"pieces", std::move(pieces)}};
}

}  // namespace

void add_setup(nlohmann::ordered_json& json, const Setup& setup, const Cell& cell) {
    json_values::JsonWriter writer(json);
    base_fields(writer, setup);
    json.update({{"block", cell.stock[setup.block.stock].name},
                 {"block_mm", json_of(setup.block.size)},
                 {"undercut", setup.undercut},
                 {"workholding", workholding_json(setup)},
                 {"reach", json_of(setup.access)}});
}

void add_margins(nlohmann::ordered_json& json, const StockFit& fit) {
    Json margins;
    for (const Margin& m : fit.margins) margins[m.name] = m.mm;
    json["margins_mm"] = std::move(margins);
}

std::string base_word(const Setup& setup) {
    return (setup.base ? "cut " : "side ") + std::to_string(setup.base_number);
}

std::string share_word(double share) {
    return fixed(100 * share, 2) + " %";
}

std::string arm_note(const Cell& cell) {
    if (cell.machine) return {};
    return "Arm not checked: the cell file describes none; a tilt of up to 60 degrees is taken for "
           "possible.";
}

std::string out_of_reach_sentence(const std::string& piece, double share, double limit) {
    return "piece " + piece + ": " + share_word(share) + " of its surface is out of reach, more than " +
           share_word(limit);
}

std::vector<std::string> warnings(const SetupAnswer& answer) {
    std::vector<std::string> sentences;
    for (const PieceSetups& p : answer.pieces) {
        const SurfaceAccess& access = p.piece_setup.setup().access;
        if (!access.exceeds(answer.max_unreachable)) continue;
        const bool is_ordered = p.order && (p.order->base || p.order->max_directions);
        sentences.push_back(out_of_reach_sentence(p.piece, access.unreachable_share(), answer.max_unreachable) +
                            (is_ordered ? "; its setup was decided: qchopper setup " + shell_word(answer.folder) +
                                              " --piece " + p.piece + " --auto lets the program choose again"
                                        : std::string()));
    }
    return sentences;
}

std::vector<std::string> lines(const SetupAnswer& answer) {
    std::vector<std::string> text;
    if (!answer.done.empty()) text.push_back(answer.done);
    if (answer.pieces.size() == 1) {
        add_piece(answer.pieces.front(), answer, text);
    } else {
        for (const std::string& line : setups_table(answer.pieces, answer.cell)) text.push_back(line);
        text.emplace_back("Shares are of the area without base and sawn caps.");
    }
    if (answer.ignored) text.push_back(ignored_line(*answer.ignored) + "; it counts in no share.");
    if (const std::string note = arm_note(answer.cell); !note.empty()) text.push_back(note);
    const std::string word = shell_word(answer.folder);
    if (answer.is_job_written())
        text.push_back("The job of the piece is written again" + program_words(*answer.job) + ".");
    const std::string piece = answer.pieces.empty() ? "A" : answer.pieces.front().piece;
    text.push_back(answer.pieces.size() == 1 ? "Choose: qchopper setup " + word + " --piece " + piece +
                                                   " --base N --orientations N --tools N,...   or --auto"
                                             : "One piece: qchopper setup " + word + " --piece " + piece);
    return text;
}

std::vector<std::string> lines(const PlaneSetups& plane) {
    std::vector<PieceSetups> pieces;
    std::vector<std::vector<std::string>> rows{after_piece(
        "piece", {"reached", "too narrow", "steep", "holder", "hidden", "ignored", "sawn", "base", "side"})};
    for (const PlanePiece& p : plane.pieces) {
        pieces.push_back(p.setups);
        const SurfaceAreas& a = p.areas;
        std::vector<std::string> row;
        for (const double mm2 : {a.reached, a.too_narrow, a.steep, a.holder, a.hidden, a.ignored, a.sawn, a.base}) {
            row.push_back(fixed(mm2 / 100, 1));
        }
        row.emplace_back(side_word(p.is_above));
        rows.push_back(after_piece(p.piece.name, std::move(row)));
    }
    std::vector<std::string> text = setups_table(pieces, plane.cell);
    text.emplace_back(
        "Shares are of the area without base and sawn caps. Areas in cm2, as the setup sheet colours them:");
    for (std::string& line : columns(rows)) text.push_back(std::move(line));
    return text;
}

nlohmann::ordered_json plane_setups_json(const PlaneSetups& plane) {
    Json pieces = Json::array();
    for (const PlanePiece& p : plane.pieces) {
        pieces.push_back(setups_json(p.setups, plane.cell));
        json_values::JsonWriter writer(pieces.back());
        writer("side", side_word(p.is_above));
        writer("fits", p.setups.piece_setup.fits());
        writer("areas_mm2", p.areas);
    }
    return json_in_cell(plane.cell, plane.max_unreachable, std::move(pieces));
}

Document document(const SetupAnswer& answer) {
    Json pieces = Json::array();
    for (const PieceSetups& p : answer.pieces) pieces.push_back(setups_json(p, answer.cell));
    Json json{{"schema", "qchopper-setup-2"}, {"project", answer.folder.string()}};
    json.update(json_in_cell(answer.cell, answer.max_unreachable, std::move(pieces)));
    json["done"] = answer.done;
    json["job_written"] = answer.is_job_written();
    if (answer.is_job_written()) json["program"] = program_json(*answer.job);
    if (answer.ignored) json["ignored"] = json_of(*answer.ignored);
    return compose(std::move(json));
}

}  // namespace qchopper

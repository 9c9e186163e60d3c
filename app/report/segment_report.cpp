// Text and JSON from a value. Of a ranking only the best answer.proposal.top planes are listed.

#include "app/report/segment_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/command_line_text.h"
#include "app/report/objective_terms.h"
#include "app/report/report_json.h"
#include "app/report/setup_report.h"
#include "app/store/project_lines.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {

template <class V, Of<BorderPlane> T>
void fields(V& v, T& border) {
    fields(v, border.plane);
    v("border_mm", border.border_mm);
}

template <class V, Of<ShownRegions> T>
void fields(V& v, T& shown) {
    v("method", shown.method);
    v("regions", shown.regions);
    v("copy_faces", shown.copy_faces);
    v("planes", shown.planes.planes);
    v("straight_borders", shown.planes.straight);
    v("equal_planes", shown.planes.equal);
    v("planes_left_out", shown.planes.beyond);
    v("file", shown.file);
}

namespace {

using Json = nlohmann::ordered_json;

std::string describe(Vec3 v, int digits) {
    return fixed(v.x, digits) + " " + fixed(v.y, digits) + " " + fixed(v.z, digits);
}

std::string describe_weights(const Weights& w) {
    std::string text;
    for (const ObjectiveTerm& term : objective_terms(w))
        text += (text.empty() ? "" : ", ") + std::string(term.name) + " " + fixed(w.*term.weight, 3);
    return text;
}

bool is_fragment(const SolidEvaluation& solid, const Project& project) {
    return solid.volume_mm3 < project.settings.objectives.fragment_volume_mm3;
}

// For planes in which the piece runs through itself; a cut there has the same warning (cut_piece.cpp).
std::string sections_cross(const std::string& planes) {
    return "The sections of " + planes + " cross: the piece runs through itself there, and the caps would overlap.";
}

void add(std::vector<std::string>& text, const std::vector<std::string>& more) {
    text.insert(text.end(), more.begin(), more.end());
}

bool has_access(const Project& project) {
    return project.settings.objectives.weights.unreachable > 0;
}

std::string percent(double share) {
    return fixed(100 * share, 2) + " %";
}

std::string shown(const ObjectiveTerm& term, const Terms& values) {
    const double value = values.*term.value;
    return term.value == &Terms::unreachable ? percent(value) : fixed(value, term.digits);
}

// The project with the weights by which proposal and preview are ranked.
Project ranked_by(const SegmentAnswer& answer) {
    Project project = answer.project;
    if (answer.tried_weights) project.settings.objectives.weights = *answer.tried_weights;
    return project;
}

// "face_ratio=10,fragility=5", as --weights takes them: those that differ from others.
std::string weights_word(const Weights& weights, const Weights& others) {
    std::string word;
    for (const ObjectiveField& field : all_objectives) {
        if (weights.*field.weight == others.*field.weight) continue;
        word += (word.empty() ? "" : ",") + std::string(field.key) + "=" + significant(weights.*field.weight, 15);
    }
    return word;
}

std::vector<std::string> proposal_lines(const Proposal& p, const Project& project, const std::filesystem::path& folder,
                                        bool is_tried) {
    std::vector<std::string> text;
    text.push_back("Piece " + p.piece + ", " + with_commas(p.faces) +
                   " faces: " + describe_planes(p.candidates, project.settings) + ", best first." +
                   (p.rules_hold ? " The stop rules hold already; this is the piece with most faces." : ""));
    const Objectives& objectives = project.settings.objectives;
    const std::vector<ObjectiveTerm> terms = objective_terms(objectives.weights);
    std::vector<std::vector<std::string>> rows{{"K", "normal", "offset mm"}};
    for (const ObjectiveTerm& term : terms) rows.front().emplace_back(term.name);
    rows.front().emplace_back("total");
    for (std::size_t k = 0; k < p.listed.size(); ++k) {
        const Ranked& r = p.listed[k];
        rows.push_back({
            std::to_string(k + 1),
            describe(r.plane.normal, 4),
            fixed(r.plane.offset, 3),
        });
        for (const ObjectiveTerm& term : terms) rows.back().push_back(shown(term, r.terms));
        rows.back().push_back(fixed(r.terms.total, 4));
    }
    add(text, columns(rows));
    if (!p.listed.empty() && is_forbidden(p.listed.front().terms, objectives))
        text.emplace_back("Every plane has a forbidden value.");
    if (has_access(project)) {
        text.emplace_back("unreachable: of the scan's surface, over all pieces, once this plane has cut.");
    }
    std::string crossing;
    for (const std::size_t k : p.crossing) crossing += (crossing.empty() ? "K " : ", ") + std::to_string(k);
    if (!crossing.empty()) text.push_back(sections_cross(crossing));
    if (!p.listed.empty() && !is_tried) {
        text.push_back("Nothing was cut. Take one by: qchopper segment " + shell_word(folder) + " --piece " + p.piece +
                       " --accept K");
    }
    return text;
}

std::vector<std::string> preview_lines(const Preview& p, const Project& project) {
    std::vector<std::string> text;
    text.push_back("Plane " + describe(p.plane.plane.normal, 6) + ", " + fixed(p.plane.plane.offset, 3) +
                   " mm on piece " + p.piece + ": total " + fixed(p.plane.terms.total, 4));
    if (has_access(project)) {
        text.push_back("With it " + percent(p.plane.terms.unreachable) +
                       " of the scan's surface would be out of reach, over all pieces.");
    }
    text.push_back("Outline: " + with_commas(p.outline.loops.size()) +
                   (p.outline.loops.size() == 1 ? " loop, " : " loops, ") + fixed(p.outline.length_mm, 1) +
                   " mm long, within " + describe(p.outline.box.min, 1) + " to " + describe(p.outline.box.max, 1) +
                   " mm");
    std::vector<std::vector<std::string>> rows{{"would make", "side", "faces", "volume"}};
    for (const SolidEvaluation& s : p.solids) {
        rows.push_back({is_fragment(s, project) ? "fragment" : "piece", s.above ? "above" : "below",
                        with_commas(s.faces), describe_volume(s.volume_mm3)});
    }
    add(text, columns(rows));
    if (p.sections_cross) text.push_back(sections_cross("this plane"));
    if (p.setups) add(text, lines(*p.setups));
    text.push_back("Nothing was cut.");
    return text;
}

std::vector<std::string> piece_table(const SegmentAnswer& answer) {
    const Project& project = answer.project;
    const bool has_shares = answer.unreachable.size() == project.pieces.size() && !project.pieces.empty();
    std::vector<std::vector<std::string>> rows{{"piece", "made by", "faces", "volume"}};
    if (has_shares) rows.front().emplace_back("unreachable");
    for (std::size_t i = 0; i < project.pieces.size(); ++i) {
        const SolidRecord& p = project.pieces[i];
        rows.push_back({p.name, p.cut > 0 ? "cut " + std::to_string(p.cut) : "the scan", with_commas(p.faces),
                        describe_volume(p.volume_mm3)});
        if (has_shares) rows.back().push_back(answer.unreachable[i] ? percent(*answer.unreachable[i]) : "-");
    }
    std::vector<std::string> text = columns(rows);
    if (has_shares) {
        text.push_back("unreachable: of the surface without the base, along all directions within " +
                       significant(project.settings.objectives.tilt_deg, 4) +
                       " degrees, for a tool without radius. A setup has at most eight of them, and a real tool.");
    }
    return text;
}

std::vector<std::string> committed_lines(const SegmentAnswer& answer) {
    const Project& project = answer.project;
    std::vector<std::string> text = piece_table(answer);
    text.push_back(counted(project.pieces.size(), "piece") + " by " + counted(project.cuts.size(), "cut") + ", " +
                   counted(project.fragment_list.size(), "fragment") +
                   ". Weights: " + describe_weights(project.settings.objectives.weights) + ".");
    add(text, scan_lines(project));
    add(text, discarded_lines(project));
    for (const auto& [option, what] :
         {std::pair{"--undo", undo_text(project.history)}, {"--redo", redo_text(project.history)}})
        if (!what.empty()) text.push_back(std::string(option) + ": " + what);
    return text;
}

Json plane_json(const Ranked& r, const Project& project) {
    Json json{{"normal", json_of(r.plane.normal)},
              {"offset_mm", r.plane.offset},
              {"offset_in_scan_mm", r.plane.offset + height(r.plane.normal, project.scan.centre)},
              {"wanted_offset_mm", r.wanted_offset},
              {"normal_index", r.normal_index},
              {"offset_index", r.offset_index},
              {"terms", json_of(r.terms)}};
    if (r.coarse_sections > 0) json["coarse_sections"] = r.coarse_sections;
    return json;
}

Json proposal_json(const Proposal& p, const Project& project) {
    Json planes = Json::array();
    for (std::size_t k = 0; k < p.listed.size(); ++k) {
        Json plane{{"k", k + 1}};
        plane.update(plane_json(p.listed[k], project));
        plane["sections_cross"] = std::find(p.crossing.begin(), p.crossing.end(), k + 1) != p.crossing.end();
        planes.push_back(plane);
    }
    Json json{{"piece", p.piece},
              {"faces", p.faces},
              {"rules_hold", p.rules_hold},
              {"candidates", p.candidates},
              {"planes", planes}};
    if (const std::size_t judged = max_judged_planes(project.settings); judged > 0) json["max_judged_planes"] = judged;
    return json;
}

Json preview_json(const Preview& p, const Project& project) {
    Json solids = Json::array();
    for (const SolidEvaluation& s : p.solids) {
        solids.push_back({{"side", s.above ? "above" : "below"},
                          {"faces", s.faces},
                          {"volume_mm3", s.volume_mm3},
                          {"fragment", is_fragment(s, project)}});
    }
    Json json{{"piece", p.piece},
              {"plane", plane_json(p.plane, project)},
              {"sections_cross", p.sections_cross},
              {"loops", json_of(p.outline.loops)},
              {"length_mm", p.outline.length_mm},
              {"box_min_mm", json_of(p.outline.box.min)},
              {"box_max_mm", json_of(p.outline.box.max)},
              {"makes", solids}};
    if (p.setups) json["milled_pieces"] = plane_setups_json(*p.setups);
    return json;
}

Json cuts_json(const Project& project) {
    Json cuts = Json::array();
    for (const Cut& cut : project.cuts) {
        Json json{{"number", cut.number}, {"piece", cut.piece}};
        json.update(plane_json(cut.chosen, project));
        json["pieces"] = cut.pieces;
        json["fragments"] = cut.fragments;
        cuts.push_back(json);
    }
    return cuts;
}

Json stress_json(const StressedModel& stress) {
    const StructureReport& r = stress.report;
    const double voxel_mm3 = std::pow(stress.grid.size, 3);
    Json floating = Json::array();
    for (const FloatingSolid& solid : r.floating) {
        floating.push_back({{"volume_mm3", static_cast<double>(solid.voxels) * voxel_mm3},
                            {"centre_mm", json_of(solid.centre)},
                            {"hinged", solid.is_hinged}});
    }
    return {{"voxel_mm", stress.grid.size},
            {"unknowns", r.unknowns},
            {"iterations", r.iterations},
            {"residual", r.residual},
            {"largest_tension_mpa", r.largest_tension_mpa},
            {"largest_tension_at_mm", json_of(r.largest_tension_at)},
            {"standing_voxels", r.standing_voxels},
            {"thin_voxels", r.thin_voxels},
            {"hinges", r.hinges},
            {"floating", floating}};
}

Json text_or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

}  // namespace

Json discarded_json(const Project& project) {
    Json all = Json::array();
    for (std::size_t i = 0; i < project.discarded.size(); ++i) {
        const SolidRecord& solid = project.discarded[i];
        all.push_back({{"name", solid.name},
                       {"after", project.discards.at(i).after},
                       {"cut", solid.cut},
                       {"faces", solid.faces},
                       {"volume_mm3", solid.volume_mm3}});
    }
    return all;
}

std::vector<std::string> lines(const SegmentAnswer& answer) {
    if (!answer.is_project_made) return command_line_text(answer.notes);
    const Project& project = answer.project;
    std::vector<std::string> text;
    if (!answer.done.empty()) text.push_back(command_line_text(answer.done));
    add(text, command_line_text(answer.notes));
    if (answer.plan) {
        text.push_back(
            "Plan of " + std::to_string(project.cuts.size()) + " cuts" +
            (project.discards.empty() ? "" : " and " + std::to_string(project.discards.size()) + " discarded pieces") +
            ": " + answer.plan->string());
        add(text, discarded_lines(project));
    }
    if (answer.regions) {
        text.push_back(region_sentence(answer.regions->method, answer.regions->regions, answer.regions->planes));
        text.push_back("The regions are in " + answer.regions->file.string() + ". Nothing was cut.");
    }
    if (answer.pieces_written) text.push_back("The pieces are in " + (answer.folder / "pieces").string() + ".");
    const Project by_tried = ranked_by(answer);
    if (answer.proposal) {
        add(text, proposal_lines(*answer.proposal, by_tried, answer.folder, answer.tried_weights.has_value()));
    }
    if (answer.preview) add(text, preview_lines(*answer.preview, by_tried));
    if (answer.tried_weights) {
        const std::string word = weights_word(*answer.tried_weights, project.settings.objectives.weights);
        text.push_back("By the weights " + describe_weights(*answer.tried_weights) + ". Nothing was cut. " +
                       (word.empty() ? "They are in force already."
                                     : "They are not kept; keep them by: qchopper segment " +
                                           shell_word(answer.folder) + " --weights " + word));
    }
    if (!answer.proposal && !answer.preview && !answer.plan && !answer.regions) add(text, committed_lines(answer));
    return text;
}

Document document(const SegmentAnswer& answer) {
    const Project& project = answer.project;
    Json pieces = Json::array();
    for (std::size_t i = 0; i < project.pieces.size(); ++i) {
        const SolidRecord& p = project.pieces[i];
        pieces.push_back({{"name", p.name}, {"cut", p.cut}, {"faces", p.faces}, {"volume_mm3", p.volume_mm3}});
        // Along all directions that the tilt allows, not those of a setup.
        if (i < answer.unreachable.size() && answer.unreachable[i]) {
            pieces.back()["unreachable_all_directions"] = *answer.unreachable[i];
        }
    }
    Json json{{"schema", "qchopper-segment-3"},
              {"project", answer.folder.string()},
              {"done", text_or_null(answer.done.text)},
              {"demand_met", answer.is_demand_met},
              {"notes", list_of(answer.notes, [](const Sentence& note) { return Json(note.text); })},
              {"undo", text_or_null(undo_text(project.history))},
              {"redo", text_or_null(redo_text(project.history))},
              {"ended_because", text_or_null(project.ended_because)},
              {"weights", json_of(project.settings.objectives.weights)},
              {"cuts", cuts_json(project)},
              {"pieces", pieces},
              {"fragments", project.fragment_list.size()},
              {"discarded", discarded_json(project)},
              {"warnings", project.warnings}};
    add_scan(json, project);
    if (answer.stress) json["stress"] = stress_json(*answer.stress);
    if (answer.regions) json["found_regions"] = json_of(*answer.regions);
    if (answer.pieces_written) json["pieces_written"] = (answer.folder / "pieces").string();
    if (answer.plan) json["plan"] = answer.plan->string();
    if (answer.tried_weights) json["tried_weights"] = json_of(*answer.tried_weights);
    if (answer.proposal) json["proposal"] = proposal_json(*answer.proposal, ranked_by(answer));
    if (answer.preview) json["preview"] = preview_json(*answer.preview, ranked_by(answer));
    return compose(json);
}

}  // namespace qchopper

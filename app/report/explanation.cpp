// Text and JSON from a value; the planes are ranked already. O(candidates).

#include "app/report/explanation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/objective_terms.h"
#include "app/report/report_json.h"
#include "app/report/segment_report.h"
#include "app/store/project_lines.h"
#include "base/text.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

bool is_own(const Cut& cut) {
    return cut.chosen.normal_index == own_index;
}

// Whose plane it is, as a sentence begins.
std::string origin_of(const Cut& cut) {
    switch (cut.chosen.normal_index) {
        case own_index:
            return "The plane is the operator's own";
        case refined_index:
            return "The plane is a candidate that the search moved and turned a little";
        case symmetry_index:
            return "The plane is the symmetry plane of the scan";
        case refined_given_index:
            return "The plane is one of those given for all pieces, which the search moved and turned a little";
        case given_index:
            return "The plane is one of those given for all pieces";
        case mirror_index:
            return "The plane is the mirror image of another cut";
        default:
            return "The plane is a candidate of the search";
    }
}

// Where one plane is better or worse than another, in what is added to the total.
std::string differences(const Terms& a, const Terms& b, const Weights& weights) {
    std::string text;
    for (const ObjectiveTerm& term : objective_terms(weights)) {
        const double more = weights.*term.weight * (b.*term.value - a.*term.value);
        if (std::abs(more) < 0.0005) continue;
        text += (text.empty() ? "" : ", ") + std::string(term.name) + " " + (more > 0 ? "+" : "") + fixed(more, 3);
    }
    return text;
}

Json to_json(const Ranked& r) {
    return {{"normal", json_of(r.plane.normal)},
            {"offset_mm", r.plane.offset},
            {"normal_index", r.normal_index},
            {"offset_index", r.offset_index},
            {"terms", json_of(r.terms)}};
}

// Head and rows: the ten best, and the chosen plane if it is not among them, where its total puts it.
std::vector<std::vector<std::string>> table(const Explanation& e) {
    const Weights& w = e.objectives.weights;
    std::vector<std::vector<std::string>> rows{{"", "place", "normal", "offset mm", "total"}};
    for (const ObjectiveTerm& term : objective_terms(w)) {
        rows[0].push_back(std::string(term.name) + " x " + describe_weight(w.*term.weight));
    }
    const auto add = [&](const std::string& place, const Ranked& r, bool is_chosen) {
        std::vector<std::string> row{is_chosen ? "->" : "", place, in_brackets(r.plane.normal, 3),
                                     fixed(r.plane.offset, 3), fixed(r.terms.total, 4)};
        for (const ObjectiveTerm& term : objective_terms(w)) row.push_back(fixed(r.terms.*term.value, 4));
        rows.push_back(row);
    };
    bool is_shown = e.place && std::find(e.listed.begin(), e.listed.end(), *e.place) != e.listed.end();
    const auto add_chosen = [&] {
        add(e.place ? std::to_string(*e.place + 1) : is_own(e.cut) ? "own" : "-", e.chosen, true);
        is_shown = true;
    };
    for (const std::size_t i : e.listed) {
        if (!is_shown && e.chosen.terms.total < e.ranked[i].terms.total) add_chosen();
        add(std::to_string(i + 1), e.ranked[i], e.place == i);
    }
    if (!is_shown) add_chosen();
    return rows;
}

// "120", or "up to 10,560 planes, 248 of them evaluated whole".
std::string planes(const Explanation& e) {
    if (e.max_judged == 0) return std::to_string(e.ranked.size());
    return "up to " + with_commas(e.max_judged) + " planes, " + with_commas(e.ranked.size()) +
           " of them evaluated whole";
}

std::string percent(double share) {
    return fixed(100 * share, 2) + " %";
}

// What is true of the plane by reach alone, whatever the other terms say.
std::vector<std::string> opened_lines(const Explanation& e) {
    if (!e.opened) return {};
    const OpenedSurface& o = *e.opened;
    const bool opens = o.opened_share() >= 0;
    std::vector<std::string> text{
        "By reach: the plane " + std::string(opens ? "opens " : "hides ") + percent(std::abs(o.opened_share())) +
        " of the surface of piece " + e.cut.piece + " (" + percent(std::abs(o.before_mm2 - o.after_mm2) / o.scan_mm2) +
        " of the scan's): " + percent(o.before_mm2 / o.piece_mm2) + " of it was out of reach before the cut, " +
        percent(o.after_mm2 / o.piece_mm2) + " is after."};
    if (o.other_normals == 0) return text;
    const double more = o.opened_share() - o.best_other_share();
    text.push_back("Of " + with_commas(o.other_planes) + " planes along " + std::to_string(o.other_normals) +
                   " other normals the best opens " + percent(o.best_other_share()) + ", " + percent(std::abs(more)) +
                   (more >= 0 ? " less." : " more; the other terms decided."));
    return text;
}

// What setups said of the cut; where they replaced it, they and not the totals decided.
std::vector<std::string> setups_line(const Cut& cut, const Project& project) {
    SetupReview of_cut;
    if (!project.review) return {};
    for (const CutReview& review : project.review->cuts) {
        if (review.cut == cut.number) of_cut.cuts.push_back(review);
    }
    return review_lines(of_cut);
}

Json json_of(const OpenedSurface& o) {
    return {{"piece_mm2", o.piece_mm2},
            {"scan_mm2", o.scan_mm2},
            {"unreachable_before_mm2", o.before_mm2},
            {"unreachable_after_mm2", o.after_mm2},
            {"other_normals", o.other_normals},
            {"other_planes", o.other_planes},
            {"unreachable_after_best_other_mm2", o.best_other_after_mm2}};
}

// The chosen plane beside the next or the best one.
std::string comparison(const Explanation& e) {
    const Ranked* other = e.best_other();
    if (other == nullptr) {
        return e.place ? "The plane is the only candidate that parts the piece."
                       : origin_of(e.cut) + "; no candidate parts this piece.";
    }
    const std::string count = planes(e);
    const Weights& w = e.objectives.weights;
    const double more = other->terms.total - e.chosen.terms.total;
    const std::string why = " (" + differences(e.chosen.terms, other->terms, w) + ").";
    const std::size_t cheaper = e.cheaper();
    if (!e.place) {
        const std::string beside = origin_of(e.cut) + ", beside " + count + (e.max_judged == 0 ? " candidates" : "");
        if (std::abs(more) < 0.0005) return beside + ": the best of them costs as much.";
        return beside + ": the best of them would cost " + fixed(std::abs(more), 3) + (more > 0 ? " more" : " less") +
               why;
    }
    if (cheaper > 0) {
        return "The plane is number " + std::to_string(cheaper + 1) + " of " + count + ": the best would cost " +
               fixed(std::abs(more), 3) + " less" + why;
    }
    if (more < 0.0005) return "The plane is the best of " + count + "; the next is as good.";
    return "The plane is the best of " + count + "; the next would cost " + fixed(more, 3) + " more" + why;
}

}  // namespace

std::string describe(const Explanation& e) {
    if (e.proposer.empty()) return comparison(e);
    return comparison(e) + " It was proposed by " + e.proposer + ", along a border between two regions of the scan.";
}

std::vector<std::string> lines(const Explanation& e, const Project& project, const std::string& picture) {
    std::vector<std::string> text{"cut " + std::to_string(e.cut.number) + " on piece " + e.cut.piece + " makes " +
                                  makes(e.cut)};
    for (const std::string& line : scan_lines(project)) text.push_back(line);
    for (const std::string& line : discarded_lines(project)) text.push_back(line);
    text.push_back(describe(e));
    for (const std::string& line : setups_line(e.cut, project)) text.push_back(line);
    for (const std::string& line : opened_lines(e)) text.push_back(line);
    for (const std::string& line : columns(table(e))) text.push_back(line);
    text.push_back("plot: " + picture);
    return text;
}

std::vector<std::string> warnings(const Explanation& e) {
    const double was = e.cut.chosen.terms.total;
    const double now = e.chosen.terms.total;
    if (std::abs(now - was) <= 1e-6 * (1 + std::abs(now))) return {};
    return {"cut " + std::to_string(e.cut.number) + " was decided at a total of " + std::to_string(was) +
            ", which now comes out as " + std::to_string(now)};
}

Document document(const Explanation& e, const Project& project, const std::string& picture) {
    Json best = Json::array();
    for (const std::size_t i : e.listed) best.push_back(to_json(e.ranked[i]));
    Json json{{"schema", "qchopper-explain-3"},
              {"cut", e.cut.number},
              {"piece", e.cut.piece},
              {"pieces", e.cut.pieces},
              {"fragments", e.cut.fragments},
              {"discarded", discarded_json(project)},
              {"weights", json_of(e.objectives.weights)},
              {"chosen", to_json(e.chosen)},
              {"proposed_by", e.proposer.empty() ? Json() : Json(e.proposer)},
              {"place", e.place ? Json(*e.place + 1) : Json()},
              {"candidates", e.ranked.size()},
              {"best", best},
              {"explanation", describe(e)},
              {"picture", picture}};
    if (e.opened) {
        json["opened"] = json_of(*e.opened);
        json["max_judged_planes"] = e.max_judged;
    }
    add_scan(json, project);
    return compose(json);
}

}  // namespace qchopper

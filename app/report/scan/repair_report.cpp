// Text and JSON from a value.

#include "app/report/scan/repair_report.h"

#include <nlohmann/json.hpp>

#include "app/report/report_json.h"
#include "base/text.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

std::string verdict(const RepairReport& r) {
    if (r.is_solid()) return "closed: a solid";
    if (r.open_components_left > 0) return "no solid: more is missing than there is";
    if (r.open_edges > 0) return "open at " + with_commas(r.open_edges) + " edges";
    return "no solid: it has no volume";
}

// Distances are mm where the unit of the file is known, else in that unit.
std::string unit_of_lengths(const RepairedScan& scan) {
    return scan.mm_per_unit ? "mm" : "units of the file";
}

std::string distance_line(const RepairedScan& scan) {
    const OneSidedDistance& f = scan.report.deviation->largest();
    if (f.triangles == 0) return "nothing that was scanned has changed its place";
    return fixed(f.mm, 6) + " " + unit_of_lengths(scan) + ", at most " + fixed(f.at_most, 6) +
           ", from the scan to the result over what changed";
}

Json one_sided_distance(const OneSidedDistance& f) {
    return {{"distance", f.mm}, {"at_most", f.at_most}, {"at", json_of(f.at)}, {"faces_looked_at", f.triangles}};
}

Json hole_json(const OpenHole& hole) {
    return {{"edges", hole.edges}, {"centre", json_of(hole.centre)}};
}

Json step_json(const RepairStep& step) {
    return {{"step", step.name}, {"count", step.count}, {"description", step.words}};
}

Json counts(const RepairReport& r) {
    return {{"points_welded", r.welded},
            {"faces_collapsed", r.collapsed},
            {"points_unused", r.unreferenced},
            {"border_points_snapped", r.borders_snapped},
            {"border_moved_mm", r.border_moved_mm},
            {"faces_repeated", r.repeated},
            {"faces_of_doubled_components", r.of_doubled_components},
            {"edges_split", r.edges_split},
            {"edges_cut", r.edges_cut},
            {"points_copied", r.points_copied},
            {"faces_reoriented", r.faces_reoriented},
            {"edges_stitched", r.stitched},
            {"degenerate_removed", r.degenerate_removed},
            {"degenerate_left", r.degenerate_left},
            {"holes_filled", r.holes_filled},
            {"holes_faired", r.holes_faired},
            {"faces_added", r.faces_added},
            {"points_added", r.points_added},
            {"added_area_share", r.added_area_share},
            {"open_components", r.open_components_dropped},
            {"open_component_faces", r.open_component_faces},
            {"shells", r.shells},
            {"cavities", r.cavities},
            {"shells_reoriented", r.shells_reoriented},
            {"shells_overlapping", r.overlapping},
            {"fragments", r.fragments},
            {"fragment_faces", r.fragment_faces},
            {"fragment_area_share", r.fragment_area_share},
            {"fragments_dropped", r.fragments_dropped}};
}

Json resolved(const RepairReport& r) {
    if (!r.resolved) return {};
    return {{"pairs", r.resolved->pairs},
            {"left", r.resolved->left},
            {"places", r.resolved->places},
            {"removed", r.resolved->removed},
            {"added", r.resolved->added},
            {"undone", r.resolving_undone},
            {"where_left", json_of(r.resolved->where_left)}};
}

Json pen_grooves(const RepairReport& r) {
    if (!r.pen_grooves) return {};
    return {{"count", r.pen_grooves->count},
            {"points_moved", r.pen_grooves->points_moved},
            {"area_mm2", r.pen_grooves->area_mm2},
            {"length_mm", r.pen_grooves->length_mm},
            {"max_depth_mm", r.pen_grooves->max_depth},
            {"mean_depth_mm", r.pen_grooves->mean_depth}};
}

}  // namespace

std::vector<std::string> lines(const RepairedScan& scan, const RepairRequest& request) {
    const RepairReport& r = scan.report;
    std::vector<std::string> text;
    text.push_back(request.out.string() + ": " + with_commas(r.faces_out) + " faces, " +
                   with_commas(r.faces_in - r.faces_gone) + " of them as scanned");
    for (const RepairStep& step : steps(r)) {
        if (step.count == 0) continue;
        text.push_back(step.name + std::string(step.name.size() < 13 ? 13 - step.name.size() : 1, ' ') + step.words);
    }
    if (r.deviation) text.push_back("distance     " + distance_line(scan));
    if (r.open_edges == 0 && scan.mm_per_unit) {
        const double unit = *scan.mm_per_unit;
        text.push_back("volume       " + describe_volume(unit * unit * unit * r.volume));
    }
    text.push_back("verdict      " + verdict(r));
    return text;
}

Document document(const RepairedScan& scan, const RepairRequest& request) {
    const RepairReport& r = scan.report;
    Json json{{"schema", "qchopper-repair-3"},
              {"file", request.scan.string()},
              {"out", request.out.string()},
              {"format", name_of(scan.format)},
              {"sha256", to_hex(scan.sha256)},
              {"units", scan.mm_per_unit ? Json(name_of(unit_of(*scan.mm_per_unit))) : Json()},
              {"scale", request.options.scale},
              {"faces_in", r.faces_in},
              {"vertices_in", r.points_in},
              {"faces", r.faces_out},
              {"vertices", r.points_out},
              {"faces_gone", r.faces_gone},
              {"faces_new", r.faces_new},
              {"passes", r.passes},
              {"steps", list_of(steps(r), step_json)},
              {"counts", counts(r)},
              {"self_intersections", resolved(r)},
              {"pen_grooves", pen_grooves(r)},
              {"alpha_wrap", r.alpha_wrapped ? Json{{"alpha_mm", r.alpha_wrapped->alpha_mm},
                                                    {"offset_mm", r.alpha_wrapped->offset_mm}}
                                             : Json()},
              {"left_open", list_of(r.left_open, hole_json)},
              {"closed", r.open_edges == 0},
              {"solid", r.is_solid()},
              {"volume", r.volume}};
    if (r.deviation) {
        json["hausdorff_distance"] = {{"unit", scan.mm_per_unit ? "mm" : "file"},
                                      {"largest", r.deviation->largest().mm},
                                      {"from_scan", one_sided_distance(r.deviation->from_scan)},
                                      {"from_result", one_sided_distance(r.deviation->from_result)}};
    }
    json["warnings"] = scan.warnings;
    json["verdict"] = verdict(r);
    return compose(json);
}

}  // namespace qchopper

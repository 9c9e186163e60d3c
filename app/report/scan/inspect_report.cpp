// Text and JSON from a value. Lengths are in the unit of the file.

#include "app/report/scan/inspect_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/text.h"
#include "segment/import/import_scan.h"

namespace qchopper {

template <class V, Of<SelfIntersected> T>
void fields(V& v, T& found) {
    v("pairs", found.pairs);
    v("complete", found.is_complete);
    v("places", found.places);
}

template <class V, Of<InspectedSolid> T>
void fields(V& v, T& solid) {
    v("volume", solid.volume);
    v("faces", solid.faces);
    v("centre", solid.centre);
}

template <class V, Of<FaultPlaces> T>
void fields(V& v, T& places) {
    v("kind", places.kind);
    v("points", places.points);
}

namespace {

using Json = nlohmann::ordered_json;

const char* name_of_value(Verdict verdict) {
    constexpr const char* names[] = {"ready", "to repair", "unrepairable"};  // in the order of Verdict
    return names[static_cast<std::size_t>(verdict)];
}

std::string percent(double share) {
    return fixed(100 * share, 3) + " %";
}

std::string size_line(const InspectedFile& file) {
    const Vec3 size = file.inspection.box.size();
    if (file.units) return describe_size(mm_per(unit_named(*file.units)) * size);
    return fixed(size.x, 4) + " x " + fixed(size.y, 4) + " x " + fixed(size.z, 4) +
           " (the file has no unit: pass --units)";
}

std::string volume_line(const InspectedFile& file) {
    const double volume = file.inspection.volume;
    if (!file.units) return fixed(volume, 6) + " unit^3";
    const double unit = mm_per(unit_named(*file.units));
    return fixed(volume, 6) + " " + *file.units + "^3, " + describe_volume(unit * unit * unit * volume);
}

void add_faults(std::vector<std::string>& text, const Inspection& i) {
    const std::pair<const char*, std::size_t> faults[] = {
        {"edges of more than two faces", i.non_manifold},
        {"edges with faces turned against each other", i.inconsistent},
        {"points where surfaces only touch", i.non_manifold_vertices},
        {"faces collapsed to a line or point", i.collapsed},
        {"faces without area", i.degenerate},
        {"faces that lie on another one", i.repeated},
        {"open components, with more missing than there is", i.open_components},
        {"points in no face", i.unreferenced}};
    for (const auto& [what, count] : faults) {
        if (count > 0) text.push_back("             " + with_commas(count) + " " + what);
    }
}

void add_holes(std::vector<std::string>& text, const Inspection& i, const std::string& unit) {
    text.push_back("open edges   " + with_commas(i.open_edges) + " in " + with_commas(i.holes.size()) +
                   (i.holes.size() == 1 ? " hole" : " holes"));
    const BorderLoop* const longest = i.longest_hole();
    if (longest == nullptr) return;
    text.push_back("             the longest: " + with_commas(longest->edges) + " edges, " + fixed(longest->length, 4) +
                   " " + unit + ", around " + in_brackets(longest->centre, 4));
}

void add_self_intersections(std::vector<std::string>& text, const Inspection& i) {
    if (!i.self_intersected) return;
    const SelfIntersected& found = *i.self_intersected;
    if (found.pairs == 0) {
        text.push_back("             it runs through itself nowhere");
        return;
    }
    text.push_back("runs through itself at " + std::string(found.is_complete ? "" : "more than ") +
                   with_commas(found.pairs) + (found.pairs == 1 ? " pair of faces" : " pairs of faces"));
    for (const Vec3& at : found.places) text.push_back("             around " + in_brackets(at, 4));
}

Json hole_document(const BorderLoop& hole) {
    return {{"edges", hole.edges}, {"length", hole.length}, {"centre", json_of(hole.centre)}};
}

}  // namespace

std::vector<std::string> lines(const InspectedFile& file) {
    const Inspection& i = file.inspection;
    const std::string unit = file.units.value_or("unit");
    std::vector<std::string> text{file.name + ": " + name_of(i.format)};
    text.push_back("faces        " + with_commas(i.triangles));
    text.push_back("vertices     " + with_commas(i.vertices));
    text.push_back("size         " + size_line(file));
    text.push_back("shells       " + with_commas(i.shells) + " (" + with_commas(i.cavities) + " cavities, " +
                   with_commas(i.inside_out) + " inside out)");
    if (i.fragments > 0) {
        text.push_back("fragments    " + with_commas(i.fragments) + " too small to be pieces, with " +
                       percent(i.fragment_area_share) + " of the surface");
    }
    add_holes(text, i, unit);
    text.push_back("volume       " + volume_line(file) + (i.is_closed() ? "" : " (not closed)"));
    text.push_back("area         " + fixed(i.area, 6) + " " + unit + "^2");
    add_faults(text, i);
    add_self_intersections(text, i);
    for (const std::string& warning : i.warnings) text.push_back("note         " + warning);
    const Judgement judgement = judge(i);
    text.push_back("verdict      " + std::string(name_of_value(judgement.verdict)) +
                   (judgement.verdict == Verdict::to_repair ? ": prepare or repair does it" : ""));
    for (const std::string& reason : judgement.reasons) text.push_back("             " + reason);
    return text;
}

Document document(const InspectedFile& file) {
    const Inspection& i = file.inspection;
    const BorderLoop* const longest = i.longest_hole();
    const Judgement judgement = judge(i);
    const Json json{{"schema", "qchopper-inspect-3"},
                    {"file", file.name},
                    {"format", name_of(i.format)},
                    {"warnings", i.warnings},
                    {"faces_in_file", i.faces_in_file},
                    {"vertices_in_file", i.points_in_file},
                    {"faces", i.triangles},
                    {"vertices", i.vertices},
                    {"welded_vertices", i.welded},
                    {"units", file.units ? Json(*file.units) : Json()},
                    {"units_in_file", i.mm_per_unit ? Json(*i.mm_per_unit) : Json()},
                    {"size", json_of(i.box.size())},
                    {"size_text", file.units ? Json(size_line(file)) : Json()},
                    {"min", json_of(i.box.min)},
                    {"max", json_of(i.box.max)},
                    {"closed", i.is_closed()},
                    {"volume", i.volume},
                    {"area", i.area},
                    {"shells", i.shells},
                    {"cavities", i.cavities},
                    {"inside_out", i.inside_out},
                    {"solid_count", i.solid_count},
                    {"largest_solids", json_of(i.solids)},
                    {"fragments", {{"count", i.fragments}, {"area_share", i.fragment_area_share}}},
                    {"open_components", {{"count", i.open_components}, {"area_share", i.open_component_area_share}}},
                    {"open_edges", i.open_edges},
                    {"holes", list_of(i.holes, hole_document)},
                    {"longest_hole", longest == nullptr ? Json() : hole_document(*longest)},
                    {"non_manifold_edges", i.non_manifold},
                    {"touching_edges", i.touching},
                    {"inconsistent_edges", i.inconsistent},
                    {"non_manifold_vertices", i.non_manifold_vertices},
                    {"repeated_faces", i.repeated},
                    {"collapsed_faces", i.collapsed},
                    {"faces_without_area", i.degenerate},
                    {"faces_without_corners", i.faces_without_area},
                    {"unreferenced_vertices", i.unreferenced},
                    {"self_intersections", json_of(i.self_intersected)},
                    {"places", json_of(i.places)},
                    {"verdict", name_of_value(judgement.verdict)},
                    {"reasons", judgement.reasons}};
    return compose(json);
}

}  // namespace qchopper

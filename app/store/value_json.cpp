// Field by field, in the order of the structs.

#include "app/store/value_json.h"

#include <nlohmann/json.hpp>

#include "app/store/enum_names.h"
#include "base/error.h"
#include "segment/access/tool_directions.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

constexpr EnumName<Stop> stop_names[] = {{Stop::any, "any"}, {Stop::all, "all"}};
constexpr EnumName<FragilityForm> fragility_names[] = {
    {FragilityForm::thinness, "thinness"}, {FragilityForm::thesis, "thesis"}, {FragilityForm::binary, "binary"}};

constexpr EnumName<CandidateNormals> normals_names[] = {{CandidateNormals::box, "box"},
                                                        {CandidateNormals::sphere, "sphere"}};

constexpr EnumName<ConnectorForm> connector_names[] = {{ConnectorForm::spread, "spread"},
                                                       {ConnectorForm::ratio, "ratio"}};

constexpr EnumName<ReviewOutcome> outcome_names[] = {{ReviewOutcome::replaced, "replaced"},
                                                     {ReviewOutcome::kept, "kept"},
                                                     {ReviewOutcome::carries_cut, "carries_cut"},
                                                     {ReviewOutcome::decided, "decided"}};

double length_from(double length, double least) {
    constexpr double most = 1e15;
    if (length >= least && length <= most) return length;
    throw InputError(InputFault::config, "a length of its print volume or of connectors is impossible");
}
constexpr double min_length = 1e-9;
constexpr double min_spacing = 0.1;  // a finer grid would exceed any memory

Json json_of(const MilledSurface& s) {
    return {{"unreachable_mm2", s.unreachable_mm2}, {"area_mm2", s.area_mm2}};
}

MilledSurface milled_surface_from(const Json& json) {
    return {json.at("unreachable_mm2").get<double>(), json.at("area_mm2").get<double>()};
}

Terms terms_from(const Json& json) {
    Terms t;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        t.*field.value = i < always_named ? json.at(field.key).get<double>() : json.value(field.key, 0.0);
    }
    t.total = json.at("total").get<double>();
    return t;
}

}  // namespace

Json json_of(Vec3 v) {
    return Json::array({v.x, v.y, v.z});
}

Vec3 vec3_from(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json json_of(const Weights& w) {
    Json json;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        if (i < always_named || w.*field.weight != 0) json[field.key] = w.*field.weight;
    }
    return json;
}

Weights weights_from(const Json& json) {
    Weights w;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        w.*field.weight = i < always_named ? json.at(field.key).get<double>() : json.value(field.key, 0.0);
    }
    return w;
}

Json json_of(const Terms& t) {
    Json json;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        if (i < always_named || t.*field.value != 0) json[field.key] = t.*field.value;
    }
    json["total"] = t.total;
    return json;
}

Json json_of(const SolidRecord& solid) {
    Json json;
    if (!solid.name.empty()) json["name"] = solid.name;
    json["cut"] = solid.cut;
    json["faces"] = solid.faces;
    json["volume_mm3"] = solid.volume_mm3;
    json["centre_mm"] = json_of(solid.centre);
    return json;
}

SolidRecord solid_from(const Json& json) {
    return {json.value("name", ""), json.at("cut").get<std::int32_t>(), json.at("faces").get<std::size_t>(),
            json.at("volume_mm3").get<double>(), vec3_from(json.at("centre_mm"))};
}

Json json_of(const IgnoredSurface& ignored) {
    return {{"painted", ignored.painted.empty() ? Json() : Json(ignored.painted.string())},
            {"inside", ignored.inside},
            {"share", ignored.share},
            {"sha256", to_hex(ignored.sha256)}};
}

Json json_of(const NoCutSurface& no_cut) {
    return {{"painted", no_cut.painted.string()}, {"points", no_cut.points}, {"sha256", to_hex(no_cut.sha256)}};
}

Json json_of(const SymmetryPlane& s) {
    return {{"normal", json_of(s.plane.normal)}, {"offset_mm", s.plane.offset}, {"score_mm", s.score_mm},
            {"spacing_mm", s.spacing_mm},        {"ratio", s.ratio()},          {"is_symmetric", s.is_symmetric()}};
}

void add_scan(Json& json, const Project& project) {
    if (project.ignored) json["ignored"] = json_of(*project.ignored);
    if (project.no_cut) json["no_cut"] = json_of(*project.no_cut);
    const std::optional<SymmetryPlane>& symmetry = project.settings.candidates.symmetry;
    if (symmetry) json["symmetry"] = json_of(*symmetry);
}

namespace {

// All but the number of offsets, and what is kept beside project.json.
void add_candidates(Json& json, const CandidateOptions& c) {
    if (c.normals) json["normals"] = name_of_value(normals_names, *c.normals);
    if (c.offset_step_mm) json["offset_step_mm"] = *c.offset_step_mm;
    if (c.takes_symmetry) json["takes_symmetry"] = true;
    if (c.symmetry) json["symmetry"] = json_of(*c.symmetry);
    for (const Plane& plane : c.given) {
        json["planes"].push_back({{"normal", json_of(plane.normal)}, {"offset_mm", plane.offset}});
    }
}

Plane plane_from(const Json& json) {
    return {vec3_from(json.at("normal")), json.at("offset_mm").get<double>()};
}

void take_candidates(CandidateOptions& c, const Json& json) {
    c.offsets_per_normal = json.at("offsets_per_normal").get<int>();
    if (json.contains("normals")) c.normals = value_of_name(normals_names, json.at("normals").get<std::string>());
    if (json.contains("offset_step_mm")) c.offset_step_mm = json.at("offset_step_mm").get<double>();
    c.takes_symmetry = json.value("takes_symmetry", false);
    if (json.contains("symmetry")) {
        const Json& s = json.at("symmetry");
        c.symmetry = SymmetryPlane{plane_from(s), s.at("score_mm").get<double>(), s.at("spacing_mm").get<double>()};
    }
    if (json.contains("planes")) {
        for (const Json& plane : json.at("planes")) c.given.push_back(plane_from(plane));
    }
    if (c.offset_step_mm && !(*c.offset_step_mm > 0)) {
        throw InputError(InputFault::config, "the step between offsets in it is not above 0");
    }
}

}  // namespace

Json json_of(const SearchSettings& s) {
    const Objectives& o = s.objectives;
    Json stop{{"combine", name_of_value(stop_names, s.stop.combine)},
              {"fits_cell", s.stop.fits_cell},
              {"max_cuts", s.stop.max_cuts}};
    if (s.stop.max_faces) stop["max_faces"] = *s.stop.max_faces;
    if (s.stop.min_cuts) stop["min_cuts"] = *s.stop.min_cuts;
    if (s.stop.max_obb) stop["max_obb_mm"] = json_of(*s.stop.max_obb);
    if (s.stop.max_unreachable) stop["max_unreachable"] = *s.stop.max_unreachable;
    if (s.stop.count_narrow) stop["count_narrow"] = true;
    Json json{{"weights", json_of(o.weights)},
              {"face_ratio_threshold", o.face_ratio_threshold},
              {"fragility_form", name_of_value(fragility_names, o.fragility_form)},
              {"fragility_distance_mm", o.fragility_distance},
              {"undercut_by_area", o.undercut_by_area},
              {"fragment_volume_mm3", o.fragment_volume_mm3},
              {"offsets_per_normal", s.candidates.offsets_per_normal},
              {"runners_up", s.runners_up},
              {"beam", s.beam},
              {"near", s.near},
              {"stop", stop}};
    if (o.scope == TermScope::cut) json["terms_over"] = "cut";
    if (o.utilization_scope == TermScope::whole) json["utilization_over"] = "whole";
    if (o.print_volume) json["print_volume_mm"] = json_of(*o.print_volume);
    const ConnectorOptions& c = o.connector;
    if (c != ConnectorOptions{}) {
        json["connector"] = {{"form", name_of_value(connector_names, c.form)},
                             {"diameter_mm", c.diameter},
                             {"depth_mm", c.depth},
                             {"wall_mm", c.wall},
                             {"spacing_mm", c.spacing}};
    }
    if (!o.forbidden.empty()) json["forbidden"] = o.forbidden;
    if (o.tilt_deg != default_tilt_deg) json["tilt_deg"] = o.tilt_deg;
    add_candidates(json, s.candidates);
    return json;
}

SearchSettings settings_from(const Json& json) {
    SearchSettings s;
    s.objectives.weights = weights_from(json.at("weights"));
    s.objectives.face_ratio_threshold = json.at("face_ratio_threshold").get<double>();
    s.objectives.fragility_form = value_of_name(fragility_names, json.at("fragility_form"));
    s.objectives.fragility_distance = json.at("fragility_distance_mm").get<double>();
    s.objectives.undercut_by_area = json.at("undercut_by_area").get<bool>();
    s.objectives.fragment_volume_mm3 = json.at("fragment_volume_mm3").get<double>();
    if (json.value("terms_over", "whole") == "cut") s.objectives.scope = TermScope::cut;
    if (json.value("utilization_over", "cut") == "whole") s.objectives.utilization_scope = TermScope::whole;
    if (json.contains("print_volume_mm")) {
        const Vec3 box = vec3_from(json.at("print_volume_mm"));
        s.objectives.print_volume =
            Vec3{length_from(box.x, min_length), length_from(box.y, min_length), length_from(box.z, min_length)};
    }
    if (json.contains("connector")) {
        const Json& c = json.at("connector");
        s.objectives.connector = {
            value_of_name(connector_names, c.at("form")), length_from(c.at("diameter_mm").get<double>(), min_length),
            length_from(c.at("depth_mm").get<double>(), min_length), length_from(c.at("wall_mm").get<double>(), 0),
            length_from(c.at("spacing_mm").get<double>(), min_spacing)};
    }
    if (json.contains("forbidden")) s.objectives.forbidden = json.at("forbidden").get<std::vector<std::string>>();
    s.objectives.tilt_deg = json.value("tilt_deg", default_tilt_deg);
    take_candidates(s.candidates, json);
    if (s.candidates.symmetry) s.objectives.symmetry_plane = s.candidates.symmetry->plane;
    s.runners_up = json.at("runners_up").get<std::size_t>();
    s.beam = json.at("beam").get<std::size_t>();
    s.near = json.at("near").get<double>();
    const Json& stop = json.at("stop");
    s.stop.combine = value_of_name(stop_names, stop.at("combine"));
    s.stop.fits_cell = stop.at("fits_cell").get<bool>();
    s.stop.max_cuts = stop.at("max_cuts").get<int>();
    if (stop.contains("max_faces")) s.stop.max_faces = stop.at("max_faces").get<std::size_t>();
    if (stop.contains("min_cuts")) s.stop.min_cuts = stop.at("min_cuts").get<int>();
    if (stop.contains("max_obb_mm")) s.stop.max_obb = vec3_from(stop.at("max_obb_mm"));
    if (stop.contains("max_unreachable")) s.stop.max_unreachable = stop.at("max_unreachable").get<double>();
    if (stop.contains("count_narrow")) s.stop.count_narrow = stop.at("count_narrow").get<bool>();
    return s;
}

Json json_of(const Ranked& r) {
    Json json{{"normal", json_of(r.plane.normal)},   {"offset_mm", r.plane.offset},
              {"wanted_offset_mm", r.wanted_offset}, {"normal_index", r.normal_index},
              {"offset_index", r.offset_index},      {"terms", json_of(r.terms)}};
    if (r.seam_mm != 0) json["seam_mm"] = r.seam_mm;
    if (r.coarse_sections != 0) json["coarse_sections"] = r.coarse_sections;
    return json;
}

Ranked ranked_from(const Json& json) {
    return {{vec3_from(json.at("normal")), json.at("offset_mm").get<double>()},
            json.at("wanted_offset_mm").get<double>(),
            json.at("normal_index").get<int>(),
            json.at("offset_index").get<int>(),
            terms_from(json.at("terms")),
            json.value("seam_mm", 0.0),
            json.value("coarse_sections", std::uint32_t{0})};
}

Json json_of(const Cut& cut) {
    Json runners_up = Json::array();
    for (const Ranked& r : cut.runners_up) runners_up.push_back(json_of(r));
    return {{"number", cut.number},         {"piece", cut.piece},   {"chosen", json_of(cut.chosen)},
            {"candidates", cut.candidates}, {"pieces", cut.pieces}, {"fragments", cut.fragments},
            {"runners_up", runners_up}};
}

Cut cut_from(const Json& json) {
    Cut cut;
    cut.number = json.at("number").get<std::int32_t>();
    cut.piece = json.at("piece").get<std::string>();
    cut.chosen = ranked_from(json.at("chosen"));
    cut.candidates = json.at("candidates").get<std::size_t>();
    cut.pieces = json.at("pieces").get<std::vector<std::string>>();
    cut.fragments = json.at("fragments").get<std::size_t>();
    for (const Json& r : json.at("runners_up")) cut.runners_up.push_back(ranked_from(r));
    return cut;
}

Json json_of(const CutReview& review) {
    return {{"cut", review.cut},
            {"piece", review.piece},
            {"outcome", name_of_value(outcome_names, review.outcome)},
            {"planes", review.planes},
            {"before", json_of(review.before)},
            {"best", json_of(review.best)}};
}

CutReview cut_review_from(const Json& json) {
    return {json.at("cut").get<std::int32_t>(),
            json.at("piece").get<std::string>(),
            value_of_name(outcome_names, json.at("outcome").get<std::string>()),
            json.at("planes").get<std::size_t>(),
            milled_surface_from(json.at("before")),
            milled_surface_from(json.at("best"))};
}

std::string text_of(const Json& document) {
    return document.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace qchopper

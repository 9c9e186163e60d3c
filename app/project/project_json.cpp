#include "app/project/project_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "qchopper-project-2";
constexpr const char* schema_before = "qchopper-project-1";  // no record of job files, no beam; still read

// Names of the enumerations, as they stand in the file.
template <typename Enum>
struct Word {
    Enum value;
    const char* word;
};
constexpr Word<Stage> stage_words[] = {{Stage::cutting, "cutting"}, {Stage::cut, "cut"}, {Stage::done, "done"}};
constexpr Word<CrumbChoice> crumb_words[] = {{CrumbChoice::keep, "keep"}, {CrumbChoice::drop, "drop"}};
constexpr Word<Stop> stop_words[] = {{Stop::any, "any"}, {Stop::all, "all"}};
constexpr Word<FragilityForm> fragility_words[] = {{FragilityForm::thinness, "thinness"},
                                                   {FragilityForm::thesis, "thesis"}};

template <typename Enum, std::size_t n>
const char* word_of(const Word<Enum> (&words)[n], Enum value) {
    for (const auto& w : words) {
        if (w.value == value) return w.word;
    }
    return "?";
}

template <typename Enum, std::size_t n>
Enum value_of(const Word<Enum> (&words)[n], const Json& json) {
    const std::string text = json.get<std::string>();
    for (const auto& w : words) {
        if (text == w.word) return w.value;
    }
    throw InputError(InputFault::config, "\"" + text + "\" is not known here");
}

Json to_json(Vec3 v) {
    return Json::array({v.x, v.y, v.z});
}

Vec3 vec3(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json to_json(const Weights& w) {
    return {{"face_ratio", w.face_ratio},
            {"fragility", w.fragility},
            {"piece_count", w.piece_count},
            {"undercut", w.undercut}};
}

Weights weights_from(const Json& json) {
    return {json.at("face_ratio").get<double>(), json.at("fragility").get<double>(),
            json.at("piece_count").get<double>(), json.at("undercut").get<double>()};
}

Json to_json(const SearchSettings& s) {
    const Objectives& o = s.objectives;
    Json stop{{"combine", word_of(stop_words, s.stop.combine)},
              {"fits_cell", s.stop.fits_cell},
              {"max_cuts", s.stop.max_cuts}};
    if (s.stop.max_faces) stop["max_faces"] = *s.stop.max_faces;
    if (s.stop.min_cuts) stop["min_cuts"] = *s.stop.min_cuts;
    if (s.stop.max_obb) stop["max_obb_mm"] = to_json(*s.stop.max_obb);
    return {{"weights", to_json(o.weights)},
            {"face_ratio_threshold", o.face_ratio_threshold},
            {"fragility_form", word_of(fragility_words, o.fragility_form)},
            {"fragility_distance_mm", o.fragility_distance},
            {"undercut_by_area", o.undercut_by_area},
            {"crumb_volume_mm3", o.crumb_volume_mm3},
            {"offsets_per_normal", s.candidates.offsets_per_normal},
            {"runners_up", s.runners_up},
            {"beam", s.beam},
            {"near", s.near},
            {"stop", stop}};
}

SearchSettings settings_from(const Json& json) {
    SearchSettings s;
    s.objectives.weights = weights_from(json.at("weights"));
    s.objectives.face_ratio_threshold = json.at("face_ratio_threshold").get<double>();
    s.objectives.fragility_form = value_of(fragility_words, json.at("fragility_form"));
    s.objectives.fragility_distance = json.at("fragility_distance_mm").get<double>();
    s.objectives.undercut_by_area = json.at("undercut_by_area").get<bool>();
    s.objectives.crumb_volume_mm3 = json.at("crumb_volume_mm3").get<double>();
    s.candidates.offsets_per_normal = json.at("offsets_per_normal").get<int>();
    s.runners_up = json.at("runners_up").get<std::size_t>();
    s.beam = json.at("beam").get<std::size_t>();
    s.near = json.at("near").get<double>();
    const Json& stop = json.at("stop");
    s.stop.combine = value_of(stop_words, stop.at("combine"));
    s.stop.fits_cell = stop.at("fits_cell").get<bool>();
    s.stop.max_cuts = stop.at("max_cuts").get<int>();
    if (stop.contains("max_faces")) s.stop.max_faces = stop.at("max_faces").get<std::size_t>();
    if (stop.contains("min_cuts")) s.stop.min_cuts = stop.at("min_cuts").get<int>();
    if (stop.contains("max_obb_mm")) s.stop.max_obb = vec3(stop.at("max_obb_mm"));
    return s;
}

Json to_json(const SolidRecord& solid) {
    Json json;
    if (!solid.name.empty()) json["name"] = solid.name;
    json["cut"] = solid.cut;
    json["faces"] = solid.faces;
    json["volume_mm3"] = solid.volume_mm3;
    json["centre_mm"] = to_json(solid.centre);
    return json;
}

std::vector<SolidRecord> solids_from(const Json& json) {
    std::vector<SolidRecord> solids;
    for (const Json& s : json) {
        solids.push_back({s.value("name", ""), s.at("cut").get<std::int32_t>(), s.at("faces").get<std::size_t>(),
                          s.at("volume_mm3").get<double>(), vec3(s.at("centre_mm"))});
    }
    return solids;
}

Json to_json(const RepairChoices& repair) {
    return {{"weld_mm", repair.weld_mm},
            {"fill", name_of(repair.fill)},
            {"resolve_self_intersections", repair.resolve_self_intersections},
            {"smooth_marks", repair.smooth_marks},
            {"wrap_mm", repair.wrap_mm}};
}

RepairChoices repair_from(const Json& json) {
    RepairChoices repair;
    repair.weld_mm = json.at("weld_mm").get<double>();
    const std::optional<Fill> fill = fill_named(json.at("fill").get<std::string>());
    if (!fill) throw InputError(InputFault::config, "\"" + json.at("fill").get<std::string>() + "\" fills no hole");
    repair.fill = *fill;
    repair.resolve_self_intersections = json.at("resolve_self_intersections").get<bool>();
    repair.smooth_marks = json.at("smooth_marks").get<bool>();
    repair.wrap_mm = json.at("wrap_mm").get<double>();
    return repair;
}

Json to_json(const ScanSource& scan) {
    return {{"path", scan.path.string()},        {"sha256", scan.sha256},
            {"units", name_of(scan.unit)},       {"scale", scan.scale},
            {"centre_mm", to_json(scan.centre)}, {"faces", scan.faces},
            {"volume_mm3", scan.volume_mm3},     {"warnings", scan.warnings},
            {"repair", to_json(scan.repair)}};
}

ScanSource scan_from(const Json& json) {
    ScanSource scan;
    scan.path = json.at("path").get<std::string>();
    scan.sha256 = json.at("sha256").get<std::string>();
    scan.unit = unit_named(json.at("units").get<std::string>());
    scan.scale = json.at("scale").get<double>();
    scan.centre = vec3(json.at("centre_mm"));
    scan.faces = json.at("faces").get<std::size_t>();
    scan.volume_mm3 = json.at("volume_mm3").get<double>();
    scan.warnings = json.at("warnings").get<std::vector<std::string>>();
    if (json.contains("repair")) scan.repair = repair_from(json.at("repair"));  // older projects have none
    return scan;
}

Json to_json(const WrittenJob& job) {
    return {{"piece", job.piece}, {"sha256", job.sha256}, {"project_id", job.project_id}};
}

std::vector<WrittenJob> jobs_from(const Json& json) {
    std::vector<WrittenJob> jobs;
    for (const Json& j : json) {
        jobs.push_back({j.at("piece").get<std::string>(), j.at("sha256").get<std::string>(),
                        j.at("project_id").get<std::string>()});
    }
    return jobs;
}

Json to_json(const Terms& t) {
    return {{"face_ratio", t.face_ratio},
            {"fragility", t.fragility},
            {"piece_count", t.piece_count},
            {"undercut", t.undercut},
            {"total", t.total}};
}

Terms terms_from(const Json& json) {
    return {json.at("face_ratio").get<double>(), json.at("fragility").get<double>(),
            json.at("piece_count").get<double>(), json.at("undercut").get<double>(), json.at("total").get<double>()};
}

Json to_json(const Ranked& r) {
    return {{"normal", to_json(r.plane.normal)}, {"offset_mm", r.plane.offset}, {"wanted_offset_mm", r.wanted_offset},
            {"normal_number", r.normal},         {"offset_number", r.offset},   {"terms", to_json(r.terms)}};
}

Ranked ranked_from(const Json& json) {
    return {{vec3(json.at("normal")), json.at("offset_mm").get<double>()},
            json.at("wanted_offset_mm").get<double>(),
            json.at("normal_number").get<int>(),
            json.at("offset_number").get<int>(),
            terms_from(json.at("terms"))};
}

Json to_json(const Cut& cut) {
    Json runners_up = Json::array();
    for (const Ranked& r : cut.runners_up) runners_up.push_back(to_json(r));
    return {{"number", cut.number},         {"piece", cut.piece},   {"chosen", to_json(cut.chosen)},
            {"candidates", cut.candidates}, {"pieces", cut.pieces}, {"crumbs", cut.crumbs},
            {"runners_up", runners_up}};
}

Cut cut_from(const Json& json) {
    Cut cut;
    cut.number = json.at("number").get<std::int32_t>();
    cut.piece = json.at("piece").get<std::string>();
    cut.chosen = ranked_from(json.at("chosen"));
    cut.candidates = json.at("candidates").get<std::size_t>();
    cut.pieces = json.at("pieces").get<std::vector<std::string>>();
    cut.crumbs = json.at("crumbs").get<std::size_t>();
    for (const Json& r : json.at("runners_up")) cut.runners_up.push_back(ranked_from(r));
    return cut;
}

Json to_json(const Decision& decision) {
    if (const Cut* cut = std::get_if<Cut>(&decision)) return {{"cut", to_json(*cut)}};
    if (const auto* change = std::get_if<WeightsChange>(&decision)) return {{"weights", to_json(change->weights)}};
    if (const auto* discard = std::get_if<Discard>(&decision)) {
        return {{"discard", {{"piece", discard->piece}, {"after", discard->after}}}};
    }
    return {{"reset", true}};
}

Decision decision_from(const Json& json) {
    if (json.contains("cut")) return cut_from(json.at("cut"));
    if (json.contains("weights")) return WeightsChange{weights_from(json.at("weights"))};
    if (json.contains("discard")) {
        const Json& discard = json.at("discard");
        return Discard{discard.at("piece").get<std::string>(), discard.at("after").get<std::size_t>()};
    }
    if (json.contains("reset")) return Reset{};
    throw InputError(InputFault::config, "a decision is neither a cut nor a discarded piece nor weights nor a reset");
}

Json to_json(const BeamState::Branch& branch) {
    return {{"last", branch.last}, {"passed_over", branch.passed_over}};
}

// The root, or one of the cuts before it.
std::size_t place_from(const Json& json, std::size_t cuts) {
    const auto place = json.get<std::size_t>();
    if (place > cuts) throw InputError(InputFault::config, "a cut of its beam follows one that is not there");
    return place;
}

BeamState::Branch branch_from(const Json& json, std::size_t cuts) {
    return {place_from(json.at("last"), cuts), json.at("passed_over").get<std::vector<std::string>>()};
}

// The search may give up only cuts that it made itself: after the root nothing but cuts was decided.
bool belongs_to(const BeamState& beam, const History& history) {
    const std::vector<Cut> standing = standing_cuts(history);
    if (beam.branches.empty() || beam.from > standing.size()) return false;
    for (std::size_t i = 0; i < standing.size() - beam.from; ++i) {
        if (!std::holds_alternative<Cut>(history.decisions[history.standing - 1 - i])) return false;
    }
    const std::vector<Cut> best = cuts_of(beam, beam.branches.front());
    return std::equal(best.begin(), best.end(), standing.begin() + static_cast<std::ptrdiff_t>(beam.from),
                      standing.end());
}

Json to_json(const History& history) {
    Json decisions = Json::array();
    for (const Decision& decision : history.decisions) decisions.push_back(to_json(decision));
    return {{"weights_at_start", to_json(history.weights_at_start)},
            {"standing", history.standing},
            {"decisions", decisions}};
}

History history_from(const Json& json) {
    History history;
    history.weights_at_start = weights_from(json.at("weights_at_start"));
    for (const Json& decision : json.at("decisions")) history.decisions.push_back(decision_from(decision));
    history.standing = json.at("standing").get<std::size_t>();
    if (history.standing > history.decisions.size()) {
        throw InputError(InputFault::config, "more decisions stand than there are");
    }
    return history;
}

Json to_json(const BeamState& beam) {
    Json cuts = Json::array();
    for (const BeamState::Node& node : beam.cuts) cuts.push_back({{"after", node.after}, {"cut", to_json(node.cut)}});
    Json branches = Json::array();
    for (const BeamState::Branch& branch : beam.branches) branches.push_back(to_json(branch));
    Json json{{"from", beam.from}, {"cuts", cuts}, {"branches", branches}};
    if (beam.stuck) json["stuck"] = to_json(*beam.stuck);
    return json;
}

BeamState beam_from(const Json& json, const History& history) {
    BeamState beam;
    beam.from = json.at("from").get<std::size_t>();
    for (const Json& node : json.at("cuts")) {
        beam.cuts.push_back({place_from(node.at("after"), beam.cuts.size()), cut_from(node.at("cut"))});
    }
    for (const Json& branch : json.at("branches")) beam.branches.push_back(branch_from(branch, beam.cuts.size()));
    if (json.contains("stuck")) beam.stuck = branch_from(json.at("stuck"), beam.cuts.size());
    if (!belongs_to(beam, history)) throw InputError(InputFault::config, "its beam is not of the cuts that stand");
    return beam;
}

Project from_json(const Json& json) {
    const bool is_older = json.at("schema") == schema_before;
    if (!is_older && json.at("schema") != schema) {
        throw InputError(InputFault::config, "its schema is not " + std::string(schema));
    }
    Project project;
    project.scan = scan_from(json.at("scan"));
    project.preset = json.at("preset").get<std::string>();
    project.settings = settings_from(json.at("settings"));
    project.crumbs = value_of(crumb_words, json.at("crumb_choice"));
    project.stage = value_of(stage_words, json.at("stage"));
    project.ended_because = json.at("ended_because").get<std::string>();
    project.history = history_from(json.at("history"));
    project.cuts = standing_cuts(project.history);
    project.discards = standing_discards(project.history);
    if (json.contains("discarded")) project.discarded = solids_from(json.at("discarded"));
    if (project.discarded.size() != project.discards.size()) {
        throw InputError(InputFault::config, "its list of discarded pieces is not that of its decisions");
    }
    if (json.contains("beam")) project.beam = beam_from(json.at("beam"), project.history);
    project.pieces = solids_from(json.at("pieces"));
    project.crumb_list = solids_from(json.at("crumbs"));
    project.warnings = json.at("warnings").get<std::vector<std::string>>();
    if (!is_older) project.jobs = jobs_from(json.at("jobs"));
    return project;
}

}  // namespace

std::string to_json(const Project& project) {
    Json pieces = Json::array();
    for (const SolidRecord& piece : project.pieces) pieces.push_back(to_json(piece));
    Json crumbs = Json::array();
    for (const SolidRecord& crumb : project.crumb_list) crumbs.push_back(to_json(crumb));
    Json jobs = Json::array();
    for (const WrittenJob& job : project.jobs) jobs.push_back(to_json(job));
    Json discarded = Json::array();
    for (const SolidRecord& solid : project.discarded) discarded.push_back(to_json(solid));
    Json json{{"schema", schema},
              {"scan", to_json(project.scan)},
              {"preset", project.preset},
              {"settings", to_json(project.settings)},
              {"crumb_choice", word_of(crumb_words, project.crumbs)},
              {"stage", word_of(stage_words, project.stage)},
              {"ended_because", project.ended_because},
              {"history", to_json(project.history)},
              {"pieces", pieces},
              {"crumbs", crumbs},
              {"discarded", discarded},
              {"warnings", project.warnings},
              {"jobs", jobs}};
    if (project.beam) json["beam"] = to_json(*project.beam);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Project project_from_json(std::string_view text, const std::string& name) {
    try {
        return from_json(Json::parse(text));
    } catch (const Json::parse_error& e) {
        throw InputError(InputFault::config, name + " is not JSON from byte " + std::to_string(e.byte) + " on",
                         "restore the file, or prepare the scan again");
    } catch (const Json::exception&) {  // its own words speak of the library
        throw InputError(InputFault::config,
                         name + " is not a project of this version: a value is missing, or is not of the right kind",
                         "restore the file, or prepare the scan again");
    } catch (const InputError& e) {
        throw InputError(InputFault::config, name + " is not a project of this version: " + e.what(),
                         "restore the file, or prepare the scan again");
    }
}

}  // namespace qchopper

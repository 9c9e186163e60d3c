// By nlohmann/json, with keys in a fixed order. Everything that the history determines is derived from it.

#include "app/store/project_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/store/enum_names.h"
#include "app/store/value_json.h"
#include "base/error.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "qchopper-project-3";

// Names of the enumerations, as they stand in the file.
constexpr EnumName<Stage> stage_names[] = {{Stage::cutting, "cutting"}, {Stage::cut, "cut"}, {Stage::done, "done"}};
constexpr EnumName<FragmentChoice> fragment_names[] = {{FragmentChoice::keep, "keep"}, {FragmentChoice::drop, "drop"}};

std::vector<SolidRecord> solids_from(const Json& json) {
    std::vector<SolidRecord> solids;
    for (const Json& solid : json) solids.push_back(solid_from(solid));
    return solids;
}

Json json_of(const RepairChoices& repair) {
    return {{"weld_mm", repair.weld_mm},
            {"fill", name_of(repair.fill)},
            {"resolve_self_intersections", repair.resolve_self_intersections},
            {"smooth_pen_grooves", repair.smooth_pen_grooves},
            {"alpha_wrap_mm", repair.alpha_wrap_mm}};
}

RepairChoices repair_from(const Json& json) {
    RepairChoices repair;
    repair.weld_mm = json.at("weld_mm").get<double>();
    const std::optional<Fill> fill = fill_named(json.at("fill").get<std::string>());
    if (!fill) throw InputError(InputFault::config, "\"" + json.at("fill").get<std::string>() + "\" fills no hole");
    repair.fill = *fill;
    repair.resolve_self_intersections = json.at("resolve_self_intersections").get<bool>();
    repair.smooth_pen_grooves = json.at("smooth_pen_grooves").get<bool>();
    repair.alpha_wrap_mm = json.at("alpha_wrap_mm").get<double>();
    return repair;
}

Sha256 sha256_from(const Json& json) {
    const std::optional<Sha256> digest = sha256_from_hex(json.get<std::string>());
    if (!digest) throw InputError(InputFault::config, "a SHA-256 in it is not 64 hexadecimal digits");
    return *digest;
}

Json json_of(const ScanSource& scan) {
    return {{"path", scan.path.string()},    {"sha256", to_hex(scan.sha256)},     {"units", name_of(scan.unit)},
            {"scale", scan.scale},           {"centre_mm", json_of(scan.centre)}, {"faces", scan.faces},
            {"volume_mm3", scan.volume_mm3}, {"warnings", scan.warnings},         {"repair", json_of(scan.repair)}};
}

ScanSource scan_from(const Json& json) {
    ScanSource scan;
    scan.path = json.at("path").get<std::string>();
    scan.sha256 = sha256_from(json.at("sha256"));
    scan.unit = unit_named(json.at("units").get<std::string>());
    scan.scale = json.at("scale").get<double>();
    scan.centre = vec3_from(json.at("centre_mm"));
    scan.faces = json.at("faces").get<std::size_t>();
    scan.volume_mm3 = json.at("volume_mm3").get<double>();
    scan.warnings = json.at("warnings").get<std::vector<std::string>>();
    scan.repair = repair_from(json.at("repair"));
    return scan;
}

IgnoredSurface ignored_from(const Json& json) {
    IgnoredSurface ignored;
    if (!json.at("painted").is_null()) ignored.painted = json.at("painted").get<std::string>();
    ignored.inside = json.at("inside").get<bool>();
    ignored.share = json.at("share").get<double>();
    ignored.sha256 = sha256_from(json.at("sha256"));
    return ignored;
}

Json json_of(const StructureOptions& load) {
    return {{"upright", json_of(load.up)},       {"density_kg_per_m3", load.density_kg_per_m3},
            {"strength_mpa", load.strength_mpa}, {"own_weight", load.has_own_weight},
            {"force_n", load.force_n},           {"poisson_ratio", load.poisson_ratio},
            {"voxel_mm", load.voxel_mm},         {"unknowns", load.unknowns}};
}

StructureOptions load_from(const Json& json) {
    return {vec3_from(json.at("upright")),         json.at("density_kg_per_m3").get<double>(),
            json.at("strength_mpa").get<double>(), json.at("own_weight").get<bool>(),
            json.at("force_n").get<double>(),      json.at("poisson_ratio").get<double>(),
            json.at("voxel_mm").get<double>(),     json.at("unknowns").get<std::size_t>()};
}

NoCutSurface no_cut_from(const Json& json) {
    return {json.at("painted").get<std::string>(), json.at("points").get<std::size_t>(),
            sha256_from(json.at("sha256"))};
}

Json json_of(const WrittenJob& job) {
    return {{"piece", job.piece}, {"sha256", to_hex(job.sha256)}, {"project_id", job.project_id}, {"part", job.part}};
}

std::vector<WrittenJob> jobs_from(const Json& json) {
    std::vector<WrittenJob> jobs;
    for (const Json& j : json) {
        jobs.push_back({j.at("piece").get<std::string>(), sha256_from(j.at("sha256")),
                        j.at("project_id").get<std::string>(), j.at("part").get<std::uint16_t>()});
    }
    return jobs;
}

Json json_of(const Decision& decision) {
    if (const Cut* cut = std::get_if<Cut>(&decision)) return {{"cut", json_of(*cut)}};
    if (const auto* change = std::get_if<WeightsChange>(&decision)) return {{"weights", json_of(change->weights)}};
    if (const auto* discards = std::get_if<Discards>(&decision)) {
        Json list = Json::array();
        for (const Discard& d : *discards) list.push_back({{"piece", d.piece}, {"after", d.after}});
        return {{"discard", list.size() == 1 ? list.front() : list}};
    }
    if (const auto* other = std::get_if<Replacement>(&decision)) return {{"replacement", json_of(other->cut)}};
    if (const auto* order = std::get_if<SetupOrder>(&decision)) {
        Json setup{{"piece", order->piece}};
        if (order->base) setup["base"] = *order->base;
        if (order->max_directions) setup["max_directions"] = *order->max_directions;
        if (!order->tools.empty()) setup["tools"] = order->tools;
        return {{"setup", setup}};
    }
    return {{"reset", true}};
}

// One is an object, several are a list of them.
Discards discards_from(const Json& json) {
    const Json list = json.is_array() ? json : Json::array({json});
    if (list.empty()) throw InputError(InputFault::config, "a decision discards no piece");
    Discards discards;
    for (const Json& d : list) discards.push_back({d.at("piece").get<std::string>(), d.at("after").get<std::size_t>()});
    return discards;
}

Decision decision_from(const Json& json) {
    if (json.contains("cut")) return cut_from(json.at("cut"));
    if (json.contains("replacement")) return Replacement{cut_from(json.at("replacement"))};
    if (json.contains("weights")) return WeightsChange{weights_from(json.at("weights"))};
    if (json.contains("discard")) return discards_from(json.at("discard"));
    if (json.contains("setup")) {
        const Json& setup = json.at("setup");
        SetupOrder order{setup.at("piece").get<std::string>(), {}, {}};
        if (setup.contains("base")) order.base = setup.at("base").get<int>();
        if (setup.contains("max_directions")) order.max_directions = setup.at("max_directions").get<std::size_t>();
        if (setup.contains("tools")) order.tools = setup.at("tools").get<std::vector<std::uint16_t>>();
        return order;
    }
    if (json.contains("reset")) return Reset{};
    throw InputError(InputFault::config,
                     "a decision is neither a cut nor a replacement nor a discarded piece nor a setup nor weights "
                     "nor a reset");
}

Json json_of(const RevertedTrial& trial) {
    return {{"piece", trial.piece},
            {"cuts", trial.cuts},
            {"before_mm2", trial.before_mm2},
            {"after_mm2", trial.after_mm2},
            {"is_cut_short", trial.is_cut_short}};
}

std::vector<RevertedTrial> reverted_from(const Json& json) {
    std::vector<RevertedTrial> reverted;
    for (const Json& trial : json) {
        reverted.push_back({trial.at("piece").get<std::string>(), trial.at("cuts").get<int>(),
                            trial.at("before_mm2").get<double>(), trial.at("after_mm2").get<double>(),
                            trial.at("is_cut_short").get<bool>()});
    }
    return reverted;
}

Json json_of(const BeamState::Branch& branch) {
    Json json{{"last", branch.last}, {"passed_over", branch.passed_over}};
    for (const RevertedTrial& trial : branch.reverted) json["reverted"].push_back(json_of(trial));
    return json;
}

// 0 for the root, else the number of a cut. Throws InputError (config) for a cut that is not there.
std::size_t place_from(const Json& json, std::size_t cuts) {
    const auto place = json.get<std::size_t>();
    if (place > cuts) throw InputError(InputFault::config, "a cut of its beam follows one that is not there");
    return place;
}

BeamState::Branch branch_from(const Json& json, std::size_t cuts) {
    BeamState::Branch branch{place_from(json.at("last"), cuts), json.at("passed_over").get<std::vector<std::string>>()};
    if (json.contains("reverted")) branch.reverted = reverted_from(json.at("reverted"));
    return branch;
}

// Whether a search may go on with the beam: after its root nothing but cuts was decided, and they are those of its
// first branch.
bool belongs_to(const BeamState& beam, const History& history) {
    const std::vector<Cut> committed = committed_cuts(history);
    if (beam.branches.empty() || beam.from > committed.size()) return false;
    for (std::size_t i = 0; i < committed.size() - beam.from; ++i) {
        if (!std::holds_alternative<Cut>(history.decisions[history.committed - 1 - i])) return false;
    }
    const std::vector<Cut> best = cuts_of(beam, beam.branches.front());
    return std::equal(best.begin(), best.end(), committed.begin() + static_cast<std::ptrdiff_t>(beam.from),
                      committed.end());
}

template <typename Value>
Json list_of(const std::vector<Value>& values) {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(json_of(value));
    return list;
}

Json json_of(const History& history) {
    return {{"weights_at_start", json_of(history.weights_at_start)},
            {"committed", history.committed},
            {"decisions", list_of(history.decisions)}};
}

History history_from(const Json& json) {
    History history;
    history.weights_at_start = weights_from(json.at("weights_at_start"));
    for (const Json& decision : json.at("decisions")) history.decisions.push_back(decision_from(decision));
    history.committed = json.at("committed").get<std::size_t>();
    if (history.committed > history.decisions.size()) {
        throw InputError(InputFault::config, "more decisions are in force than there are");
    }
    if (!are_replacements_possible(history)) {
        throw InputError(InputFault::config, "a replaced cut of it is not there, or its pieces were cut further");
    }
    return history;
}

Json json_of(const BeamState& beam) {
    Json cuts = Json::array();
    for (const BeamState::Node& node : beam.cuts) cuts.push_back({{"after", node.after}, {"cut", json_of(node.cut)}});
    Json json{{"from", beam.from}, {"cuts", cuts}, {"branches", list_of(beam.branches)}};
    if (beam.stuck) json["stuck"] = json_of(*beam.stuck);
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
    if (!belongs_to(beam, history)) throw InputError(InputFault::config, "its beam is not of the cuts in force");
    return beam;
}

Json json_of(const SetupReview& review) {
    Json cuts = Json::array();
    for (const CutReview& cut : review.cuts) cuts.push_back(json_of(cut));
    return {{"done", review.is_done}, {"cuts_are_asked", review.are_cuts_asked}, {"cuts", cuts}};
}

SetupReview review_from(const Json& json) {
    SetupReview review;
    for (const Json& cut : json.at("cuts")) review.cuts.push_back(cut_review_from(cut));
    review.is_done = json.at("done").get<bool>();
    review.are_cuts_asked = json.at("cuts_are_asked").get<bool>();
    return review;
}

Project from_json(const Json& json) {
    if (json.at("schema") != schema) {
        throw InputError(InputFault::config, "its schema is not " + std::string(schema));
    }
    Project project;
    project.scan = scan_from(json.at("scan"));
    if (json.contains("ignored")) project.ignored = ignored_from(json.at("ignored"));
    if (json.contains("load")) project.load = load_from(json.at("load"));
    if (json.contains("no_cut")) project.no_cut = no_cut_from(json.at("no_cut"));
    project.preset = json.at("preset").get<std::string>();
    project.settings = settings_from(json.at("settings"));
    project.fragments = value_of_name(fragment_names, json.at("fragment_choice"));
    project.stage = value_of_name(stage_names, json.at("stage"));
    project.ended_because = json.at("ended_because").get<std::string>();
    project.end_reason = end_reason_of(project.ended_because);
    if (json.contains("reverted")) project.reverted = reverted_from(json.at("reverted"));
    project.history = history_from(json.at("history"));
    project.cuts = committed_cuts(project.history);
    project.discards = committed_discards(project.history);
    project.discarded = solids_from(json.at("discarded"));
    if (project.discarded.size() != project.discards.size()) {
        throw InputError(InputFault::config, "its list of discarded pieces is not that of its decisions");
    }
    if (json.contains("beam")) project.beam = beam_from(json.at("beam"), project.history);
    if (json.contains("verdict")) project.review = review_from(json.at("verdict"));
    project.pieces = solids_from(json.at("pieces"));
    project.fragment_list = solids_from(json.at("fragments"));
    project.warnings = json.at("warnings").get<std::vector<std::string>>();
    project.has_programs = json.at("programs").get<bool>();
    project.tools = json.value("tools", std::vector<std::uint16_t>());
    project.jobs = jobs_from(json.at("jobs"));
    return project;
}

}  // namespace

std::string to_json(const Project& project) {
    Json json{{"schema", schema},
              {"scan", json_of(project.scan)},
              {"preset", project.preset},
              {"settings", json_of(project.settings)},
              {"fragment_choice", name_of_value(fragment_names, project.fragments)},
              {"stage", name_of_value(stage_names, project.stage)},
              {"ended_because", project.ended_because},
              {"history", json_of(project.history)},
              {"pieces", list_of(project.pieces)},
              {"fragments", list_of(project.fragment_list)},
              {"discarded", list_of(project.discarded)},
              {"warnings", project.warnings},
              {"programs", project.has_programs},
              {"jobs", list_of(project.jobs)}};
    if (!project.tools.empty()) json["tools"] = project.tools;
    if (project.ignored) json["ignored"] = json_of(*project.ignored);
    if (project.load) json["load"] = json_of(*project.load);
    if (project.no_cut) json["no_cut"] = json_of(*project.no_cut);
    if (project.beam) json["beam"] = json_of(*project.beam);
    if (project.review) json["verdict"] = json_of(*project.review);
    for (const RevertedTrial& trial : project.reverted) json["reverted"].push_back(json_of(trial));
    return text_of(json) + "\n";
}

Project project_from_json(std::string_view text, const std::string& name) {
    try {
        return from_json(Json::parse(text));
    } catch (const Json::parse_error& e) {
        throw InputError(InputFault::config, name + " is not JSON from byte " + std::to_string(e.byte) + " on",
                         "restore the file, or prepare the scan again");
    } catch (const Json::exception&) {  // its message is about the library
        throw InputError(InputFault::config,
                         name + " is not a project of this version: a value is missing, or is not of the right kind",
                         "restore the file, or prepare the scan again");
    } catch (const InputError& e) {
        throw InputError(InputFault::config, name + " is not a project of this version: " + e.what(),
                         "restore the file, or prepare the scan again");
    }
}

}  // namespace qchopper

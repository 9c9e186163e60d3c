// One table per object of the JSON. Everything that the history determines is derived from it.

#include "app/store/project_json.h"

#include <algorithm>

#include "app/store/value_fields.h"
#include "base/error.h"
#include "base/json_schema.h"
#include "cam/job/setup_fields.h"

namespace qchopper {
namespace {

using namespace json_values;

// A decision as the object of its one key.
struct DecisionFields {
    std::optional<Cut> cut;
    std::optional<Weights> weights;
    std::optional<Discards> discards;
    std::optional<Cut> replacement;
    std::optional<SetupOrder> setup;
    bool reset = false;
};

DecisionFields to_fields(const Decision& decision) {
    DecisionFields own;
    if (const Cut* cut = std::get_if<Cut>(&decision)) own.cut = *cut;
    if (const auto* change = std::get_if<WeightsChange>(&decision)) own.weights = change->weights;
    if (const auto* discards = std::get_if<Discards>(&decision)) own.discards = *discards;
    if (const auto* other = std::get_if<Replacement>(&decision)) own.replacement = other->cut;
    if (const auto* order = std::get_if<SetupOrder>(&decision)) own.setup = *order;
    own.reset = std::holds_alternative<Reset>(decision);
    return own;
}

Decision to_decision(const DecisionFields& own) {
    if (own.cut) return *own.cut;
    if (own.replacement) return Replacement{*own.replacement};
    if (own.weights) return WeightsChange{*own.weights};
    if (own.discards && own.discards->empty()) throw std::runtime_error("a decision discards no piece");
    if (own.discards) return *own.discards;
    if (own.setup) return *own.setup;
    if (own.reset) return Reset{};
    throw std::runtime_error(
        "a decision is neither a cut nor a replacement nor a discarded piece nor a setup nor weights nor a reset");
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

}  // namespace

constexpr auto names_of(EndReason) {
    return EnumNames<EndReason, 6>{{{EndReason::rules_hold, "rules_hold"},
                                    {EndReason::no_rule, "no_rule"},
                                    {EndReason::no_plane, "no_plane"},
                                    {EndReason::passed_over, "passed_over"},
                                    {EndReason::max_cuts, "max_cuts"},
                                    {EndReason::time_limit, "time_limit"}}};
}
constexpr auto names_of(FragmentChoice) {
    return EnumNames<FragmentChoice, 2>{{{FragmentChoice::keep, "keep"}, {FragmentChoice::drop, "drop"}}};
}

template <class V, Of<RepairChoices> T>
void fields(V& v, T& repair) {
    v("snap_borders_mm", repair.snap_borders_mm);
    v.converted(
        "fill", repair.fill, [](Fill fill) { return name_of(fill); },
        [](const std::string& name) {
            const std::optional<Fill> fill = fill_named(name);
            if (!fill) throw std::runtime_error("\"" + name + "\" fills no hole");
            return *fill;
        });
    v("resolve_self_intersections", repair.resolve_self_intersections);
    v("smooth_pen_grooves", repair.smooth_pen_grooves);
    v("alpha_wrap_mm", repair.alpha_wrap_mm);
}

template <class V, Of<ScanSource> T>
void fields(V& v, T& scan) {
    v("path", scan.path);
    v("sha256", scan.sha256);
    v.converted(
        "units", scan.unit, [](Unit unit) { return name_of(unit); },
        [](const std::string& name) { return unit_named(name); });
    v("scale", scan.scale);
    v("centre_mm", scan.centre);
    v("faces", scan.faces);
    v("volume_mm3", scan.volume_mm3);
    v("warnings", scan.warnings);
    v("repair", scan.repair);
}

template <class V, Of<StructureOptions> T>
void fields(V& v, T& load) {
    v("upright", load.up);
    v("density_kg_per_m3", load.density_kg_per_m3);
    v("strength_mpa", load.strength_mpa);
    v("own_weight", load.has_own_weight);
    v("force_n", load.force_n);
    v("poisson_ratio", load.poisson_ratio);
    v("voxel_mm", load.voxel_mm);
    v("unknowns", load.unknowns);
}

template <class V, Of<WrittenJob> T>
void fields(V& v, T& job) {
    v("piece", job.piece);
    v("sha256", job.sha256);
    v("project_id", job.project_id);
    v("part", job.part);
    v.maybe("place", job.place);
}

template <class V, Of<Discard> T>
void fields(V& v, T& discard) {
    v("piece", discard.piece);
    v("after", discard.after);
}

// One is an object, several are a list of them.
static void put(Json& at, const Discards& discards) {
    discards.size() == 1 ? put(at, discards.front()) : put<Discard>(at, discards);
}

static void put_schema(Json& at, const Discards& like) {
    put_schema(added_choice(at), Discard{});
    put_schema<Discard>(added_choice(at), like);
}

static void take(const Json& json, const std::string& key, Discards& discards) {
    is_list(json) ? take<Discard>(json, key, discards) : take(json, key, discards.emplace_back());
}

template <class V, Of<SetupOrder> T>
void fields(V& v, T& order) {
    v("piece", order.piece);
    v.maybe("base_number", order.base);
    v.maybe("max_directions", order.max_directions);
    v.maybe("tools", order.tools);
}

namespace {

template <class V, Of<DecisionFields> T>
void fields(V& v, T& decision) {
    v.maybe("cut", decision.cut);
    v.maybe("weights", decision.weights);
    v.maybe("discard", decision.discards);
    v.maybe("replacement", decision.replacement);
    v.maybe("setup", decision.setup);
    v.maybe("reset", decision.reset);
}

}  // namespace

static void put(Json& at, const Decision& decision) {
    put(at, to_fields(decision));
}

static void put_schema(Json& at, const Decision& decision) {
    put_schema(at, to_fields(decision));
}

static void take(const Json& json, const std::string& key, Decision& decision) {
    DecisionFields own;
    take(json, key, own);
    decision = to_decision(own);
}

template <class V, Of<History> T>
void fields(V& v, T& history) {
    v("weights_at_start", history.weights_at_start);
    v("committed", history.committed);
    v("decisions", history.decisions);
}

template <class V, Of<RevertedTrial> T>
void fields(V& v, T& trial) {
    v("piece", trial.piece);
    v("cuts", trial.cuts);
    v("before_mm2", trial.before_mm2);
    v("after_mm2", trial.after_mm2);
    v("is_cut_short", trial.is_cut_short);
    v.maybe("holds", trial.holds);
}

template <class V, Of<BeamState::Branch> T>
void fields(V& v, T& branch) {
    v("last", branch.last);
    v("passed_over", branch.passed_over);
    v.maybe("reverted", branch.reverted);
}

template <class V, Of<BeamState::Node> T>
void fields(V& v, T& node) {
    v("after", node.after);
    v("cut", node.cut);
}

template <class V, Of<BeamState> T>
void fields(V& v, T& beam) {
    v("from", beam.from);
    v("cuts", beam.cuts);
    v("branches", beam.branches);
    v.maybe("stuck", beam.stuck);
}

template <class V, Of<SetupReview> T>
void fields(V& v, T& review) {
    v("done", review.is_done);
    v("cuts_are_asked", review.are_cuts_asked);
    v("cuts", review.cuts);
}

template <class V, Of<Project> T>
void fields(V& v, T& project) {
    v.constant("schema", "qchopper-project-4", "is not qchopper-project-4");
    v("scan", project.scan);
    v("preset", project.preset);
    v("settings", project.settings);
    v("fragment_choice", project.fragments);
    v("stage", project.stage);
    v("end_reason", project.end_reason);
    v("ended_because", project.ended_because);
    v("history", project.history);
    v("pieces", project.pieces);
    v("fragments", project.fragment_list);
    v("discarded", project.discarded);
    v("warnings", project.warnings);
    v("programs", project.has_programs);
    v("jobs", project.jobs);
    v.maybe("tools", project.tools);
    v.maybe("all_fine_tools", project.has_all_fine_tools);
    v.maybe("ignored", project.ignored);
    v.maybe("load", project.load);
    v.maybe("no_cut", project.no_cut);
    v.maybe("beam", project.beam);
    v.maybe("review", project.review);
    v.maybe("reverted", project.reverted);
}

namespace {

void require(bool holds, const char* otherwise) {
    if (!holds) throw std::runtime_error(otherwise);
}

void check_settings(const SearchSettings& settings) {
    constexpr double least = 1e-9;
    constexpr double least_spacing = 0.1;  // a finer grid would exceed any memory
    const auto are_lengths = [](std::initializer_list<double> lengths, double min) {
        return std::all_of(lengths.begin(), lengths.end(),
                           [&](double length) { return length >= min && length <= 1e15; });
    };
    const ConnectorOptions& c = settings.objectives.connector;
    const Vec3 box = settings.objectives.print_volume.value_or(Vec3{1, 1, 1});
    require(are_lengths({box.x, box.y, box.z, c.diameter, c.depth}, least) && are_lengths({c.wall}, 0) &&
                are_lengths({c.spacing}, least_spacing),
            "a length of its print volume or of connectors is impossible");
    require(settings.candidates.offset_step_mm.value_or(1) > 0, "the step between offsets in it is not above 0");
}

void check_beam(const BeamState& beam, const History& history) {
    constexpr const char* no_cut = "a cut of its beam follows one that is not there";
    for (std::size_t i = 0; i < beam.cuts.size(); ++i) require(beam.cuts[i].after <= i, no_cut);
    for (const BeamState::Branch& branch : beam.branches) require(branch.last <= beam.cuts.size(), no_cut);
    require(!beam.stuck || beam.stuck->last <= beam.cuts.size(), no_cut);
    require(belongs_to(beam, history), "its beam is not of the cuts in force");
}

void check(const Project& project) {
    check_settings(project.settings);
    require(project.history.committed <= project.history.decisions.size(),
            "more decisions are in force than there are");
    require(are_replacements_possible(project.history),
            "a replaced cut of it is not there, or its pieces were cut further");
    require(project.discarded.size() == committed_discards(project.history).size(),
            "its list of discarded pieces is not that of its decisions");
    if (project.beam) check_beam(*project.beam, project.history);
}

// What the file does not hold, because it follows from the rest.
void derive(Project& project) {
    const std::optional<SymmetryPlane>& symmetry = project.settings.candidates.symmetry;
    if (symmetry) project.settings.objectives.symmetry_plane = symmetry->plane;
    project.cuts = committed_cuts(project.history);
    project.discards = committed_discards(project.history);
}

}  // namespace

std::string to_json(const Project& project) {
    return to_document(project, 1);
}

std::string project_schema() {
    return schema_of_document<Project>("project.json of qchopper");
}

Project project_from_json(std::string_view text, const std::string& name) {
    constexpr const char* to_do = "restore the file, or prepare the scan again";
    try {
        Project project;
        from_document(text, project, false);
        check(project);
        derive(project);
        return project;
    } catch (const NotJson& fault) {
        throw InputError(InputFault::config, name + " " + fault.what(), to_do);
    } catch (const std::runtime_error& fault) {
        throw InputError(InputFault::config, name + " is not a project of this version: " + fault.what(), to_do);
    }
}

}  // namespace qchopper

// By tables of fields. A key that no table has read is refused, so that none is without effect: what was read is
// written again, and a key of the request that is not in it is not known. O(body).

#include "app/console/worker/console_requests.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_schema.h"

namespace qchopper {

using json_values::Json;

namespace {

constexpr const char* refused_to_do = "load the page again; docs/developer/console.md lists what may be asked";
constexpr const char* whole = "it";       // the body, in messages
constexpr std::size_t longest_said = 40;  // of what the client has named

// Rules, as JsonReader takes them.
const char* is_plane(const std::vector<double>& numbers) {
    if (numbers.size() != 4) return "is not of four numbers";
    return json_values::is_direction({numbers[0], numbers[1], numbers[2]});
}

const char* is_place(const std::optional<std::size_t>& place) {
    return place && *place == 0 ? "begins at 1" : nullptr;
}

}  // namespace

template <class V, Of<GivenWeights> T>
void fields(V& v, T& weights) {
    for (std::size_t i = 0; i < all_objectives.size(); ++i) v.maybe(all_objectives[i].key, weights.weight[i]);
}

template <class V, Of<CutOrder> T>
void fields(V& v, T& cut) {
    v.maybe("piece", cut.piece);
    v("plane", cut.plane, is_plane);
    v.maybe("k", cut.k, {}, is_place);
}

template <class V, Of<NamedPieces> T>
void fields(V& v, T& named) {
    v("pieces", named.pieces);
}

template <class V, Of<SetupRequest> T>
void fields(V& v, T& setup) {
    v.maybe("piece", setup.piece);
    v.maybe("base", setup.base);
    v.maybe("orientations", setup.max_directions);
    v.maybe("automatic", setup.is_free);
}

template <class V, Of<DecisionBody> T>
void fields(V& v, T& decision) {
    v.maybe("cut", decision.cut);
    v.maybe("weights", decision.weights);
    v.maybe("discard", decision.discard);
    v.maybe("setup", decision.setup);
    v.maybe("undo", decision.undo);
    v.maybe("redo", decision.redo);
    v.maybe("back_to", decision.back_to);
    v.maybe("reset", decision.reset);
}

template <class V, Of<RankQuestion> T>
void fields(V& v, T& question) {
    v.maybe("piece", question.piece);
    v.maybe("weights", question.weights);
    v.maybe("top", question.top, 10);
}

template <class V, Of<PreviewQuestion> T>
void fields(V& v, T& question) {
    v.maybe("piece", question.piece);
    v("plane", question.plane, is_plane);
    v.maybe("setups", question.setups);
}

template <class V, Of<ExplainQuestion> T>
void fields(V& v, T& question) {
    v.maybe("cut", question.cut);
}

template <class V, Of<JobsQuestion> T>
void fields(V&, T&) {}

template <class V, Of<DisplayQuestion> T>
void fields(V&, T&) {}

template <class V, Of<QuestionBody> T>
void fields(V& v, T& question) {
    v.maybe("lane", question.lane);
    v.maybe("rank", question.rank);
    v.maybe("preview", question.preview);
    v.maybe("explain", question.explain);
    v.maybe("setups", question.setups);
    v.maybe("jobs", question.jobs);
    v.maybe("display", question.display);
}

template <class V, Of<RepairBody> T>
void fields(V& v, T& repair) {
    v.maybe("fill", repair.fill);
    v.maybe("snap_borders_mm", repair.snap_borders_mm);
    v.maybe("alpha_wrap_mm", repair.alpha_wrap_mm);
    v.maybe("resolve_self_intersections", repair.resolve_self_intersections);
    v.maybe("smooth_pen_grooves", repair.smooth_pen_grooves);
}

template <class V, Of<CheckBody> T>
void fields(V& v, T& check) {
    v("scan", check.scan);
    v.maybe("units", check.units);
    v.maybe("deep", check.deep);
}

template <class V, Of<NewProjectBody> T>
void fields(V& v, T& project) {
    v("check", project.check);
    v("name", project.name);
    v.maybe("units", project.units);
    v.maybe("scale", project.scale);
    v.maybe("cell", project.cell);
    v.maybe("preset", project.preset);
    v.maybe("fragment_volume_mm3", project.fragment_volume_mm3);
    v.maybe("size_ok", project.size_ok);
    v.maybe("repair", project.repair);
    v.maybe("cuts_of", project.cuts_of);
    v.maybe("strokes", project.strokes);
}

template <class V, Of<WorkBody> T>
void fields(V& v, T& work) {
    v("kind", work.kind);
    v.maybe("piece", work.piece);
    v.maybe("part", work.part);
}

template <class V, Of<PlanOrder> T>
void fields(V& v, T& plan) {
    v.maybe("pieces", plan.pieces);
    v.maybe("again", plan.is_again);
    v.maybe("accept_unreachable", plan.accept_unreachable);
    v.maybe("real", plan.is_for_real_cell);
}

template <class V, Of<HandOverBody> T>
void fields(V& v, T& order) {
    v("plan", order.plan);
    v.maybe("typed", order.typed);
}

constexpr auto names_of(QueueAction) {
    return EnumNames<QueueAction, 3>{
        {{QueueAction::pause, "pause"}, {QueueAction::go_on, "go_on"}, {QueueAction::remove, "remove"}}};
}

template <class V, Of<QueueBody> T>
void fields(V& v, T& queue) {
    v("action", queue.action);
    v.maybe("entry", queue.entry);
}

template <class V, Of<CellCommandBody> T>
void fields(V& v, T& order) {
    v("command", order.command);
    v.maybe("job", order.job);
}

template <class V, Of<SimulatorBody> T>
void fields(V& v, T& order) {
    v("line", order.line);
}

template <class V, Of<TicketBody> T>
void fields(V& v, T& ticket) {
    v("path", ticket.path);
}

namespace {

// Why a value is not as its schema says in its keys, at any depth; empty: it is. An object of which every key may be
// left out is read of anything.
std::string wrong_key(const std::string& name, const Json& value, const Json& schema) {
    if (schema.contains("anyOf")) {
        return value.is_null() ? std::string() : wrong_key(name, value, schema.at("anyOf").front());
    }
    const auto known = schema.find("properties");
    if (known == schema.end()) return {};
    if (!value.is_object()) return name + " is not an object";
    for (const auto& [key, inner] : value.items()) {
        const auto found = known->find(key);
        if (found == known->end()) return key.substr(0, longest_said) + " is not known";
        std::string wrong = wrong_key(key, inner, *found);
        if (!wrong.empty()) return wrong;
    }
    return {};
}

template <class Body>
Body read_body(const std::string& json) {
    try {
        Body body;
        json_values::from_document(json, body, false);
        json_values::read_document(
            json,
            [&](const Json& given) {
                Json schema;
                json_values::put_schema(schema, Body{});
                const std::string wrong = wrong_key(whole, given, schema);
                if (!wrong.empty()) throw std::runtime_error(wrong);
            },
            false);
        return body;
    } catch (const std::runtime_error& e) {
        throw InputError(InputFault::use, std::string("the request is wrong: ") + e.what(), refused_to_do);
    }
}

void check_one(int count) {
    if (count == 1) return;
    throw InputError(InputFault::use, "the request asks for " + std::to_string(count) + " things, and one is wanted",
                     refused_to_do);
}

}  // namespace

PlanOrder read_plan(const std::string& json) {
    return read_body<PlanOrder>(json);
}

std::string to_json(const PlanOrder& order) {
    return json_values::to_document(order, -1);
}

HandOverBody read_hand_over(const std::string& json) {
    return read_body<HandOverBody>(json);
}

QueueBody read_queue(const std::string& json) {
    return read_body<QueueBody>(json);
}

CellCommandBody read_cell_command(const std::string& json) {
    return read_body<CellCommandBody>(json);
}

SimulatorBody read_simulator(const std::string& json) {
    return read_body<SimulatorBody>(json);
}

CheckBody read_check(const std::string& json) {
    return read_body<CheckBody>(json);
}

RepairBody read_repair(const std::string& json) {
    return read_body<RepairBody>(json);
}

NewProjectBody read_new_project(const std::string& json) {
    return read_body<NewProjectBody>(json);
}

WorkBody read_work(const std::string& json) {
    return read_body<WorkBody>(json);
}

TicketBody read_ticket(const std::string& json) {
    return read_body<TicketBody>(json);
}

DecisionBody read_decision(const std::string& json) {
    DecisionBody d = read_body<DecisionBody>(json);
    check_one(int{d.cut.has_value()} + int{d.weights.has_value()} + int{d.discard.has_value()} +
              int{d.setup.has_value()} + int{d.undo.has_value()} + int{d.redo.has_value()} +
              int{d.back_to.has_value()} + int{d.reset});
    if (d.setup && (!d.setup->piece || !d.setup->decides())) check_one(0);
    return d;
}

QuestionBody read_question(const std::string& json) {
    QuestionBody q = read_body<QuestionBody>(json);
    check_one(int{q.rank.has_value()} + int{q.preview.has_value()} + int{q.explain.has_value()} +
              int{q.setups.has_value()} + int{q.jobs.has_value()} + int{q.display.has_value()});
    if (q.setups && q.setups->decides()) check_one(0);
    return q;
}

}  // namespace qchopper

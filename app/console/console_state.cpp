// By tables of fields. O(document).

#include "app/console/console_state.h"

#include "app/console/worker/answer_fields.h"

namespace qchopper {

constexpr auto names_of(WorkState) {
    return EnumNames<WorkState, 7>{{{WorkState::queued, "queued"},
                                    {WorkState::running, "running"},
                                    {WorkState::stopping, "stopping"},
                                    {WorkState::stopped, "stopped"},
                                    {WorkState::done, "done"},
                                    {WorkState::failed, "failed"},
                                    {WorkState::lost, "lost"}}};
}

namespace {

std::optional<std::string> text_or_nothing(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(text);
}

template <class T>
std::string line_of(const T& value) {
    return one_line(json_values::to_document(value, -1));
}

}  // namespace

template <class V, Of<Work> T>
void fields(V& v, T& work) {
    v("id", work.id);
    v("kind", work.kind);
    v.written("of", [&] { return text_or_nothing(work.of); });
    v("state", work.state);
    v("what", work.what);
    v("done", work.done);
    v("total", work.total);
    v("elapsed_s", work.elapsed_s);
    v("remaining_s", work.remaining_s);
    v("messages", work.messages);
    v("result", work.result);
    v("error", work.error);
}

template <class V, Of<ProjectSummary> T>
void fields(V& v, T& project) {
    v("id", project.id);
    v("name", project.name);
    v("stage", project.stage);
    v("revision", project.revision);
    v.written("undo", [&] { return text_or_nothing(project.undo); });
    v.written("redo", [&] { return text_or_nothing(project.redo); });
    v("writer", project.writer);
}

template <class V, Of<ProjectChange> T>
void fields(V& v, T& change) {
    fields(v, change.project);
    v("by", change.by);
    v("sentence", change.sentence);
}

template <class V, Of<ListedScan> T>
void fields(V& v, T& scan) {
    v("id", scan.id);
    v("name", scan.name);
    v("bytes", scan.bytes);
}

template <class V, Of<ListedProject> T>
void fields(V& v, T& project) {
    v("id", project.id);
    v("name", project.name);
    v("stage", project.stage);
    v("cuts", project.cuts);
    v("pieces", project.pieces);
    v("scan", project.scan);
    v.written("problem", [&] { return text_or_nothing(project.problem); });
}

template <class V, Of<FolderList> T>
void fields(V& v, T& list) {
    v.constant("schema", "qchopper-console-files-1", nullptr);
    v("folder", list.folder);
    v("scans", list.scans);
    v("projects", list.projects);
    v("cut_off", list.is_cut_off);
}

template <class V, Of<NamedChoice> T>
void fields(V& v, T& choice) {
    v("name", choice.name);
    v("sentence", choice.sentence);
}

template <class V, Of<ConsoleChoices> T>
void fields(V& v, T& choices) {
    v.constant("schema", "qchopper-console-choices-1", nullptr);
    v("units", choices.units);
    v("presets", choices.presets);
    v("cells", choices.cells);
}

template <class V, Of<ConsoleHello> T>
void fields(V& v, T& hello) {
    v.constant("schema", "qchopper-console-hello-1", nullptr);
    v("server", hello.server);
    v("version", hello.version);
    v("page", hello.page);
}

template <class V, Of<ConsoleState> T>
void fields(V& v, T& state) {
    v.constant("schema", "qchopper-console-state-1", nullptr);
    v("event", state.event);
    v("read_only", state.is_read_only);
    v("dispatch", state.dispatch);
    v("simulator", state.has_simulator);
    v("folder", state.folder);
    v("projects", state.projects);
    v("work", state.work);
    v("cells", state.cells);
    v("queue", state.queue);
    v("paused", state.is_paused);
}

template <class V, Of<ShownProject> T>
void fields(V& v, T& project) {
    v.constant("schema", "qchopper-console-project-1", nullptr);
    fields(v, project.summary);
    v("decisions", project.decisions);
    v("history", project.history);
    v("segment", project.segment);
}

template <class V, Of<CheckedScan> T>
void fields(V& v, T& checked) {
    v("check", checked.check);
    v("inspect", checked.inspect);
    v("mesh", checked.mesh);
}

template <class V, Of<ShownRepair> T>
void fields(V& v, T& repaired) {
    v("repair", repaired.repair);
    v("before", repaired.before);
    v("after", repaired.after);
}

template <class V, Of<MadeProject> T>
void fields(V& v, T& made) {
    v("project", made.project);
    v("segment", made.segment);
}

template <class V, Of<BegunWork> T>
void fields(V& v, T& begun) {
    v("work", begun.work);
}

template <class V, Of<TicketAddress> T>
void fields(V& v, T& address) {
    v("path", address.path);
}

template <class V, Of<OfferedPlan> T>
void fields(V& v, T& offered) {
    fields(v, offered.plan);
    v("plan", offered.id);
    v("kind", offered.kind);
    v("expires_s", offered.expires_s);
}

template <class V, Of<ShownQueue> T>
void fields(V& v, T& shown) {
    v("queue", shown.queue);
}

bool is_over(WorkState state) {
    return state == WorkState::stopped || state == WorkState::done || state == WorkState::failed ||
           state == WorkState::lost;
}

std::string to_json(const Work& work) {
    return line_of(work);
}

std::string to_json(const ProjectChange& change) {
    return line_of(change);
}

std::string to_json(const FolderList& list) {
    return line_of(list);
}

std::string to_json(const ConsoleChoices& choices) {
    return line_of(choices);
}

std::string to_json(const ConsoleHello& hello) {
    return line_of(hello);
}

std::string to_json(const ConsoleState& state) {
    return line_of(state);
}

std::string to_json(const ShownProject& project) {
    return line_of(project);
}

std::string to_json(const CheckedScan& checked) {
    return line_of(checked);
}

std::string to_json(const ShownRepair& repaired) {
    return line_of(repaired);
}

std::string to_json(const MadeProject& made) {
    return line_of(made);
}

std::string to_json(const BegunWork& begun) {
    return line_of(begun);
}

std::string to_json(const TicketAddress& address) {
    return line_of(address);
}

std::string to_json(const OfferedPlan& plan) {
    return line_of(plan);
}

std::string to_json(const ShownQueue& queue) {
    return line_of(queue);
}

}  // namespace qchopper

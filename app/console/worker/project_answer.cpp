// By tables of fields. O(document).

#include "app/console/worker/project_answer.h"

#include "app/console/worker/answer_fields.h"

namespace qchopper {

template <class V, Of<ProjectAnswer> T>
void fields(V& v, T& answer) {
    v("revision", answer.revision);
    v("stage", answer.stage);
    v("done", answer.done);
    v("undo", answer.undo);
    v("redo", answer.redo);
    v("decisions", answer.decisions);
    v.maybe("history", answer.history);
    v.maybe("pieces", answer.pieces);
    v.maybe("states", answer.states);
    v("document", answer.document);
}

std::string to_json(const ProjectAnswer& answer) {
    return one_line(json_values::to_document(answer, -1));
}

ProjectAnswer read_project_answer(const std::string& json) {
    ProjectAnswer answer;
    json_values::from_document(json, answer, false);
    return answer;
}

JsonText to_text(const DispatchPlan& plan) {
    return {one_line(json_values::to_document(plan, -1))};
}

DispatchPlan read_dispatch_plan(const JsonText& document) {
    DispatchPlan plan;
    json_values::from_document(document.text, plan, false);
    return plan;
}

}  // namespace qchopper

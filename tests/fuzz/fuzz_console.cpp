// Requests to the operator's console: bodies, heads with their routes, lines of its worker. The first byte says which.

#include <algorithm>

#include "app/console/admission.h"
#include "app/console/worker/console_requests.h"
#include "app/console/worker/worker.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

void demand_plane(const std::vector<double>& plane) {
    demand(plane.size() == 4);
    const double length = plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2];
    demand(length > 0.99 && length < 1.01);
    demand(plane[3] - plane[3] == 0);  // finite
}

void decide(const std::string& text) {
    const DecisionBody body = read_decision(text);
    demand(int{body.cut.has_value()} + int{body.weights.has_value()} + int{body.discard.has_value()} +
               int{body.setup.has_value()} + int{body.undo.has_value()} + int{body.redo.has_value()} +
               int{body.back_to.has_value()} + int{body.reset} ==
           1);
    if (body.cut) demand_plane(body.cut->plane);
    if (body.cut && body.cut->k) demand(*body.cut->k > 0);
    if (body.setup) demand(body.setup->piece && body.setup->decides());
}

void ask(const std::string& text) {
    const QuestionBody body = read_question(text);
    demand(int{body.rank.has_value()} + int{body.preview.has_value()} + int{body.explain.has_value()} +
               int{body.setups.has_value()} ==
           1);
    if (body.preview) demand_plane(body.preview->plane);
    if (body.setups) demand(!body.setups->decides());
}

constexpr auto is_in_id = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
};

std::string taken_line(std::string& text) {
    const std::size_t end = text.find('\n');
    std::string line = text.substr(0, end);
    text.erase(0, end == std::string::npos ? end : end + 1);
    return line;
}

// Lines: method, target, fields as NAME:VALUE.
void admit(std::string text) {
    HttpRequest head;
    head.method = taken_line(text);
    head.target = taken_line(text);
    while (!text.empty()) {
        const std::string line = taken_line(text);
        const std::size_t colon = line.find(':');
        if (colon != std::string::npos) head.fields.emplace_back(line.substr(0, colon), line.substr(colon + 1));
    }
    const RouteMatch match = match_route(head.method, head.path());
    if (match.row != nullptr) {
        demand(match.row->method == head.method);
        demand(match.ids.size() == static_cast<std::size_t>(std::ranges::count(match.row->path, '*')));
        for (const std::string& id : match.ids) {
            demand(!id.empty() && id.size() <= 64 && id != "." && id != ".." && std::ranges::all_of(id, is_in_id));
        }
    }
    const ConsoleRules rules{"0123456789abcdef0123456789abcdef", {"a:1"}, false};
    const auto refused = refusal_of(head, match, rules);
    if (refused) {
        demand(refused->status >= 400 && refused->status < 500 && !refused->why.empty());
        return;
    }
    demand(match.row != nullptr && head.value("Host") == "a:1" && head.target.find('%') == std::string::npos);
    demand(match.row->access != RouteAccess::moves);  // it is not said to come from this machine
    if (match.row->access != RouteAccess::open) demand(head.value("Authorization") == "Bearer " + rules.key);
    if (match.row->needs_revision) demand(!revision_of(head).empty());
}

void answer(const std::string& text) {
    const std::optional<WorkerAnswer> read = read_answer(text);
    if (!read) return;
    const std::optional<WorkerAnswer> again = read_answer(to_line(*read));
    demand(again && again->status == read->status && again->document == read->document);
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    if (size == 0) return 0;
    const std::string text = text_of(data + 1, size - 1);
    or_refused(InputFault::use, [&] {
        switch (*data % 9) {
            case 0:
                return decide(text);
            case 1:
                return ask(text);
            case 2:
                return admit(text);
            case 3:
                return answer(text);
            case 4:
                return static_cast<void>(read_check(text));
            case 5:
                return static_cast<void>(read_repair(text));
            case 6:
                return static_cast<void>(read_new_project(text));
            case 7:
                return static_cast<void>(read_work(text));
            default:
                return static_cast<void>(read_ticket(text));
        }
    });
    return 0;
}

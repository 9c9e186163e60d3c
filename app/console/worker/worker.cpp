// The requests are those of the command line (decide.h, setup_project.h, explain.h), so the answers are its documents.
// O(what is asked), beside a SHA-256 of project.json.

#include "app/console/worker/worker.h"

#include <array>
#include <iterator>
#include <new>

#include "app/console/worker/console_requests.h"
#include "app/console/worker/dispatch_plan.h"
#include "app/console/worker/project_answer.h"
#include "app/console/worker/resident_project.h"
#include "app/console/worker/shown_pieces.h"
#include "app/engine/explain.h"
#include "app/engine/segment_project.h"
#include "app/report/explanation.h"
#include "app/report/notices.h"
#include "app/report/segment_report.h"
#include "app/report/setup_report.h"
#include "app/store/project_json.h"
#include "base/enum_names.h"
#include "base/error.h"
#include "base/json_fields.h"

namespace qchopper {

constexpr auto names_of(WorkerTask) {
    return EnumNames<WorkerTask, 4>{{{WorkerTask::show, "show"},
                                     {WorkerTask::decide, "decide"},
                                     {WorkerTask::ask, "ask"},
                                     {WorkerTask::plan, "plan"}}};
}

template <class V, Of<WorkerRequest> T>
void fields(V& v, T& request) {
    v("task", request.task);
    v("revision", request.revision);
    v("body", request.body);
}

template <class V, Of<WorkerAnswer> T>
void fields(V& v, T& answer) {
    v("status", answer.status);
    v("document", answer.document);
}

namespace {

std::optional<std::string> text_or_nothing(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(text);
}

JsonText text_of_document(const Document& document) {
    return {text_of(document)};
}

constexpr std::array fault_statuses{400U, 422U, 404U, 409U, 507U, 423U, 422U};  // in the order of InputFault
static_assert(static_cast<std::size_t>(InputFault::config) + 1 == std::size(fault_statuses));

Plane plane_of(const std::vector<double>& numbers) {
    return {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

constexpr const char* nothing_changed = "Nothing was changed.";

std::vector<std::string> sentences_of(const History& history) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < history.committed; ++i) sentences.push_back(describe(history.decisions[i]));
    return sentences;
}

class Worker {
 public:
    Worker(const std::filesystem::path& folder, std::string program_version, const ProjectContext& context)
        : resident_(folder, context), program_version_(std::move(program_version)), context_(context) {}

    WorkerAnswer answer(const WorkerRequest& request) {
        ProjectAnswer result;
        const bool is_bound = request.task == WorkerTask::decide || request.task == WorkerTask::plan;
        resident_.with_project(is_bound ? request.revision : "", [&](OpenProject& open) {
            switch (request.task) {
                case WorkerTask::show:
                    result.document = text_of_document(document(segment_open_project(open, {}, context_)));
                    result.history = sentences_of(open.project().history);
                    break;
                case WorkerTask::decide:
                    decide_in(open, read_decision(request.body), result);
                    break;
                case WorkerTask::ask:
                    ask_in(open, read_question(request.body), result);
                    break;
                case WorkerTask::plan:
                    result.document = to_text(plan_dispatch(open.folder(), read_plan(request.body), context_));
                    break;
            }
            const Project& project = open.project();
            result.stage = names_of(project.stage)(project.stage);
            result.undo = text_or_nothing(undo_text(project.history));
            result.redo = text_or_nothing(redo_text(project.history));
            result.decisions = project.history.committed;
        });
        result.revision = resident_.revision();
        return {200, to_json(result)};
    }

 private:
    // The pieces of the last time where they are the same: to find them in the cache takes a hash of their meshes.
    const std::vector<ShownPiece>& shown(OpenProject& open) {
        std::vector<std::shared_ptr<const TriangleMesh>> meshes;
        for (const Piece& piece : open.segmentation().pieces) meshes.push_back(piece.mesh);
        if (meshes != shown_meshes_) {
            shown_pieces_ = shown_pieces(open, context_);
            shown_meshes_ = std::move(meshes);
        }
        return shown_pieces_;
    }

    // `is_of_ranking`: what is refused is a plane that is not at its place any more.
    void take(const SegmentAnswer& answer, ProjectAnswer& result, bool is_of_ranking) {
        if (!answer.is_demand_met && !answer.notes.empty()) {
            if (is_of_ranking) throw StaleRequest(answer.notes.back().text);
            throw ImpossibleRequest(answer.notes.back().text);
        }
        result.done = text_or_nothing(answer.done.text);
        result.document = text_of_document(document(answer));
    }

    void decide_in(OpenProject& open, const DecisionBody& body, ProjectAnswer& result) {
        const History& history = open.project().history;
        if (body.setup) {
            const SetupAnswer answer = setup_open_project(open, *body.setup, program_version_, context_);
            result.done = text_or_nothing(answer.done);
            result.document = text_of_document(document(answer));
            return;
        }
        ProjectRequest request;
        bool is_of_ranking = false;
        if (body.cut) {
            request.piece = body.cut->piece;
            if (body.cut->k) {
                request.accept = body.cut->k;
                request.expected_plane = plane_of(body.cut->plane);
                is_of_ranking = true;
            } else {
                request.plane = canonical(plane_of(body.cut->plane));
            }
        }
        request.weights = body.weights;
        if (body.discard) request.discard = DiscardRequest{body.discard->pieces, {}};
        request.undo = body.undo.has_value();
        request.redo = body.redo.has_value();
        request.reset = body.reset;
        expect_same(body.undo, undo_text(history));
        expect_same(body.redo, redo_text(history));
        if (body.back_to) {
            go_back(open, *body.back_to);
            take(segment_open_project(open, {}, context_), result, is_of_ranking);
            result.done = "The project is back at decision " + std::to_string(*body.back_to) + ".";
            return;
        }
        take(segment_open_project(open, request, context_), result, is_of_ranking);
    }

    static void expect_same(const std::optional<std::string>& expected, const std::string& now) {
        if (!expected || *expected == now) return;
        throw StaleRequest(now.empty() ? "there is nothing to take back or to do again" : "this would be: " + now);
    }

    static void go_back(OpenProject& open, std::size_t decisions) {
        if (decisions > open.project().history.committed) {
            throw StaleRequest("only " + std::to_string(open.project().history.committed) + " decisions are in force");
        }
        while (open.project().history.committed > decisions) open.undo();
    }

    void ask_in(OpenProject& open, const QuestionBody& body, ProjectAnswer& result) {
        if (body.jobs) {
            result.document = to_text(plan_dispatch(open.folder(), {}, context_));
            return;
        }
        if (body.display) {
            result.pieces = shown(open);
            return;
        }
        if (body.explain) {
            const Cut cut = cut_to_explain(open.project(),
                                           body.explain->cut == 0 ? std::nullopt : std::optional(body.explain->cut));
            result.document = text_of_document(document(explain(open, cut, context_), open.project(), ""));
            return;
        }
        if (body.setups) {
            result.document =
                text_of_document(document(setup_open_project(open, *body.setups, program_version_, context_)));
            if (body.setups->piece) result.states = shown_states(open, *body.setups->piece, context_);
            return;
        }
        ProjectRequest request;
        if (body.rank) {
            request.propose = true;
            request.piece = body.rank->piece;
            request.tried_weights = body.rank->weights;
            request.top = body.rank->top;
        }
        if (body.preview) {
            request.piece = body.preview->piece;
            request.preview = canonical(plane_of(body.preview->plane));
            request.preview_setups = body.preview->setups;
        }
        take(segment_open_project(open, request, context_), result, false);
    }

    ResidentProject resident_;
    std::vector<std::shared_ptr<const TriangleMesh>> shown_meshes_;  // of shown_pieces_
    std::vector<ShownPiece> shown_pieces_;
    std::string program_version_;
    ProjectContext context_;
};

WorkerAnswer answer_to(Worker& worker, const std::string& line) {
    try {
        WorkerRequest request;
        json_values::from_document(line, request, false);
        return worker.answer(request);
    } catch (const InputError& e) {
        return answer_to(e);
    } catch (const StaleRequest& e) {
        return error_answer(412, e.what(), nothing_changed, "look at the project as it is now, and decide again");
    } catch (const ImpossibleRequest& e) {
        return error_answer(409, e.what(), nothing_changed, "choose another plane");
    } catch (const Cancelled&) {
        throw;
    } catch (const std::bad_alloc&) {
        return error_answer(500, "out of memory", nothing_changed, "use a machine with more memory");
    } catch (const std::exception& e) {
        return error_answer(500, std::string("internal error: ") + e.what(), "", "report this with the scan");
    }
}

}  // namespace

std::string to_line(const WorkerAnswer& answer) {
    return one_line(json_values::to_document(answer, -1));
}

std::string to_line(const WorkerRequest& request) {
    return one_line(json_values::to_document(request, -1));
}

std::optional<WorkerAnswer> read_answer(const std::string& line) {
    try {
        WorkerAnswer answer;
        json_values::from_document(line, answer, false);
        return answer;
    } catch (const std::runtime_error&) {
        return {};
    }
}

WorkerAnswer error_answer(unsigned status, const std::string& what, const std::string& unchanged,
                          const Sentence& to_do) {
    return {status, text_of(error_document(what, unchanged, to_do, 1))};
}

WorkerAnswer answer_to(const InputError& error) {
    return error_answer(fault_statuses[static_cast<std::size_t>(error.fault)], error.what(), nothing_changed,
                        error.to_do);
}

void work_for_console(const std::filesystem::path& folder, const std::function<std::optional<std::string>()>& next_line,
                      const std::function<void(const std::string&)>& print, const std::string& program_version,
                      const ProjectContext& context) {
    Worker worker(folder, program_version, context);
    while (const std::optional<std::string> line = next_line()) print(to_line(answer_to(worker, *line)));
}

}  // namespace qchopper

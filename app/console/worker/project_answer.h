// What a worker has made of a request about its project, as a value and as JSON.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/console/worker/dispatch_plan.h"
#include "app/console/worker/json_text.h"
#include "app/console/worker/shown_pieces.h"

namespace qchopper {

struct ProjectAnswer {
    std::string revision;
    std::string stage;                // cutting, cut or done
    std::optional<std::string> done;  // the decision as a sentence
    std::optional<std::string> undo;  // "Undo cut 3 on piece C"
    std::optional<std::string> redo;
    std::size_t decisions = 0;         // in force
    std::vector<std::string> history;  // these as sentences, the oldest first; empty: they were not asked for
    std::vector<ShownPiece> pieces;    // as they are drawn; empty: likewise
    std::string states;                // of the faces of a piece as it is drawn (QCS1); empty: likewise
    JsonText document;                 // that of the command line, or of a plan
    bool operator==(const ProjectAnswer&) const = default;
};

std::string to_json(const ProjectAnswer& answer);
// The inverse. Throws std::runtime_error for any other text.
ProjectAnswer read_project_answer(const std::string& json);

JsonText to_text(const DispatchPlan& plan);
// The inverse; throws likewise.
DispatchPlan read_dispatch_plan(const JsonText& document);

}  // namespace qchopper

// The cost is that of cutting the scan again and of choosing the setups that are shown.

#include "app/engine/setup_project.h"

#include <algorithm>

#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "segment/access/piece_access.h"

namespace qchopper {
namespace {

std::size_t index_of(OpenProject& project, const std::string& piece) {
    if (const auto index = piece_named(project.segmentation(), piece)) return *index;
    throw InputError(InputFault::use, "the project has no piece " + piece,
                     "see its pieces by: qchopper segment " + shell_word(project.folder()));
}

void check_base(const Piece& piece, int base) {
    std::string numbers;
    for (const PieceBase& b : bases_of(piece)) {
        if (b.number == base) return;
        numbers += (numbers.empty() ? "" : ", ") + std::to_string(b.number);
    }
    throw InputError(InputFault::use, "piece " + piece.name + " has no base " + std::to_string(base),
                     "its bases are " + numbers);
}

// The order in force with what is requested changed.
SetupOrder order_of(const Project& project, const SetupRequest& request) {
    SetupOrder order{*request.piece, {}, {}};
    if (!request.is_free) order = committed_setup_order(project.history, order.piece);
    if (request.base) order.base = request.base;
    if (request.max_directions) order.max_directions = request.max_directions;
    if (!request.tools.empty()) order.tools = request.tools;
    return order;
}

PieceSetups setups_of(OpenProject& project, const Piece& piece) {
    PieceSetups shown{piece.name, {}, project.setups()->placed(piece)};
    const SetupOrder order = committed_setup_order(project.project().history, piece.name);
    if (!order.is_free()) shown.order = order;
    return shown;
}

}  // namespace

SetupAnswer setup_project(const std::filesystem::path& folder, const SetupRequest& request,
                          const std::string& program_version, const ProjectContext& context) {
    // What is only shown is shown of a project that another program is writing, and of one that cannot be written.
    std::optional<ProjectLock> lock;
    if (request.decides()) {
        lock.emplace(folder);
        clear_leftovers(folder);
    }
    OpenProject project(folder, context);
    project.check_cell();
    context.saved("The project is unchanged.");
    const std::vector<Piece>& pieces = project.segmentation().pieces;
    std::optional<std::size_t> index;
    if (request.piece) index = index_of(project, *request.piece);
    SetupAnswer answer;
    if (request.decides()) {
        const Piece& piece = pieces[*index];
        if (request.base) check_base(piece, *request.base);
        with_tools(project.setups()->cell(), request.tools);  // throws for tools that cannot be
        if (project.decide_setup(order_of(project.project(), request))) {
            answer.done = "The setup of piece " + piece.name + " is changed.";
            context.saved("The setup of piece " + piece.name + " is changed; its job is not written yet.");
            answer.job = project.write_job_again(*index, program_version);
        } else {
            answer.done = "This setup is in force already.";
        }
    }
    const StageTimer stage(context, "setups chosen");
    if (!index) project.setups()->place(pieces, context);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!index || *index == i) answer.pieces.push_back(setups_of(project, pieces[i]));
    }
    answer.folder = folder;
    answer.cell = project.setups()->cell();
    answer.ignored = project.project().ignored;
    answer.max_unreachable = max_unreachable(project.project(), answer.cell);
    return answer;
}

}  // namespace qchopper

// The cost is that of cutting the scan again and of choosing the setups that are shown.

#include "app/engine/setup_project.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "app/engine/planes_by_setups.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "segment/access/piece_access.h"
#include "segment/mesh/measure.h"

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

// The side of the point that is farthest from the plane.
bool is_above(const Piece& piece, const Plane& plane) {
    double farthest = 0;
    for (const Vec3& point : piece.mesh->points) {
        const double distance = height(plane.normal, point) - plane.offset;
        if (std::abs(distance) > std::abs(farthest)) farthest = distance;
    }
    return farthest > 0;
}

// Of a mapped setup.
SurfaceAreas surface_areas(const Piece& piece, const SetupChoice& choice) {
    assert(choice.states.size() == piece.mesh->triangles.size());
    constexpr double SurfaceAreas::*by_state[] = {&SurfaceAreas::reached, &SurfaceAreas::too_narrow,
                                                  &SurfaceAreas::steep,   &SurfaceAreas::holder,
                                                  &SurfaceAreas::hidden,  &SurfaceAreas::ignored};
    static_assert(static_cast<std::size_t>(SurfaceState::ignored) + 1 == std::size(by_state));
    const Setup& setup = choice.setups.front();
    SurfaceAreas areas;
    for (std::size_t t = 0; t < choice.states.size(); ++t) {
        const std::int32_t cut = cap_of(*piece.mesh, t);
        double SurfaceAreas::*const kind = setup.base && cut == *setup.base ? &SurfaceAreas::base
                                           : cut > 0 && setup.is_unmilled(cut)
                                               ? &SurfaceAreas::sawn
                                               : by_state[static_cast<std::size_t>(choice.states[t])];
        areas.*kind += norm(area_vector(*piece.mesh, t));
    }
    return areas;
}

}  // namespace

PlaneSetups setups_of_plane(OpenProject& project, std::size_t piece, const Ranked& plane, const Context& context) {
    project.check_cell();
    Setups& setups = *project.setups();
    PlaneSetups answer{setups.cell(), max_unreachable(project.project(), setups.cell()), {}};
    const StageTimer stage(context, "setups of a plane");
    const std::vector<Piece> made =
        pieces_made(project.segmentation(), piece, plane, project.project().settings.objectives.fragment_volume_mm3);
    setups.place(made, context);
    for (const Piece& own : made) {
        PieceSetups shown = setups_of(project, own);
        const SurfaceAreas areas = surface_areas(own, shown.piece_setup.choice);
        answer.pieces.push_back({own, is_above(own, plane.plane), std::move(shown), areas});
    }
    return answer;
}

SetupAnswer setup_open_project(OpenProject& project, const SetupRequest& request, const std::string& program_version,
                               const ProjectContext& context) {
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
    answer.folder = project.folder();
    answer.cell = project.setups()->cell();
    answer.ignored = project.project().ignored;
    answer.max_unreachable = max_unreachable(project.project(), answer.cell);
    return answer;
}

SetupAnswer setup_project(const std::filesystem::path& folder, const SetupRequest& request,
                          const std::string& program_version, const ProjectContext& context) {
    // What is only shown is shown of a project that another program is writing, and of one that cannot be written.
    std::optional<ProjectLock> lock;
    if (request.decides()) {
        lock.emplace(folder);
        clear_leftovers(folder);
    }
    OpenProject project(folder, context);
    return setup_open_project(project, request, program_version, context);
}

}  // namespace qchopper

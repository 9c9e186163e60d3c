// Opens the project, which cuts the scan again, and sets up the pieces of the shard alone. The cost is that of their
// programs.

#include "app/engine/work_project.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

#include "app/engine/open_project.h"
#include "app/jobs/piece_program.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/shared_progress.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

double box_area(const Piece& piece) {
    const Vec3 size = bounds(*piece.mesh).size();
    return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

void check(const Project& project, const std::filesystem::path& folder, const Cell& cell) {
    const std::string prepare = "qchopper prepare " + shell_word(folder) + " --no-programs";
    if (project.stage != Stage::done) {
        throw InputError(InputFault::use, folder.string() + " is not finished: its cuts may change", prepare);
    }
    const std::string because = no_programs_for(cell);
    if (!because.empty()) throw InputError(InputFault::use, "no programs are made for " + cell.name + ": " + because);
}

}  // namespace

std::vector<std::size_t> pieces_of(const Shard& shard, std::span<const Piece> pieces) {
    std::vector<double> areas;
    areas.reserve(pieces.size());
    for (const Piece& piece : pieces) areas.push_back(box_area(piece));
    std::vector<std::size_t> order(pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    std::vector<double> loads(shard.count, 0);
    std::vector<std::size_t> own;
    for (const std::size_t piece : order) {
        const auto least = std::min_element(loads.begin(), loads.end());
        *least += areas[piece];
        if (static_cast<std::size_t>(least - loads.begin()) == shard.number) own.push_back(piece);
    }
    return own;
}

WorkAnswer work_project(const std::filesystem::path& folder, const Shard& shard, const std::string& program_version,
                        const std::function<void(const WorkedPiece&)>& on_piece, const ProjectContext& context) {
    OpenProject open(folder, context);
    open.check_cell();
    check(open.project(), folder, open.setups()->cell());
    context.saved("The project is unchanged; programs that are made are kept, and the same command makes the rest.");
    const Segmentation& segmentation = open.segmentation();
    const std::vector<std::size_t> own = pieces_of(shard, segmentation.pieces);
    const std::vector<PieceJoint> joints =
        piece_joints(segmentation.pieces, joint_settings(&open.setups()->cell()), context);
    std::vector<Piece> pieces;
    pieces.reserve(own.size());
    for (const std::size_t piece : own) pieces.push_back(segmentation.pieces[piece]);
    open.setups()->place(pieces, context);
    std::vector<WorkedPiece> worked(own.size());
    SharedProgress progress(context, "programs made", own.size());
    std::mutex telling;
    std::atomic<std::size_t> next = 0;
    parallel_for(0, own.size(), [&](std::size_t) {  // the largest first, whatever the order of the loop
        context.check_cancelled();
        const std::size_t k = next++;
        Context quiet;
        quiet.cancelled = context.cancelled;
        worked[k] = keep_programs_of(folder, open.project(), segmentation, own[k], *open.setups(), joints,
                                     program_version, quiet);
        {
            const std::lock_guard lock(telling);
            if (on_piece) on_piece(worked[k]);
        }
        progress.add(1);
    });
    std::vector<std::size_t> by_index(own.size());
    std::iota(by_index.begin(), by_index.end(), std::size_t{0});
    std::sort(by_index.begin(), by_index.end(), [&](std::size_t a, std::size_t b) { return own[a] < own[b]; });
    WorkAnswer answer{folder, shard, segmentation.pieces.size(), {}};
    for (const std::size_t k : by_index) answer.pieces.push_back(std::move(worked[k]));
    return answer;
}

}  // namespace qchopper

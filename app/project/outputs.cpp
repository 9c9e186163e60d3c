// Every file is written aside and renamed. O(triangles) for pieces and jobs; pictures cost a ray per pixel.

#include "app/project/outputs.h"

#include <algorithm>
#include <cassert>
#include <mutex>
#include <optional>
#include <set>

#include "app/project/ordered_job.h"
#include "app/project/project_folder.h"
#include "app/project/shell_word.h"
#include "app/project/unreachable_picture.h"
#include "base/file.h"
#include "base/parallel.h"
#include "base/timings.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "segment/io/write_ply.h"
#include "segment/mesh/measure.h"
#include "segment/picture/exploded.h"
#include "segment/picture/picture.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

TriangleMesh together(const std::vector<Fragment>& fragments) {
    TriangleMesh all;
    for (const Fragment& fragment : fragments) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), fragment.mesh->points.begin(), fragment.mesh->points.end());
        for (std::size_t t = 0; t < fragment.mesh->triangles.size(); ++t) {
            const Triangle& v = fragment.mesh->triangles[t];
            all.triangles.push_back({v[0] + first, v[1] + first, v[2] + first});
            all.cap_of.push_back(cap_of(*fragment.mesh, t));
        }
    }
    assert(is_consistent(all));
    return all;
}

std::size_t place_of(const std::string& piece, const Segmentation& segmentation) {
    const auto found = std::find_if(segmentation.pieces.begin(), segmentation.pieces.end(),
                                    [&](const Piece& p) { return p.name == piece; });
    return static_cast<std::size_t>(found - segmentation.pieces.begin());
}

// Removes the files of a folder that are not in `keep`; the folder may be missing.
void remove_but(const fs::path& folder, const std::set<std::string>& keep) {
    std::error_code error;
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!keep.contains(entry.path().filename().string())) old.push_back(entry.path());
    }
    for (const fs::path& file : old) fs::remove(file, error);
}

}  // namespace

void write_pieces(const fs::path& folder, const Segmentation& segmentation, FragmentChoice fragments,
                  const Context& context) {
    fs::create_directories(folder / "pieces");
    std::set<std::string> written;
    for (const Piece& piece : segmentation.pieces) {
        context.progress("pieces written", written.size(), segmentation.pieces.size());
        const std::string name = piece.name + ".ply";
        assert(!piece.name.empty() && !written.contains(name));
        write_file(folder / "pieces" / name, to_ply(*piece.mesh));
        written.insert(name);
    }
    if (!segmentation.fragments.empty() && fragments == FragmentChoice::keep) {
        write_file(folder / "pieces" / "fragments.ply", to_ply(together(segmentation.fragments)));
        written.insert("fragments.ply");
    }
    remove_but(folder / "pieces", written);
}

double most_unreachable(const Project& project, const Cell& cell) {
    if (project.settings.stop.max_unreachable) return *project.settings.stop.max_unreachable;
    return cell.machine ? cell.machine->max_unreachable : 1;
}

namespace {

struct MadeJob {
    PieceReport report;
    std::optional<WrittenJob> written;  // nothing: the piece does not fit, and has no job
};

// Empty for a piece of which no more is out of reach than may be.
std::vector<ReachAdvice> advice_for(const fs::path& folder, const Project& project, const Piece& piece,
                                    const SurfaceReach& reach, const Cell& cell) {
    if (reach.unreachable_share() <= most_unreachable(project, cell)) return {};
    AdviceInput input;
    input.reach = reach;
    input.inside_share = inside_share(piece);
    input.tilt_deg = max_tilt_deg(cell);
    input.max_directions = SetupOptions{}.max_directions;
    for (const SetupOrder& order : committed_setup_orders(project.history)) {
        if (order.piece == piece.name) input.max_directions = order.max_directions.value_or(input.max_directions);
    }
    const std::string of_piece = shell_word(folder) + " --piece " + piece.name;
    input.segment_command = "qchopper segment " + of_piece + " --step";
    input.setup_command = "qchopper setup " + of_piece;
    return reach_advice(input, cell);
}

// Writes or removes the file of one job.
MadeJob make_job(const fs::path& folder, const Project& project, const Segmentation& segmentation, std::size_t index,
                 const Carving& carving, const Cell& cell, const std::string& program_version) {
    const Piece& piece = segmentation.pieces[index];
    MadeJob made{{piece.name, piece.mesh->triangles.size(), volume_mm3(*piece.mesh), carving, {}}, std::nullopt};
    made.report.carving.mesh.reset();
    made.report.carving.choice.states.clear();
    made.report.advice = advice_for(folder, project, piece, carving.setup().reach, cell);
    const fs::path file = folder / "jobs" / job_file_name(piece.name);
    if (!carving.fits()) {
        fs::remove(file);  // an earlier job of a piece that cannot be carved must not stay
        return made;
    }
    JobInput input;
    input.piece = piece;
    input.piece_no = static_cast<std::uint16_t>(index + 1);
    input.piece_count = static_cast<std::uint16_t>(segmentation.pieces.size());
    input.program_version = program_version;
    input.project_id = project_id(project);
    input.scan_sha256 = project.scan.sha256;
    input.cell = cell;
    input.setup = carving.setup();
    input.envelope = carving.envelope;
    input.work_envelope = carving.work_envelope;
    input.alternatives.assign(carving.choice.setups.begin() + 1, carving.choice.setups.end());
    input.states = carving.choice.states;
    input.max_unreachable = most_unreachable(project, cell);
    input.warnings = project.warnings;
    const Bytes bytes = job_file(input);
    write_file(file, bytes);
    made.written = written_job(piece.name, bytes, input.project_id);
    made.report.job = file;
    return made;
}

}  // namespace

PieceReport write_job(const fs::path& folder, Project& project, const Segmentation& segmentation, std::size_t index,
                      Setups& setups, const std::string& program_version) {
    const Piece& piece = segmentation.pieces[index];
    MadeJob made = make_job(folder, project, segmentation, index, setups.held(piece), setups.cell(), program_version);
    std::erase_if(project.jobs, [&](const WrittenJob& job) { return job.piece == piece.name; });
    const auto later = std::find_if(project.jobs.begin(), project.jobs.end(),
                                    [&](const WrittenJob& job) { return place_of(job.piece, segmentation) > index; });
    if (made.written) project.jobs.insert(later, *made.written);
    return std::move(made.report);
}

std::vector<PieceReport> write_jobs(const fs::path& folder, Project& project, const Segmentation& segmentation,
                                    Setups& setups, const std::string& program_version, const Context& context) {
    StageTimer stage(context, "setups chosen");
    const std::size_t count = segmentation.pieces.size();
    context.progress("setups chosen", 0, count);
    setups.compute(segmentation.pieces, context);
    stage.next("work envelopes judged");
    setups.compute_held(segmentation.pieces, context);
    stage.next("jobs written");
    context.progress("jobs written", 0, count);
    std::vector<const Carving*> carvings;
    for (const Piece& piece : segmentation.pieces) carvings.push_back(&setups.held(piece));
    std::vector<MadeJob> made(count);
    std::mutex reporting;
    std::size_t done = 0;
    parallel_for(0, count, [&](std::size_t i) {
        context.check_cancelled();
        made[i] = make_job(folder, project, segmentation, i, *carvings[i], setups.cell(), program_version);
        const std::lock_guard lock(reporting);
        context.progress("jobs written", ++done, count);
    });
    project.jobs.clear();
    std::vector<PieceReport> reports;
    for (MadeJob& job : made) {
        if (job.written) project.jobs.push_back(*job.written);
        reports.push_back(std::move(job.report));
    }
    return reports;
}

void write_pictures(const fs::path& folder, const std::vector<Piece>& pieces, Setups& setups, const Context& context) {
    const StageTimer stage(context, "pictures drawn");
    context.progress("pictures drawn", 0, 3);
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    Scene scene(coloured(pieces));
    write_file(folder / "pictures" / "segmentation.png", render_png(scene, {}, context));
    scene.place(shifts);
    write_file(folder / "pictures" / "exploded.png", render_png(scene, {}, context));
    std::vector<CarvedPiece> carved;
    for (const Piece& piece : pieces) {
        const Carving& carving = setups.of(piece);
        carved.push_back({carving.choice.states, carving.setup().base});
    }
    write_file(folder / "pictures" / "unreachable.png", draw_unreachable(pieces, shifts, carved, context));
}

void remove_outputs(const fs::path& folder, Project& project) {
    if (project.stage != Stage::cutting || !project.jobs.empty()) {
        project.jobs.clear();
        project.stage = Stage::cutting;
        project.end_reason.reset();
        project.ended_because.clear();
        save_project(folder, project);
    }
    for (const char* name : {"pieces", "jobs", "pictures"}) remove_but(folder / name, {});
}

}  // namespace qchopper

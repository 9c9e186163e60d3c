// Every file is written aside and renamed. O(triangles) for pieces and jobs; pictures cost a ray per pixel.

#include "app/project/outputs.h"

#include <cassert>
#include <set>

#include "app/project/ordered_job.h"
#include "app/project/project_folder.h"
#include "base/file.h"
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

std::vector<PieceReport> write_jobs(const fs::path& folder, Project& project, const Segmentation& segmentation,
                                    Setups& setups, const std::string& program_version, const Context& context) {
    StageTimer stage(context, "setups chosen");
    context.progress("setups chosen", 0, segmentation.pieces.size());
    setups.compute(segmentation.pieces, context);
    stage.next("jobs written");
    project.jobs.clear();
    JobInput input;
    input.piece_no = 0;
    input.piece_count = static_cast<std::uint16_t>(segmentation.pieces.size());
    input.program_version = program_version;
    input.project_id = project_id(project);
    input.scan_sha256 = project.scan.sha256;
    input.cell = setups.cell();
    input.warnings = project.warnings;
    std::vector<PieceReport> reports;
    for (const Piece& piece : segmentation.pieces) {
        context.check_cancelled();
        context.progress("jobs written", input.piece_no, segmentation.pieces.size());
        ++input.piece_no;
        const Carving& carving = setups.of(piece);
        PieceReport report{piece.name, piece.mesh->triangles.size(), volume_mm3(*piece.mesh), carving, {}};
        report.carving.mesh.reset();
        const fs::path file = folder / "jobs" / job_file_name(piece.name);
        if (carving.envelope.fits()) {
            input.piece = piece;
            input.setup = carving.setup;
            input.envelope = carving.envelope;
            const Bytes bytes = job_file(input);
            write_file(file, bytes);
            project.jobs.push_back(written_job(piece.name, bytes, input.project_id));
            report.job = file;
        } else {
            fs::remove(file);  // an earlier job of a piece that cannot be carved must not stay
        }
        reports.push_back(std::move(report));
    }
    return reports;
}

void write_pictures(const fs::path& folder, const std::vector<Piece>& pieces, const Context& context) {
    const StageTimer stage(context, "pictures drawn");
    context.progress("pictures drawn", 0, 2);
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    Scene scene(coloured(pieces));
    write_file(folder / "pictures" / "segmentation.png", render_png(scene, {}, context));
    scene.place(shifts);
    write_file(folder / "pictures" / "exploded.png", render_png(scene, {}, context));
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

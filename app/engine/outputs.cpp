// Every file is written aside and renamed. O(triangles) for pieces and jobs; pictures cost a ray per pixel.

#include "app/engine/outputs.h"

#include <cassert>
#include <set>

#include "app/jobs/project_sheets.h"
#include "app/pictures/unreachable_picture.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "base/timings.h"
#include "segment/io/write_mesh.h"
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

void write_pictures(const fs::path& folder, const std::vector<Piece>& pieces, Setups& setups, const Context& context) {
    const StageTimer stage(context, "pictures drawn");
    context.progress("pictures drawn", 0, 3);
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    Scene scene(coloured(pieces));
    write_file(folder / "pictures" / "segmentation.png", render_png(scene, {}, context));
    scene.place(shifts);
    write_file(folder / "pictures" / "exploded.png", render_png(scene, {}, context));
    std::vector<MilledPiece> milled;
    for (const Piece& piece : pieces) {
        const PlacedSetup& piece_setup = setups.placed(piece);
        milled.push_back({piece_setup.choice.states, piece_setup.setup().base});
    }
    write_file(folder / "pictures" / "unreachable.png",
               draw_unreachable(pieces, shifts, milled, setups.counts_narrow(), context));
}

void remove_jobs(const fs::path& folder, Project& project) {
    if (project.stage != Stage::done) return;
    project.jobs.clear();
    project.stage = Stage::cut;
    save_project(folder, project);
    for (const char* name : {"jobs", "pictures"}) remove_but(folder / name, {});
    remove_sheets(folder);
}

void remove_items(const fs::path& folder) {
    std::error_code error;
    fs::remove_all(folder / "work", error);
}

void remove_outputs(const fs::path& folder, Project& project) {
    if (project.stage != Stage::cutting || !project.jobs.empty()) {
        project.jobs.clear();
        project.stage = Stage::cutting;
        project.end_reason.reset();
        project.ended_because.clear();
        project.reverted.clear();
        save_project(folder, project);
    }
    for (const char* name : {"pieces", "jobs", "pictures"}) remove_but(folder / name, {});
    remove_sheets(folder);
    remove_items(folder);
}

}  // namespace qchopper

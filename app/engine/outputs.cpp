// Every file is written aside and renamed. O(triangles) for pieces and jobs; pictures cost a ray per pixel; outputs are
// moved aside and back by renaming, O(files).

#include "app/engine/outputs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "app/jobs/project_sheets.h"
#include "app/pictures/unreachable_picture.h"
#include "app/store/project_folder.h"
#include "app/store/project_json.h"
#include "base/files/file.h"
#include "base/files/staged_folder.h"
#include "base/sha256.h"
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

constexpr std::size_t most_kept_aside = 3;
constexpr std::array output_folders{"pieces", "jobs", "pictures"};

// Where outputs of finished projects are kept: a folder for each, named by the SHA-256 of project.json as it was, which
// it holds too.
fs::path kept_aside(const fs::path& folder) {
    return folder / "earlier";
}
fs::path kept_aside(const fs::path& folder, const std::string& as_it_was) {
    const Sha256 digest = sha256({reinterpret_cast<const std::uint8_t*>(as_it_was.data()), as_it_was.size()});
    return kept_aside(folder) / to_hex(digest).substr(0, 16);
}

// Nothing if the file is not there or not whole.
std::optional<Project> project_kept_in(const fs::path& kept) {
    const fs::path file = kept / "project.json";
    try {
        const Bytes bytes = read_file(file, record_limit);
        return project_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
    } catch (const InputError&) {
        return std::nullopt;
    }
}

// The folders, the oldest first.
std::vector<fs::path> all_kept_aside(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(kept_aside(folder), error)) {
        found.emplace_back(fs::last_write_time(entry.path() / "project.json", error), entry.path());
    }
    std::sort(found.begin(), found.end());
    std::vector<fs::path> paths;
    paths.reserve(found.size());
    for (auto& [time, path] : found) paths.push_back(std::move(path));
    return paths;
}

void move_if_there(const fs::path& from, const fs::path& to) {
    if (!fs::exists(from)) return;
    fs::remove_all(to);
    fs::rename(from, to);
}

void move_outputs(const fs::path& from, const fs::path& to) {
    for (const char* name : output_folders) move_if_there(from / name, to / name);
    for (const char* name : sheet_files) move_if_there(from / name, to / name);
}

// What cannot be moved stays where it is, and is removed.
void keep_aside(const fs::path& folder, const std::string& as_it_was) {
    const fs::path kept = kept_aside(folder, as_it_was);
    try {
        fs::remove_all(kept);
        fs::create_directories(kept.parent_path());
        StagedFolder aside(kept);
        move_outputs(folder, aside.path());
        write_file(aside.path() / "project.json", as_it_was);
        aside.move_to_its_place();
        std::vector<fs::path> all = all_kept_aside(folder);
        for (std::size_t i = 0; i + most_kept_aside < all.size(); ++i) fs::remove_all(all[i]);
    } catch (const std::exception&) {  // no outputs are kept then, as on a full disk
    }
}

// Whether outputs of `then` are those of `now`, whose search and review may not have been taken up again.
bool has_same_decisions(const Project& then, const Project& now) {
    const auto in_force = [](const Project& p) { return std::span(p.history.decisions).first(p.history.committed); };
    if (!std::ranges::equal(in_force(then), in_force(now))) return false;
    Project same = then;
    same.history = now.history;
    same.settings.candidates.no_cut = now.settings.candidates.no_cut;
    same.stage = now.stage;
    same.end_reason = now.end_reason;
    same.ended_because = now.ended_because;
    same.reverted = now.reverted;
    same.warnings = now.warnings;
    same.beam = now.beam;
    same.review = now.review;
    same.jobs = now.jobs;
    return then.history.weights_at_start == now.history.weights_at_start && same == now;
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
    const std::optional<std::string> finished =
        project.stage == Stage::done ? std::optional(to_json(project)) : std::nullopt;
    if (project.stage != Stage::cutting || !project.jobs.empty()) {
        project.jobs.clear();
        project.stage = Stage::cutting;
        project.end_reason.reset();
        project.ended_because.clear();
        project.reverted.clear();
        save_project(folder, project);
    }
    if (finished) keep_aside(folder, *finished);
    std::error_code error;
    for (const char* name : output_folders) {
        fs::create_directories(folder / name, error);
        remove_but(folder / name, {});
    }
    remove_sheets(folder);
    remove_items(folder);
}

bool are_outputs_kept(const fs::path& folder, const Project& as_it_was) {
    return fs::exists(kept_aside(folder, to_json(as_it_was)));
}

bool bring_back_outputs(const fs::path& folder, Project& project) {
    for (const fs::path& kept : all_kept_aside(folder)) {
        std::optional<Project> then = project_kept_in(kept);
        if (!then || !has_same_decisions(*then, project)) continue;
        try {
            fs::remove(kept / "project.json");  // first: what is moved in part is not taken again
            move_outputs(kept, folder);
            fs::remove_all(kept);
        } catch (const fs::filesystem_error&) {
            return false;
        }
        then->history = std::move(project.history);
        then->settings = std::move(project.settings);
        project = std::move(*then);
        save_project(folder, project);
        return true;
    }
    return false;
}

}  // namespace qchopper

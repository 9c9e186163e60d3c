#include "app/project/products.h"

#include <cassert>
#include <set>

#include "base/file.h"
#include "segment/io/write_ply.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

TriangleMesh together(const std::vector<Crumb>& crumbs) {
    TriangleMesh all;
    for (const Crumb& crumb : crumbs) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), crumb.mesh->points.begin(), crumb.mesh->points.end());
        for (std::size_t t = 0; t < crumb.mesh->triangles.size(); ++t) {
            const Triangle& v = crumb.mesh->triangles[t];
            all.triangles.push_back({v[0] + first, v[1] + first, v[2] + first});
            all.cap_of.push_back(cap_of(*crumb.mesh, t));
        }
    }
    assert(is_consistent(all));
    return all;
}

// Files of a folder that are not named; the folder may be missing.
void remove_but(const fs::path& folder, const std::set<std::string>& keep) {
    std::error_code error;
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!keep.contains(entry.path().filename().string())) old.push_back(entry.path());
    }
    for (const fs::path& file : old) fs::remove(file, error);
}

}  // namespace

void write_pieces(const fs::path& folder, const Segmentation& segmentation, CrumbChoice crumbs) {
    fs::create_directories(folder / "pieces");
    std::set<std::string> written;
    for (const Piece& piece : segmentation.pieces) {
        const std::string name = piece.name + ".ply";
        assert(!piece.name.empty() && !written.contains(name));
        write_file(folder / "pieces" / name, to_ply(*piece.mesh));
        written.insert(name);
    }
    if (!segmentation.crumbs.empty() && crumbs == CrumbChoice::keep) {
        write_file(folder / "pieces" / "crumbs.ply", to_ply(together(segmentation.crumbs)));
        written.insert("crumbs.ply");
    }
    remove_but(folder / "pieces", written);
}

void take_away_products(const fs::path& folder, Project& project) {
    if (project.stage != Stage::cutting || !project.jobs.empty()) {
        project.jobs.clear();
        project.stage = Stage::cutting;
        project.ended_because.clear();
        save_project(folder, project);
    }
    for (const char* room : {"pieces", "jobs", "pictures"}) remove_but(folder / room, {});
}

void clear_leftovers(const fs::path& folder) {
    std::vector<fs::path> left;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().filename().string().find(".tmp.") != std::string::npos) left.push_back(entry.path());
    }
    for (const fs::path& file : left) fs::remove(file);
}

}  // namespace qchopper

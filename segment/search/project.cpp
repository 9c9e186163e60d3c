#include "segment/search/project.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "segment/error.h"
#include "segment/files/file.h"
#include "segment/mesh/measure.h"
#include "segment/search/project_json.h"

namespace qchopper {
namespace {

std::int32_t made_by(const Piece& piece) {
    return piece.bounds.empty() ? 0 : piece.bounds.back().cut;
}

}  // namespace

void record(Project& project, const Segmentation& segmentation) {
    follow(project.history, segmentation.cuts);
    project.cuts = segmentation.cuts;
    project.pieces.clear();
    for (const Piece& piece : segmentation.pieces) {
        project.pieces.push_back({piece.name, made_by(piece), piece.mesh->triangles.size(), volume_mm3(*piece.mesh),
                                  bounds(*piece.mesh).centre()});
    }
    project.crumb_list.clear();
    for (const Crumb& crumb : segmentation.crumbs) {
        project.crumb_list.push_back({"", crumb.cut, crumb.mesh->triangles.size(), crumb.volume_mm3, crumb.centre});
    }
    project.warnings = project.scan.warnings;
    project.warnings.insert(project.warnings.end(), segmentation.warnings.begin(), segmentation.warnings.end());
}

void save_project(const std::filesystem::path& folder, const Project& project) {
    write_file(folder / "project.json", to_json(project));
}

Project load_project(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "project.json";
    if (!std::filesystem::exists(file)) {
        throw InputError(InputFault::missing, folder.string() + " holds no project (no project.json)",
                         "name a folder that prepare has made");
    }
    const Bytes bytes = read_file(file, record_limit);
    return project_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

Segmentation replay(const Project& project, const TriangleMesh& scan) {
    const double crumb_volume = project.settings.objectives.crumb_volume_mm3;
    Segmentation segmentation = uncut(scan, crumb_volume);
    for (const Cut& cut : project.cuts) {
        if (!apply(segmentation, cut, crumb_volume)) {
            throw InputError(InputFault::config,
                             "cut " + std::to_string(cut.number) + " of the project does not part piece " + cut.piece,
                             "prepare the scan again");
        }
    }
    return segmentation;
}

ProjectLock::ProjectLock(const std::filesystem::path& folder)
    : descriptor_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) {
        throw InputError(InputFault::create, folder.string() + " cannot be written", "check the rights of the folder");
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor_);
        throw InputError(InputFault::busy, folder.string() + " is being written by another qchopper",
                         "wait until it has ended, or stop it");
    }
}

ProjectLock::~ProjectLock() {
    ::close(descriptor_);
}

}  // namespace qchopper

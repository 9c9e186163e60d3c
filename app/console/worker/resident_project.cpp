// What a request costs beside its work: the SHA-256 of project.json before and after it.

#include "app/console/worker/resident_project.h"

#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "base/sha256.h"

namespace qchopper {

std::string revision_of_project(const std::filesystem::path& folder) {
    constexpr std::size_t digits = 16;
    return to_hex(sha256(read_file(folder / "project.json", record_limit))).substr(0, digits);
}

ResidentProject::ResidentProject(std::filesystem::path folder, ProjectContext context)
    : folder_(std::move(folder)), context_(std::move(context)) {}

void ResidentProject::with_project(const std::string& revision, const std::function<void(OpenProject&)>& use) {
    const ProjectLock lock(folder_);
    const std::string found = revision_of_project(folder_);
    if (open_ == nullptr || found != revision_) {
        open_.reset();
        clear_leftovers(folder_);
        open_ = std::make_unique<OpenProject>(folder_, context_);
        revision_ = found;
    }
    if (!revision.empty() && revision != revision_) {
        const Decision* const last = to_undo(open_->project().history);
        throw StaleRequest("the project has changed" +
                           (last == nullptr ? std::string() : "; the last decision is now: " + describe(*last)));
    }
    try {
        use(*open_);
    } catch (const RefusedRequest&) {
        throw;
    } catch (...) {
        open_.reset();
        throw;
    }
    revision_ = revision_of_project(folder_);
}

}  // namespace qchopper

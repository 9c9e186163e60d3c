// A temporary name, flock() while it is filled, rename() at the end. The constructor lists the parent folder once.

#include "base/files/staged_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "base/files/temporary_name.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// The descriptor of the folder with its lock; -1: it cannot be opened, or another run holds the lock.
int open_locked(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    ::close(descriptor);
    return -1;
}

// Removes what killed runs left in a folder. What cannot be removed is left: no run depends on it.
void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> left;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (is_leftover(it->path().filename().string())) left.push_back(it->path());
    }
    for (const fs::path& path : left) {
        const int lock = open_locked(path);
        if (lock < 0) continue;  // a run in another container of this machine holds it
        fs::remove_all(path, error);
        ::close(lock);
    }
}

}  // namespace

StagedFolder::StagedFolder(const fs::path& place)
    : place_(place), path_(place.parent_path() / temporary_name(place.filename().string())), listed_(path_) {
    remove_leftovers(place.has_parent_path() ? place.parent_path() : fs::path("."));
    fs::create_directory(path_);
    descriptor_ = open_locked(path_);
}

StagedFolder::~StagedFolder() {
    std::error_code error;
    if (!is_moved_) fs::remove_all(path_, error);
    if (descriptor_ >= 0) ::close(descriptor_);
}

void StagedFolder::move_to_its_place() {
    fs::rename(path_, place_);
    is_moved_ = true;
}

}  // namespace qchopper

// mkdtemp() and flock(). The constructor lists the folder for temporary files once.

#include "base/files/temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "base/error.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// The descriptor of the folder itself, never of a link's target, and only if this user owns it: others may write where
// temporary files lie. -1 otherwise.
int open_folder(const fs::path& folder) {
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    struct stat info {};
    if (fd >= 0 && (::fstat(fd, &info) != 0 || info.st_uid != ::geteuid())) {
        ::close(fd);
        return -1;
    }
    return fd;
}

// Removes what killed runs left in the folder for temporary files.
void remove_leftovers(const fs::path& parent, const std::string& prefix) {
    std::error_code error;
    std::vector<fs::path> old;
    for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(prefix) && name.size() == prefix.size() + 6) old.push_back(entry->path());
    }
    for (const fs::path& folder : old) {
        const int fd = open_folder(folder);
        if (fd < 0) continue;
        if (::flock(fd, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder, error);
        ::close(fd);
    }
}

// Whether the name still leads to the folder that is open.
bool is_there(const fs::path& folder, int fd) {
    struct stat named {};
    struct stat opened {};
    return ::lstat(folder.c_str(), &named) == 0 && ::fstat(fd, &opened) == 0 && named.st_ino == opened.st_ino &&
           named.st_dev == opened.st_dev;
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& prefix) {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    remove_leftovers(parent, prefix);
    // Another run may remove the new folder as a leftover before the lock is on it: then try again.
    for (int attempt = 0; attempt < 100; ++attempt) {
        std::string name = (parent / (prefix + "XXXXXX")).string();
        if (::mkdtemp(name.data()) == nullptr) break;
        lock_ = open_folder(name);
        if (lock_ >= 0 && ::flock(lock_, LOCK_EX) == 0 && is_there(name, lock_)) {
            path_ = name;
            return;
        }
        if (lock_ >= 0) ::close(lock_);
    }
    throw InputError(
        InputFault::create,
        "no temporary folder can be made in " + parent.string() + ": " + std::generic_category().message(errno),
        "free some space there, or name another place by TMPDIR");
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    ::close(lock_);
}

}  // namespace qchopper

// Temporary name with process id and checksum, flock() while it is filled, rename() at the end. The constructor lists
// the parent folder once.

#include "base/files/staged_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <vector>

#include "base/sha256.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* infix = ".tmp.";

// "NAME.tmp.4711-1a2b3c4d"
std::string staged_name(const std::string& name, long process) {
    const std::string base = name + infix + std::to_string(process);
    const std::string checked = "qchopper staged folder " + base;
    const Sha256 digest = sha256({reinterpret_cast<const std::uint8_t*>(checked.data()), checked.size()});
    return base + "-" + to_hex(digest).substr(0, 8);
}

// The process id in a name that staged_name() made; 0 for any other name.
long process_in(const std::string& name) {
    const std::size_t at = name.rfind(infix);
    if (at == std::string::npos) return 0;
    const char* const digits = name.c_str() + at + std::string(infix).size();
    long process = 0;
    std::from_chars(digits, name.c_str() + name.size(), process);
    return process > 0 && staged_name(name.substr(0, at), process) == name ? process : 0;
}

// The descriptor of the folder with its lock; -1: it cannot be opened, or another run holds the lock.
int open_locked(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    ::close(descriptor);
    return -1;
}

bool has_ended(long process) {
    return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

// Removes what killed runs left in a folder. What cannot be removed is left: no run depends on it.
void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> left;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const long process = process_in(it->path().filename().string());
        if (process != 0 && has_ended(process)) left.push_back(it->path());
    }
    for (const fs::path& path : left) {
        const int lock = open_locked(path);
        if (lock < 0) continue;  // a run on another machine or in another container holds it
        fs::remove_all(path, error);
        ::close(lock);
    }
}

}  // namespace

StagedFolder::StagedFolder(const fs::path& place)
    : place_(place),
      path_(place.parent_path() / staged_name(place.filename().string(), static_cast<long>(::getpid()))),
      listed_(path_) {
    remove_leftovers(place.has_parent_path() ? place.parent_path() : fs::path("."));
    fs::remove_all(path_);  // of an earlier process with this number
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

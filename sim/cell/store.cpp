// A lock file with flock(), and copies named after their jobs. Removing copies sorts them by the end of their jobs:
// O(n log n) comparisons for n copies, and one pass over the folder for each copy removed.

#include "sim/cell/store.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

#include "base/error.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct Copy {
    std::uint64_t ended_ms = 0;  // 0: of a job that never ran
    std::string name;
    fs::path file;
    std::uint64_t size = 0;
    bool operator<(const Copy& other) const { return std::tie(ended_ms, name) < std::tie(other.ended_ms, other.name); }
};

std::vector<Copy> copies_in(const fs::path& folder) {
    std::vector<Copy> copies;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code unknown;
        const std::uintmax_t size = entry->file_size(unknown);
        if (!unknown) copies.push_back({0, entry->path().filename().string(), entry->path(), size});
    }
    return copies;
}

// Files that a killed cell had not finished writing. Under the lock nothing else writes here.
void remove_leftovers(const fs::path& folder) {
    for (const fs::path& place : {folder, folder / "jobs"}) {
        for (const Copy& copy : copies_in(place)) {
            std::error_code ignored;
            if (copy.name.find(".tmp.") != std::string::npos) fs::remove(copy.file, ignored);
        }
    }
}

}  // namespace

Store::Store(const fs::path& folder, std::uint64_t max_bytes)
    : own_(folder.empty() ? std::make_unique<TemporaryFolder>("qchopper-cell-sim-") : nullptr),
      folder_(own_ ? own_->path() : folder),
      max_bytes_(max_bytes) {
    std::error_code error;
    fs::create_directories(folder_ / "jobs", error);
    if (error) {
        throw InputError(InputFault::create, "cannot use " + folder_.string() + " as store: " + error.message(), "");
    }
    lock_ = open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0) {
        remove_leftovers(folder_);
        return;
    }
    const bool is_held = lock_ >= 0 && errno == EWOULDBLOCK;
    if (lock_ >= 0) close(lock_);
    throw InputError(is_held ? InputFault::busy : InputFault::create,
                     "the store " + folder_.string() + (is_held ? " is in use by another cell" : " cannot be locked"),
                     "Give another store folder.");
}

Store::~Store() {
    close(lock_);
}

fs::path Store::marks() const {
    if (own_) return folder_ / "marks.json";
    const fs::path whole = fs::absolute(folder_).lexically_normal();
    const fs::path named = whole.has_filename() ? whole : whole.parent_path();  // "store/" is "store"
    return fs::path(named) += ".marks.json";
}

fs::path Store::job(const Uuid& id) const {
    return folder_ / "jobs" / (to_text(id) + ".qjob");
}

std::uint64_t Store::free_bytes() const {
    std::error_code error;
    const auto disk = fs::space(folder_, error);
    if (error) return 0;
    std::uint64_t used = 0;
    for (const Copy& copy : copies_in(folder_ / "jobs")) used += copy.size;
    return std::min<std::uint64_t>(disk.available, max_bytes_ - std::min(used, max_bytes_));
}

std::uint32_t Store::free_kib() const {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(free_bytes() / 1024, 0xFFFFFFFFU));
}

void Store::empty() const {
    std::error_code ignored;
    std::filesystem::remove(memory(), ignored);
    for (const Copy& copy : copies_in(folder_ / "jobs")) std::filesystem::remove(copy.file, ignored);
}

void Store::remove_old_copies(const CellMemory& memory, std::uint64_t bytes) const {
    if (free_bytes() >= bytes) return;
    std::map<std::string, std::uint64_t> ends;
    for (const auto& [id, record] : memory.jobs) ends[to_text(id) + ".qjob"] = record.end_time_ms;
    std::vector<Copy> copies = copies_in(folder_ / "jobs");
    for (Copy& copy : copies) {
        if (const auto found = ends.find(copy.name); found != ends.end()) copy.ended_ms = found->second;
    }
    std::sort(copies.begin(), copies.end());
    for (const Copy& copy : copies) {
        std::error_code ignored;
        fs::remove(copy.file, ignored);
        if (free_bytes() >= bytes) return;
    }
}

}  // namespace qchopper

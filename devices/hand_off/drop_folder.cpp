// flock() on the folder itself: shared by all dispatchers, exclusive for the one that removes what was left behind,
// given back by the kernel when a program dies. O(entries of the folder).

#include "devices/hand_off/drop_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/files/portable_name.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t id_length = 36;

bool is_id(const std::string& text) {
    return text.size() == id_length && text.find_first_not_of("0123456789abcdef-") == std::string::npos;
}

// ".C.qjob.<job id>", or that with the ".tmp.4711" of write_file.
bool is_staging_name(std::string name) {
    const std::size_t aside = name.rfind(".tmp.");
    if (aside != std::string::npos) name.resize(aside);
    if (name.size() < id_length + 3 || name.front() != '.') return false;
    const std::size_t dot = name.size() - id_length - 1;
    return name[dot] == '.' && is_id(name.substr(dot + 1)) && is_portable_name(name.substr(1, dot - 1));
}

void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> old;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code unknown;
        const bool is_file = fs::is_regular_file(entry->symlink_status(unknown));
        if (is_file && is_staging_name(entry->path().filename().string())) old.push_back(entry->path());
    }
    for (const fs::path& file : old) fs::remove(file, error);
}

}  // namespace

std::string staging_name(const std::string& file_name, const Uuid& job_id) {
    return "." + file_name + "." + to_text(job_id);
}

std::string fault_of_drop_folder(const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status)) return "there is no drop folder " + folder.string();
    if (!fs::is_directory(status)) return "the drop folder " + folder.string() + " is not a folder";
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
    return "the drop folder " + folder.string() + " cannot be written to: " + std::strerror(errno);
}

DropFolderUse::DropFolderUse(const fs::path& folder)
    : lock_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (lock_ < 0) return;
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) remove_leftovers(folder);
    // Another dispatcher may be removing files at this moment; the wait for it is bounded.
    for (int attempt = 0; attempt < 100 && ::flock(lock_, LOCK_SH | LOCK_NB) != 0; ++attempt) ::usleep(10'000);
}

DropFolderUse::~DropFolderUse() {
    if (lock_ >= 0) ::close(lock_);
}

StagedFile::~StagedFile() {
    std::error_code ignored;
    if (!staged_.empty()) fs::remove(staged_, ignored);
}

std::string StagedFile::stage(const fs::path& folder, const std::string& file_name, const Uuid& job_id,
                              const Bytes& bytes) {
    if (std::string fault = fault_of_drop_folder(folder); !fault.empty()) return fault;
    use_.emplace(folder);
    staged_ = folder / staging_name(file_name, job_id);
    target_ = folder / file_name;
    try {
        write_file(staged_, bytes);
    } catch (const InputError& error) {
        staged_.clear();
        return std::string("the job file cannot be written into the drop folder: ") + error.what();
    }
    return {};
}

std::string StagedFile::put() {
    std::error_code error;
    fs::rename(staged_, target_, error);
    if (error) {
        const std::string fault = fault_of_drop_folder(target_.parent_path());
        return fault.empty() ? "cannot put " + target_.string() + " into the drop folder: " + error.message() : fault;
    }
    staged_.clear();
    return {};
}

}  // namespace qchopper

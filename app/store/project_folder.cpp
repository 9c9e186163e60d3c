// Folders are staged and renamed (base/files/staged_folder.h); the lock is flock(2) on a file that stays. O(bytes), and
// O(files) where leftovers are looked for.

#include "app/store/project_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>

#include "app/store/ignored_surface.h"
#include "app/store/no_cut_surface.h"
#include "app/store/project_json.h"
#include "base/error.h"
#include "base/files/staged_folder.h"
#include "base/files/temporary_name.h"
#include "base/printable.h"
#include "base/process.h"
#include "base/text.h"
#include "cam/cell/cell.h"

namespace qchopper {

namespace fs = std::filesystem;

fs::path without_slash(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

fs::path items_folder(const fs::path& project) {
    return project / "work" / "items";
}

bool is_project_folder(const fs::path& path) {
    std::error_code error;
    const bool is_folder = fs::is_directory(path, error);
    if (is_folder && !fs::exists(path / "project.json", error)) {
        throw InputError(InputFault::missing, path.string() + " is a folder, but no project",
                         "name a scan, or a folder that segment or prepare has made");
    }
    return is_folder;
}

void check_output(const fs::path& out) {
    std::error_code error;
    if (fs::exists(out, error)) {
        throw InputError(InputFault::create, out.string() + " exists already",
                         fs::exists(out / "project.json", error)
                             ? "go on with it by: qchopper prepare " + shell_word(out) + ", or choose another name"
                             : "choose another name");
    }
    const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, error)) {
        throw InputError(InputFault::create, out.string() + " cannot be made: there is no folder " + parent.string(),
                         "make that folder first");
    }
    if (::access(parent.c_str(), W_OK) != 0) {
        throw InputError(InputFault::create,
                         out.string() + " cannot be made: " + parent.string() + " cannot be written",
                         "choose another place");
    }
}

void create_project(const fs::path& folder, const Project& project, const std::optional<Bytes>& cell_file,
                    const Bytes& ignored) {
    try {
        StagedFolder aside(folder);
        fs::create_directories(aside.path() / "pieces");
        fs::create_directory(aside.path() / "jobs");
        fs::create_directory(aside.path() / "pictures");
        if (cell_file) write_file(aside.path() / "cell.toml", *cell_file);
        if (!ignored.empty()) write_file(aside.path() / ignored_file, ignored);
        const Bytes no_cut = no_cut_bytes(project.settings.candidates.no_cut);
        if (!no_cut.empty()) write_file(aside.path() / no_cut_file, no_cut);
        save_project(aside.path(), project);
        aside.move_to_its_place();
    } catch (const fs::filesystem_error& e) {
        throw InputError(InputFault::create, folder.string() + " cannot be made: " + e.code().message(),
                         "choose another place");
    }
}

void take_cell(const fs::path& folder, const fs::path& cell_file, const Context& context) {
    read_cell(cell_file);  // an impossible one is refused before it is copied
    write_file(folder / "cell.toml", read_file(cell_file, settings_limit));
    context.message(folder.string() + ": its cell is now that of " + cell_file.string());
}

void save_project(const fs::path& folder, const Project& project) {
    write_file(folder / "project.json", to_json(project));
}

Project load_project(const fs::path& folder) {
    const fs::path file = folder / "project.json";
    if (!fs::exists(file)) {
        throw InputError(InputFault::missing, folder.string() + " holds no project (no project.json)",
                         "name a folder that prepare has made");
    }
    const Bytes bytes = read_file(file, record_limit);
    Project project = project_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
    if (project.no_cut) project.settings.candidates.no_cut = load_no_cut(folder, *project.no_cut);
    return project;
}

void clear_leftovers(const fs::path& folder) {
    std::vector<fs::path> left;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (is_leftover(entry.path().filename().string())) left.push_back(entry.path());
    }
    for (const fs::path& file : left) fs::remove_all(file);
}

namespace {

// The line that the holder of a lock writes into its file: "prepare, process 4711 on bench, since 2026-11-22 17:43:28".
std::string holder_line() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    return first_argument() + ", process " + std::to_string(::getpid()) + " on " + host_name() + ", since " +
           utc_text(static_cast<std::uint64_t>(ms)) + " UTC\n";
}

// What another process has written there: ": " and its line, or nothing.
std::string holder_of(int descriptor) {
    std::array<char, 256> text{};
    const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
    const std::string line(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    const std::size_t end = line.find('\n');
    return end == std::string::npos ? std::string() : ": " + line.substr(0, end);
}

}  // namespace

std::optional<std::string> writer_of(const fs::path& folder) {
    const int file = ::open((folder / "lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return {};
    std::optional<std::string> writer;
    if (::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        const std::string holder = holder_of(file);
        writer = holder.empty() ? "another program" : holder.substr(2);
    }
    ::close(file);
    return writer;
}

ProjectLock::ProjectLock(const fs::path& folder)
    : descriptor_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) {
        throw InputError(InputFault::create, folder.string() + " cannot be written", "check the rights of the folder");
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
        const std::string line = holder_line();
        // For the message of another process only: without it, as on a full disk, the lock holds all the same.
        static_cast<void>(::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, line.data(), line.size(), 0) > 0);
        return;
    }
    const int fault = errno;
    const std::string holder = holder_of(descriptor_);
    ::close(descriptor_);
    if (fault == EWOULDBLOCK) {
        throw InputError(InputFault::busy, folder.string() + " is being written by another qchopper" + holder,
                         "wait until it has ended, or stop it");
    }
    // ENOLCK, EOPNOTSUPP, ENOSYS: such as a network file system without a lock manager.
    throw InputError(
        InputFault::create,
        folder.string() + " is on a file system that cannot lock files: " + std::generic_category().message(fault),
        "keep the project on a disk of this machine, or have the file system mounted with locks");
}

ProjectLock::~ProjectLock() {
    static_cast<void>(::ftruncate(descriptor_, 0) == 0);
    ::close(descriptor_);
}

}  // namespace qchopper

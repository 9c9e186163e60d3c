#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>

#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/files/file.h"
#include "segment/intake/write_ply.h"
#include "segment/search/project.h"

extern char** environ;

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "bench-XXXXXX").string();
        path_ = ::mkdtemp(name.data()) != nullptr ? name : std::string();
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

 private:
    fs::path path_;
};

struct Ended {
    int status = -1;
    double peak_bytes = 0;
    double wall = 0;
};

Ended run(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    Ended ended;
    const double started = wall_s();
    pid_t child = 0;
    posix_spawn_file_actions_t streams;
    ::posix_spawn_file_actions_init(&streams);
    ::posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int fault = ::posix_spawnp(&child, arguments[0], &streams, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&streams);
    if (fault != 0) return ended;
    rusage usage{};
    if (::wait4(child, &ended.status, 0, &usage) != child) return ended;
    ended.wall = wall_s() - started;
    ended.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    return ended;
}

}  // namespace

void measure_growth(const Measured& small, const Base& small_base, std::size_t faces, Figures& figures) {
    const Measured large = one_shell("skull " + number_text(static_cast<double>(faces)), Specimen::skull, faces);
    const double seconds = pricing_s(large, 3);
    const double growth = static_cast<double>(large.faces()) / static_cast<double>(small.faces());
    figures.tell(large.name, "pricing", time_text(seconds));
    figures.at_most(large.name, "growth of pricing / growth of the faces from " + small.name,
                    seconds / small_base.pricing_s / growth, 1.2);
}

void measure_memory(const fs::path& program, std::size_t faces, Figures& figures) {
    const std::string name = "skull " + number_text(static_cast<double>(faces));
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "skull.ply";
    {
        SampleOptions options;
        options.faces = faces;
        write_file(file, to_ply(sample(Specimen::skull, options)));
    }
    const Ended ended = run({program.string(), "segment", file.string(), "--units", "mm", "--min-cuts", "1", "--auto",
                             "--quiet", "-o", (folder.path() / "skull.qch").string()});
    const bool is_done = ended.status == 0 && load_project(folder.path() / "skull.qch").cuts.size() == 1;
    if (!is_done) {
        figures.add({name, "peak memory of " + program.string() + " segment",
                     "it ended with status " + std::to_string(ended.status), "at most 200 bytes a face", std::nullopt});
        return;
    }
    figures.tell(name, "segment to one cut, reading and writing", "wall " + time_text(ended.wall));
    figures.at_most(name, "peak memory of segment, bytes a face", ended.peak_bytes / static_cast<double>(faces), 200);
}

}  // namespace qchopper::bench

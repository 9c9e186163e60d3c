// posix_spawn and wait4, which reports the resources that the child has used.

#include "bench/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/clock.h"

extern char** environ;

namespace qchopper::bench {

ChildResult run(const std::vector<std::string>& command, const ChildStreams& streams) {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ChildResult ended;
    const double started = wall_s();
    pid_t child = 0;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, streams.out.c_str(), flags, 0600);
    if (!streams.err.empty()) {
        ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, streams.err.c_str(), flags, 0600);
    }
    const int fault = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (fault != 0) return ended;
    rusage usage{};
    if (::wait4(child, &ended.status, 0, &usage) != child) return ended;
    ended.wall = wall_s() - started;
    ended.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    ended.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    return ended;
}

}  // namespace qchopper::bench

// posix_spawnp with a pipe for each output; both are read until they are closed or the time is over. O(bytes read).

#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>
#include <utility>

extern char** environ;

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int not_found = 127;
constexpr int killed = 128;

[[noreturn]] void fail(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class Pipe {
 public:
    Pipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail(errno, "pipe");
    }
    ~Pipe() {
        close(0);
        close(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    int end(std::size_t which) const { return ends_[which]; }
    void close(std::size_t which) {
        if (ends_[which] >= 0) ::close(ends_[which]);
        ends_[which] = -1;
    }

 private:
    std::array<int, 2> ends_{-1, -1};
};

class FileActions {
 public:
    FileActions() { ::posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    posix_spawn_file_actions_t* get() { return &actions_; }

 private:
    posix_spawn_file_actions_t actions_{};
};

// Whether more may come.
bool read_some(Pipe& pipe, std::string& text) {
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(pipe.end(0), buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count > 0 || (count < 0 && errno == EINTR)) return true;
    pipe.close(0);
    return false;
}

// 0: there is no such program.
pid_t spawned(const std::vector<std::string>& words, FileActions& actions) {
    assert(!words.empty());
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, arguments[0], actions.get(), nullptr, arguments.data(), environ);
    if (error == ENOENT || error == EACCES) return 0;
    if (error != 0) fail(error, words[0].c_str());
    return child;
}

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status);
}

}  // namespace

ChildOutput run_child(const std::vector<std::string>& words, std::chrono::milliseconds limit) {
    Pipe out;
    Pipe err;
    FileActions actions;
    ::posix_spawn_file_actions_adddup2(actions.get(), out.end(1), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), err.end(1), STDERR_FILENO);
    const pid_t child = spawned(words, actions);
    if (child == 0) return {not_found, {}, {}};
    out.close(1);
    err.close(1);
    ChildOutput output;
    const Clock::time_point end = Clock::now() + limit;
    bool is_open = true;
    while (is_open) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left <= 0) break;
        std::array<pollfd, 2> watched{{{out.end(0), POLLIN, 0}, {err.end(0), POLLIN, 0}}};
        if (::poll(watched.data(), watched.size(), static_cast<int>(left)) <= 0) continue;
        if (watched[0].revents != 0) read_some(out, output.out);
        if (watched[1].revents != 0) read_some(err, output.err);
        is_open = out.end(0) >= 0 || err.end(0) >= 0;
    }
    int status = 0;
    pid_t ended = is_open ? 0 : ::waitpid(child, &status, WNOHANG);
    while (ended == 0 && Clock::now() < end) {  // it may go on without its outputs
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ended = ::waitpid(child, &status, WNOHANG);
    }
    if (ended == 0) ::kill(child, SIGKILL);
    while (ended == 0 || (ended < 0 && errno == EINTR)) ended = ::waitpid(child, &status, 0);
    output.code = code_of(status);
    return output;
}

Child::Child(const std::vector<std::string>& words, const std::filesystem::path& output) {
    constexpr mode_t readable = 0644;
    const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, readable);
    if (file < 0) fail(errno, output.c_str());
    FileActions actions;
    ::posix_spawn_file_actions_adddup2(actions.get(), file, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), file, STDERR_FILENO);
    try {
        process_ = spawned(words, actions);
    } catch (...) {
        ::close(file);
        throw;
    }
    ::close(file);
    if (process_ == 0) code_ = not_found;
}

Child::~Child() {
    if (process_ == 0 || code()) return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Child::Child(Child&& other) noexcept : process_(std::exchange(other.process_, 0)), code_(other.code_) {}

std::optional<int> Child::code() {
    int status = 0;
    if (!code_ && process_ > 0 && ::waitpid(process_, &status, WNOHANG) == process_) code_ = code_of(status);
    return code_;
}

void Child::stop() {
    if (process_ > 0 && !code()) ::kill(process_, SIGTERM);
}

}  // namespace qchopper

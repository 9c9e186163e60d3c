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
pid_t spawned(const std::vector<std::string>& words, FileActions& actions, bool has_input = false,
              const posix_spawnattr_t* attributes = nullptr) {
    assert(!words.empty());
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    if (!has_input) ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // Descriptors that libraries open without O_CLOEXEC, such as sockets, are not the child's.
    ::posix_spawn_file_actions_addclosefrom_np(actions.get(), STDERR_FILENO + 1);
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, arguments[0], actions.get(), attributes, arguments.data(), environ);
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

namespace {

// Standard output and error at the end of a file while it lives.
class OutputFile {
 public:
    OutputFile(const std::filesystem::path& path, FileActions& actions) {
        constexpr mode_t readable = 0644;
        file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, readable);
        if (file_ < 0) fail(errno, path.c_str());
        ::posix_spawn_file_actions_adddup2(actions.get(), file_, STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(actions.get(), file_, STDERR_FILENO);
    }
    ~OutputFile() { ::close(file_); }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

 private:
    int file_ = -1;
};

}  // namespace

Child::Child(const std::vector<std::string>& words, const std::filesystem::path& output) {
    FileActions actions;
    const OutputFile file(output, actions);
    process_ = spawned(words, actions);
    if (process_ == 0) code_ = not_found;
}

int start_detached(const std::vector<std::string>& words, const std::filesystem::path& output) {
    FileActions actions;
    const OutputFile file(output, actions);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    const int process = spawned(words, actions, false, &attributes);
    ::posix_spawnattr_destroy(&attributes);
    return process;
}

std::optional<int> code_of_detached(int process) {
    int status = 0;
    return ::waitpid(process, &status, WNOHANG) == process ? std::optional(code_of(status)) : std::nullopt;
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

struct TalkingChild::Ends {
    Pipe in;
    Pipe out;
    Pipe err;
    std::string out_text;  // read and not yet returned
    std::string err_text;
};

namespace {

// Takes the first line of a text, or all of it if nothing follows any more.
std::optional<std::string> take_line(std::string& text, bool is_over) {
    const std::size_t end = text.find('\n');
    if (end == std::string::npos && (!is_over || text.empty())) return {};
    std::string line = text.substr(0, end);
    text.erase(0, end == std::string::npos ? end : end + 1);
    return line;
}

}  // namespace

TalkingChild::TalkingChild(const std::vector<std::string>& words) : ends_(std::make_unique<Ends>()) {
    FileActions actions;
    ::posix_spawn_file_actions_adddup2(actions.get(), ends_->in.end(0), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), ends_->out.end(1), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(actions.get(), ends_->err.end(1), STDERR_FILENO);
    process_ = spawned(words, actions, true);
    ends_->in.close(0);
    ends_->out.close(1);
    ends_->err.close(1);
    if (process_ == 0) code_ = not_found;
}

TalkingChild::~TalkingChild() {
    kill();
    static_cast<void>(code());
}

namespace {

// Keeps SIGPIPE from this thread while it lives, also one that came meanwhile: writing to a child that has ended is an
// error like any other, and no end of this program.
class NoBrokenPipe {
 public:
    NoBrokenPipe() {
        ::sigemptyset(&pipe_);
        ::sigaddset(&pipe_, SIGPIPE);
        ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~NoBrokenPipe() {
        const timespec at_once{};
        while (::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
        }
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    NoBrokenPipe(const NoBrokenPipe&) = delete;
    NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
    sigset_t pipe_{};
    sigset_t before_{};
};

}  // namespace

bool TalkingChild::write_line(const std::string& line) {
    const NoBrokenPipe guard;
    const std::string text = line + "\n";
    std::size_t written = 0;
    while (written < text.size()) {
        const ssize_t count = ::write(ends_->in.end(1), text.data() + written, text.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        written += static_cast<std::size_t>(count);
    }
    return true;
}

std::optional<TalkingChild::Line> TalkingChild::read_line(std::chrono::milliseconds limit) {
    Ends& e = *ends_;
    const Clock::time_point until = Clock::now() + limit;
    while (true) {
        if (auto line = take_line(e.err_text, e.err.end(0) < 0)) return Line{std::move(*line), true};
        if (auto line = take_line(e.out_text, e.out.end(0) < 0)) return Line{std::move(*line), false};
        if (e.out.end(0) < 0 && e.err.end(0) < 0) {
            is_closed_ = true;
            return {};
        }
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
        if (left < 0) return {};
        std::array<pollfd, 2> watched{{{e.out.end(0), POLLIN, 0}, {e.err.end(0), POLLIN, 0}}};
        if (::poll(watched.data(), watched.size(), static_cast<int>(left)) < 0 && errno != EINTR) return {};
        if (watched[0].revents != 0) read_some(e.out, e.out_text);
        if (watched[1].revents != 0) read_some(e.err, e.err_text);
    }
}

int TalkingChild::code() {
    if (code_) return *code_;
    siginfo_t ended{};
    while (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    const std::lock_guard lock(reaping_);
    int status = 0;
    code_ = ::waitpid(process_, &status, 0) == process_ ? code_of(status) : not_found;
    process_ = 0;
    return *code_;
}

void TalkingChild::signal(int number) {
    const std::lock_guard lock(reaping_);
    if (process_ > 0) ::kill(process_, number);
}

void TalkingChild::stop() {
    signal(SIGTERM);
}

void TalkingChild::kill() {
    signal(SIGKILL);
}

}  // namespace qchopper

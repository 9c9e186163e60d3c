#include "tests/app/cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <thread>

namespace qchopper::program {
namespace {

namespace fs = std::filesystem;

void keep_to_one_core() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    ::sched_getaffinity(0, sizeof allowed, &allowed);
    int core = 0;
    while (CPU_ISSET(core, &allowed) == 0) ++core;
    CPU_ZERO(&allowed);
    CPU_SET(core, &allowed);
    ::sched_setaffinity(0, sizeof allowed, &allowed);
}

void redirect(const fs::path& file, int flags, int descriptor) {
    const int opened = ::open(file.c_str(), flags, 0600);
    if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(127);
}

// Looks every few milliseconds; false if it takes too long.
bool comes_true(const std::function<bool()>& condition, double seconds) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > until) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
    return true;
}

// The journals of all runs in one folder: never those of the user, nor those of another test.
fs::path state_of(const fs::path& folder) {
    static const Folder states;
    return states.path / std::to_string(std::hash<std::string>()(folder.string()));
}

// A terminal on which a text is typed: the file that stands for it.
std::string open_keyboard(int& keyboard, const std::string& text) {
    keyboard = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (keyboard < 0 || ::grantpt(keyboard) != 0 || ::unlockpt(keyboard) != 0) return {};
    EXPECT_EQ(::write(keyboard, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    return ::ptsname(keyboard);
}

}  // namespace

Process::Process(const Arguments& arguments, const RunOptions& options) {
    put(streams_.path / "in", options.input);
    std::vector<std::string> words{QCHOPPER_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const fs::path state = state_of(options.folder);
    const std::string terminal = options.has_terminal ? open_keyboard(keyboard_, options.input) : "";
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (::chdir(options.folder.c_str()) != 0) ::_exit(127);
    redirect(terminal.empty() ? streams_.path / "in" : fs::path(terminal), O_RDONLY | O_NOCTTY, STDIN_FILENO);
    redirect(streams_.path / "out", O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(streams_.path / "err", O_WRONLY | O_CREAT, STDERR_FILENO);
    ::setenv("XDG_STATE_HOME", state.c_str(), 1);
    if (options.one_core) keep_to_one_core();
    const rlimit limit{options.largest_file, options.largest_file};
    if (options.largest_file > 0) ::setrlimit(RLIMIT_FSIZE, &limit);
    if (!options.temporary_folder.empty()) ::setenv("TMPDIR", options.temporary_folder.c_str(), 1);
    ::execv(argv[0], argv.data());
    ::_exit(127);
}

Process::~Process() {
    if (keyboard_ >= 0) ::close(keyboard_);
    if (pid_ <= 0 || has_ended()) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
}

bool Process::has_ended() {
    if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return ended_;
}

void Process::signal(int number) const {
    if (!ended_) ::kill(pid_, number);
}

bool Process::waits_until_signals_are_caught() {
    const std::uint64_t wanted = 1ULL << (SIGINT - 1) | 1ULL << (SIGTERM - 1);
    const auto is_caught = [&] {
        const std::string status = bytes_in("/proc/" + std::to_string(pid_) + "/status");
        const std::size_t at = status.find("SigCgt:");
        return at != std::string::npos && (std::stoull(status.substr(at + 7), nullptr, 16) & wanted) == wanted;
    };
    return comes_true([&] { return is_caught() || has_ended(); }, 60) && is_caught();
}

std::string Process::out() const {
    return bytes_in(streams_.path / "out");
}
std::string Process::err() const {
    return bytes_in(streams_.path / "err");
}

bool Process::waits_until_out(const std::string& text, double seconds) {
    const auto is_there = [&] { return out().find(text) != std::string::npos; };
    return comes_true([&] { return is_there() || has_ended(); }, seconds) && is_there();
}

bool Process::waits_until_err(const std::string& text, double seconds) {
    const auto is_there = [&] { return err().find(text) != std::string::npos; };
    return comes_true([&] { return is_there() || has_ended(); }, seconds) && is_there();
}

bool Process::waits_until_there(const fs::path& file, double seconds) {
    return comes_true([&] { return fs::exists(file) || has_ended(); }, seconds) && fs::exists(file);
}

Ended Process::wait(double seconds) {
    Ended ended;
    ended.in_time = comes_true([&] { return has_ended(); }, seconds);
    if (!ended.in_time) {
        ::kill(pid_, SIGKILL);
        ended_ = ::waitpid(pid_, &status_, 0) == pid_;
    }
    if (WIFEXITED(status_)) ended.code = WEXITSTATUS(status_);
    if (WIFSIGNALED(status_)) ended.killed_by = WTERMSIG(status_);
    ended.out = out();
    ended.err = err();
    EXPECT_TRUE(ended.in_time) << ended.err;
    return ended;
}

Ended run(const Arguments& arguments, const RunOptions& options) {
    Ended ended = Process(arguments, options).wait();
    const bool is_document = std::ranges::find(arguments, "--json") != arguments.end();
    const bool is_error = ended.out.find("qchopper-error-") != std::string::npos;  // it is the command line's own
    std::smatch option;
    // An option, as a word of a sentence; the paths of the tests have none.
    if (is_document && !is_error && std::regex_search(ended.out, option, std::regex(R"([ ;(]--[a-z][a-z-]*)"))) {
        ADD_FAILURE() << "a document names an option, which a page does not have:" << option.str();
    }
    return ended;
}

std::string address_of(Process& cell) {
    const std::string head = "listening ";
    EXPECT_TRUE(cell.waits_until_out("\n")) << cell.err();
    const std::string line = cell.out();
    EXPECT_TRUE(line.starts_with(head)) << line;
    return line.starts_with(head) ? line.substr(head.size(), line.find('\n') - head.size()) : std::string();
}

std::string bytes_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

void put(const fs::path& file, const std::string& bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream << bytes;
    if (!stream.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

Contents contents(const fs::path& folder) {
    Contents found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        found[name] = entry.is_regular_file() ? bytes_in(entry.path()) : "a folder";
    }
    return found;
}

std::string difference(const Contents& before, const Contents& after) {
    std::string names;
    for (const auto& [name, bytes] : before) {
        const auto there = after.find(name);
        if (there == after.end()) names += " -" + name;
        if (there != after.end() && there->second != bytes) names += " !" + name;
    }
    for (const auto& [name, bytes] : after) {
        if (!before.contains(name)) names += " +" + name;
    }
    return names;
}

fs::path foam_cell() {
    return fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "foam-1.toml";
}

Arguments prepare_arguments(const std::string& scan) {
    return {"prepare", scan, "--units", "mm", "--cell", foam_cell().string(), "--preset", "thesis", "--min-cuts", "2"};
}

void make_prepared(const fs::path& folder) {
    const Ended sampled = run({"sample", "vertebra", "--faces", "3000", "-o", "scan.ply"}, {folder});
    ASSERT_EQ(sampled.code, 0) << sampled.err;
    Arguments arguments = prepare_arguments("scan.ply");
    arguments.insert(arguments.end(), {"-o", "scan.qch"});
    const Ended made = run(arguments, {folder});
    ASSERT_EQ(made.code, 0) << made.err;
}

const fs::path& prepared() {
    static const Folder own;
    static const fs::path folder = [] {
        if (const char* const shared = std::getenv("QCHOPPER_PREPARED")) return fs::path(shared);
        make_prepared(own.path);
        return own.path;
    }();
    EXPECT_TRUE(fs::exists(folder / "scan.qch" / "project.json")) << folder;
    return folder;
}

}  // namespace qchopper::program

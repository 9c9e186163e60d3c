#include "tests/sim/cell/tls_rig.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace qchopper::rig {
namespace {

namespace fs = std::filesystem;

constexpr const char* stunnel_program = "/usr/bin/stunnel4";

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

bool accepts_connections(std::uint16_t port) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    const bool is_open = connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(fd);
    return is_open;
}

std::string address(std::uint16_t port) {
    return "127.0.0.1:" + std::to_string(port);
}

std::string with_value(const std::string& text, const std::string& key, const std::string& value) {
    return std::regex_replace(text, std::regex("(^|\n)" + key + " = [^\n]*"), "$1" + key + " = " + value);
}

// Of processes that are started from here, nothing is inherited but standard streams that go to the log.
pid_t start(const std::vector<std::string>& words, const fs::path& log) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t pid = -1;
    const int error = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + words[0]);
    return pid;
}

}  // namespace

bool has_stunnel() {
    return access(stunnel_program, X_OK) == 0 && access("/usr/bin/openssl", X_OK) == 0;
}

std::vector<std::string> blocks_of_tls_page(const std::string& language) {
    const std::string page = text_of(fs::path(QCHOPPER_SOURCE_DIR) / "docs/user/tls.md");
    const std::string head = "```" + language + "\n";
    std::vector<std::string> blocks;
    for (std::size_t at = page.find(head); at != std::string::npos; at = page.find(head, at)) {
        at += head.size();
        const std::size_t end = page.find("```", at);
        blocks.push_back(page.substr(at, end - at));
        at = end;
    }
    return blocks;
}

std::uint16_t free_port() {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in any = loopback(0);
    socklen_t size = sizeof any;
    if (bind(fd, reinterpret_cast<sockaddr*>(&any), size) != 0) throw std::runtime_error("no free port");
    getsockname(fd, reinterpret_cast<sockaddr*>(&any), &size);
    close(fd);
    return ntohs(any.sin_port);
}

Authority::Authority(fs::path parent) : folder_(parent / "plant-ca") {
    fs::create_directories(parent);
    const std::string command = "cd '" + parent.string() + "' && { " + blocks_of_tls_page("sh").at(0) + "}";
    std::ofstream(parent / "make.sh") << "set -e\n" << command << "\n";
    const std::string quiet =
        "bash '" + (parent / "make.sh").string() + "' >'" + (parent / "make.log").string() + "' 2>&1";
    if (std::system(quiet.c_str()) != 0) throw std::runtime_error(text_of(parent / "make.log"));
}

void Authority::run(const std::string& commands) const {
    const fs::path script = folder_ / "commands.sh";
    std::ofstream(script) << "set -e\ncd '" << folder_.string() << "'\n" << commands;
    const fs::path log = folder_ / "commands.log";
    if (std::system(("bash '" + script.string() + "' >'" + log.string() + "' 2>&1").c_str()) != 0) {
        throw std::runtime_error(text_of(log));
    }
}

void Authority::issue(const std::string& name, const std::string& dates) const {
    std::string commands = blocks_of_tls_page("sh").at(1);
    commands = std::regex_replace(commands, std::regex("name=[^\n]*"), "name=" + name);
    commands = std::regex_replace(commands, std::regex("openssl ca "), "openssl ca " + dates + " ");
    run(commands);
}

void Authority::revoke(const std::string& name) const {
    run(std::regex_replace(blocks_of_tls_page("sh").at(2), std::regex("old-pc.plant.example"), name));
}

void Authority::make_crl(const std::string& dates) const {
    run("openssl ca -config ca.cnf -gencrl " + dates + " -out plant-crl.pem\n");
}

Stunnel::Stunnel(std::string configuration, const fs::path& folder, std::uint16_t accepts, std::uint16_t connects) {
    static std::atomic<int> count = 0;
    const fs::path file = folder / ("stunnel-" + std::to_string(++count) + ".conf");
    log_ = file;
    log_.replace_extension(".log");
    configuration = with_value(configuration, "accept", address(accepts));
    configuration = with_value(configuration, "connect", address(connects));
    configuration = std::regex_replace(configuration, std::regex("/etc/stunnel"), folder.string());
    std::ofstream(file) << "foreground = yes\npid =\n" << configuration;
    pid_ = start({stunnel_program, file.string()}, log_);
    for (int n = 0; n < 3000 && !is_listening_; ++n) {
        if (waitpid(pid_, nullptr, WNOHANG) == pid_) {
            pid_ = -1;
            return;
        }
        is_listening_ = accepts_connections(accepts);
        if (!is_listening_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

Stunnel::~Stunnel() {
    if (pid_ < 0) return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
}

std::string Stunnel::log() const {
    return text_of(log_);
}

std::string without_key(const std::string& text, const std::string& key) {
    return std::regex_replace(text, std::regex("(^|\n)" + key + " = [^\n]*"), "$1; " + key);
}

}  // namespace qchopper::rig

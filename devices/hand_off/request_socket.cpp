// A stream socket with one client at a time, never blocking on the dispatcher's side. O(bytes).

#include "devices/hand_off/request_socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>

#include "devices/wire/device_error.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_line = 64;

// The beginnings of the line of an answer.
constexpr std::string_view done_line = "OK";
constexpr std::string_view refused_line = "refused: ";

std::filesystem::path socket_in(const std::filesystem::path& folder) {
    return folder / "requests";
}

std::optional<sockaddr_un> address_of(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.native().size() >= sizeof address.sun_path) return std::nullopt;
    std::memcpy(address.sun_path, path.c_str(), path.native().size() + 1);
    return address;
}

void close_and_forget(int& descriptor) {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = -1;
}

void send_line(int descriptor, std::string text) {
    for (char& c : text) c = c == '\n' ? ' ' : c;
    text += '\n';
    static_cast<void>(::send(descriptor, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
}

RequestAnswer answer_of(const std::string& line) {
    if (line == done_line) return {CommandEnd::done, {}};
    if (line.starts_with(refused_line)) return {CommandEnd::refused, line.substr(refused_line.size())};
    return {CommandEnd::unknown, line};
}

[[noreturn]] void refuse(const std::string& why) {
    throw DeviceError(DeviceFault::busy, "a dispatcher drives the cell, and " + why,
                      "Try again, or use the panel of the cell.");
}

}  // namespace

std::string describe(const RequestAnswer& answer) {
    if (answer.end == CommandEnd::done) return std::string(done_line);
    return (answer.end == CommandEnd::refused ? std::string(refused_line) : "") + answer.why;
}

RequestSocket::RequestSocket(const std::filesystem::path& folder) : path_(socket_in(folder)) {
    const std::optional<sockaddr_un> address = address_of(path_);
    if (!address) return;
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);  // of a dispatcher that was killed
    listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (listener_ < 0) return;
    constexpr int waiting_clients = 8;
    if (::bind(listener_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
        ::listen(listener_, waiting_clients) != 0) {
        close_and_forget(listener_);
    }
}

RequestSocket::~RequestSocket() {
    answer({CommandEnd::refused, "the dispatcher has ended"});
    close_and_forget(client_);
    if (listener_ < 0) return;
    close_and_forget(listener_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void RequestSocket::accept_client() {
    if (client_ >= 0 || listener_ < 0) return;
    client_ = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    line_.clear();
}

CellCommand RequestSocket::next() {
    if (is_asked_) return CellCommand::none;
    accept_client();
    if (client_ < 0) return CellCommand::none;
    char bytes[longest_line];
    const ssize_t got = ::recv(client_, bytes, sizeof bytes, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return CellCommand::none;
    if (got > 0) line_.append(bytes, static_cast<std::size_t>(got));
    const std::size_t end = line_.find('\n');
    if (end == std::string::npos) {
        if (got <= 0 || line_.size() >= longest_line) close_and_forget(client_);
        return CellCommand::none;
    }
    const std::string word = line_.substr(0, end);
    for (const CellCommand command : {CellCommand::unhold, CellCommand::clear}) {
        is_asked_ = word == name(command);
        if (is_asked_) return command;
    }
    send_line(client_, describe({CommandEnd::refused, "only Unhold and Clear are passed on"}));
    close_and_forget(client_);
    return CellCommand::none;
}

void RequestSocket::answer(const RequestAnswer& answer) {
    if (!is_asked_) return;
    is_asked_ = false;
    send_line(client_, describe(answer));
    close_and_forget(client_);
}

RequestAnswer ask_dispatcher(const std::filesystem::path& folder, CellCommand command, double patience_s) {
    const std::optional<sockaddr_un> address = address_of(socket_in(folder));
    if (!address) refuse("its socket has too long a name: " + socket_in(folder).string());
    int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0 || ::connect(descriptor, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
        close_and_forget(descriptor);
        refuse("it does not listen for requests");
    }
    send_line(descriptor, name(command));
    std::string line;
    pollfd waiting{descriptor, POLLIN, 0};
    while (line.find('\n') == std::string::npos && ::poll(&waiting, 1, static_cast<int>(1000 * patience_s)) > 0) {
        char bytes[256];
        const ssize_t got = ::recv(descriptor, bytes, sizeof bytes, 0);
        if (got <= 0) break;
        line.append(bytes, static_cast<std::size_t>(got));
    }
    close_and_forget(descriptor);
    if (line.find('\n') == std::string::npos) refuse("it did not answer whether the cell has done it: ask the cell");
    return answer_of(line.substr(0, line.find('\n')));
}

}  // namespace qchopper

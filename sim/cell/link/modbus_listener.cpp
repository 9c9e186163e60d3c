// POSIX sockets; addresses are checked by inet_pton, which is strict. O(1).

#include "sim/cell/link/modbus_listener.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <optional>

#include "base/error.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const ListenAt& where, const std::string& why, const Sentence& to_do,
                         InputFault fault = InputFault::use) {
    throw InputError(fault, "cannot listen on " + where.host + ":" + std::to_string(where.port) + ": " + why, to_do);
}

// Nothing if it is no numeric address. inet_pton is strict: other functions accept "0" and "127.1".
std::optional<sockaddr_storage> parsed(const std::string& text) {
    sockaddr_storage address{};
    address.ss_family = AF_INET;
    if (inet_pton(AF_INET, text.c_str(), &reinterpret_cast<sockaddr_in&>(address).sin_addr) == 1) return address;
    address.ss_family = AF_INET6;
    if (inet_pton(AF_INET6, text.c_str(), &reinterpret_cast<sockaddr_in6&>(address).sin6_addr) == 1) return address;
    return std::nullopt;
}

}  // namespace

std::vector<std::string> checked_addresses(const std::vector<std::string>& addresses) {
    std::vector<std::string> checked;
    for (const std::string& text : addresses) {
        const std::optional<sockaddr_storage> address = parsed(text);
        if (!address) {
            throw InputError(InputFault::use, "\"" + text + "\" in the list of allowed addresses is no numeric address",
                             "Give an address such as 192.168.1.20 in its place: a name may come to stand for another "
                             "computer.");
        }
        checked.push_back(numeric(*address));
    }
    return checked;
}

std::string numeric(const sockaddr_storage& address) {
    char text[INET6_ADDRSTRLEN] = "";
    if (address.ss_family == AF_INET) {
        inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(address).sin_addr, text, sizeof text);
    } else {
        inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr, text, sizeof text);
    }
    // An IPv4 peer of an IPv6 socket.
    const std::string whole = text;
    return whole.starts_with("::ffff:") ? whole.substr(7) : whole;
}

bool is_loopback(const std::string& address) {
    return address == "::1" || address.starts_with("127.");
}

Listener listen_on(const ListenAt& where) {
    const std::string host = where.host == "localhost" ? "127.0.0.1" : where.host;
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
    addrinfo* found = nullptr;
    if (!parsed(host) || getaddrinfo(host.c_str(), std::to_string(where.port).c_str(), &wanted, &found) != 0) {
        refuse(where, "this is not a numeric address", "Give an address such as 127.0.0.1.");
    }
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> guard(found, &freeaddrinfo);
    if (!is_loopback(host) && where.allow.empty()) {
        refuse(where, "other computers could reach it, and no list of allowed addresses is given",
               Sentence::with_key("list_who_may_connect", {},
                                  "Listen on 127.0.0.1, or list the addresses that may connect."));
    }
    const int fd = socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) refuse(where, std::strerror(errno), "", InputFault::create);
    const int on = 1;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    if (bind(fd, found->ai_addr, found->ai_addrlen) != 0 || listen(fd, SOMAXCONN) != 0 ||
        getsockname(fd, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
        const int error = errno;
        close(fd);
        refuse(where, std::strerror(error), "Choose another port, or 0 for a free one.", InputFault::create);
    }
    const std::uint16_t port = bound.ss_family == AF_INET ? reinterpret_cast<const sockaddr_in&>(bound).sin_port
                                                          : reinterpret_cast<const sockaddr_in6&>(bound).sin6_port;
    return {fd, ntohs(port)};
}

}  // namespace qchopper

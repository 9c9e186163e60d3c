// Where the server of a cell listens, its socket, and the addresses of its peers as text.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct sockaddr_storage;

namespace qchopper {

struct ListenAt {
    std::string host = "127.0.0.1";  // numeric; any other than loopback needs an allow-list
    std::uint16_t port = 0;          // 0: a free one
    std::vector<std::string> allow;  // numeric addresses that may connect, empty: all; loopback always may
};

struct Listener {
    int fd = -1;
    std::uint16_t port = 0;
};

// Non-blocking. Throws InputError (use, create): address not numeric, not allowed, or in use.
Listener listen_on(const ListenAt& where);

// In the form that numeric() gives. Throws InputError (use) for a name, a range, or anything else that is no address.
std::vector<std::string> checked_addresses(const std::vector<std::string>& addresses);

// Numeric; an IPv4 peer of an IPv6 socket as IPv4.
std::string numeric(const sockaddr_storage& address);
bool is_loopback(const std::string& address);

}  // namespace qchopper

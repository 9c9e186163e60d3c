// The listening socket of the cell's server, and the addresses of its peers as text.
//
// For modbus_server.cpp only.

#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <string>
#include <vector>

namespace qchopper {

struct Listener {
    int fd = -1;
    std::uint16_t port = 0;
};

// Where to listen; see ModbusServerOptions.
struct ListenerOptions {
    std::string host;
    std::uint16_t port = 0;
    std::vector<std::string> allow;
};
// Non-blocking. Throws InputError (use, create): address not numeric, not allowed, or in use.
Listener listen_on(const ListenerOptions& options);

// Numeric; an IPv4 peer of an IPv6 socket as IPv4.
std::string numeric(const sockaddr_storage& address);
bool is_loopback(const std::string& address);

}  // namespace qchopper

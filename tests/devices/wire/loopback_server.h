// A TCP server on a free port of 127.0.0.1, for peers that answer wrongly.
//
// Accepts one connection after the other in a thread of its own and passes each to a function. The destructor waits for
// the function to return.

#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <thread>
#include <utility>

namespace qchopper {

// Binds a TCP socket to a free port of 127.0.0.1 and returns the port.
inline std::uint16_t bind_to_loopback(int descriptor) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size), 0);
    return ntohs(address.sin_port);
}

class LoopbackServer {
    int listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);

 public:
    // `serve` gets the descriptor of a connection and its number, from 1; the descriptor is closed after it.
    explicit LoopbackServer(std::function<void(int fd, int number)> serve) {
        EXPECT_EQ(listen(listener_, 8), 0);
        thread_ = std::thread([this, serve = std::move(serve)] {
            for (int number = 1;; ++number) {
                const int fd = accept(listener_, nullptr, nullptr);
                if (fd < 0) return;
                serve(fd, number);
                close(fd);
            }
        });
    }
    ~LoopbackServer() {
        shutdown(listener_, SHUT_RDWR);
        thread_.join();
        close(listener_);
    }
    LoopbackServer(const LoopbackServer&) = delete;
    LoopbackServer& operator=(const LoopbackServer&) = delete;

    const std::uint16_t port = bind_to_loopback(listener_);

 private:
    std::thread thread_;
};

}  // namespace qchopper

// A strict Modbus TCP server: frames by their length field, never waits for one client while others want something.
//
// One thread, poll(), a buffer per connection. Closed: a protocol id that is not 0, a length outside 2..254, a frame
// that is not complete after 2 s, an answer that is not fetched for 2 s, a minute of silence, the 9th connection
// (tests/sim/server_test.cpp). Knows nothing of registers.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/file.h"

namespace qchopper {

struct ModbusServerOptions {
    std::string host = "127.0.0.1";  // numeric; another than loopback needs an allow-list
    std::uint16_t port = 0;          // 0: a free one
    std::vector<std::string> allow;  // numeric addresses that may connect; loopback always may
    double frame_s = 2;
    double drain_s = 2;
    double idle_s = 60;
    double tick_s = 0.02;  // how often on_tick is called
};

class ModbusServer {
 public:
    // Answers one request; called from the server's thread. Must be quick.
    using Answer = std::function<Bytes(std::uint8_t unit, std::span<const std::uint8_t> pdu)>;

    ModbusServer(ModbusServerOptions options, Answer answer, std::function<void()> on_tick,
                 std::function<void(const std::string&)> on_message);
    ~ModbusServer();
    ModbusServer(const ModbusServer&) = delete;
    ModbusServer& operator=(const ModbusServer&) = delete;

    // Binds, listens, serves in a thread. Throws InputError: address not allowed or in use.
    void start();
    std::uint16_t port() const;
    void stop();

 private:
    struct Loop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace qchopper

// A strict Modbus TCP server: passes the PDU of each request to a function and sends its answer.
//
// A slow client never delays another. A connection is closed for a protocol id other than 0, a length outside 2..254, a
// frame not complete after frame_s, an answer not read for drain_s, nothing received for idle_s, and if it is the 9th;
// but one without a whole request for frame_s, since its last or its beginning, is closed in place of the 9th: of
// several the one that has been without for the longest. Memory is bounded for each connection.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "sim/cell/faults.h"
#include "sim/cell/modbus_listener.h"

namespace qchopper {

struct ModbusServerOptions : ListenAt {
    double frame_s = 2;
    double drain_s = 2;
    double idle_s = 60;
    double tick_s = 0.02;  // longest time between two calls of on_tick
    // What is sent for an answer with its header; empty: the answer at once. For faults on the way out.
    std::function<std::vector<Delivery>(Bytes frame)> deliver;
};

class ModbusServer {
 public:
    // Answers one request with a PDU of 1 to 253 bytes; an empty one closes the connection. All functions are called
    // from the server's thread, and while one runs, no client is served. They must not throw. on_message may be empty.
    using Answer = std::function<Bytes(std::uint8_t unit, std::span<const std::uint8_t> pdu)>;

    ModbusServer(ModbusServerOptions options, Answer answer, std::function<void()> on_tick,
                 std::function<void(const std::string&)> on_message);
    ~ModbusServer();
    ModbusServer(const ModbusServer&) = delete;
    ModbusServer& operator=(const ModbusServer&) = delete;

    // Binds, listens, serves in a thread; while that runs, a second call has no effect. Throws InputError (use,
    // create): address not numeric, not allowed, or in use.
    void start();
    std::uint16_t port() const;  // after start()
    void set_power(bool is_on);  // without power it closes all connections; may be called from any thread
    void stop();                 // closes all connections; a second call has no effect

 private:
    struct Loop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace qchopper

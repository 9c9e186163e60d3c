// A strict Modbus TCP server: passes the PDU of each request to a function and sends its answer.
//
// A slow or hostile client never delays another. A newcomer always gets a place, as modbus_places.h states. A
// connection is closed for a protocol id other than 0, a length outside 2..254, a frame not complete after frame_s, an
// answer not read for drain_s, and nothing received for idle_s. The requests of the clients at one address are
// answered at peer_rate at most and wait beyond that, but the first eight of each connection, and those of the holder
// of the lease, do not count. What is refused is told in at most one line a minute. Memory is bounded.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "sim/cell/faults.h"
#include "sim/cell/link/modbus_listener.h"
#include "sim/cell/link/modbus_places.h"

namespace qchopper {

struct ModbusServerOptions : ListenAt {
    Places places;
    double frame_s = 2;
    double drain_s = 2;
    double idle_s = 60;
    double peer_rate = 200;   // requests per second of one address, > 0
    double peer_burst = 400;  // which it may send at once, > 0
    double tick_s = 0.02;     // longest time between two calls of on_tick
    // What is sent for an answer with its header; empty: the answer at once. For faults on the way out.
    std::function<std::vector<Delivery>(Bytes frame)> deliver;
    std::function<std::uint64_t()> lease;  // names the lease that is alive; 0: there is none. Empty: never one
    std::function<void(std::uint64_t connection)> on_close;
};

struct ServerRequest {
    std::uint64_t connection = 0;  // running number, from 1
    std::uint8_t unit = 0;
    std::span<const std::uint8_t> pdu;  // 1 to 253 bytes
};

struct ServerAnswer {
    Bytes pdu;                // empty: closes the connection
    bool is_valid = true;     // what was asked makes sense; an exception is never valid
    std::uint64_t lease = 0;  // that the request named rightly as its own; 0: none
};

class ModbusServer {
 public:
    // Answers one request. All functions are called from the server's thread, and while one runs, no client is served.
    // They must not throw. on_message may be empty.
    using Answer = std::function<ServerAnswer(const ServerRequest&)>;

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

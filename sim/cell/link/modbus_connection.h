// One client of the Modbus server: its socket, what was received of it, what is to be sent to it, and since when.
//
// Used by modbus_server.cpp only. Memory: ModbusStream::input_bytes and output_bytes at most; a client that has not
// read so much is not read either.

#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sim/cell/faults.h"
#include "sim/cell/link/modbus_stream.h"

namespace qchopper {

using LinkTime = std::chrono::steady_clock::time_point;

// In seconds.
inline double seconds_between(LinkTime then, LinkTime now) {
    return std::chrono::duration<double>(now - then).count();
}

class ModbusConnection {
 public:
    ModbusConnection(int socket, std::string address, std::uint64_t running_number, LinkTime now);
    ~ModbusConnection();  // closes the socket
    ModbusConnection(const ModbusConnection&) = delete;
    ModbusConnection& operator=(const ModbusConnection&) = delete;

    const int fd;
    const std::string peer;      // its address, numeric
    const std::uint64_t number;  // of the connections of one server, in their order
    ModbusStream stream;
    std::uint64_t answered = 0;          // requests so far
    std::optional<LinkTime> last_valid;  // when a valid request was answered last
    LinkTime last_byte;
    LinkTime frame_began;   // of the frame that is not complete yet
    LinkTime output_moved;  // when something was last sent, or the output began to fill

    bool is_full() const;         // so much waits to be sent that no further request is answered
    bool waits_for_turn() const;  // a whole request is here that could be answered
    bool has_output() const { return !output_.empty(); }
    bool may_send_more() const { return !has_ended_; }  // the client has not closed its side
    bool is_done() const;                               // nothing more will come, and all is sent

    // Each returns false if the connection is broken and to be closed.
    bool receive(LinkTime now);   // what is there, up to the space of the stream
    bool flush(LinkTime now);     // what the socket takes at once
    bool send_due(LinkTime now);  // of the held parts

    // Behind what is held already.
    void hold(std::vector<Delivery> parts, LinkTime now);

 private:
    struct Held {  // a part of an answer that is not to be sent yet
        LinkTime due;
        Bytes bytes;
        bool then_close = false;
    };
    void move_due(LinkTime now);

    Bytes output_;
    std::deque<Held> held_;   // after what stands in output_
    bool ends_ = false;       // to be closed as soon as the output is sent
    bool has_ended_ = false;  // the client has closed its side
};

}  // namespace qchopper

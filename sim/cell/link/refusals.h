// Counts what a server refuses to its clients, and says so in at most one line a minute.

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "sim/cell/link/modbus_connection.h"

namespace qchopper {

enum class RefusedBecause {
    not_listed,     // its address is not on the list
    gave_place,     // closed, because another connection needed the place
    not_modbus,     // what it sent is no Modbus TCP
    not_whole,      // its request was not whole in time
    not_read,       // it did not read its answers in time
    silent,         // it sent nothing for too long
    no_descriptor,  // the process may open no more sockets
    count
};

class Refusals {
 public:
    void add(RefusedBecause why, const std::string& peer, LinkTime now);
    // The line, if one is due: a second after the first refusal, and a minute after the last line.
    std::optional<std::string> line(LinkTime now);
    // What was counted since the last line; none: nothing was. For the end of a server.
    std::optional<std::string> rest();

 private:
    std::array<std::size_t, static_cast<std::size_t>(RefusedBecause::count)> counts_{};
    std::string last_peer_;
    std::optional<LinkTime> first_;  // refusal since the last line
    std::optional<LinkTime> last_line_;
};

}  // namespace qchopper

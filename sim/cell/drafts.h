// TICKET and SIGNATURE as each connection has written them.
//
// STORE takes what came over its own connection, so that another client that writes there in between does no harm; a
// connection that has written neither takes what was written last by any, as on a controller that does not tell its
// clients apart.

#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "devices/wire/layout.h"
#include "sim/cell/cell_state.h"

namespace qchopper {

class Drafts {
 public:
    // The cell has the drafts that hold for this connection until end(), which notes what its request has written.
    void begin(std::uint64_t connection, CellState& cell);
    void end(std::uint64_t connection, std::span<const std::uint8_t> pdu, CellState& cell);
    void forget(std::uint64_t connection);

 private:
    struct Pair {
        Registers ticket;
        Registers signature;
    };
    std::map<std::uint64_t, Pair> own_;  // by connection
    Pair last_;                          // by any
};

}  // namespace qchopper

// Who has to go when a server has no place for one more connection.
//
// Before its first request nobody knows whether a newcomer is an operator. So it always gets a place: that of the
// stranger whose last valid request is the oldest, where one without a valid request comes before all others. The
// connection of the holder of the lease is never the one.

#pragma once

#include <cstdint>
#include <list>
#include <string>

#include "sim/cell/link/modbus_connection.h"

namespace qchopper {

struct Places {
    std::size_t in_all = 128;
    std::size_t of_a_peer = 64;  // of one address, so that one leaves room for others
};

// The connection that has to go before one from `peer` may be added; end() if there is room. `kept` is the number of
// the connection that stays in any case, 0 for none. Precondition: both counts of `places` are 2 or more.
std::list<ModbusConnection>::iterator leaver(std::list<ModbusConnection>& connections, const std::string& peer,
                                             std::uint64_t kept, const Places& places);

}  // namespace qchopper

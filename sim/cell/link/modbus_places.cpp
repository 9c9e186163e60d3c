// Two passes over the connections. O(connections).

#include "sim/cell/link/modbus_places.h"

#include <algorithm>
#include <utility>

namespace qchopper {

std::list<ModbusConnection>::iterator leaver(std::list<ModbusConnection>& connections, const std::string& peer,
                                             std::uint64_t kept, const Places& places) {
    const auto is_of_peer = [&](const ModbusConnection& one) { return one.peer == peer; };
    const auto of_peer = static_cast<std::size_t>(std::ranges::count_if(connections, is_of_peer));
    const bool peer_is_full = of_peer >= places.of_a_peer;
    auto oldest = connections.end();
    if (!peer_is_full && connections.size() < places.in_all) return oldest;
    for (auto one = connections.begin(); one != connections.end(); ++one) {
        if (one->number == kept || (peer_is_full && !is_of_peer(*one))) continue;
        const bool is_older = oldest == connections.end() ||
                              std::pair(one->last_valid, one->number) < std::pair(oldest->last_valid, oldest->number);
        if (is_older) oldest = one;
    }
    return oldest;
}

}  // namespace qchopper

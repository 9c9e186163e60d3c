// The one seam to the outside world: registers of a cell, read and written a block at a time.
//
// Addresses are 0-based. A call ends within a bound that its maker states; after `lost` nobody knows whether a write
// arrived, and the next call starts on a fresh connection. No call is ever repeated inside the bus.

#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace qchopper {

using Registers = std::vector<std::uint16_t>;

enum class BusEnd {
    ok,
    exception,  // the server refused this request; the connection is as good as before
    lost        // no answer, or one that cannot be trusted
};

struct BusAnswer {
    BusEnd end = BusEnd::lost;
    int exception = 0;      // Modbus exception code if end is exception
    Registers registers;    // what was read
    std::string why;        // for people, if end is not ok
    bool is_alien = false;  // with `lost`: what came is no answer to the request
    bool is_ok() const { return end == BusEnd::ok; }
};

class RegisterBus {
 public:
    virtual ~RegisterBus() = default;
    virtual BusAnswer read_input(std::uint16_t address, std::uint16_t count) = 0;
    virtual BusAnswer read_holding(std::uint16_t address, std::uint16_t count) = 0;
    virtual BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) = 0;
    // From when `cancelled` is set, which may be during a call, all calls together take no longer than within_s: what
    // is asked for after that is lost at once. nullptr: no longer. A bus whose calls never wait needs nothing here.
    virtual void leave_when(const std::atomic<bool>* cancelled, double within_s) {
        static_cast<void>(cancelled);
        static_cast<void>(within_s);
    }
};

}  // namespace qchopper

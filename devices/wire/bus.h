// The registers of a cell: read and written one block at a time. The only virtual interface of the program.
//
// Addresses are 0-based. A call ends within a time that the implementation states. After `lost` it is unknown whether a
// write has arrived, and the next call uses a new connection. An implementation never repeats a request by itself.

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
    exception,  // the server refused this request; the connection stays usable
    lost        // no answer, or one that is not an answer to the request
};

struct BusAnswer {
    BusEnd end = BusEnd::lost;
    int exception = 0;      // Modbus exception code if end is exception
    Registers registers;    // of a read that ended ok: as many as were asked for
    std::string why;        // the reason if end is not ok, for the operator
    bool is_alien = false;  // with `lost`: bytes came that are no answer to the request
    bool is_ok() const { return end == BusEnd::ok; }
};

class RegisterBus {
 public:
    virtual ~RegisterBus() = default;
    // `count` of 1 to 125 registers; any other count ends as exception 3 and nothing is sent.
    virtual BusAnswer read_input(std::uint16_t address, std::uint16_t count) = 0;
    virtual BusAnswer read_holding(std::uint16_t address, std::uint16_t count) = 0;
    // 1 to 123 registers, otherwise the same.
    virtual BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) = 0;
    // Once `cancelled` is set, before or during a call, all calls from then on together take at most within_s seconds;
    // a call after that is lost at once. nullptr removes the limit; until then `cancelled` must live. A bus whose calls
    // never wait need not override this.
    virtual void leave_when(const std::atomic<bool>* cancelled, double within_s) {
        static_cast<void>(cancelled);
        static_cast<void>(within_s);
    }
    // Seconds since a call, or this function, noticed that it is set; 0 if it is not.
    virtual double leaving_for_s() const { return 0; }
};

}  // namespace qchopper

// The bus over Modbus TCP; frames as in modbus_frame.h (docs/decisions/0016-requests-are-framed-by-us.md).
//
// A call on an open connection ends within call_s, even if the peer sends one byte at a time; a call without one
// connects first, within connect_s (tests/devices/wire/modbus_tcp_test.cpp). Every failure except an exception answer
// closes the connection, and so does an answer that is not right in every field; the next call opens a new one. Calls
// do not throw. To be used from one thread.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "devices/wire/bus.h"

namespace qchopper {

struct TcpAddress {
    std::string host;  // IPv4, IPv6 or a name
    std::uint16_t port = 502;
};

// "127.0.0.1:15020", "cell-3:502", "[::1]:502"; without a port 502. Throws InputError (use) if `text` is no address.
TcpAddress parse_tcp_address(const std::string& text);

// The numeric addresses that a name stands for, "127.0.0.1:15020", in the order in which they are tried; those that
// are numeric already are written in one form. Empty if the name is not resolved within so many seconds.
std::vector<std::string> numeric_addresses(const TcpAddress& address, double within_s = 2);

// Upper bounds in seconds.
struct ModbusTimings {
    double connect_s = 2;   // resolving the name and connecting, all addresses together
    double response_s = 1;  // until the first byte of an answer
    double call_s = 2;      // a whole call on an open connection
};

class ModbusTcpBus : public RegisterBus {
 public:
    // Connects with the first call.
    explicit ModbusTcpBus(TcpAddress address, std::uint8_t unit = 255, ModbusTimings timings = {});
    ~ModbusTcpBus() override;
    ModbusTcpBus(const ModbusTcpBus&) = delete;
    ModbusTcpBus& operator=(const ModbusTcpBus&) = delete;

    // Connects now. Throws DeviceError (unreachable) within connect_s.
    void connect();
    // The numeric address to which the last connection was made, as by numeric_addresses(); "" before the first.
    std::string peer() const;

    BusAnswer read_input(std::uint16_t address, std::uint16_t count) override;
    BusAnswer read_holding(std::uint16_t address, std::uint16_t count) override;
    BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) override;
    void leave_when(const std::atomic<bool>* cancelled, double within_s) override;
    double leaving_for_s() const override;

 private:
    struct Link;
    std::unique_ptr<Link> link_;
};

}  // namespace qchopper

// The bus over Modbus TCP; frames as in modbus_frame.h (docs/decisions/0016-requests-are-framed-by-us.md).
//
// Every call ends within `call_s`, even if the peer sends one byte at a time (tests/devices/modbus_tcp_test.cpp). Any
// failure but an exception answer closes the connection, and so does an answer that is not wholly right; the next call
// connects anew. Use an object from one thread.

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "devices/bus.h"

namespace qchopper {

struct TcpAddress {
    std::string host;  // IPv4, IPv6 or a name
    std::uint16_t port = 502;
};

// "127.0.0.1:15020", "cell-3:502", "[::1]:502"; without a port 502. Throws InputError (use).
TcpAddress parse_tcp_address(const std::string& text);

struct ModbusTimings {
    double connect_s = 2;   // finding the name and connecting, all addresses together
    double response_s = 1;  // until the first byte of an answer
    double call_s = 2;      // a whole call on an open connection
};

class ModbusTcpBus : public RegisterBus {
 public:
    explicit ModbusTcpBus(TcpAddress address, std::uint8_t unit = 255, ModbusTimings timings = {});
    ~ModbusTcpBus() override;
    ModbusTcpBus(const ModbusTcpBus&) = delete;
    ModbusTcpBus& operator=(const ModbusTcpBus&) = delete;

    // Connects now. Throws DeviceError (unreachable) within connect_s.
    void connect();

    BusAnswer read_input(std::uint16_t address, std::uint16_t count) override;
    BusAnswer read_holding(std::uint16_t address, std::uint16_t count) override;
    BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) override;
    void leave_when(const std::atomic<bool>* cancelled, double within_s) override;

 private:
    struct Link;
    std::unique_ptr<Link> link_;
};

}  // namespace qchopper

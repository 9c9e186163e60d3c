// The bus of one PC to the cell of a World: as ModbusTcpBus, in virtual time and over the fault proxy.
//
// The same frames, the same checks of answers, the same time limits: 1 s until the first byte, 2 s for a call. After
// `lost` the connection is closed, and the next call opens another.

#pragma once

#include "devices/wire/bus.h"
#include "devices/wire/modbus_frame.h"
#include "tests/schedules/world.h"

namespace qchopper::schedules {

class VirtualLink : public RegisterBus {
 public:
    explicit VirtualLink(World& world) : world_(world) {}
    ~VirtualLink() override { drop(); }
    VirtualLink(const VirtualLink&) = delete;
    VirtualLink& operator=(const VirtualLink&) = delete;

    BusAnswer read_input(std::uint16_t address, std::uint16_t count) override;
    BusAnswer read_holding(std::uint16_t address, std::uint16_t count) override;
    BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) override;
    void leave_when(const std::atomic<bool>* cancelled, double within_s) override;
    double leaving_for_s() const override;

 private:
    BusAnswer call(ModbusRequest request);
    BusAnswer exchange(const ModbusRequest& request);
    BusAnswer receive(const ModbusRequest& request);
    double bounded(double deadline_s) const;
    void drop();

    World& world_;
    int connection_ = -1;
    std::uint16_t transaction_ = 0;
    const std::atomic<bool>* cancelled_ = nullptr;
    double within_s_ = 0;
    mutable double leave_by_s_ = 1e300;
};

}  // namespace qchopper::schedules

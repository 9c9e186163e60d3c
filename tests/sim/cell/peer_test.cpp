// The cell against an independent client: libmodbus, used directly.

#include <gtest/gtest.h>
#include <modbus.h>

#include <cerrno>
#include <memory>

#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

struct FreeModbus {
    void operator()(modbus_t* context) const {
        modbus_close(context);
        modbus_free(context);
    }
};

struct Peer {
    Peer() : sim(rig::quick_cell(folder.path)) {
        sim.start();
        client.reset(modbus_new_tcp("127.0.0.1", sim.port()));
        EXPECT_EQ(modbus_connect(client.get()), 0) << modbus_strerror(errno);
    }
    rig::Folder folder;
    CellSim sim;
    std::unique_ptr<modbus_t, FreeModbus> client;
};

TEST(Peer, LibmodbusReadsTheStatus) {
    const Peer peer;
    std::uint16_t registers[MODBUS_MAX_READ_REGISTERS] = {};
    ASSERT_EQ(modbus_read_input_registers(peer.client.get(), 0, 100, registers), 100) << modbus_strerror(errno);
    EXPECT_EQ(registers[0], 0x5143);
    EXPECT_EQ(registers[7], 2);  // Stopped
    EXPECT_EQ(registers[13], 0xFFFF);
    EXPECT_NE(registers[9] & (1 << 9), 0);
    EXPECT_TRUE(decode<Status>(std::span(registers).first(100)).is_ok());
}

TEST(Peer, LibmodbusClaimsTheCellWithRegistersWrittenByHand) {
    const Peer peer;
    std::uint16_t registers[60] = {0x5143, 0x0100, 0, 1, 0, 1, 100, 0};
    registers[38] = 0xABCD;
    registers[39] = 0xEF01;
    const std::uint32_t crc = crc32_of_registers(std::span(registers).first(58));
    registers[58] = static_cast<std::uint16_t>(crc >> 16);
    registers[59] = static_cast<std::uint16_t>(crc & 0xFFFF);
    ASSERT_EQ(modbus_write_registers(peer.client.get(), 0, 60, registers), 60) << modbus_strerror(errno);
    std::uint16_t status[MODBUS_MAX_READ_REGISTERS] = {};
    ASSERT_EQ(modbus_read_input_registers(peer.client.get(), 0, 100, status), 100);
    EXPECT_EQ(status[17], 1);       // OK
    EXPECT_EQ(status[91], 0xABCD);  // OWNER_HELD
    EXPECT_EQ(status[92], 0xEF01);
    EXPECT_EQ(status[11], 1);  // EPOCH_HELD
}

TEST(Peer, LibmodbusGetsAnExceptionForWhatIsNotServed) {
    const Peer peer;
    modbus_t* client = peer.client.get();
    std::uint16_t registers[MODBUS_MAX_READ_REGISTERS] = {};
    std::uint8_t bits[8] = {};
    EXPECT_EQ(modbus_write_register(client, 0, 1), -1);  // function 6
    EXPECT_EQ(errno, EMBXILFUN);
    EXPECT_EQ(modbus_read_bits(client, 0, 8, bits), -1);
    EXPECT_EQ(errno, EMBXILFUN);
    EXPECT_EQ(modbus_read_input_registers(client, 150, 10, registers), -1);
    EXPECT_EQ(errno, EMBXILADD);
    EXPECT_EQ(modbus_write_registers(client, 0, 59, registers), -1);
    EXPECT_EQ(errno, EMBXILADD);
    modbus_set_slave(client, 7);
    EXPECT_EQ(modbus_read_input_registers(client, 0, 1, registers), -1);
    EXPECT_EQ(errno, EMBXGTAR);
    modbus_set_slave(client, 1);
    EXPECT_EQ(modbus_read_input_registers(client, 0, 1, registers), 1);  // and the connection stays usable
}

TEST(Peer, GarbageInAllHoldingRegistersStartsNothing) {
    const Peer peer;
    std::uint16_t registers[123];
    for (int n = 0; n < 50; ++n) {
        for (int i = 0; i < 123; ++i) registers[i] = static_cast<std::uint16_t>(31 * n + 7919 * i);
        modbus_write_registers(peer.client.get(), 0, 60, registers);
        modbus_write_registers(peer.client.get(), 100, 100, registers);
        modbus_write_registers(peer.client.get(), 200, 32, registers);
        modbus_write_registers(peer.client.get(), 300, 121, registers);
        modbus_write_registers(peer.client.get(), 500, 5, registers);
    }
    EXPECT_EQ(peer.sim.status().starts_total, 0U);
    EXPECT_EQ(peer.sim.status().state, PackState::stopped);
    EXPECT_EQ(peer.sim.status().bad_frames, 50);
}

}  // namespace
}  // namespace qchopper

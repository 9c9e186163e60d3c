// ModbusTcpBus against the cell's server.

#include <gtest/gtest.h>

#include "devices/wire/codec.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

struct Link {
    Link() : sim(rig::quick_cell(folder.path)) {
        sim.start();
        bus = rig::connect(sim);
    }
    rig::Folder folder;
    CellSim sim;
    std::unique_ptr<ModbusTcpBus> bus;
};

TEST(Bus, ReadsTheStatusOfTheCell) {
    const Link link;
    const BusAnswer answer = link.bus->read_input(status_block.base, status_block.count);
    ASSERT_TRUE(answer.is_ok()) << answer.why;
    const Decoded<Status> status = decode<Status>(answer.registers);
    ASSERT_TRUE(status.is_ok());
    EXPECT_EQ(status.value.cell_id, any_cell_id);
    EXPECT_TRUE(status.value.has(flag::simulated));
}

TEST(Bus, AnExceptionIsAnAnswerAndTheNextCallGoesOn) {
    const Link link;
    const BusAnswer refused = link.bus->read_input(150, 1);
    EXPECT_EQ(refused.end, BusEnd::exception);
    EXPECT_EQ(refused.exception, 2);
    EXPECT_FALSE(refused.why.empty());
    EXPECT_TRUE(link.bus->read_input(0, 1).is_ok());
}

TEST(Bus, HoldingRegistersReadAsZero) {
    const Link link;
    ASSERT_TRUE(link.bus->write_holding(heartbeat_block.base, encode(Heartbeat{1, 2, 3})).is_ok());
    const BusAnswer answer = link.bus->read_holding(heartbeat_block.base, 5);
    ASSERT_TRUE(answer.is_ok());
    EXPECT_EQ(answer.registers, Registers(5, 0));
}

TEST(Bus, ACellThatWentAndCameBackIsFoundAgain) {
    rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    auto sim = std::make_unique<CellSim>(options);
    sim->start();
    options.port = sim->port();
    ModbusTcpBus bus({"127.0.0.1", options.port});
    EXPECT_TRUE(bus.read_input(0, 1).is_ok());
    sim->stop();
    EXPECT_EQ(bus.read_input(0, 1).end, BusEnd::lost);
    EXPECT_EQ(bus.read_input(0, 1).end, BusEnd::lost);
    sim = std::make_unique<CellSim>(options);
    sim->start();
    EXPECT_TRUE(bus.read_input(0, 1).is_ok());
}

}  // namespace
}  // namespace qchopper

// What the tests of the link share: a job to send, a cell to send it to, a raw socket for wrong frames.

#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "devices/hand_off/dispatch.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/cell_sim.h"
#include "tests/folder.h"

namespace qchopper::rig {

using qchopper::Folder;

struct Job {
    Bytes file;
    JobTicket ticket;
};
// `bytes` pseudo-random bytes and a sound ticket for them that takes `seconds`.
Job make_job(std::size_t bytes = 5000, std::uint32_t seconds = 20);

// A cell that runs jobs 100 times as fast, and a dispatcher that polls quickly.
CellSimOptions quick_cell(const std::filesystem::path& drop);
DispatchOptions quick_dispatch(const std::filesystem::path& drop);

std::unique_ptr<ModbusTcpBus> connect(const CellSim& cell);

// The first IPv4 address of this computer that is not of loopback; empty: there is none.
std::string own_address();

// A TCP connection that sends any bytes.
class RawSocket {
 public:
    // From this numeric address; empty: the one that the system chooses.
    explicit RawSocket(std::uint16_t port, const std::string& host = "127.0.0.1", const std::string& from = {});
    ~RawSocket();
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;
    void send(const Bytes& bytes) const;
    // Up to `count` bytes; fewer if the peer closes or nothing comes for `seconds`.
    Bytes receive(std::size_t count, double seconds = 1) const;
    bool is_closed_within(double seconds) const;

 private:
    int fd_;
};

// MBAP header and PDU.
Bytes frame(std::uint16_t transaction, const Bytes& pdu, std::uint8_t unit = 1);
Bytes read_request(std::uint8_t function, std::uint16_t address, std::uint16_t count);
Bytes write_request(std::uint16_t address, const Registers& registers);

}  // namespace qchopper::rig

// docs/user/tls.md as it stands: who is let in to a cell behind stunnel, and who is not.

#include <gtest/gtest.h>

#include <atomic>

#include "devices/hand_off/first_contact.h"
#include "devices/wire/device_error.h"
#include "sim/cell/link/modbus_server.h"
#include "sim/cell/modbus_pdu.h"
#include "tests/sim/cell/cell_rig.h"
#include "tests/sim/cell/tls_rig.h"

namespace qchopper {
namespace {

constexpr const char* cell_name = "cell-1.plant.example";
constexpr const char* office_name = "office-pc.plant.example";

// Two authorities, and certificates of all kinds, made once.
struct Plant {
    Plant() : authority(folder.path / "plant"), other(folder.path / "other") {
        authority.issue(cell_name);
        authority.issue(office_name);
        authority.issue("expired", "-startdate 20200101000000Z -enddate 20200102000000Z");
        authority.issue("old-pc");
        authority.revoke("old-pc");
        other.issue(office_name);
        std::filesystem::copy(authority.folder(), no_crl);
        std::filesystem::remove(no_crl / "plant-crl.pem");
        std::filesystem::copy(authority.folder(), old_crl);
        std::filesystem::copy(authority.folder(), mixed);
        for (const char* suffix : {".pem", ".key"}) {
            std::filesystem::copy(other.folder() / (std::string(office_name) + suffix),
                                  mixed / (std::string("foreign") + suffix));
        }
        authority.make_crl("-crl_lastupdate 20200101000000Z -crl_nextupdate 20200102000000Z");
        std::filesystem::copy(authority.folder() / "plant-crl.pem", old_crl / "plant-crl.pem",
                              std::filesystem::copy_options::overwrite_existing);
    }
    rig::Folder folder;
    rig::Authority authority;
    rig::Authority other;
    std::filesystem::path mixed = folder.path / "mixed";  // with a certificate of the other authority: foreign.pem
    std::filesystem::path no_crl = folder.path / "no-crl";
    std::filesystem::path old_crl = folder.path / "old-crl";
};

const Plant& plant() {
    static const Plant one;
    return one;
}

std::string cell_side() {
    return rig::blocks_of_tls_page("ini").at(0);
}

// With the certificate of this name.
std::string office_side(const std::string& name = office_name) {
    std::string text = rig::blocks_of_tls_page("ini").at(1);
    for (std::size_t at = 0; (at = text.find(office_name, at)) != std::string::npos; at += name.size()) {
        text.replace(at, std::string(office_name).size(), name);
    }
    return text;
}

// The two programs between a client and a server.
struct Tunnel {
    Tunnel(std::uint16_t server, const std::string& office, const std::filesystem::path& at_office,
           const std::filesystem::path& at_cell)
        : between(rig::free_port()),
          cell(cell_side(), at_cell, between, server),
          port(rig::free_port()),
          pc(office, at_office, port, between) {}
    explicit Tunnel(std::uint16_t server) : Tunnel(server, office_side(), plant().mixed, plant().mixed) {}
    std::string logs() const { return "at the cell:\n" + cell.log() + "at the office:\n" + pc.log(); }
    std::uint16_t between;
    rig::Stunnel cell;
    std::uint16_t port;
    rig::Stunnel pc;
};

struct Cell {
    Cell() {
        CellSimOptions options = rig::quick_cell(drop.path);
        sim = std::make_unique<CellSim>(options);
        sim->start();
    }
    rig::Folder drop;
    std::unique_ptr<CellSim> sim;
};

// The first STATUS comes through.
bool is_let_in(const Tunnel& tunnel) {
    ModbusTcpBus bus({"127.0.0.1", tunnel.port});
    try {
        return read_first_status(bus, "the cell", {}).has_value();
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault, DeviceFault::unreachable) << error.what();
        return false;
    }
}

struct Tls : testing::Test {
    void SetUp() override {
        if (!rig::has_stunnel()) GTEST_SKIP() << "stunnel4 is not installed here";
    }
};

TEST_F(Tls, OnlyARightCertificateIsLetIn) {
    const Cell cell;
    const auto tries = [&](const std::string& office) {
        const Tunnel tunnel(cell.sim->port(), office, plant().mixed, plant().mixed);
        EXPECT_TRUE(tunnel.cell.is_listening()) << tunnel.logs();
        EXPECT_TRUE(tunnel.pc.is_listening()) << tunnel.logs();
        const bool is_in = is_let_in(tunnel);
        return std::pair(is_in, tunnel.logs());
    };
    const auto [right, right_logs] = tries(office_side());
    EXPECT_TRUE(right) << right_logs;
    const auto refused = [&](const std::string& office, const std::string& why) {
        const auto [is_in, logs] = tries(office);
        EXPECT_FALSE(is_in) << why;
        EXPECT_NE(logs.find(why), std::string::npos) << logs;
    };
    refused(rig::without_key(rig::without_key(office_side(), "cert"), "key"), "peer did not return a certificate");
    refused(office_side("foreign"), "unable to get local issuer certificate");
    refused(office_side("expired"), "certificate has expired");
    refused(office_side("old-pc"), "certificate revoked");
    EXPECT_EQ(cell.sim->status().ack_seq, 0U);
}

TEST_F(Tls, WithoutTlsNobodyIsLetIn) {
    const Cell cell;
    const Tunnel tunnel(cell.sim->port());
    const rig::RawSocket plain(tunnel.between);
    plain.send(rig::frame(1, rig::read_request(4, 0, 1)));
    EXPECT_TRUE(plain.is_closed_within(10)) << tunnel.logs();
}

// The page says that the office computer asks for the name of the cell.
TEST_F(Tls, ACellOfAnotherNameIsNotTalkedTo) {
    const Cell cell;
    std::string office = office_side();
    office.replace(office.find("checkHost = ") + 12, std::string(cell_name).size(), "cell-2.plant.example");
    EXPECT_FALSE(is_let_in(Tunnel(cell.sim->port(), office, plant().mixed, plant().mixed)));
}

TEST_F(Tls, WithoutARevocationListStunnelDoesNotStart) {
    const Cell cell;
    const Tunnel at_cell(cell.sim->port(), office_side(), plant().mixed, plant().no_crl);
    EXPECT_FALSE(at_cell.cell.is_listening());
    EXPECT_NE(at_cell.cell.log().find("plant-crl.pem"), std::string::npos) << at_cell.logs();
    EXPECT_FALSE(is_let_in(at_cell));
    const Tunnel at_office(cell.sim->port(), office_side(), plant().no_crl, plant().mixed);
    EXPECT_FALSE(at_office.pc.is_listening());
    EXPECT_FALSE(is_let_in(at_office));
}

TEST_F(Tls, AnOldRevocationListLetsNobodyIn) {
    const Cell cell;
    const Tunnel at_cell(cell.sim->port(), office_side(), plant().mixed, plant().old_crl);
    EXPECT_FALSE(is_let_in(at_cell));
    EXPECT_NE(at_cell.logs().find("CRL has expired"), std::string::npos) << at_cell.logs();
    const Tunnel at_office(cell.sim->port(), office_side(), plant().old_crl, plant().mixed);
    EXPECT_FALSE(is_let_in(at_office));
}

TEST_F(Tls, AWholeHandOffGoesThrough) {
    const Cell cell;
    const Tunnel tunnel(cell.sim->port());
    const rig::Job job = rig::make_job(100000, 20);
    for (const std::filesystem::path& folder : {cell.drop.path, std::filesystem::path()}) {
        ModbusTcpBus bus({"127.0.0.1", tunnel.port});
        const JobOutcome outcome = dispatch_job(bus, job.ticket, job.file, rig::quick_dispatch(folder), {});
        EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << outcome.why << "\n" << tunnel.logs();
        EXPECT_TRUE(outcome.is_complete()) << outcome.why;
    }
    EXPECT_EQ(cell.sim->status().starts_total, 2U);
}

// Fails before the deadline of the first contact, and sends nothing.
TEST(Fault, F56_ADispatchWithAWrongCertificateReportsAndDoesNotHang) {
    if (!rig::has_stunnel()) GTEST_SKIP() << "stunnel4 is not installed here";
    const Cell cell;
    const rig::Job job = rig::make_job();
    const std::string nothing = rig::without_key(rig::without_key(office_side(), "cert"), "key");
    for (const std::string& office : {nothing, office_side("foreign"), office_side("expired"), office_side("old-pc")}) {
        const Tunnel tunnel(cell.sim->port(), office, plant().mixed, plant().mixed);
        ModbusTcpBus bus({"127.0.0.1", tunnel.port});
        try {
            dispatch_job(bus, job.ticket, job.file, rig::quick_dispatch(cell.drop.path), {});
            ADD_FAILURE() << "it was let in";
        } catch (const DeviceError& error) {
            EXPECT_EQ(error.fault, DeviceFault::unreachable) << error.what();
        }
    }
    EXPECT_EQ(cell.sim->status().starts_total, 0U);
    EXPECT_EQ(cell.sim->status().ack_seq, 0U);
}

// A cell that is real to those who read its STATUS: the simulated one, without bit 9 of FLAGS.
struct RealLooking {
    RealLooking() {
        hooks.save = [](const CellMemory&) { return true; };
        state = boot({}, {}, 1, {}, hooks);
        state.store_free_kib = 1000000;
        server = std::make_unique<ModbusServer>(
            ModbusServerOptions{},
            [this](const ServerRequest& request) {
                if (request.pdu[0] == 16) ++writes;
                return ServerAnswer{answer(request)};
            },
            [] {}, [](const std::string&) {});
        server->start();
    }
    ~RealLooking() { server->stop(); }
    Bytes answer(const ServerRequest& request) {
        now.steady_ms += 10;
        Bytes pdu = answer_pdu(request.unit, request.pdu, state, now, hooks);
        if (request.pdu[0] != 4 || pdu.size() != 2U + 2U * status_block.count || request.pdu[2] != 0) return pdu;
        Status shown = status_of(state, now);
        shown.flags = static_cast<std::uint16_t>(shown.flags & ~unsigned{flag::simulated});
        pdu.resize(2);
        for (const std::uint16_t value : encode(shown)) {
            pdu.push_back(static_cast<std::uint8_t>(value >> 8));
            pdu.push_back(static_cast<std::uint8_t>(value & 0xFF));
        }
        return pdu;
    }
    CellHooks hooks;
    CellTime now{1000000, 1700000000000};
    CellState state;
    std::atomic<int> writes = 0;
    std::unique_ptr<ModbusServer> server;
};

TEST_F(Tls, AJobForASimulatedCellStartsNoRealOneAndTheReverse) {
    RealLooking real;
    const rig::Job job = rig::make_job();
    const auto dispatch = [&](std::uint16_t server, bool want_simulated) {
        const Tunnel tunnel(server);
        ModbusTcpBus bus({"127.0.0.1", tunnel.port});
        DispatchOptions options = rig::quick_dispatch({});
        options.want_simulated = want_simulated;
        options.timings.answer_s = 2;
        return dispatch_job(bus, job.ticket, job.file, options, {});
    };
    EXPECT_THROW(dispatch(real.server->port(), true), DeviceError);
    EXPECT_EQ(real.writes, 0);
    const Cell simulated;
    EXPECT_THROW(dispatch(simulated.sim->port(), false), DeviceError);
    EXPECT_EQ(simulated.sim->status().ack_seq, 0U);
    // The ticket itself says for which kind it was made: here it is one for a real cell that comes to a simulated one.
    const JobOutcome outcome = dispatch(real.server->port(), false);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started) << outcome.why;
    EXPECT_EQ(outcome.refusal, AckResult::ticket_field) << outcome.why;
    EXPECT_GT(real.writes, 0);
    EXPECT_EQ(real.state.memory.starts_total, 0U);
}

}  // namespace
}  // namespace qchopper

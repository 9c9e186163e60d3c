// Who gets a place at the server, and how much the clients at one address may ask.

#include "sim/cell/link/modbus_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "devices/wire/codec.h"
#include "sim/cell/drafts.h"
#include "sim/cell/link/modbus_server.h"
#include "sim/cell/link/peer_rates.h"
#include "sim/cell/link/refusals.h"
#include "sim/cell/modbus_pdu.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using rig::frame;
using rig::RawSocket;
using rig::read_request;
using Sockets = std::vector<std::unique_ptr<RawSocket>>;

constexpr const char* here = "127.0.0.1";
constexpr std::uint64_t some_lease = 7;

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A server that answers what it can: a write names the lease, a read is valid, any other function is refused.
struct Served {
    explicit Served(ModbusServerOptions options) {
        options.lease = [this] { return lease.load(); };
        server = std::make_unique<ModbusServer>(
            options,
            [](const ServerRequest& request) {
                if (request.pdu[0] == 16) return ServerAnswer{{16, 0, 0, 0, 1}, true, some_lease};
                if (request.pdu[0] != 4) return ServerAnswer{{static_cast<std::uint8_t>(request.pdu[0] | 0x80U), 1}};
                return ServerAnswer{{4, 2, 0x51, 0x43}};
            },
            [] {},
            [this](const std::string& line) {
                const std::lock_guard lock(mutex);
                lines.push_back(line);
            });
        server->start();
    }
    explicit Served(const Places& places) : Served(with(places)) {}
    static ModbusServerOptions with(const Places& places) {
        ModbusServerOptions options;
        options.places = places;
        return options;
    }
    std::unique_ptr<RawSocket> connect(const std::string& from = {}) const {
        return std::make_unique<RawSocket>(server->port(), here, from);
    }
    std::vector<std::string> told() {
        server->stop();
        return lines;
    }
    std::atomic<std::uint64_t> lease = some_lease;
    std::mutex mutex;
    std::vector<std::string> lines;
    std::unique_ptr<ModbusServer> server;
};

void ask(const RawSocket& socket) {
    socket.send(frame(1, read_request(4, 0, 1)));
}
bool is_answered(const RawSocket& socket) {
    return socket.receive(11, 5).size() == 11;
}
bool is_served(const RawSocket& socket) {
    ask(socket);
    return is_answered(socket);
}
// A request that names the lease.
bool holds(const RawSocket& socket) {
    socket.send(frame(1, rig::write_request(0, {0})));
    return socket.receive(12, 5).size() == 12;
}
// Nothing has come, and nothing comes for a moment.
bool is_open(const RawSocket& socket) {
    return !socket.is_closed_within(0.1);
}

TEST(Places, ANewcomerTakesThatOfTheStrangerWhoseLastValidRequestIsOldest) {
    const Served served(Places{4, 4});
    Sockets sockets;
    for (int n = 0; n < 4; ++n) sockets.push_back(served.connect());
    for (const int n : {2, 0, 3, 1}) ASSERT_TRUE(is_served(*sockets[static_cast<std::size_t>(n)]));
    const RawSocket newcomer(served.server->port());
    EXPECT_TRUE(is_served(newcomer));
    EXPECT_TRUE(sockets[2]->is_closed_within(5));
    for (const std::size_t n : {0U, 1U, 3U}) EXPECT_TRUE(is_open(*sockets[n])) << n;
}

TEST(Places, WhoHasSentNothingValidGoesFirst) {
    const Served served(Places{4, 4});
    Sockets sockets;
    for (int n = 0; n < 4; ++n) {
        sockets.push_back(served.connect());
        if (n >= 2) continue;
        ASSERT_TRUE(is_served(*sockets.back()));
    }
    sockets[2]->send(frame(1, read_request(99, 0, 1)));
    ASSERT_EQ(sockets[2]->receive(9, 5).size(), 9U) << "an exception";
    for (int n = 0; n < 2; ++n) sockets.push_back(served.connect());
    EXPECT_TRUE(sockets[2]->is_closed_within(5));
    EXPECT_TRUE(sockets[3]->is_closed_within(5));
    for (const std::size_t n : {0U, 1U, 4U, 5U}) EXPECT_TRUE(is_open(*sockets[n])) << n;
}

TEST(Fault, F51_EachOfManyNewcomersIsAnsweredItsOneRequest) {
    const Served served(Places{4, 4});
    Sockets sockets;
    for (int n = 0; n < 300; ++n) {
        sockets.push_back(served.connect());
        ask(*sockets.back());
    }
    const auto answered = std::ranges::count_if(sockets, [](const auto& one) { return is_answered(*one); });
    EXPECT_EQ(answered, 300);
}

TEST(Fault, F51_SilentConnectionsKeepNobodyOut) {
    const rig::Folder folder;
    CellSim cell(rig::quick_cell(folder.path));
    cell.start();
    Sockets silent;
    for (int n = 0; n < 300; ++n) {
        silent.push_back(std::make_unique<RawSocket>(cell.port(), here, "127.0.0." + std::to_string(2 + n % 50)));
    }
    EXPECT_TRUE(is_served(RawSocket(cell.port())));
}

TEST(Fault, F51_FiftyClientsOfOneAddressAreServedAtOnce) {
    const rig::Folder folder;
    CellSim cell(rig::quick_cell(folder.path));
    cell.start();
    Sockets sockets;
    for (int n = 0; n < 50; ++n) sockets.push_back(std::make_unique<RawSocket>(cell.port()));
    for (int round = 0; round < 2; ++round) {
        const auto served = std::ranges::count_if(sockets, [](const auto& one) { return is_served(*one); });
        EXPECT_EQ(served, 50);
    }
}

TEST(Places, TheHolderOfTheLeaseKeepsItsConnection) {
    Served served(Places{4, 4});
    const RawSocket holder(served.server->port());
    ASSERT_TRUE(holds(holder));
    const RawSocket second(served.server->port());
    ASSERT_TRUE(holds(second)) << "names the same lease, for it is no secret";
    Sockets others;
    for (int n = 0; n < 20; ++n) {
        others.push_back(served.connect());
        ASSERT_TRUE(is_served(*others.back())) << n;
    }
    EXPECT_TRUE(second.is_closed_within(5));
    EXPECT_TRUE(is_served(holder));

    served.lease = 0;
    for (int n = 0; n < 20; ++n) {
        others.push_back(served.connect());
        ASSERT_TRUE(is_served(*others.back())) << n;
    }
    EXPECT_TRUE(holder.is_closed_within(5)) << "without a lease it is a stranger";
}

TEST(Places, TheHolderThatComesBackIsTheHolderAgain) {
    const Served served(Places{4, 4});
    auto holder = served.connect();
    ASSERT_TRUE(holds(*holder));
    holder = served.connect();
    // The server may learn of the end of the first connection a moment later.
    for (int n = 0; n < 5; ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        ASSERT_TRUE(holds(*holder));
    }
    Sockets others;
    for (int n = 0; n < 20; ++n) {
        others.push_back(served.connect());
        ASSERT_TRUE(is_served(*others.back())) << n;
    }
    EXPECT_TRUE(is_served(*holder));
}

// The cell itself says who holds the lease.
TEST(Places, ADispatcherThatHasClaimedTheCellKeepsItsConnection) {
    const rig::Folder folder;
    CellSim cell(rig::quick_cell(folder.path));
    cell.start();
    const RawSocket owner(cell.port());
    Command claim;
    claim.command = CellCommand::claim;
    claim.epoch = claim.seq = 1;
    claim.owner = 0xABCD;
    owner.send(frame(1, rig::write_request(command_block.base, encode(claim))));
    ASSERT_EQ(owner.receive(12, 5).size(), 12U);
    ASSERT_TRUE(cell.status().has(flag::lease_held));
    Sockets others;
    for (int n = 0; n < 300; ++n) {
        others.push_back(std::make_unique<RawSocket>(cell.port(), here, "127.0.0." + std::to_string(2 + n % 50)));
        ASSERT_TRUE(is_served(*others.back())) << n;
    }
    EXPECT_TRUE(others.front()->is_closed_within(5));
    EXPECT_TRUE(is_served(owner));
}

TEST(Places, OneAddressTakesThoseOfItsOwnOnceItHasItsShare) {
    const Served served(Places{8, 3});
    const auto other = served.connect("127.0.0.3");
    ASSERT_TRUE(is_served(*other));
    Sockets sockets;
    for (int n = 0; n < 10; ++n) {
        sockets.push_back(served.connect("127.0.0.2"));
        ASSERT_TRUE(is_served(*sockets.back())) << n;
    }
    EXPECT_TRUE(is_open(*other)) << "its last valid request is the oldest of all";
    const auto open = std::ranges::count_if(sockets, [](const auto& one) { return is_open(*one); });
    EXPECT_EQ(open, 3);
}

ModbusServerOptions with_rate(double per_second) {
    ModbusServerOptions options;
    options.peer_rate = per_second;
    options.peer_burst = 4;
    return options;
}

constexpr double hardly_ever = 0.001;  // requests per second

TEST(Rate, WhatOneAddressAsksTooFastWaits) {
    const Served served(with_rate(10));
    const auto socket = served.connect("127.0.0.2");
    const double began = now_s();
    for (int n = 0; n < 19; ++n) ask(*socket);
    for (int n = 0; n < 19; ++n) ASSERT_TRUE(is_answered(*socket)) << n;
    EXPECT_GT(now_s() - began, 0.69) << "eight are free, four are the burst, seven come at 10 a second";
}

TEST(Rate, OtherAddressesAndTheFirstRequestsOfAConnectionDoNotWait) {
    const Served served(with_rate(hardly_ever));
    const auto socket = served.connect("127.0.0.2");
    for (int n = 0; n < 20; ++n) ask(*socket);
    for (int n = 0; n < 12; ++n) ASSERT_TRUE(is_answered(*socket)) << n;
    EXPECT_EQ(socket->receive(1, 0.2).size(), 0U) << "the thirteenth waits";
    for (const char* from : {"127.0.0.3", "127.0.0.2"}) {
        const auto other = served.connect(from);
        for (int n = 0; n < 8; ++n) EXPECT_TRUE(is_served(*other)) << from;
    }
    EXPECT_TRUE(is_open(*socket)) << "to wait is no fault";
}

TEST(Rate, TheHolderOfTheLeaseDoesNotWait) {
    const Served served(with_rate(hardly_ever));
    const RawSocket holder(served.server->port());
    ASSERT_TRUE(holds(holder));
    for (int n = 0; n < 300; ++n) ASSERT_TRUE(is_served(holder)) << n;
}

TEST(Rate, ABucketFillsUpAgainAndIsForgottenThen) {
    PeerRates rates(10, 3);
    LinkTime now{};
    const auto taken = [&] {
        int count = 0;
        while (rates.take("a", now)) ++count;
        return count;
    };
    EXPECT_EQ(taken(), 3);
    now += std::chrono::milliseconds(250);
    EXPECT_EQ(taken(), 2);
    rates.forget(now);
    EXPECT_EQ(rates.peers(), 1U);
    now += std::chrono::hours(1);
    rates.forget(now);
    EXPECT_EQ(rates.peers(), 0U);
    EXPECT_EQ(taken(), 3);
}

TEST(Refusals, AreToldInOneLineAMinute) {
    Refusals refusals;
    LinkTime now = LinkTime() + std::chrono::hours(1);
    const auto pass = [&](double seconds) {
        now += std::chrono::milliseconds(static_cast<int>(1000 * seconds));
        return refusals.line(now).value_or("");
    };
    EXPECT_EQ(pass(100), "");
    for (int n = 0; n < 40; ++n) refusals.add(RefusedBecause::not_listed, "192.0.2.7", now);
    refusals.add(RefusedBecause::not_modbus, "192.0.2.9", now);
    EXPECT_EQ(pass(0.5), "");
    EXPECT_EQ(
        pass(0.6),
        "41 connections refused or closed, the last from 192.0.2.9: 40 not on the list of allowed addresses, 1 not "
        "Modbus TCP");
    refusals.add(RefusedBecause::silent, "192.0.2.9", now);
    for (int n = 0; n < 59; ++n) EXPECT_EQ(pass(1), "") << n;
    refusals.add(RefusedBecause::silent, "192.0.2.8", now);
    EXPECT_EQ(pass(1.1), "2 connections refused or closed, the last from 192.0.2.8: 2 silent for too long");
    EXPECT_EQ(pass(1000), "");
    refusals.add(RefusedBecause::gave_place, "192.0.2.1", now);
    EXPECT_EQ(refusals.rest(),
              "1 connection refused or closed, the last from 192.0.2.1: 1 for a newcomer that needed the place");
    EXPECT_EQ(refusals.rest(), std::nullopt);
}

TEST(Refusals, OfTheServerAreCounted) {
    Served served(Places{4, 4});
    Sockets sockets;
    for (int n = 0; n < 44; ++n) {
        sockets.push_back(served.connect());
        ASSERT_TRUE(is_served(*sockets.back())) << n;
    }
    const auto broken = served.connect();
    broken->send(Bytes(20, 0xFF));
    EXPECT_TRUE(broken->is_closed_within(5));
    const std::vector<std::string> lines = served.told();
    ASSERT_FALSE(lines.empty());
    ASSERT_LE(lines.size(), 2U) << "one during the attack, one at the end";
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    EXPECT_NE(all.find("for a newcomer that needed the place"), std::string::npos) << all;
    EXPECT_NE(all.find("1 not Modbus TCP"), std::string::npos) << all;
}

TEST(Drafts, StoreTakesWhatItsOwnConnectionHasWritten) {
    Drafts drafts;
    CellState cell;
    const auto writes = [&](std::uint64_t connection, std::uint16_t ticket) {
        Bytes pdu = rig::write_request(ticket_block.base, Registers(ticket_block.count, ticket));
        drafts.begin(connection, cell);
        answer_pdu(1, pdu, cell, {}, {});
        drafts.end(connection, pdu, cell);
    };
    const auto sees = [&](std::uint64_t connection) {
        drafts.begin(connection, cell);
        const Registers seen = cell.ticket_draft;
        drafts.end(connection, rig::read_request(4, 0, 1), cell);
        return seen.empty() ? 0 : seen[0];
    };
    EXPECT_EQ(sees(1), 0);
    writes(1, 11);
    writes(2, 22);
    EXPECT_EQ(sees(1), 11);
    EXPECT_EQ(sees(2), 22);
    EXPECT_EQ(sees(3), 22) << "it has written none: the last one of any";
    writes(1, 33);
    writes(3, 33);
    writes(2, 44);
    EXPECT_EQ(sees(3), 33) << "its own, though it was what another had written";
    drafts.forget(3);
    EXPECT_EQ(sees(3), 44);
    EXPECT_EQ(sees(1), 33);
}

}  // namespace
}  // namespace qchopper

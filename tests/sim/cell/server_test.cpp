#include "sim/cell/link/modbus_server.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <random>
#include <thread>

#include "base/error.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using rig::frame;
using rig::RawSocket;
using rig::read_request;

struct Cell {
    Cell() : sim(rig::quick_cell(folder.path)) { sim.start(); }
    rig::Folder folder;
    CellSim sim;
};

// An answer to "read one status register" has 11 bytes, and begins with the transaction id.
bool is_served(const RawSocket& socket, std::uint16_t transaction = 0x0102) {
    socket.send(frame(transaction, read_request(4, 0, 1)));
    const Bytes bytes = socket.receive(11);
    return bytes.size() == 11 && bytes[0] == transaction >> 8 && bytes[1] == (transaction & 0xFF) && bytes[9] == 0x51 &&
           bytes[10] == 0x43;
}

TEST(Fault, F54_AFrameSplitAtAnyByteGetsTheSameAnswer) {
    const Cell cell;
    const RawSocket socket(cell.sim.port());
    const Bytes whole = frame(0x0A0B, read_request(4, 0, 3));
    socket.send(whole);
    const Bytes expected = socket.receive(15);
    // STATUS begins with magic and version; the third register is the snapshot, which changes.
    ASSERT_EQ(expected.size(), 15U);
    for (std::size_t at = 1; at < whole.size(); ++at) {
        socket.send(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at)));
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
        socket.send(Bytes(whole.begin() + static_cast<std::ptrdiff_t>(at), whole.end()));
        const Bytes bytes = socket.receive(15);
        ASSERT_EQ(bytes.size(), 15U) << at;
        EXPECT_TRUE(std::equal(bytes.begin(), bytes.begin() + 13, expected.begin())) << at;
    }
}

TEST(Fault, F53_TenPipelinedRequestsGetTenAnswersInOrderThoughOneIsBad) {
    const Cell cell;
    const RawSocket socket(cell.sim.port());
    Bytes all;
    for (std::uint16_t n = 0; n < 10; ++n) {
        const Bytes one = frame(n, n == 4 ? read_request(20, 0, 1) : read_request(4, 0, 1));
        all.insert(all.end(), one.begin(), one.end());
    }
    socket.send(all);
    for (std::uint16_t n = 0; n < 10; ++n) {
        const Bytes bytes = socket.receive(n == 4 ? 9 : 11);
        ASSERT_EQ(bytes.size(), n == 4 ? 9U : 11U) << n;
        EXPECT_EQ(bytes[1], n);
        EXPECT_EQ(bytes[7], n == 4 ? 0x94 : 4);
    }
}

TEST(Server, ManyRequestsOfAClientThatReadsAreAllServed) {
    const Cell cell;
    const RawSocket socket(cell.sim.port());
    constexpr std::size_t count = 2000;
    std::thread writer([&] {
        for (std::size_t n = 0; n < count; ++n)
            socket.send(frame(static_cast<std::uint16_t>(n), read_request(4, 0, 100)));
    });
    const Bytes bytes = socket.receive(count * 209, 3);
    writer.join();
    ASSERT_EQ(bytes.size(), count * 209);
    for (std::size_t n = 0; n < count; ++n) {
        ASSERT_EQ(bytes[n * 209] << 8 | bytes[n * 209 + 1], static_cast<int>(n));
    }
}

TEST(Fault, F49_F52_WhatIsNotModbusIsClosed) {
    const Cell cell;
    const auto is_closed = [&](Bytes bytes) {
        const RawSocket socket(cell.sim.port());
        socket.send(bytes);
        return socket.is_closed_within(1);
    };
    for (const std::uint16_t length : {0, 1, 255, 256, 65535}) {
        Bytes bytes = frame(1, read_request(4, 0, 1));
        bytes[4] = static_cast<std::uint8_t>(length >> 8);
        bytes[5] = static_cast<std::uint8_t>(length & 0xFF);
        EXPECT_TRUE(is_closed(bytes)) << length;
    }
    for (const std::size_t at : {2U, 3U}) {
        Bytes bytes = frame(1, read_request(4, 0, 1));
        bytes[at] = 7;
        EXPECT_TRUE(is_closed(bytes)) << at;
    }
    const std::string http = "GET / HTTP/1.1\r\nHost: cell\r\n\r\n";
    EXPECT_TRUE(is_closed(Bytes(http.begin(), http.end())));
    EXPECT_TRUE(is_closed({0x16, 0x03, 0x01, 0x02, 0x00, 0x01, 0x00, 0x01, 0xFC, 0x03, 0x03}));
    EXPECT_TRUE(is_closed(frame(1, rig::write_request(0, Registers(124, 0)))));
    EXPECT_TRUE(is_served(RawSocket(cell.sim.port())));
}

TEST(Fault, F50_AHalfFrameIsClosedAfterTwoSecondsAndAByteNowAndThenDoesNotHelp) {
    const Cell cell;
    const RawSocket half(cell.sim.port());
    const RawSocket slow(cell.sim.port());
    half.send({0, 1, 0, 0, 0});
    const auto began = std::chrono::steady_clock::now();
    bool slow_is_closed = false;
    const Bytes whole = frame(1, rig::write_request(0, Registers(60, 0)));
    for (std::size_t n = 0; n < 14 && !slow_is_closed; ++n) {
        slow.send({whole[n]});
        slow_is_closed = slow.is_closed_within(0.2);
    }
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    EXPECT_TRUE(slow_is_closed);
    EXPECT_GT(took, 1.8);
    EXPECT_LT(took, 2.6);
    EXPECT_TRUE(half.is_closed_within(0.3));
}

TEST(Fault, F49_F50_ASlowClientDoesNotStallTheOthers) {
    const Cell cell;
    const RawSocket slow(cell.sim.port());
    const RawSocket deaf(cell.sim.port());
    const RawSocket quick(cell.sim.port());
    slow.send({0, 1, 0, 0, 0});
    for (int n = 0; n < 200; ++n) deaf.send(frame(1, read_request(4, 0, 100)));  // and never reads
    double worst = 0;
    for (std::uint16_t n = 0; n < 200; ++n) {
        const auto began = std::chrono::steady_clock::now();
        ASSERT_TRUE(is_served(quick, n));
        worst = std::max(worst, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    }
    EXPECT_LT(worst, 0.1);  // 0.02 on a quiet machine
}

TEST(Fault, F51_ManyConnectionsLeaveNoDescriptorBehind) {
    const Cell cell;
    const auto open_files = [] {
        const std::filesystem::directory_iterator all("/proc/self/fd");
        return std::distance(begin(all), end(all));
    };
    const auto before = open_files();
    for (int n = 0; n < 10000; ++n) {
        const RawSocket socket(cell.sim.port());
        if (n % 50 == 0) socket.send({1, 2, 3});
    }
    for (int n = 0; n < 100 && open_files() != before; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(open_files(), before);
    // Those that hung up before they were accepted may still take the places for a moment.
    bool served = false;
    for (int n = 0; n < 50 && !served; ++n) served = is_served(RawSocket(cell.sim.port()));
    EXPECT_TRUE(served);
}

TEST(Fault, F52_RandomStreamsDoNotHurtTheCell) {
    const Cell cell;
    std::mt19937 random(3);
    for (int n = 0; n < 50; ++n) {
        const RawSocket socket(cell.sim.port());
        Bytes bytes(random() % 600);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        if (n % 2 == 0 && bytes.size() > 6) bytes[2] = bytes[3] = bytes[4] = 0;
        socket.send(bytes);
    }
    for (int n = 0; n < 100 && !is_served(RawSocket(cell.sim.port())); ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    EXPECT_TRUE(is_served(RawSocket(cell.sim.port())));
    EXPECT_EQ(cell.sim.status().starts_total, 0U);
    EXPECT_EQ(cell.sim.status().ack_seq, 0U);
}

TEST(Server, SilenceIsClosedInTheEnd) {
    ModbusServerOptions options;
    options.idle_s = 0.2;
    ModbusServer server(
        options,
        [](const ServerRequest&) {
            return ServerAnswer{{4, 0}};
        },
        [] {}, {});
    server.start();
    const RawSocket socket(server.port());
    EXPECT_TRUE(socket.is_closed_within(1));
}

TEST(Fault, F50_AClientThatNeverReadsIsClosed) {
    ModbusServerOptions options;
    options.drain_s = 0.3;
    const Bytes long_answer(253, 4);
    ModbusServer server(
        options, [&](const ServerRequest&) { return ServerAnswer{long_answer}; }, [] {}, {});
    server.start();
    const RawSocket socket(server.port());
    // More answers than the sockets' own buffers hold.
    std::atomic<bool> done = false;
    std::thread writer([&] {
        for (int n = 0; n < 60000 && !done; ++n) socket.send(frame(1, read_request(4, 0, 1)));
        done = true;
    });
    for (int n = 0; n < 300 && !done; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(done) << "the server neither read nor closed";
    done = true;
    socket.is_closed_within(0.1);
    writer.join();
}

TEST(Fault, F55_OutsideOfLoopbackOnlyWithAList) {
    const auto start = [](const std::string& host, std::vector<std::string> allow) {
        ModbusServerOptions options;
        options.host = host;
        options.allow = std::move(allow);
        ModbusServer server(
            options,
            [](const ServerRequest&) {
                return ServerAnswer{{4, 0}};
            },
            [] {}, {});
        server.start();
        EXPECT_NE(server.port(), 0);
    };
    for (const char* host : {"0.0.0.0", "::", "0", "0anything", "example", ""})
        EXPECT_THROW(start(host, {}), InputError) << host;
    EXPECT_NO_THROW(start("0.0.0.0", {"192.0.2.1"}));
    EXPECT_NO_THROW(start("127.0.0.1", {}));
    EXPECT_NO_THROW(start("localhost", {}));
}

TEST(Fault, F55_APeerThatIsNotOnTheListIsRefusedAndLogged) {
    std::mutex mutex;
    std::string log;
    ModbusServerOptions options;
    options.host = "::";
    options.allow = {"192.0.2.1"};
    ModbusServer server(
        options,
        [](const ServerRequest&) {
            return ServerAnswer{{4, 2, 0x51, 0x43}};
        },
        [] {},
        [&](const std::string& line) {
            const std::lock_guard lock(mutex);
            log += line;
        });
    try {
        server.start();
    } catch (const InputError&) {
        GTEST_SKIP() << "no IPv6 here";
    }
    const std::string own = rig::own_address();
    if (own.empty()) GTEST_SKIP() << "this computer has no address but loopback";
    EXPECT_TRUE(RawSocket(server.port(), own).is_closed_within(2));
    EXPECT_TRUE(is_served(RawSocket(server.port()))) << "loopback always may";
    server.stop();
    EXPECT_NE(
        log.find("1 connection refused or closed, the last from " + own + ": 1 not on the list of allowed addresses"),
        std::string::npos)
        << log;
}

// The server waits by poll(), which has no limit for descriptors.
TEST(Fault, F57_ADescriptorOf1024OrMoreIsServedLikeAnyOther) {
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit before = limit;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 1200);
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
    if (limit.rlim_cur < 1100) GTEST_SKIP() << "this process may not open so many files";
    std::vector<int> taken;
    while (taken.empty() || taken.back() < 1024) taken.push_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
    {
        const Cell cell;
        EXPECT_TRUE(is_served(RawSocket(cell.sim.port())));
    }
    for (const int fd : taken) close(fd);
    setrlimit(RLIMIT_NOFILE, &before);
}

TEST(Server, APortInUseIsAnErrorThatNamesIt) {
    const Cell cell;
    ModbusServerOptions options;
    options.port = cell.sim.port();
    ModbusServer server(
        options,
        [](const ServerRequest&) {
            return ServerAnswer{{4, 0}};
        },
        [] {}, {});
    try {
        server.start();
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(options.port)), std::string::npos);
        EXPECT_FALSE(error.to_do.empty());
    }
}

}  // namespace
}  // namespace qchopper

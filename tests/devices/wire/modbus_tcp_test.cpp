#include "devices/wire/modbus_tcp.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "base/error.h"
#include "devices/wire/device_error.h"
#include "tests/devices/wire/loopback_server.h"

namespace qchopper {
namespace {

TEST(TcpAddress, HostAndPortAreTakenApart) {
    const auto is = [](const char* text, const char* host, int port) {
        const TcpAddress address = parse_tcp_address(text);
        EXPECT_EQ(address.host, host) << text;
        EXPECT_EQ(address.port, port) << text;
    };
    is("127.0.0.1:15020", "127.0.0.1", 15020);
    is("cell-3", "cell-3", 502);
    is("[::1]:15020", "::1", 15020);
    is("::1", "::1", 502);
    is("[fe80::1]", "fe80::1", 502);
    for (const char* bad :
         {"", ":502", "host:", "host:0", "host:65536", "host:5x", "[::1", "[::1]x", "[::1]:", "a b:5", "host:-1"}) {
        EXPECT_THROW(parse_tcp_address(bad), InputError) << bad;
    }
}

std::array<std::uint8_t, 12> request_from(int fd) {
    std::array<std::uint8_t, 12> request{};
    EXPECT_EQ(recv(fd, request.data(), request.size(), MSG_WAITALL), 12);
    return request;
}

// One register, 0x1234.
std::vector<std::uint8_t> answer_to(const std::array<std::uint8_t, 12>& request) {
    return {request[0], request[1], 0, 0, 0, 5, request[6], request[7], 2, 0x12, 0x34};
}

void put(int fd, const std::vector<std::uint8_t>& bytes) {
    send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

double seconds_of(const std::function<void()>& work) {
    const auto began = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void wait_for_close(int fd) {
    std::uint8_t byte = 0;
    while (recv(fd, &byte, 1, 0) > 0) {
    }
}

TEST(ModbusTcpBus, NothingListensIsUnreachable) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);  // bound, not listening: nobody else gets the port
    ModbusTcpBus bus({"127.0.0.1", bind_to_loopback(fd)});
    try {
        bus.connect();
        FAIL();
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault, DeviceFault::unreachable);
        EXPECT_NE(std::string(error.what()).find("127.0.0.1"), std::string::npos);
    }
    EXPECT_EQ(bus.read_input(0, 1).end, BusEnd::lost);
    close(fd);
}

TEST(ModbusTcpBus, ANameThatNobodyKnowsIsUnreachableInTime) {
    ModbusTcpBus bus({"no-such-cell.invalid", 502});
    EXPECT_LT(seconds_of([&] { EXPECT_THROW(bus.connect(), DeviceError); }), 2.5);
}

TEST(ModbusTcpBus, ARegisterIsRead) {
    const LoopbackServer peer([](int fd, int) {
        put(fd, answer_to(request_from(fd)));
        wait_for_close(fd);
    });
    ModbusTcpBus bus({"localhost", peer.port});
    const BusAnswer answer = bus.read_input(7, 1);
    ASSERT_TRUE(answer.is_ok()) << answer.why;
    EXPECT_EQ(answer.registers, (Registers{0x1234}));
}

TEST(ModbusTcpBus, APeerThatIsSilentCostsOneSecondAndTheNextCallIsAFreshConnection) {
    const LoopbackServer peer([](int fd, int number) {
        const auto request = request_from(fd);
        if (number > 1) put(fd, answer_to(request));
        wait_for_close(fd);
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    const double took = seconds_of([&] { EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost); });
    EXPECT_LT(took, 1.5);
    EXPECT_TRUE(bus.read_input(7, 1).is_ok());
}

TEST(ModbusTcpBus, APeerThatSendsAByteAtATimeIsCutOffAfterTwoSeconds) {
    const LoopbackServer peer([](int fd, int) {
        for (const std::uint8_t byte : answer_to(request_from(fd))) {
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            put(fd, {byte});
        }
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    const double took = seconds_of([&] {
        const BusAnswer answer = bus.read_input(7, 1);
        EXPECT_EQ(answer.end, BusEnd::lost);
        EXPECT_NE(answer.why.find("in time"), std::string::npos) << answer.why;
    });
    EXPECT_GT(took, 1.9);
    EXPECT_LT(took, 2.3);
}

TEST(ModbusTcpBus, ALateAnswerNeverBelongsToTheNextQuestion) {
    const LoopbackServer peer([](int fd, int number) {
        const auto request = request_from(fd);
        if (number == 1) std::this_thread::sleep_for(std::chrono::milliseconds(1200));
        put(fd, answer_to(request));
        wait_for_close(fd);
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost);
    EXPECT_TRUE(bus.read_input(8, 1).is_ok());
}

TEST(ModbusTcpBus, AnExceptionKeepsTheConnectionAndAnythingElseDoesNot) {
    const LoopbackServer peer([](int fd, int) {
        for (const std::uint8_t code : {6, 2}) {
            const auto request = request_from(fd);
            put(fd,
                {request[0], request[1], 0, 0, 0, 3, request[6], static_cast<std::uint8_t>(request[7] | 0x80), code});
        }
        auto request = request_from(fd);
        request[0] ^= 0xFF;  // another transaction
        put(fd, answer_to(request));
        wait_for_close(fd);
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    for (const int code : {6, 2}) {
        const BusAnswer answer = bus.read_input(7, 1);
        EXPECT_EQ(answer.end, BusEnd::exception);
        EXPECT_EQ(answer.exception, code);
    }
    EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost);
}

TEST(ModbusTcpBus, ACloseAndATornAnswerAreLost) {
    const LoopbackServer peer([](int fd, int number) {
        std::vector<std::uint8_t> answer = answer_to(request_from(fd));
        if (number == 1) return;
        answer.resize(8);
        put(fd, answer);
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost);
    EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost);
}

TEST(ModbusTcpBus, AnAnswerWithOneWrongFieldEndsTheConnection) {
    // The place of a byte in the answer, and what it becomes: transaction, protocol, length, unit, function, count.
    const std::vector<std::pair<std::size_t, std::uint8_t>> faults{
        {0, 0x77}, {1, 0x77}, {2, 7}, {3, 7}, {4, 1}, {5, 0x40}, {5, 4}, {6, 9}, {7, 3}, {7, 5}, {8, 4}, {8, 0}};
    for (const auto& [at, value] : faults) {
        const LoopbackServer peer([at = at, value = value](int fd, int number) {
            std::vector<std::uint8_t> answer = answer_to(request_from(fd));
            answer.resize(80, 0x11);
            if (number == 1) answer[at] = value;
            answer.resize(11);
            put(fd, answer);
            wait_for_close(fd);
        });
        ModbusTcpBus bus({"127.0.0.1", peer.port});
        const BusAnswer answer = bus.read_input(7, 1);
        EXPECT_EQ(answer.end, BusEnd::lost) << "byte " << at << " is " << int{value};
        EXPECT_TRUE(bus.read_input(7, 1).is_ok()) << "the next call is a fresh connection";
    }
}

TEST(ModbusTcpBus, AWriteWhoseEchoNamesOtherRegistersIsLost) {
    const auto echo = [](std::size_t at) {
        return [at](int fd, int) {
            std::array<std::uint8_t, 15> request{};
            EXPECT_EQ(recv(fd, request.data(), request.size(), MSG_WAITALL), 15);
            std::vector<std::uint8_t> answer(request.begin(), request.begin() + 12);
            answer[4] = 0;
            answer[5] = 6;
            if (at != 0) answer[at] ^= 1;
            put(fd, answer);
            wait_for_close(fd);
        };
    };
    for (const std::size_t at : {0, 8, 9, 10, 11}) {
        const LoopbackServer peer(echo(at));
        ModbusTcpBus bus({"127.0.0.1", peer.port});
        EXPECT_EQ(bus.write_holding(0x0205, Registers{5}).is_ok(), at == 0) << at;
    }
}

TEST(ModbusTcpBus, BytesThatNobodyAskedForEndTheConnection) {
    const LoopbackServer peer([](int fd, int) {
        std::vector<std::uint8_t> answer = answer_to(request_from(fd));
        const std::vector<std::uint8_t> once = answer;
        answer.insert(answer.end(), once.begin(), once.end());
        put(fd, answer);
        wait_for_close(fd);
    });
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    EXPECT_TRUE(bus.read_input(7, 1).is_ok());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost);
    EXPECT_TRUE(bus.read_input(7, 1).is_ok());
}

TEST(ModbusTcpBus, ACallUnderWayEndsSoonAfterTheRequestToStop) {
    const LoopbackServer peer([](int fd, int) { wait_for_close(fd); });
    ModbusTimings patient;
    patient.response_s = patient.call_s = 30;
    ModbusTcpBus bus({"127.0.0.1", peer.port}, 255, patient);
    std::atomic<bool> cancelled = false;
    bus.leave_when(&cancelled, 0.3);
    std::thread signal([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        cancelled = true;
    });
    const double took = seconds_of([&] { EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost); });
    signal.join();
    EXPECT_GT(took, 0.45);
    EXPECT_LT(took, 0.8);
    EXPECT_GE(bus.leaving_for_s(), 0.3) << "since the request, not since the end of the call";
    EXPECT_LT(seconds_of([&] { EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost); }), 0.1);
    bus.leave_when(nullptr, 0);
    EXPECT_EQ(bus.leaving_for_s(), 0);
}

// Else the two seconds of the hand-off and those of its bus would end at different times.
TEST(Fault, F58_TheTimeOfABusToLeaveRunsFromWhenItIsAskedForIt) {
    const LoopbackServer peer([](int fd, int) { wait_for_close(fd); });
    ModbusTimings patient;
    patient.response_s = patient.call_s = 30;
    ModbusTcpBus bus({"127.0.0.1", peer.port}, 255, patient);
    std::atomic<bool> cancelled = false;
    bus.leave_when(&cancelled, 0.5);
    EXPECT_EQ(bus.leaving_for_s(), 0);
    cancelled = true;
    EXPECT_LT(bus.leaving_for_s(), 0.1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_GE(bus.leaving_for_s(), 0.3);
    EXPECT_LT(seconds_of([&] { EXPECT_EQ(bus.read_input(7, 1).end, BusEnd::lost); }), 0.45);
    bus.leave_when(nullptr, 0);
}

TEST(ModbusTcpBus, ADescriptorOf1024OrMoreServesLikeAnyOther) {
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    if (limit.rlim_max < 1100) GTEST_SKIP() << "this system allows too few files";
    const rlimit raised{1100, limit.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &raised), 0);
    const LoopbackServer peer([](int fd, int) {
        put(fd, answer_to(request_from(fd)));
        wait_for_close(fd);
    });
    std::vector<int> files;
    for (int fd = 0; fd < FD_SETSIZE;) {
        fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
        ASSERT_GE(fd, 0);
        files.push_back(fd);
    }
    ModbusTcpBus bus({"127.0.0.1", peer.port});
    const BusAnswer answer = bus.read_input(7, 1);
    for (const int fd : files) close(fd);
    setrlimit(RLIMIT_NOFILE, &limit);
    EXPECT_TRUE(answer.is_ok()) << answer.why;
    EXPECT_EQ(answer.registers, (Registers{0x1234}));
}

TEST(ModbusTcpBus, ACountThatNoRequestCanHoldIsRefusedAtHome) {
    ModbusTcpBus bus({"127.0.0.1", 1});
    EXPECT_EQ(bus.read_input(0, 126).exception, 3);
    EXPECT_EQ(bus.read_holding(0, 0).exception, 3);
    EXPECT_EQ(bus.write_holding(0, Registers(124, 0)).exception, 3);
}

}  // namespace
}  // namespace qchopper

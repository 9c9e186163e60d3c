// Requests of another program to a dispatcher.

#include "devices/hand_off/request_socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <future>
#include <thread>

#include "devices/wire/device_error.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

CellCommand next_within(RequestSocket& socket, int ms) {
    for (int n = 0; n < ms; ++n) {
        if (const CellCommand command = socket.next(); command != CellCommand::none) return command;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return CellCommand::none;
}

std::future<RequestAnswer> ask(const Folder& folder, CellCommand command) {
    return std::async(std::launch::async, [&folder, command] {
        try {
            return ask_dispatcher(folder.path, command, 5);
        } catch (const DeviceError& error) {
            return RequestAnswer{CommandEnd::unknown, "error: " + std::string(error.what())};
        }
    });
}

TEST(RequestSocket, ARequestIsPassedOnOnceAndAnswered) {
    const Folder folder;
    RequestSocket socket(folder.path);
    ASSERT_TRUE(socket.is_open());
    EXPECT_EQ(socket.next(), CellCommand::none);
    for (const CellCommand command : {CellCommand::unhold, CellCommand::clear}) {
        std::future<RequestAnswer> answer = ask(folder, command);
        EXPECT_EQ(next_within(socket, 2000), command);
        EXPECT_EQ(socket.next(), CellCommand::none);
        socket.answer({CommandEnd::done, {}});
        EXPECT_EQ(answer.get(), (RequestAnswer{CommandEnd::done, {}}));
    }
}

// A command that the cell did not do must not be told as done.
TEST(RequestSocket, EachAnswerArrivesAsItWasGiven) {
    const Folder folder;
    RequestSocket socket(folder.path);
    for (const RequestAnswer& given : {RequestAnswer{CommandEnd::refused, "NO_CONSENT"},
                                       RequestAnswer{CommandEnd::unknown, "the cell did not answer in time"}}) {
        std::future<RequestAnswer> answer = ask(folder, CellCommand::unhold);
        EXPECT_EQ(next_within(socket, 2000), CellCommand::unhold);
        socket.answer(given);
        EXPECT_EQ(answer.get(), given);
    }
}

TEST(RequestSocket, OtherCommandsAndOtherTextAreRefused) {
    const Folder folder;
    RequestSocket socket(folder.path);
    std::future<RequestAnswer> answer = ask(folder, CellCommand::start);
    EXPECT_EQ(next_within(socket, 100), CellCommand::none);
    EXPECT_EQ(answer.get(), (RequestAnswer{CommandEnd::refused, "only Unhold and Clear are passed on"}));

    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (folder.path / "requests").c_str(), sizeof address.sun_path - 1);
    const int silent = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ASSERT_EQ(::connect(silent, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const std::string flood(500, 'x');
    ASSERT_GT(::send(silent, flood.data(), flood.size(), MSG_NOSIGNAL), 0);
    EXPECT_EQ(next_within(socket, 100), CellCommand::none);
    ::close(silent);
    std::future<RequestAnswer> later = ask(folder, CellCommand::unhold);
    EXPECT_EQ(next_within(socket, 2000), CellCommand::unhold);
    socket.answer({CommandEnd::done, {}});
    EXPECT_EQ(later.get(), (RequestAnswer{CommandEnd::done, {}}));
}

TEST(RequestSocket, WithoutADispatcherOrWithOneThatEndsTheClientIsTold) {
    const Folder folder;
    EXPECT_NE(ask(folder, CellCommand::unhold).get().why.find("does not listen"), std::string::npos);
    std::future<RequestAnswer> answer;
    {
        RequestSocket socket(folder.path);
        answer = ask(folder, CellCommand::unhold);
        EXPECT_EQ(next_within(socket, 2000), CellCommand::unhold);
    }
    EXPECT_EQ(answer.get(), (RequestAnswer{CommandEnd::refused, "the dispatcher has ended"}));
    // A socket that a killed dispatcher left is replaced.
    { RequestSocket socket(folder.path); }
    RequestSocket again(folder.path);
    EXPECT_TRUE(again.is_open());
}

}  // namespace
}  // namespace qchopper

// Clients that are slow, silent or many. Limits are shorter than those of the program, so that the tests are short.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/app/console/served.h"

namespace qchopper {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

HttpLimits short_limits() {
    HttpLimits limits;
    limits.head = 600ms;
    limits.body = 600ms;
    limits.idle = 1200ms;
    limits.write = 600ms;
    limits.part = 600ms;
    return limits;
}

std::string get(const std::string& target, const ClientFields& fields = with_key) {
    return request_text("GET", target, fields);
}

// Sends byte after byte until the server closes; how long it did not.
Clock::duration drip(HttpClient& client, const std::string& begin, const std::string& byte) {
    const Clock::time_point began = Clock::now();
    static_cast<void>(client.send(begin));
    while (Clock::now() - began < 10s) {
        if (!client.send(byte) || client.is_closed(50ms)) break;
    }
    return Clock::now() - began;
}

std::size_t resident_kb() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        std::size_t kb = 0;
        if (word == "VmRSS:" && status >> kb) return kb;
    }
    return 0;
}

TEST(HttpLimits, AConnectionThatSaysNothingIsClosedInTheTimeOfAHead) {
    Served served(short_limits());
    HttpClient client(served.port());
    const Clock::time_point begin = Clock::now();
    EXPECT_TRUE(client.is_closed(5s));
    EXPECT_GE(Clock::now() - begin, 500ms);
    EXPECT_LT(Clock::now() - begin, 2s);
}

TEST(HttpLimits, HalfAHeadIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port());
    ASSERT_TRUE(client.send("GET /x HTTP/1.1\r\nHost: a\r\n"));
    const Clock::time_point begin = Clock::now();
    EXPECT_TRUE(client.is_closed(5s));
    EXPECT_LT(Clock::now() - begin, 2s);
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpLimits, ADripFedHeadIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port());
    EXPECT_LT(drip(client, "GET /x HTTP/1.1\r\nX: ", "a"), 2s);
    HttpClient lines(served.port());
    EXPECT_LT(drip(lines, "GET /x HTTP/1.1\r\n", "A: b\r\n"), 2s);
}

TEST(HttpLimits, ADripFedBodyIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port());
    ClientFields fields = with_key;
    fields.emplace_back("Content-Length", "900");
    EXPECT_LT(drip(client, request_text("POST", "/echo", fields), "b"), 2s);
    fields.back() = {"Transfer-Encoding", "chunked"};
    HttpClient chunks(served.port());
    EXPECT_LT(drip(chunks, request_text("POST", "/echo", fields), "1\r\nb\r\n"), 2s);
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpLimits, AnIdleConnectionIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port());
    EXPECT_EQ(client.ask(get("/x")).status, 200U);
    const Clock::time_point begin = Clock::now();
    EXPECT_TRUE(client.is_closed(5s));
    EXPECT_GE(Clock::now() - begin, 1s);
    EXPECT_LT(Clock::now() - begin, 3s);
}

TEST(HttpLimits, AClientThatDoesNotReadIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port(), 4096);
    ASSERT_TRUE(client.send(get("/big")));
    const Clock::time_point begin = Clock::now();
    while (Clock::now() - begin < 5s) {
        std::this_thread::sleep_for(50ms);
        HttpClient newcomer(served.port());  // with whom the server looks after those that have ended
        ASSERT_EQ(newcomer.ask(get("/x")).status, 200U);
        if (served.server.connections() == 1) break;
    }
    EXPECT_LT(Clock::now() - begin, 3s);
}

TEST(HttpLimits, AStreamThatIsNotReadIsClosedInTime) {
    Served served(short_limits());
    HttpClient client(served.port(), 4096);
    ClientFields fields = with_key;
    ASSERT_TRUE(client.send(get("/flood", fields)));
    const Clock::time_point begin = Clock::now();
    while (served.streams == 0 && Clock::now() - begin < 5s) std::this_thread::sleep_for(10ms);
    while (served.streams > 0 && Clock::now() - begin < 10s) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(served.streams, 0);
}

TEST(HttpLimits, AChunksExtensionOrATrailerWithoutEndIsRefusedAndCostsNoMemory) {
    Served served;
    ClientFields fields = with_key;
    fields.emplace_back("Transfer-Encoding", "chunked");
    const std::string block(1 << 20, 'e');
    for (const char* begin : {"1;", "0\r\nX: "}) {
        const std::size_t before = resident_kb();
        HttpClient client(served.port());
        ASSERT_TRUE(client.send(request_text("POST", "/echo", fields) + begin));
        int sent = 0;
        while (sent < 200 && client.send(block, 1s)) ++sent;
        EXPECT_LT(sent, 64) << "it is not read without end";
        EXPECT_LT(resident_kb(), before + 20'000) << begin;
    }
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpLimits, TwoHundredSilentConnectionsKeepNobodyOut) {
    Served served;
    HttpClient operators(served.port());
    ASSERT_EQ(operators.ask(get("/x")).status, 200U);
    std::vector<HttpClient> silent;
    for (int i = 0; i < 200; ++i) {
        silent.emplace_back(served.port());
        if (i % 2 == 0) static_cast<void>(silent.back().send("GET /x HT"));
        if (i % 20 == 0) {
            ASSERT_EQ(operators.ask(get("/x")).status, 200U) << i;
        }
    }
    const Clock::time_point begin = Clock::now();
    EXPECT_EQ(operators.ask(get("/x")).status, 200U) << "one that is known goes on";
    HttpClient newcomer(served.port());
    EXPECT_EQ(newcomer.ask(get("/x")).status, 200U) << "and a new one gets in";
    EXPECT_LT(Clock::now() - begin, 1s);
    EXPECT_EQ(newcomer.ask(get("/x")).status, 200U);
}

TEST(HttpLimits, ConnectionsToWhatNeedsNoKeyKeepNobodyOut) {
    Served served;
    std::vector<HttpClient> strangers;
    for (int i = 0; i < 100; ++i) {
        strangers.emplace_back(served.port());
        static_cast<void>(strangers.back().ask(get("/open", without_key)));
    }
    HttpClient newcomer(served.port());
    EXPECT_EQ(newcomer.ask(get("/x")).status, 200U);
    int open = 0;
    for (HttpClient& stranger : strangers) open += stranger.ask(get("/open", without_key)).status == 200 ? 1 : 0;
    EXPECT_LE(open, 32);
}

TEST(HttpLimits, WithTheKeyThereAreSixtyFourAndTheNextIsToldSo) {
    Served served;
    std::vector<HttpClient> clients;
    for (int i = 0; i < 64; ++i) {
        clients.emplace_back(served.port());
        ASSERT_EQ(clients.back().ask(get("/x")).status, 200U) << i;
    }
    EXPECT_EQ(HttpClient(served.port()).ask(get("/x")).status, 503U);
    for (HttpClient& client : clients) EXPECT_EQ(client.ask(get("/x")).status, 200U);
    for (int i = 0; i < 4; ++i) clients.pop_back();
    const Clock::time_point until = Clock::now() + 5s;
    unsigned status = 503;
    while (status == 503 && Clock::now() < until) status = HttpClient(served.port()).ask(get("/x")).status;
    EXPECT_EQ(status, 200U) << "a place that became free is given again";
}

TEST(HttpLimits, ConnectionsThatComeAndGoLeaveNoDescriptorAndNoThread) {
    Served served;
    const auto entries = [](const char* folder) {
        return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
    };
    const auto round = [&] {
        for (int i = 0; i < 100; ++i) {
            HttpClient client(served.port());
            if (i % 4 == 0) {
                EXPECT_EQ(client.ask(get("/x")).status, 200U);
            }
            if (i % 4 == 1) {
                EXPECT_EQ(client.ask(get("/x", without_key)).status, 401U);
            }
            if (i % 4 == 2) static_cast<void>(client.send("GET"));
        }
        HttpClient last(served.port());
        EXPECT_EQ(last.ask(get("/x")).status, 200U);
        std::this_thread::sleep_for(100ms);
    };
    round();
    const auto files = entries("/proc/self/fd");
    const auto threads = entries("/proc/self/task");
    for (int i = 0; i < 5; ++i) round();
    EXPECT_LE(entries("/proc/self/fd"), files + 20);
    EXPECT_LE(entries("/proc/self/task"), threads + 20);
}

TEST(HttpLimits, ManyClientsAtOnceAreAllAnswered) {
    Served served;
    std::atomic<int> right = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 16; ++t) {
        threads.emplace_back([&, t] {
            HttpClient client(served.port());
            for (int i = 0; i < 50; ++i) {
                const std::string body = std::to_string(t) + " " + std::to_string(i);
                if (client.ask(request_text("POST", "/echo", with_key, body)).body == body) ++right;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(right, 800);
}

}  // namespace
}  // namespace qchopper

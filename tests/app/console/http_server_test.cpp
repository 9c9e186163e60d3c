#include "app/console/http/http_server.h"

#include <gtest/gtest.h>

#include <thread>

#include "base/error.h"
#include "tests/app/console/served.h"

namespace qchopper {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string get(const std::string& target, const ClientFields& fields = with_key) {
    return request_text("GET", target, fields);
}

std::string post(const std::string& body) {
    return request_text("POST", "/echo", with_key, body);
}

bool comes_true(const auto& condition, std::chrono::milliseconds limit = 5s) {
    const Clock::time_point until = Clock::now() + limit;
    while (!condition()) {
        if (Clock::now() > until) return false;
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

TEST(HttpServer, AnswersManyRequestsOverOneConnection) {
    Served served;
    HttpClient client(served.port());
    for (int i = 0; i < 200; ++i) {
        const GotAnswer answer = client.ask(post("body " + std::to_string(i)));
        ASSERT_EQ(answer.status, 200U);
        EXPECT_EQ(answer.body, "body " + std::to_string(i));
    }
    EXPECT_EQ(served.server.connections(), 1U);
}

TEST(HttpServer, RequestsThatAreSentAtOnceAreAnsweredInTheirOrder) {
    Served served;
    HttpClient client(served.port());
    std::string all;
    for (int i = 0; i < 50; ++i) all += i % 2 == 0 ? post("body " + std::to_string(i)) : get("/x");
    ASSERT_TRUE(client.send(all));
    for (int i = 0; i < 50; ++i) {
        const GotAnswer answer = client.read();
        EXPECT_EQ(answer.body, i % 2 == 0 ? "body " + std::to_string(i) : "answer") << i;
    }
}

TEST(HttpServer, ARequestMayComeByteByByte) {
    Served served;
    HttpClient client(served.port());
    for (const char byte : post("slowly")) ASSERT_TRUE(client.send({&byte, 1}));
    EXPECT_EQ(client.read().body, "slowly");
}

TEST(HttpServer, AConnectionIsClosedWhereItsClientSaysSo) {
    Served served;
    HttpClient client(served.port());
    ClientFields fields = with_key;
    fields.emplace_back("Connection", "close");
    EXPECT_EQ(client.ask(get("/x", fields)).status, 200U);
    EXPECT_TRUE(client.is_closed(2s));
}

TEST(HttpServer, TheBodyOfARefusedRequestIsNotReadAndItsAnswerArrives) {
    Served served;
    HttpClient client(served.port());
    std::thread sender(
        [&] { static_cast<void>(client.send(request_text("POST", "/echo", without_key, std::string(500'000, 'b')))); });
    const GotAnswer answer = client.read();
    sender.join();
    EXPECT_EQ(answer.status, 401U);
    EXPECT_TRUE(client.is_closed(3s));
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpServer, TheSecondRequestOfAConnectionNeedsTheKeyToo) {
    Served served;
    HttpClient client(served.port());
    EXPECT_EQ(client.ask(get("/x")).status, 200U);
    EXPECT_EQ(client.ask(get("/x", without_key)).status, 401U);
    EXPECT_TRUE(client.is_closed(3s));
}

TEST(HttpServer, ABodyThatIsTooLongIsRefusedByItsLength) {
    Served served;
    HttpClient client(served.port());
    EXPECT_EQ(client.ask(post(std::string(1001, 'b'))).status, 413U);
    HttpClient exact(served.port());
    EXPECT_EQ(exact.ask(post(std::string(1000, 'b'))).body.size(), 1000U);
    HttpClient with_body(served.port());
    EXPECT_EQ(with_body.ask(request_text("GET", "/x", with_key, "b")).status, 413U) << "none is taken there";
    EXPECT_EQ(served.answered, 1);
}

TEST(HttpServer, AnImpossibleLengthIsRefused) {
    Served served;
    for (const char* length :
         {"-1", "99999999999999999999", "1e3", "0x10", "1 1", "", "1,2", "+1", "18446744073709551615"}) {
        HttpClient client(served.port());
        ClientFields fields = with_key;
        fields.emplace_back("Content-Length", length);
        const unsigned status = client.ask(request_text("POST", "/echo", fields) + "b").status;
        EXPECT_TRUE(status == 400 || status == 413) << length << " " << status;
    }
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpServer, TwoLengthsAreRefused) {
    Served served;
    ClientFields fields = with_key;
    fields.insert(fields.end(), {{"Content-Length", "1"}, {"Content-Length", "2"}});
    EXPECT_EQ(HttpClient(served.port()).ask(request_text("POST", "/echo", fields) + "bb").status, 400U);
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpServer, ALengthWithAnEncodingIsRefused) {
    Served served;
    for (const bool is_length_first : {true, false}) {
        ClientFields fields = with_key;
        if (is_length_first) fields.emplace_back("Content-Length", "5");
        fields.emplace_back("Transfer-Encoding", "chunked");
        if (!is_length_first) fields.emplace_back("Content-Length", "5");
        HttpClient client(served.port());
        EXPECT_EQ(client.ask(request_text("POST", "/echo", fields) + "0\r\n\r\n" + get("/smuggled")).status, 400U);
        EXPECT_TRUE(client.is_closed(3s));
    }
    EXPECT_EQ(served.answered, 0) << "nothing is smuggled";
}

TEST(HttpServer, AnEncodingThatIsNotChunkedIsNoBody) {
    Served served;
    for (const char* encoding : {"gzip", "chunked, gzip", "chunked, chunked", "xchunked", "identity"}) {
        ClientFields fields = with_key;
        fields.emplace_back("Transfer-Encoding", encoding);
        HttpClient client(served.port());
        const GotAnswer answer = client.ask(request_text("POST", "/echo", fields) + "0\r\n\r\n");
        EXPECT_TRUE(answer.status != 200 || answer.body.empty()) << encoding << " " << answer.body;
    }
}

std::string chunked(const std::string& chunks) {
    ClientFields fields = with_key;
    fields.emplace_back("Transfer-Encoding", "chunked");
    return request_text("POST", "/echo", fields) + chunks;
}

TEST(HttpServer, ChunksAreABodyUpToItsLimit) {
    Served served;
    HttpClient client(served.port());
    EXPECT_EQ(client.ask(chunked("3\r\nabc\r\n2;a=b\r\nde\r\n0\r\n\r\n")).body, "abcde");
    std::string many;
    for (int i = 0; i < 1001; ++i) many += "1\r\nb\r\n";
    EXPECT_EQ(client.ask(chunked(many + "0\r\n\r\n")).status, 413U);
    EXPECT_EQ(served.answered, 1);
}

TEST(HttpServer, ChunksOfImpossibleLengthAreRefused) {
    Served served;
    for (const char* chunks : {"-1\r\na\r\n0\r\n\r\n", "FFFFFFFFFFFFFFFF\r\na\r\n", "FFFFFFFFFFFFFFFFF\r\na\r\n",
                               "7fffffffffffffff\r\na\r\n", "x\r\na\r\n0\r\n\r\n", " 1\r\na\r\n0\r\n\r\n",
                               "1\r\nabc\r\n0\r\n\r\n", "3e9\r\n"}) {
        HttpClient client(served.port());
        const unsigned status = client.ask(chunked(chunks)).status;
        EXPECT_TRUE(status == 400 || status == 413) << chunks << " " << status;
    }
    HttpClient get_with_chunks(served.port());
    ClientFields fields = with_key;
    fields.emplace_back("Transfer-Encoding", "chunked");
    EXPECT_EQ(get_with_chunks.ask(request_text("GET", "/x", fields) + "1\r\nb\r\n0\r\n\r\n").status, 413U);
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpServer, ABodyIsNotUnpacked) {
    Served served;
    const std::string packed("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x4b\x04\x00\x43\xbe\xb7\xe8\x01\x00\x00\x00",
                             21);
    ClientFields fields = with_key;
    fields.emplace_back("Content-Encoding", "gzip");
    HttpClient client(served.port());
    EXPECT_EQ(client.ask(request_text("POST", "/echo", fields, packed)).body, packed);
}

TEST(HttpServer, AHeadIsOfAtMostEightThousandBytes) {
    Served served;
    ClientFields fields = with_key;
    fields.emplace_back("X-Long", std::string(7900, 'a'));
    EXPECT_EQ(HttpClient(served.port()).ask(get("/x", fields)).status, 200U);
    fields.back().second.assign(8192, 'a');
    EXPECT_EQ(HttpClient(served.port()).ask(get("/x", fields)).status, 431U);
}

TEST(HttpServer, TwentyThousandHeadersAreRefusedAndTheAnswerArrives) {
    Served served;
    ClientFields fields = with_key;
    for (int i = 0; i < 20'000; ++i) fields.emplace_back("X-" + std::to_string(i), "a");
    HttpClient client(served.port());
    GotAnswer answer;
    std::thread reader([&] { answer = client.read(); });
    static_cast<void>(client.send(get("/x", fields)));
    reader.join();
    EXPECT_EQ(answer.status, 431U);
    EXPECT_TRUE(client.is_closed(3s));
}

TEST(HttpServer, ATargetIsOfAtMost512Bytes) {
    Served served;
    EXPECT_EQ(HttpClient(served.port()).ask(get("/" + std::string(511, 'a'))).status, 200U);
    EXPECT_EQ(HttpClient(served.port()).ask(get("/" + std::string(512, 'a'))).status, 400U);
    EXPECT_EQ(served.answered, 1);
}

TEST(HttpServer, WhatIsNoRequestIsAnsweredWith400AndClosed) {
    Served served;
    for (const std::string& text :
         {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET /x\r\n\r\n"),
          std::string("GET /x HTTP/2.0\r\n\r\n"), std::string("GET /x HTTP/1.1\nHost: a\n\n"),
          std::string("GET /x y HTTP/1.1\r\n\r\n"), std::string("G\0T /x HTTP/1.1\r\n\r\n", 19),
          std::string("GET /\x01 HTTP/1.1\r\n\r\n"), std::string("GET /x HTTP/1.1\r\nNo colon\r\n\r\n"),
          std::string("GET /x HTTP/1.1\r\n: empty\r\n\r\n"), std::string("GET /x HTTP/1.1\r\nA : b\r\n\r\n"),
          std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11) + std::string(500, 'a'),
          std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), std::string("SSH-2.0-OpenSSH_9.2\r\n")}) {
        HttpClient client(served.port());
        const unsigned status = client.ask(text).status;
        EXPECT_TRUE(status == 400 || status == 401) << text << " " << status;
        EXPECT_TRUE(client.is_closed(5s)) << text;
    }
    EXPECT_EQ(served.answered, 0);
    EXPECT_EQ(HttpClient(served.port()).ask(get("/x")).status, 200U);
}

TEST(HttpServer, AFieldThatIsFoldedOrHoldsALineEndIsNoSecondField) {
    Served served;
    HttpClient client(served.port());
    const GotAnswer answer = client.ask("GET /x HTTP/1.1\r\nHost: a\r\nX: y\r\n Authorization: Bearer good\r\n\r\n");
    EXPECT_NE(answer.status, 200U);
    EXPECT_EQ(served.answered, 0);
}

TEST(HttpServer, AStreamGoesOnAndItsPlaceIsFreeWhenItIsClosedByTheClient) {
    Served served;
    for (const char* target : {"/stream", "/silent"}) {
        std::vector<HttpClient> clients;
        for (int i = 0; i < 5; ++i) {
            clients.emplace_back(served.port());
            ASSERT_TRUE(clients.back().send(get(target)));
            ASSERT_TRUE(clients.back().reads_until("\r\n\r\n", 5s));
        }
        EXPECT_TRUE(comes_true([&] { return served.streams == 5; }));
        if (target == std::string("/stream")) {
            EXPECT_TRUE(clients[0].reads_until("tick", 5s));
        }
        clients.clear();
        EXPECT_TRUE(comes_true([&] { return served.streams == 0; }, 1500ms)) << target;
    }
}

TEST(HttpServer, AnEndOfTheServerClosesOpenStreamsAndConnectionsAtOnce) {
    auto served = std::make_unique<Served>();
    std::vector<HttpClient> clients;
    for (int i = 0; i < 30; ++i) {
        clients.emplace_back(served->port());
        const std::string request = i % 3 == 0   ? get("/stream")
                                    : i % 3 == 1 ? get("/silent")
                                                 : std::string("GET /x HT");
        ASSERT_TRUE(clients.back().send(request));
    }
    EXPECT_TRUE(comes_true([&] { return served->streams == 20; }));
    const Clock::time_point begin = Clock::now();
    served.reset();
    EXPECT_LT(Clock::now() - begin, 2s);
    for (HttpClient& client : clients) EXPECT_TRUE(client.is_closed(1s));
}

TEST(HttpServer, APortThatIsTakenIsSaid) {
    Served served;
    try {
        const HttpServer second("127.0.0.1", served.port());
        ADD_FAILURE() << "it is taken";
    } catch (const InputError& e) {
        EXPECT_EQ(e.fault, InputFault::use);
        EXPECT_NE(std::string(e.what()).find(std::to_string(served.port())), std::string::npos) << e.what();
    }
    for (const char* host : {"203.0.113.7", "no such host", "256.1.1.1"}) {
        EXPECT_THROW(HttpServer(host, 0), InputError) << host;
    }
}

TEST(HttpServer, APortIsFreeAgainAfterTheEnd) {
    std::uint16_t port = 0;
    for (int i = 0; i < 5; ++i) {
        const Served served({}, port);
        port = served.port();
        EXPECT_EQ(HttpClient(port).ask(get("/x")).status, 200U);
    }
}

TEST(HttpServer, AServerEndsWhileConnectionsComeToo) {
    for (int i = 0; i < 300; ++i) {
        auto served = std::make_unique<Served>();
        std::vector<HttpClient> clients;
        for (int c = 0; c < i % 4 + 1; ++c) {
            clients.emplace_back(served->port());
            static_cast<void>(clients.back().send(get("/x")));
        }
        const Clock::time_point begin = Clock::now();
        served.reset();
        ASSERT_LT(Clock::now() - begin, 2s) << i;
    }
}

TEST(HttpServer, AServerThatNeverBeganEnds) {
    const HttpServer server("127.0.0.1", 0);
    HttpClient client(server.port());
    EXPECT_TRUE(client.send("GET / HTTP/1.1\r\n\r\n"));
}

}  // namespace
}  // namespace qchopper

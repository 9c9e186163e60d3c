// A server for tests of it, with a handler that answers to a few addresses.

#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "app/console/http/http_server.h"
#include "tests/app/console/http_client.h"

namespace qchopper {

inline const ClientFields with_key{{"Host", "a"}, {"Authorization", "Bearer good"}};
inline const ClientFields without_key{{"Host", "a"}};

// /open needs no key; all others do. POST takes 1,000 bytes. /echo answers the body, /big 8 MB, /stream is a stream of
// "tick" every 20 ms, /silent one that says nothing, /flood one of 100 kB parts.
struct Served {
    std::atomic<int> answered = 0;
    std::atomic<int> streams = 0;  // that are open
    std::atomic<bool> ends = false;
    HttpServer server;

    explicit Served(const HttpLimits& limits = {}, std::uint16_t port = 0) : server("127.0.0.1", port, limits) {
        server.begin({[](const HttpRequest& head) { return admit(head); },
                      [this](const HttpRequest& request) { return answer(request); },
                      [](unsigned status) { return json_answer(status, "fault " + std::to_string(status)); }});
    }
    ~Served() { ends = true; }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    std::uint16_t port() const { return server.port(); }

 private:
    static std::variant<HttpAnswer, HttpAdmission> admit(const HttpRequest& head) {
        const bool has_key = head.value("Authorization") == "Bearer good";
        if (!has_key && head.path() != "/open") return json_answer(401, "no key");
        return HttpAdmission{head.method == "POST" ? 1000U : 0U, has_key};
    }

    HttpAnswer answer(const HttpRequest& request) {
        ++answered;
        if (request.path() == "/big") return {200, {}, std::string(8'000'000, 'x')};
        if (request.path() == "/stream") return stream("tick\n");
        if (request.path() == "/silent") return stream("");
        if (request.path() == "/flood") return stream(std::string(100'000, 'f'));
        return {200, {{"Content-Type", "text/plain"}}, request.path() == "/echo" ? request.body : "answer"};
    }

    HttpAnswer stream(const std::string& part) {
        ++streams;
        const std::shared_ptr<std::atomic<int>> counted(&streams, [](std::atomic<int>* open) { --*open; });
        HttpAnswer answer{200, {{"Content-Type", "text/event-stream"}}};
        answer.next_part = [this, counted, part](std::chrono::milliseconds limit) -> std::optional<std::string> {
            std::this_thread::sleep_for(std::min(limit, std::chrono::milliseconds(20)));
            return ends ? std::nullopt : std::optional(part);
        };
        return answer;
    }
};

}  // namespace qchopper

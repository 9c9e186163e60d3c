// A server of HTTP/1.1 for a handful of clients, which may be hostile: limits on sizes, times and connections.
//
// A thread per connection. A connection is known once a request of it was admitted with a key; of those that are not,
// the oldest is closed for a newcomer when there are too many, so that nobody without the key keeps an operator out
// (tests/app/console/http_server_test.cpp). Bodies are never unpacked.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "app/console/http/http_message.h"

namespace qchopper {

struct HttpLimits {
    std::size_t head_bytes = 8192;
    std::size_t target_bytes = 512;
    std::size_t connections = 64;
    std::size_t not_known = 32;  // of them
    std::chrono::milliseconds head{3000};
    std::chrono::milliseconds body{5000};
    std::chrono::milliseconds idle{60'000};  // between two requests
    std::chrono::milliseconds write{10'000};
    std::chrono::milliseconds part{5000};  // to write a part of an event stream
};

struct HttpAdmission {
    std::size_t body_bytes = 0;  // at most
    bool has_key = false;        // the request came with the key, not only to what needs none
};

// Functions are called from many threads at once, and throw nothing.
struct HttpHandler {
    // Before the body is read. A refusal is answered, after which the connection is closed.
    std::function<std::variant<HttpAnswer, HttpAdmission>(const HttpRequest& head)> admit;
    std::function<HttpAnswer(const HttpRequest& request)> answer;
    // What is answered instead of these for 400, 413, 431 and 503.
    std::function<HttpAnswer(unsigned status)> fault;
};

class HttpServer {
 public:
    // Takes the port, and answers nothing yet. `host` is an address or a name of this machine; port 0: any that is
    // free. Throws InputError (use) if the address is not one of this machine, or the port is taken.
    HttpServer(const std::string& host, std::uint16_t port, const HttpLimits& limits = {});
    // Closes all connections and waits until their answers are made. Precondition: streams end.
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    std::uint16_t port() const;
    // Answers from now on. Once.
    void begin(HttpHandler handler);
    std::size_t connections() const;

 private:
    class Listener;
    std::unique_ptr<Listener> listener_;
};

}  // namespace qchopper

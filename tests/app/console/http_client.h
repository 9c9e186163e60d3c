// A client of HTTP for tests of the server: sends what it is given, right or wrong, over a socket of its own.
//
// All waits have a limit; what does not come within it is a result like any other.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qchopper {

struct GotAnswer {
    unsigned status = 0;  // 0: nothing came, or no whole answer
    std::string head;     // with its first line
    std::string body;
    // Of a field of the head; empty: there is none.
    std::string field(const std::string& name) const;
};

using ClientFields = std::vector<std::pair<std::string, std::string>>;

// The text of a request, with Content-Length where there is a body.
std::string request_text(const std::string& method, const std::string& target, const ClientFields& fields,
                         const std::string& body = {});

class HttpClient {
 public:
    // Connects to 127.0.0.1. `receives`: bytes that the system keeps for it; 0: as usual.
    explicit HttpClient(std::uint16_t port, int receives = 0);
    ~HttpClient();
    HttpClient(HttpClient&& other) noexcept;
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;
    HttpClient& operator=(HttpClient&&) = delete;

    bool is_connected() const { return socket_ >= 0; }
    // Whether all of it was sent within the limit.
    bool send(std::string_view bytes, std::chrono::milliseconds limit = std::chrono::seconds(10)) const;
    // The next answer, of which the body is as long as Content-Length says, or chunked.
    GotAnswer read(std::chrono::milliseconds limit = std::chrono::seconds(10));
    GotAnswer ask(std::string_view bytes);
    // Until this text is there, which is then gone with all before it; false: it did not come.
    bool reads_until(std::string_view text, std::chrono::milliseconds limit);
    // Whether the server closes the connection within the limit.
    bool is_closed(std::chrono::milliseconds limit);
    void close();
    const std::string& unread() const { return text_; }

 private:
    using Clock = std::chrono::steady_clock;
    bool reads_more(Clock::time_point until);
    std::optional<std::string> chunked_body(Clock::time_point until);

    int socket_ = -1;
    bool is_over_ = false;
    std::string text_;
};

}  // namespace qchopper

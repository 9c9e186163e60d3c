#include "tests/app/console/http_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>

namespace qchopper {
namespace {

int left_ms(std::chrono::steady_clock::time_point until) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    return left.count() > 0 ? static_cast<int>(left.count()) : 0;
}

}  // namespace

std::string GotAnswer::field(const std::string& name) const {
    const std::size_t at = head.find("\r\n" + name + ": ");
    if (at == std::string::npos) return {};
    const std::size_t begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
}

std::string request_text(const std::string& method, const std::string& target, const ClientFields& fields,
                         const std::string& body) {
    std::string text = method + " " + target + " HTTP/1.1\r\n";
    for (const auto& [name, value] : fields) text += name + ": " + value + "\r\n";
    if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    return text + "\r\n" + body;
}

HttpClient::HttpClient(std::uint16_t port, int receives) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receives > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receives, sizeof receives);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) close();
}

HttpClient::~HttpClient() {
    close();
}

HttpClient::HttpClient(HttpClient&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), is_over_(other.is_over_), text_(std::move(other.text_)) {}

void HttpClient::close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
}

bool HttpClient::send(std::string_view bytes, std::chrono::milliseconds limit) const {
    const Clock::time_point until = Clock::now() + limit;
    while (!bytes.empty()) {
        pollfd watched{socket_, POLLOUT, 0};
        if (::poll(&watched, 1, left_ms(until)) <= 0) return false;
        const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count < 0 && errno != EAGAIN) return false;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

bool HttpClient::reads_more(Clock::time_point until) {
    if (is_over_) return false;
    pollfd watched{socket_, POLLIN, 0};
    if (::poll(&watched, 1, left_ms(until)) <= 0) return false;
    std::array<char, 65'536> buffer{};
    const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), 0);
    if (count > 0) text_.append(buffer.data(), static_cast<std::size_t>(count));
    is_over_ = count <= 0;
    return count > 0;
}

bool HttpClient::reads_until(std::string_view text, std::chrono::milliseconds limit) {
    const Clock::time_point until = Clock::now() + limit;
    std::size_t at = 0;
    while ((at = text_.find(text)) == std::string::npos) {
        if (!reads_more(until)) return false;
    }
    text_.erase(0, at + text.size());
    return true;
}

std::optional<std::string> HttpClient::chunked_body(Clock::time_point until) {
    std::string body;
    while (true) {
        std::size_t end = 0;
        while ((end = text_.find("\r\n")) == std::string::npos) {
            if (!reads_more(until)) return {};
        }
        const std::size_t size = std::strtoul(text_.c_str(), nullptr, 16);
        while (text_.size() < end + 2 + size + 2) {
            if (!reads_more(until)) return {};
        }
        body += text_.substr(end + 2, size);
        text_.erase(0, end + 2 + size + 2);
        if (size == 0) return body;
    }
}

GotAnswer HttpClient::read(std::chrono::milliseconds limit) {
    const Clock::time_point until = Clock::now() + limit;
    GotAnswer answer;
    std::size_t end = 0;
    while ((end = text_.find("\r\n\r\n")) == std::string::npos) {
        if (!reads_more(until)) return {};
    }
    answer.head = text_.substr(0, end + 2);
    text_.erase(0, end + 4);
    if (answer.field("Transfer-Encoding") == "chunked") {
        const std::optional<std::string> body = chunked_body(until);
        if (!body) return {};
        answer.body = *body;
    } else {
        const std::size_t size = std::strtoul(answer.field("Content-Length").c_str(), nullptr, 10);
        while (text_.size() < size) {
            if (!reads_more(until)) return {};
        }
        answer.body = text_.substr(0, size);
        text_.erase(0, size);
    }
    constexpr std::size_t before_status = 9;  // "HTTP/1.1 "
    if (answer.head.starts_with("HTTP/1.1 ")) {
        answer.status = static_cast<unsigned>(std::strtoul(answer.head.c_str() + before_status, nullptr, 10));
    }
    return answer;
}

GotAnswer HttpClient::ask(std::string_view bytes) {
    static_cast<void>(send(bytes));
    return read();
}

bool HttpClient::is_closed(std::chrono::milliseconds limit) {
    const Clock::time_point until = Clock::now() + limit;
    while (reads_more(until)) {
    }
    return is_over_;
}

}  // namespace qchopper

// Boost.Beast parses and writes; each connection has a thread and an io_context of its own, whose single operation is
// waited for with a time limit. Reads are asynchronous, because SO_RCVTIMEO has no effect on Asio's synchronous ones.
// The only source that sees Beast: it takes 20 s to compile.

#include "app/console/http/http_server.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>  // Asio 1.74 needs it under C++20 and does not include it
//
#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <limits>
#include <list>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/error.h"

namespace qchopper {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;
using std::chrono::milliseconds;

// How long a stream waits for a part before it looks whether it is to end.
constexpr milliseconds stream_wait{250};
constexpr std::size_t read_bytes = 4096;
// So much that is read and not parsed is kept, so that neither a chunk's extension nor a trailer grows without end.
constexpr std::size_t kept_bytes = 65'536;
constexpr milliseconds accept_pause{50};
// After a refusal.
constexpr milliseconds linger_limit{500};
constexpr std::size_t linger_bytes = 4 << 20;

}  // namespace

// Accepts connections, and knows those that are open.
class HttpServer::Listener {
 public:
    Listener(const std::string& host, std::uint16_t port, const HttpLimits& limits) : limits_(limits), acceptor_(io_) {
        const std::string where = host + ":" + std::to_string(port);
        beast::error_code error;
        const auto found = tcp::resolver(io_).resolve(host, std::to_string(port), tcp::resolver::passive, error);
        if (error || found.empty()) {
            throw InputError(InputFault::use, where + " is no address of this machine: " + error.message(),
                             "give an address such as 127.0.0.1:8720");
        }
        const tcp::endpoint endpoint = found.begin()->endpoint();
        acceptor_.open(endpoint.protocol(), error);
        if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
        if (!error) acceptor_.bind(endpoint, error);
        if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
        if (error) {
            throw InputError(InputFault::use, where + " cannot be listened at: " + error.message(),
                             "end the program that listens there, or choose another port");
        }
    }

    void begin(HttpHandler handler) {
        handler_ = std::move(handler);
        thread_ = std::thread([this] {
            accept_next();
            io_.run();
        });
    }

    ~Listener() {
        asio::post(io_, [this] {
            beast::error_code ignored;
            acceptor_.close(ignored);
        });
        if (thread_.joinable()) thread_.join();
        is_ending_ = true;
        {
            const std::lock_guard lock(changing_);
            for (Open& open : open_) close(open);
        }
        while (true) {
            std::list<Open> ended;
            {
                const std::lock_guard lock(changing_);
                if (open_.empty()) return;
                ended.splice(ended.end(), open_, open_.begin());
            }
            ended.front().thread.join();
        }
    }

    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    std::size_t connections() const {
        const std::lock_guard lock(changing_);
        return open_.size();
    }

 private:
    struct Open {
        int socket = -1;  // a descriptor of its own, which is closed with this entry
        bool is_known = false;
        bool is_closed = false;  // shut down; its thread may run for a moment more
        bool is_over = false;
        std::thread thread = {};
    };
    using Entry = std::list<Open>::iterator;

    // One connection, of whose thread all of it is.
    class Connection {
     public:
        Connection(Listener& listener, Entry entry, tcp::socket&& accepted)
            : listener_(listener), entry_(entry), stream_(io_) {
            beast::error_code error;
            const auto protocol = accepted.local_endpoint(error).protocol();
            const auto peer = accepted.remote_endpoint(error).address();
            is_from_this_machine_ = !error && peer.is_loopback();
            stream_.socket().assign(protocol, accepted.release(), error);
            is_good_ = !error;
            beast::error_code ignored;
            stream_.socket().set_option(tcp::no_delay(true), ignored);
        }

        void run() {
            bool is_first = true;
            while (is_good_ && !listener_.is_ending_ && serve_one(is_first)) is_first = false;
            if (is_refused_) read_on();
            beast::error_code ignored;
            stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
        }

     private:
        // Starts an operation with a handler (error, bytes) and waits for its end.
        template <class Start>
        beast::error_code wait(milliseconds limit, const Start& start) {
            beast::error_code result;
            stream_.expires_after(limit);
            start([&](beast::error_code error, std::size_t) { result = error; });
            io_.restart();
            io_.run();
            return result;
        }

        // Until the time limit that is set; 0: there are none.
        std::size_t read_some() {
            std::size_t got = 0;
            stream_.async_read_some(buffer_.prepare(read_bytes),
                                    [&](beast::error_code error, std::size_t count) { got = error ? 0 : count; });
            io_.restart();
            io_.run();
            buffer_.commit(got);
            return got;
        }

        bool await_bytes(milliseconds limit) {
            if (buffer_.size() > 0) return true;
            stream_.expires_after(limit);
            return read_some() > 0;
        }

        // A connection that is closed with bytes unread takes the answer away from its client (RFC 9112, HTTP/1.1,
        // 2022, 9.6).
        void read_on() {
            beast::error_code error;
            stream_.socket().shutdown(tcp::socket::shutdown_send, error);
            stream_.expires_after(linger_limit);
            for (std::size_t read = 0, got = 1; !error && got > 0 && read < linger_bytes; read += got) {
                buffer_.clear();
                got = read_some();
            }
        }

        // Whether the connection is good for another request.
        bool serve_one(bool is_first) {
            const HttpLimits& limits = listener_.limits_;
            if (!is_first && !await_bytes(limits.idle)) return false;
            http::request_parser<http::string_body> parser;
            parser.header_limit(static_cast<std::uint32_t>(limits.head_bytes));
            parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // set when the head is known
            const beast::error_code of_head =
                wait(limits.head, [&](auto done) { http::async_read_header(stream_, buffer_, parser, done); });
            if (of_head) return refuse_broken(of_head);
            HttpRequest request = head_of(parser.get());
            if (request.target.size() > limits.target_bytes) return refuse(fault(400), request);
            const auto admitted = listener_.handler_.admit(request);
            if (const auto* refusal = std::get_if<HttpAnswer>(&admitted)) return refuse(*refusal, request);
            const auto& [most, has_key] = std::get<HttpAdmission>(admitted);
            if (has_key) listener_.set_known(entry_);
            // The limit of the parser is looked at with a Content-Length only when the head is read.
            if (parser.content_length() && *parser.content_length() > most) return refuse(fault(413), request);
            parser.body_limit(most);
            const beast::error_code of_body =
                wait(limits.body, [&](auto done) { http::async_read(stream_, buffer_, parser, done); });
            if (of_body) return refuse_broken(of_body);
            request.body = std::move(parser.get().body());
            return write(listener_.handler_.answer(request), request, parser.keep_alive());
        }

        HttpRequest head_of(const http::request<http::string_body>& read) const {
            HttpRequest request;
            request.method = std::string(read.method_string());
            request.target = std::string(read.target());
            request.version = static_cast<int>(read.version());
            request.is_from_this_machine = is_from_this_machine_;
            for (const auto& field : read) {
                request.fields.emplace_back(std::string(field.name_string()), std::string(field.value()));
            }
            return request;
        }

        HttpAnswer fault(unsigned status) const { return listener_.handler_.fault(status); }

        // What is no request gets an answer where there is somebody to read it. Always false.
        bool refuse_broken(beast::error_code error) {
            unsigned status = 400;
            if (error == http::error::header_limit) status = 431;
            if (error == http::error::body_limit) status = 413;
            const bool is_parsed = error.category() == http::make_error_code(http::error::bad_method).category();
            if (is_parsed && error != http::error::end_of_stream && error != http::error::partial_message) {
                refuse(fault(status), {});
            }
            return false;
        }

        // Always false.
        bool refuse(const HttpAnswer& answer, const HttpRequest& request) {
            is_refused_ = true;
            return write(answer, request, false);
        }

        bool write(const HttpAnswer& answer, const HttpRequest& request, bool keeps) {
            if (answer.next_part) return write_stream(answer);
            http::response<http::string_body> response(http::int_to_status(answer.status), 11);
            for (const auto& [name, value] : answer.fields) response.insert(name, value);
            response.keep_alive(keeps);
            response.body() = answer.body;
            response.prepare_payload();
            if (request.method == "HEAD") response.body().clear();
            http::response_serializer<http::string_body> serializer(response);
            const beast::error_code error =
                wait(listener_.limits_.write, [&](auto done) { http::async_write(stream_, serializer, done); });
            return !error && keeps;
        }

        // Always false: the end of a stream ends its connection.
        bool write_stream(const HttpAnswer& answer) {
            http::response<http::empty_body> response(http::int_to_status(answer.status), 11);
            for (const auto& [name, value] : answer.fields) response.insert(name, value);
            response.keep_alive(false);
            response.chunked(true);
            http::response_serializer<http::empty_body> serializer(response);
            if (wait(listener_.limits_.part, [&](auto done) { http::async_write_header(stream_, serializer, done); })) {
                return false;
            }
            while (!listener_.is_ending_) {
                const std::optional<std::string> part = answer.next_part(stream_wait);
                if (!part) break;
                if (is_closed_by_client()) return false;
                if (part->empty()) continue;
                const auto chunk = http::make_chunk(asio::buffer(*part));
                if (wait(listener_.limits_.part, [&](auto done) { asio::async_write(stream_, chunk, done); })) {
                    return false;
                }
            }
            wait(listener_.limits_.part, [&](auto done) { asio::async_write(stream_, http::make_chunk_last(), done); });
            return false;
        }

        // A stream is written every 2 s only; the place of one that is closed is free at once.
        bool is_closed_by_client() {
            char byte = 0;
            return ::recv(stream_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
        }

        Listener& listener_;
        Entry entry_;
        asio::io_context io_{1};
        beast::tcp_stream stream_;
        beast::flat_buffer buffer_{kept_bytes};
        bool is_from_this_machine_ = false;
        bool is_good_ = false;
        bool is_refused_ = false;
    };

    void accept_next() {
        acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
            // One that was accepted just before the acceptor was closed is taken, and none after it.
            if (!acceptor_.is_open()) return;
            if (!error) {
                take(std::move(socket));
            } else {
                std::this_thread::sleep_for(accept_pause);  // there is no descriptor left: the error comes again
            }
            accept_next();
        });
    }

    void take(tcp::socket socket) {
        std::list<Open> ended;
        const std::lock_guard lock(changing_);
        for (auto i = open_.begin(); i != open_.end();) {
            const auto next = std::next(i);
            if (i->is_over) ended.splice(ended.end(), open_, i);
            i = next;
        }
        for (Open& open : ended) open.thread.join();
        make_room();
        const auto open = std::ranges::count_if(open_, [](const Open& o) { return !o.is_closed; });
        // Those that are closed end at once, but for an answer that is being made.
        if (static_cast<std::size_t>(open) >= limits_.connections || open_.size() >= 2 * limits_.connections) {
            refuse(socket);
            return;
        }
        // The number of the connection's own descriptor is another's as soon as a time limit has closed it.
        open_.emplace_back().socket = ::fcntl(socket.native_handle(), F_DUPFD_CLOEXEC, 0);
        const Entry entry = std::prev(open_.end());
        try {
            auto connection = std::make_shared<Connection>(*this, entry, std::move(socket));
            entry->thread = std::thread([this, entry, connection = std::move(connection)]() mutable {
                connection->run();
                connection.reset();
                const std::lock_guard changing(changing_);
                close_descriptor(*entry);
                entry->is_over = true;
            });
        } catch (const std::exception&) {  // no thread or no descriptor is left: this client is not answered
            close_descriptor(*entry);
            open_.erase(entry);
        }
    }

    // Closes the oldest connection that is not known, where there are as many as may be. Precondition: it is locked.
    void make_room() {
        std::size_t not_known = 0;
        Open* oldest = nullptr;
        for (Open& open : open_) {
            if (open.is_known || open.is_closed || open.socket < 0) continue;
            ++not_known;
            if (oldest == nullptr) oldest = &open;
        }
        if (not_known >= limits_.not_known) close(*oldest);
    }

    // One attempt, which does not wait: a client that does not read is not waited for.
    void refuse(tcp::socket& socket) const {
        const HttpAnswer answer = handler_.fault(503);
        const std::string text = "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: " +
                                 std::to_string(answer.body.size()) + "\r\n\r\n" + answer.body;
        ::send(socket.native_handle(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    }

    static void close(Open& open) {
        open.is_closed = true;
        if (open.socket >= 0) ::shutdown(open.socket, SHUT_RDWR);
    }

    static void close_descriptor(Open& open) {
        if (open.socket >= 0) ::close(open.socket);
        open.socket = -1;
    }

    void set_known(Entry entry) {
        const std::lock_guard lock(changing_);
        entry->is_known = true;
    }

    HttpLimits limits_;
    HttpHandler handler_;
    asio::io_context io_{1};
    tcp::acceptor acceptor_;
    std::thread thread_;
    std::atomic<bool> is_ending_ = false;
    mutable std::mutex changing_;
    std::list<Open> open_;  // the oldest first
};

HttpServer::HttpServer(const std::string& host, std::uint16_t port, const HttpLimits& limits)
    : listener_(std::make_unique<Listener>(host, port, limits)) {}

HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
    return listener_->port();
}

void HttpServer::begin(HttpHandler handler) {
    listener_->begin(std::move(handler));
}

std::size_t HttpServer::connections() const {
    return listener_->connections();
}

}  // namespace qchopper

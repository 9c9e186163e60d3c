// One thread with poll() over non-blocking sockets; a buffer for each connection. Framing and its limits follow Modbus
// Messaging on TCP/IP Implementation Guide V1.0b (2006). O(connections) for each turn of the loop, of at most 8.

#include "sim/cell/modbus_server.h"

#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <thread>

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t max_connections = 8;
constexpr double quiet_s = 1;                  // refused connections are reported when no more came for so long,
constexpr double count_s = 10;                 // but not later than this after the first
constexpr std::size_t input_bytes = 520;       // two frames of the largest kind
constexpr std::size_t output_bytes = 4 * 260;  // four answers; a client that has not read them is not read either
constexpr std::size_t head_bytes = 7;          // MBAP: transaction, protocol, length, unit
constexpr std::size_t min_length = 2;          // of unit and PDU
constexpr std::size_t max_length = 254;

// A part of an answer that is not to be sent yet.
struct Held {
    Clock::time_point due;
    Bytes bytes;
    bool then_close = false;
};

struct Connection {
    int fd = -1;
    std::string peer;
    Bytes input;
    Bytes output;
    std::deque<Held> held;           // after what stands in `output`
    bool ends = false;               // to be closed as soon as the output is sent
    Clock::time_point last_request;  // when the last whole request came, or the connection began
    Clock::time_point last_byte;
    Clock::time_point frame_began;   // of the frame that is not complete yet
    Clock::time_point output_moved;  // when something was last sent, or the output began to fill
    bool is_full() const {
        std::size_t waiting = output.size();
        for (const Held& part : held) waiting += part.bytes.size();
        return ends || waiting + 260 > output_bytes;
    }
};

double since(Clock::time_point then, Clock::time_point now) {
    return std::chrono::duration<double>(now - then).count();
}

}  // namespace

struct ModbusServer::Loop {
    Loop(ModbusServerOptions given, Answer answer_one, std::function<void()> tick,
         std::function<void(const std::string&)> message)
        : options(std::move(given)),
          answer(std::move(answer_one)),
          on_tick(std::move(tick)),
          on_message(std::move(message)) {}

    void report(const std::string& line) const {
        if (on_message) on_message(line);
    }

    void run() {
        while (true) {
            std::vector<pollfd> waiting{{wake, POLLIN, 0}, {listener.fd, POLLIN, 0}};
            for (const Connection& connection : connections) {
                const int events = (connection.is_full() ? 0 : POLLIN) | (connection.output.empty() ? 0 : POLLOUT);
                waiting.push_back({connection.fd, static_cast<short>(events), 0});
            }
            const int ready = poll(waiting.data(), waiting.size(), static_cast<int>(1000 * options.tick_s));
            if (ready < 0 && errno != EINTR) report(std::string("poll: ") + std::strerror(errno));
            if (ready > 0 && waiting[0].revents != 0) return report_refused();
            serve(waiting);
            if (ready > 0 && waiting[1].revents != 0) accept_connections();
            close_overdue();
            const auto now = Clock::now();
            if (since(last_refused, now) > quiet_s || since(first_refused, now) > count_s) report_refused();
            on_tick();
        }
    }

    void serve(const std::vector<pollfd>& waiting) {
        std::size_t i = 2;
        for (auto connection = connections.begin(); connection != connections.end(); ++i) {
            const short events = waiting[i].revents;
            bool is_alive = is_on && (events & (POLLERR | POLLNVAL)) == 0;
            if (is_alive) is_alive = send_due(*connection);
            if ((events & POLLHUP) != 0 && connection->is_full()) is_alive = false;
            if (is_alive && (events & POLLOUT) != 0) is_alive = flush(*connection) && answer_frames(*connection);
            if (is_alive && (events & (POLLIN | POLLHUP)) != 0) is_alive = receive(*connection);
            connection = is_alive ? std::next(connection) : drop(connection);
        }
    }

    std::list<Connection>::iterator drop(std::list<Connection>::iterator connection) {
        close(connection->fd);
        return connections.erase(connection);
    }

    bool receive(Connection& connection) {
        std::uint8_t buffer[input_bytes];
        const std::size_t space = input_bytes - std::min(input_bytes, connection.input.size());
        if (space == 0 || connection.is_full()) return true;
        const ssize_t got = recv(connection.fd, buffer, space, 0);
        if (got == 0) return false;
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        const auto now = Clock::now();
        if (connection.input.empty()) connection.frame_began = now;
        connection.last_byte = now;
        connection.input.insert(connection.input.end(), buffer, buffer + got);
        return answer_frames(connection);
    }

    // Answers every complete frame while the output has space. False: the connection is to be closed.
    bool answer_frames(Connection& connection) {
        for (bool more = true; more;) {
            while (has_frame(connection) && !connection.is_full()) answer_frame(connection);
            if (!is_modbus(connection)) {
                report(connection.peer + " does not follow Modbus TCP; closed");
                return false;
            }
            if (!flush(connection)) return false;
            // poll() does not report frames that were received before and could not be answered for lack of space.
            more = has_frame(connection) && !connection.is_full();
        }
        return true;
    }

    static std::size_t length_of(const Connection& connection) {
        return (std::size_t{connection.input[4]} << 8U) | connection.input[5];
    }

    // Of the bytes received so far; true while the header is not complete.
    static bool is_modbus(const Connection& connection) {
        const Bytes& in = connection.input;
        if (in.size() < head_bytes) return true;
        const std::size_t length = length_of(connection);
        return in[2] == 0 && in[3] == 0 && length >= min_length && length <= max_length;
    }

    static bool has_frame(const Connection& connection) {
        return connection.input.size() >= head_bytes && is_modbus(connection) &&
               connection.input.size() >= 6 + length_of(connection);
    }

    void answer_frame(Connection& connection) const {
        const Bytes& in = connection.input;
        const std::size_t length = length_of(connection);
        const Bytes pdu = answer(in[6], std::span(in).subspan(head_bytes, length - 1));
        const std::size_t out_length = pdu.size() + 1;
        Bytes out{in[0],
                  in[1],
                  0,
                  0,
                  static_cast<std::uint8_t>(out_length >> 8U),
                  static_cast<std::uint8_t>(out_length & 0xFFU),
                  in[6]};
        out.insert(out.end(), pdu.begin(), pdu.end());
        connection.input.erase(connection.input.begin(),
                               connection.input.begin() + static_cast<std::ptrdiff_t>(6 + length));
        connection.last_request = Clock::now();
        connection.frame_began = connection.last_request;
        if (pdu.empty()) return hold(connection, {{0, {}, true}});
        hold(connection, options.deliver ? options.deliver(std::move(out)) : std::vector<Delivery>{{0, out, false}});
    }

    // Behind what is held already; what is due at once goes into the output.
    static void hold(Connection& connection, std::vector<Delivery> parts) {
        Clock::time_point due = Clock::now();
        if (!connection.held.empty()) due = std::max(due, connection.held.back().due);
        for (Delivery& part : parts) {
            due += std::chrono::milliseconds(part.after_ms);
            connection.held.push_back({due, std::move(part.bytes), part.then_close});
        }
        move_due(connection);
    }

    static void move_due(Connection& connection) {
        const auto now = Clock::now();
        while (!connection.held.empty() && connection.held.front().due <= now) {
            const Held& part = connection.held.front();
            if (connection.output.empty()) connection.output_moved = now;
            connection.output.insert(connection.output.end(), part.bytes.begin(), part.bytes.end());
            connection.ends = connection.ends || part.then_close;
            connection.held.pop_front();
        }
    }

    // False: the connection is to be closed.
    static bool send_due(Connection& connection) {
        const bool was_held = !connection.held.empty();
        move_due(connection);
        if (was_held && !flush(connection)) return false;
        return !connection.ends || !connection.output.empty();
    }

    static bool flush(Connection& connection) {
        if (connection.output.empty()) return true;
        const ssize_t sent = send(connection.fd, connection.output.data(), connection.output.size(), MSG_NOSIGNAL);
        if (sent < 0) return errno == EAGAIN || errno == EINTR;
        if (connection.is_full()) connection.frame_began = Clock::now();  // the time without reading does not count
        connection.output.erase(connection.output.begin(), connection.output.begin() + sent);
        connection.output_moved = Clock::now();
        return true;
    }

    void close_overdue() {
        const auto now = Clock::now();
        for (auto connection = connections.begin(); connection != connections.end();) {
            const char* why = nullptr;
            const bool is_reading = !connection->is_full();
            if (!connection->output.empty() && since(connection->output_moved, now) > options.drain_s) {
                why = "does not read its answers";
            } else if (is_reading && !connection->input.empty() &&
                       since(connection->frame_began, now) > options.frame_s) {
                why = "did not complete its request in time";
            } else if (since(connection->last_byte, now) > options.idle_s) {
                why = "sent nothing for too long";
            }
            if (why != nullptr) report(connection->peer + " " + why + "; closed");
            connection = why == nullptr ? std::next(connection) : drop(connection);
        }
    }

    bool may_stay(const std::string& peer) {
        const bool is_listed = std::find(options.allow.begin(), options.allow.end(), peer) != options.allow.end();
        if (!is_listed && !is_loopback(peer)) return false;
        // With a list, the last place is kept for those on it.
        const std::size_t places = max_connections - (!options.allow.empty() && !is_listed ? 1 : 0);
        return connections.size() < places || make_room(connections.size() + 1 - places);
    }

    // A connection without a whole request for frame_s gives up its place to one that comes; of several the one that
    // has been without for the longest. None does unless there are enough of them.
    bool make_room(std::size_t wanted) {
        const auto now = Clock::now();
        const auto yields = [&](const Connection& one) { return since(one.last_request, now) > options.frame_s; };
        if (static_cast<std::size_t>(std::count_if(connections.begin(), connections.end(), yields)) < wanted) {
            return false;
        }
        for (; wanted > 0; --wanted) {
            const auto longest = std::ranges::min_element(connections, {}, &Connection::last_request);
            report(longest->peer + " has sent no whole request for too long; closed, because another needs its place");
            drop(longest);
        }
        return true;
    }

    // Counted and reported together, so that repeated attempts do not fill the log.
    void count_refused(const std::string& peer) {
        last_refused = Clock::now();
        if (refused == 0) first_refused = last_refused;
        ++refused;
        refused_peer = peer;
    }

    void report_refused() {
        if (refused == 0) return;
        report(std::to_string(refused) + (refused == 1 ? " connection" : " connections") + " refused, the last from " +
               refused_peer + ": not on the list, or too many at once");
        refused = 0;
    }

    void accept_connections() {
        for (;;) {
            sockaddr_storage address{};
            socklen_t size = sizeof address;
            const int fd =
                accept4(listener.fd, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
            if (fd < 0 && (errno == EMFILE || errno == ENFILE)) {
                // Out of descriptors: the spare one serves to accept and close the connection, else poll() would spin.
                close(spare);
                const int surplus = accept(listener.fd, nullptr, nullptr);
                if (surplus >= 0) close(surplus);
                spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
                return;
            }
            if (fd < 0) return;
            const std::string peer = numeric(address);
            if (!is_on) {
                close(fd);
                continue;
            }
            if (!may_stay(peer)) {
                count_refused(peer);
                close(fd);
                continue;
            }
            const int on = 1;
            setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            const auto now = Clock::now();
            connections.push_back({fd, peer, {}, {}, {}, false, now, now, now, now});
        }
    }

    ModbusServerOptions options;
    Answer answer;
    std::function<void()> on_tick;
    std::function<void(const std::string&)> on_message;
    Listener listener;
    std::atomic<bool> is_on = true;
    int wake = -1;
    int spare = -1;
    std::list<Connection> connections;
    std::size_t refused = 0;  // connections since the last report
    std::string refused_peer;
    Clock::time_point first_refused;
    Clock::time_point last_refused;
    std::thread thread;
};

ModbusServer::ModbusServer(ModbusServerOptions options, Answer answer, std::function<void()> on_tick,
                           std::function<void(const std::string&)> on_message)
    : loop_(std::make_unique<Loop>(std::move(options), std::move(answer), std::move(on_tick), std::move(on_message))) {}

ModbusServer::~ModbusServer() {
    stop();
}

void ModbusServer::start() {
    if (loop_->thread.joinable()) return;
    loop_->listener = listen_on(loop_->options);
    loop_->wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    loop_->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
    loop_->thread = std::thread([this] { loop_->run(); });
}

void ModbusServer::set_power(bool is_on) {
    loop_->is_on = is_on;
}

std::uint16_t ModbusServer::port() const {
    return loop_->listener.port;
}

void ModbusServer::stop() {
    if (!loop_->thread.joinable()) return;
    const std::uint64_t one = 1;
    while (write(loop_->wake, &one, sizeof one) < 0 && errno == EINTR) {
    }
    loop_->thread.join();
    for (const Connection& connection : loop_->connections) close(connection.fd);
    loop_->connections.clear();
    for (const int fd : {loop_->listener.fd, loop_->wake, loop_->spare}) {
        if (fd >= 0) close(fd);
    }
}

}  // namespace qchopper

// One thread with poll() over non-blocking sockets. In each turn of the loop a stranger gets one answer and the holder
// of the lease sixteen, and so many connections are accepted, so that a turn is short whatever the clients do. The list
// of connections is in the order of their last answers: who has waited longest takes what peer_rate leaves first.
// O(connections) for each turn, of at most Places::in_all.
//
// The holder of the lease is one connection: the first that names the lease rightly, as CLAIM, a command or a heartbeat
// does, for as long as both live. Epoch and owner are no secrets, so a second one that names them changes nothing.

#include "sim/cell/link/modbus_server.h"

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
#include <list>
#include <thread>

#include "sim/cell/link/peer_rates.h"
#include "sim/cell/link/refusals.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;
using Position = std::list<ModbusConnection>::iterator;

constexpr int holder_answers = 16;  // in one turn
constexpr int accepted_at_once = 32;
constexpr int sent_ahead = 16 * 1024;       // bytes that the system may keep for a client that does not read
constexpr std::uint64_t free_requests = 8;  // of a connection, which do not count for its address
constexpr double retry_s = 0.002;           // while a request waits for what peer_rate leaves

}  // namespace

struct ModbusServer::Loop {
    Loop(ModbusServerOptions given, Answer answer_one, std::function<void()> tick,
         std::function<void(const std::string&)> message)
        : options(std::move(given)),
          answer(std::move(answer_one)),
          on_tick(std::move(tick)),
          on_message(std::move(message)),
          rates(options.peer_rate, options.peer_burst) {}

    void report(const std::optional<std::string>& line) const {
        if (line && on_message) on_message(*line);
    }

    void run() {
        while (true) {
            std::vector<pollfd> waiting{{wake, POLLIN, 0}, {listener.fd, POLLIN, 0}};
            std::vector<Position> order;
            for (auto one = connections.begin(); one != connections.end(); ++one) {
                const bool reads = !one->is_full() && !one->stream.has_frame() && one->may_send_more();
                const int events = (reads ? POLLIN : 0) | (one->has_output() ? POLLOUT : 0);
                waiting.push_back({one->fd, static_cast<short>(events), 0});
                order.push_back(one);
            }
            const int ready = poll(waiting.data(), waiting.size(), static_cast<int>(1000 * patience_s));
            if (ready < 0 && errno != EINTR) report(std::string("poll: ") + std::strerror(errno));
            if (ready > 0 && waiting[0].revents != 0) return report(refusals.rest());
            begin_turn();
            for (std::size_t i = 0; i < order.size(); ++i) {
                if (!serve(order[i], waiting[i + 2].revents)) drop(order[i]);
            }
            if (ready > 0 && waiting[1].revents != 0) accept_connections();
            close_overdue();
            report(refusals.line(now));
            on_tick();
        }
    }

    void begin_turn() {
        now = Clock::now();
        patience_s = options.tick_s;
        lease = options.lease ? options.lease() : 0;
        rates.forget(now);
    }

    void drop(Position connection) {
        if (options.on_close) options.on_close(connection->number);
        connections.erase(connection);
    }

    void refuse(Position connection, RefusedBecause why) {
        refusals.add(why, connection->peer, now);
        drop(connection);
    }

    // The number of the connection of the holder; 0: there is none.
    std::uint64_t holder() const { return lease != 0 && lease == held_lease ? holding : 0; }

    // False: the connection is to be closed.
    bool serve(Position connection, short events) {
        if (!is_on || (events & (POLLERR | POLLNVAL)) != 0) return false;
        if (!connection->send_due(now)) return false;
        if ((events & POLLOUT) != 0 && !connection->flush(now)) return false;
        if ((events & (POLLIN | POLLHUP)) != 0 && !connection->receive(now)) return false;
        return attend(connection) && (events & POLLHUP) == 0;
    }

    // Answers what its turn allows. False: the connection is to be closed.
    bool attend(Position connection) {
        int left = connection->number == holder() ? holder_answers : 1;
        for (; left > 0 && connection->waits_for_turn() && may_ask(*connection); --left) answer_frame(connection);
        if (!connection->stream.is_modbus() && !connection->is_full()) {
            refusals.add(RefusedBecause::not_modbus, connection->peer, now);
            connection->flush(now);
            return false;
        }
        if (!connection->flush(now)) return false;
        if (connection->waits_for_turn()) patience_s = std::min(patience_s, left == 0 ? 0 : retry_s);
        return !connection->is_done();
    }

    bool may_ask(const ModbusConnection& connection) {
        return connection.answered < free_requests || connection.number == holder() || rates.take(connection.peer, now);
    }

    void answer_frame(Position connection) {
        const ModbusStream& stream = connection->stream;
        const ServerAnswer made = answer({connection->number, stream.unit(), stream.pdu()});
        const bool is_exception = !made.pdu.empty() && (made.pdu[0] & 0x80U) != 0;
        Bytes frame = stream.answer(made.pdu);
        connection->stream.pop();
        ++connection->answered;
        connection->frame_began = now;
        if (made.is_valid && !is_exception) connection->last_valid = now;
        if (made.lease != 0) note_lease(*connection, made.lease);
        connections.splice(connections.end(), connections, connection);
        if (made.pdu.empty()) return connection->hold({{0, {}, true}}, now);
        if (options.deliver) return connection->hold(options.deliver(std::move(frame)), now);
        connection->hold({{0, std::move(frame), false}}, now);
    }

    void note_lease(const ModbusConnection& connection, std::uint64_t named) {
        lease = named;
        const bool is_taken =
            named == held_lease &&
            std::ranges::any_of(connections, [this](const ModbusConnection& one) { return one.number == holding; });
        if (is_taken) return;
        held_lease = named;
        holding = connection.number;
    }

    void close_overdue() {
        for (auto connection = connections.begin(); connection != connections.end();) {
            const auto one = connection++;
            const bool waits_for_bytes = !one->is_full() && !one->stream.has_frame();
            if (one->has_output() && seconds_between(one->output_moved, now) > options.drain_s) {
                refuse(one, RefusedBecause::not_read);
            } else if (waits_for_bytes && !one->stream.is_empty() &&
                       seconds_between(one->frame_began, now) > options.frame_s) {
                refuse(one, RefusedBecause::not_whole);
            } else if (waits_for_bytes && seconds_between(one->last_byte, now) > options.idle_s) {
                refuse(one, RefusedBecause::silent);
            }
        }
    }

    bool may_come(const std::string& peer) const {
        return is_loopback(peer) || options.allow.empty() || std::ranges::count(options.allow, peer) > 0;
    }

    // Who has sent nothing valid yet may have done so since it was looked at last: its one request is answered first.
    void make_room(const std::string& peer) {
        for (;;) {
            const Position one = leaver(connections, peer, holder(), options.places);
            if (one == connections.end()) return;
            const bool is_new = !one->last_valid;
            if (is_new && (!one->receive(now) || !attend(one))) return drop(one);
            if (is_new && one->last_valid) continue;
            return refuse(one, RefusedBecause::gave_place);
        }
    }

    // Out of descriptors: the spare one serves to accept and close the connection, else poll() would spin.
    void refuse_one() {
        close(spare);
        const int surplus = accept(listener.fd, nullptr, nullptr);
        if (surplus >= 0) close(surplus);
        spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
        refusals.add(RefusedBecause::no_descriptor, "an address not known", now);
    }

    void accept_connections() {
        for (int n = 0; n < accepted_at_once; ++n) {
            sockaddr_storage address{};
            socklen_t size = sizeof address;
            const int fd =
                accept4(listener.fd, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
            if (fd < 0 && (errno == EMFILE || errno == ENFILE)) return refuse_one();
            if (fd < 0) return;
            const std::string peer = numeric(address);
            if (!is_on || !may_come(peer)) {
                if (is_on) refusals.add(RefusedBecause::not_listed, peer, now);
                close(fd);
                continue;
            }
            make_room(peer);
            add(fd, peer);
        }
    }

    // What it has sent already is answered at once.
    void add(int fd, const std::string& peer) {
        const int on = 1;
        setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &sent_ahead, sizeof sent_ahead);
        connections.emplace_back(fd, peer, ++count, now);
        const Position added = std::prev(connections.end());
        if (!added->receive(now) || !attend(added)) drop(added);
    }

    ModbusServerOptions options;
    Answer answer;
    std::function<void()> on_tick;
    std::function<void(const std::string&)> on_message;
    Listener listener;
    std::atomic<bool> is_on = true;
    int wake = -1;
    int spare = -1;
    std::list<ModbusConnection> connections;  // the one that was answered last is the last
    std::uint64_t count = 0;                  // of all connections so far
    LinkTime now;                             // when this turn began
    double patience_s = 0;                    // for the next wait
    std::uint64_t lease = 0;                  // that is alive in this turn
    std::uint64_t held_lease = 0;             // of the holder
    std::uint64_t holding = 0;                // number of the holder's connection, which may have ended
    PeerRates rates;
    Refusals refusals;
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
    loop_->options.allow = checked_addresses(loop_->options.allow);
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
    loop_->connections.clear();
    for (const int fd : {loop_->listener.fd, loop_->wake, loop_->spare}) {
        if (fd >= 0) close(fd);
    }
}

}  // namespace qchopper

// One thread and poll(): frames are cut out of both streams by the length in their header, and what FaultProxy makes of
// each is sent when it is due.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "tests/sim/cell/fault_proxy.h"

namespace qchopper::rig {
namespace {

using Clock = std::chrono::steady_clock;

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

int connect_to(std::uint16_t port) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

// RST in place of FIN.
void reset(int fd) {
    const linger at_once{1, 0};
    setsockopt(fd, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close(fd);
}

}  // namespace

struct TcpFaultProxy::Loop {
    struct Link {
        int ends[2] = {-1, -1};  // by Way: where its bytes go, the cell and the PC
        Bytes parts[2];          // of a frame, by Way
        bool is_gone = false;
    };
    struct Due {
        Clock::time_point when;
        int link = 0;
        Way way = Way::to_cell;
        Bytes bytes;
        bool resets = false;
    };

    explicit Loop(std::uint16_t port) : cell_port(port), listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address = loopback(0);
        socklen_t size = sizeof address;
        static_cast<void>(bind(listener, reinterpret_cast<sockaddr*>(&address), size));
        listen(listener, 16);
        getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
        own_port = ntohs(address.sin_port);
        thread = std::thread([this] {
            while (!ends) turn();
        });
    }
    ~Loop() {
        ends = true;
        thread.join();
        for (auto& [number, link] : links) drop(link);
        close(listener);
    }
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    static void drop(Link& link) {
        for (int& fd : link.ends) {
            if (fd >= 0) reset(fd);
            fd = -1;
        }
        link.is_gone = true;
    }

    // From another thread: the loop sees the end and closes.
    static void shut(const Link& link) {
        for (const int fd : link.ends) {
            if (fd >= 0) shutdown(fd, SHUT_RDWR);
        }
    }

    void turn() {
        std::vector<pollfd> waiting{{listener, POLLIN, 0}};
        std::vector<std::pair<int, Way>> who;
        for (const auto& [number, link] : links) {
            for (const Way way : {Way::to_cell, Way::to_pc}) {
                const int from = link.ends[way == Way::to_cell ? 1 : 0];
                if (from < 0) continue;
                waiting.push_back({from, POLLIN, 0});
                who.emplace_back(number, way);
            }
        }
        poll(waiting.data(), waiting.size(), 2);
        const std::lock_guard lock(mutex);
        if ((waiting[0].revents & POLLIN) != 0) accept_one();
        for (std::size_t i = 0; i < who.size(); ++i) {
            if (waiting[i + 1].revents != 0) receive(who[i].first, who[i].second, waiting[i + 1].fd);
        }
        send_due();
    }

    void accept_one() {
        const int pc = accept(listener, nullptr, nullptr);
        if (pc < 0) return;
        const int cell = is_plugged ? connect_to(cell_port) : -1;
        if (cell < 0) return reset(pc);
        Link& link = links[++count];
        link.ends[0] = cell;
        link.ends[1] = pc;
    }

    void receive(int number, Way way, int fd) {
        Link& link = links[number];
        if (link.is_gone) return;
        std::uint8_t buffer[2048];
        const ssize_t got = recv(fd, buffer, sizeof buffer, MSG_DONTWAIT);
        if (got <= 0) return end(number, way);
        Bytes& part = link.parts[static_cast<std::size_t>(way)];
        part.insert(part.end(), buffer, buffer + got);
        while (part.size() >= 7) {
            const std::size_t whole = 6 + (std::size_t{part[4]} << 8U | part[5]);
            if (part.size() < whole) return;
            const Bytes frame(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(whole));
            part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(whole));
            plan(number, way, proxy.pass(number, way, frame));
        }
    }

    // The PC has closed: what is still to come to the cell comes. The cell has closed: so is the PC's connection.
    void end(int number, Way way) {
        Link& link = links[number];
        if (way == Way::to_pc) return drop(link);
        plan(number, Way::to_cell, proxy.close(number));
        close(link.ends[1]);
        link.ends[1] = -1;
    }

    void plan(int number, Way way, const std::vector<Piece>& pieces) {
        for (const Piece& piece : pieces) {
            int link = number;
            if (piece.elsewhere) {
                link = ++count;
                links[link].ends[0] = connect_to(cell_port);
            }
            const auto after =
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(piece.after_s));
            due.push_back({Clock::now() + after, link, way, piece.bytes, piece.resets});
        }
    }

    void send_due() {
        const auto now = Clock::now();
        std::vector<Due> later;
        for (const Due& one : due) {
            if (one.when > now) {
                later.push_back(one);
                continue;
            }
            Link& link = links[one.link];
            if (one.resets) drop(link);
            const int to = link.ends[static_cast<std::size_t>(one.way)];
            if (to >= 0) send(to, one.bytes.data(), one.bytes.size(), MSG_NOSIGNAL);
        }
        due = std::move(later);
    }

    std::uint16_t cell_port;
    std::uint16_t own_port = 0;
    int listener;
    std::mutex mutex;  // guards the proxy, the links and is_plugged; the thread alone adds and removes links
    FaultProxy proxy;
    std::map<int, Link> links;
    std::vector<Due> due;
    int count = 0;
    bool is_plugged = true;
    std::atomic<bool> ends = false;
    std::thread thread;
};

TcpFaultProxy::TcpFaultProxy(std::uint16_t cell_port) : loop_(std::make_unique<Loop>(cell_port)) {}
TcpFaultProxy::~TcpFaultProxy() = default;

std::uint16_t TcpFaultProxy::port() const {
    return loop_->own_port;
}

void TcpFaultProxy::arm(LinkFault fault, Way way, std::int64_t number, Condition when) {
    const std::lock_guard lock(loop_->mutex);
    loop_->proxy.arm(fault, way, number, std::move(when));
}

void TcpFaultProxy::set_plugged(bool is_plugged) {
    const std::lock_guard lock(loop_->mutex);
    loop_->is_plugged = is_plugged;
    if (is_plugged) return;
    for (auto& [number, link] : loop_->links) loop_->shut(link);
}

}  // namespace qchopper::rig

// A good client that was connected before the attack and one that comes anew for each request ask in turn, 5 ms apart,
// below the rate of a stranger. Latency is from before the request, or before connect(), to the last byte of the
// answer; a connection that is lost is made again within it. O(seconds).

#include "bench/link_attacks.h"

#include <arpa/inet.h>
#include <errno.h>
#include <modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "bench/clock.h"
#include "sim/cell/cell_sim.h"
#include "tests/sim/cell/attackers.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper::bench {
namespace {

constexpr int hostile = 50;
constexpr double give_up_s = 5;  // a request that is not answered within so long counts as so long

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

// The yardstick: poll() over all sockets, each of which is read once a turn and gets the same bytes back.
class EchoServer {
 public:
    EchoServer() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
        sockaddr_in any = loopback(0);
        socklen_t size = sizeof any;
        auto* where = reinterpret_cast<sockaddr*>(&any);
        if (bind(listener_, where, size) != 0 || listen(listener_, SOMAXCONN) != 0) throw std::runtime_error("no port");
        getsockname(listener_, where, &size);
        port_ = ntohs(any.sin_port);
        thread_ = std::thread([this] { run(); });
    }
    ~EchoServer() {
        ends_ = true;
        thread_.join();
        for (const pollfd& one : waiting_) close(one.fd);
    }
    EchoServer(const EchoServer&) = delete;
    EchoServer& operator=(const EchoServer&) = delete;
    std::uint16_t port() const { return port_; }

 private:
    void run() {
        waiting_.push_back({listener_, POLLIN, 0});
        while (!ends_) {
            poll(waiting_.data(), waiting_.size(), 20);
            for (std::size_t i = waiting_.size(); i-- > 1;) {
                if (waiting_[i].revents == 0 || echoes(waiting_[i].fd)) continue;
                close(waiting_[i].fd);
                waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
            }
            for (int fd = 0; waiting_[0].revents != 0 && fd >= 0;) {
                fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
                if (fd >= 0) waiting_.push_back({fd, POLLIN, 0});
            }
        }
    }
    static bool echoes(int fd) {
        std::array<char, 520> bytes{};
        const ssize_t got = recv(fd, bytes.data(), bytes.size(), 0);
        if (got > 0) send(fd, bytes.data(), static_cast<std::size_t>(got), MSG_NOSIGNAL);
        return got > 0 || (got < 0 && errno == EAGAIN);
    }

    int listener_;
    std::uint16_t port_ = 0;
    std::vector<pollfd> waiting_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// A client that asks for one register; any server that answers with the same number of bytes or more will do.
class Client {
 public:
    Client(std::uint16_t port, std::size_t answer_bytes) : port_(port), answer_bytes_(answer_bytes) {}
    ~Client() { drop(); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    void drop() {
        if (fd_ >= 0) close(fd_);
        fd_ = -1;
    }
    double asked_s() {
        const double began = wall_s();
        while (wall_s() - began < give_up_s) {
            if ((fd_ >= 0 || connects()) && is_answered()) return wall_s() - began;
            drop();
        }
        return give_up_s;
    }

 private:
    bool connects() {
        fd_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        const sockaddr_in to = loopback(port_);
        const int on = 1;
        setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
    }
    bool is_answered() const {
        const Bytes request = rig::frame(1, rig::read_request(4, 0, 1));
        if (send(fd_, request.data(), request.size(), MSG_NOSIGNAL) < 0) return false;
        std::array<char, 64> bytes{};
        for (std::size_t got = 0; got < answer_bytes_;) {
            pollfd waiting{fd_, POLLIN, 0};
            if (poll(&waiting, 1, static_cast<int>(1000 * give_up_s)) <= 0) return false;
            const ssize_t count = recv(fd_, bytes.data(), answer_bytes_ - got, 0);
            if (count <= 0) return false;
            got += static_cast<std::size_t>(count);
        }
        return true;
    }
    std::uint16_t port_;
    std::size_t answer_bytes_;
    int fd_ = -1;
};

struct Latencies {
    std::vector<double> before;  // of the client that was connected before
    std::vector<double> anew;
};

// Precondition: `all` is not empty.
double percentile(std::vector<double>& all, double share) {
    std::ranges::sort(all);
    const auto at = static_cast<std::size_t>(share * static_cast<double>(all.size()));
    return all[std::min(at, all.size() - 1)];
}

Latencies during(rig::AttackKind kind, std::uint16_t port, std::size_t answer_bytes, double seconds) {
    Latencies found;
    Client before(port, answer_bytes);
    before.asked_s();
    const rig::Attackers attackers(kind, port, hostile);
    while (attackers.connections() < hostile) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const double began = wall_s();
    while (wall_s() - began < seconds) {
        found.before.push_back(before.asked_s());
        Client anew(port, answer_bytes);
        found.anew.push_back(anew.asked_s());
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return found;
}

void compare(const char* attack, const char* who, std::vector<double>& cell, std::vector<double>& echo,
             Figures& figures) {
    const std::string what(who);
    const double cell_s = percentile(cell, 0.99);
    const double echo_s = percentile(echo, 0.99);
    figures.record(attack, what + ": 99 % within, cell and echo", time_text(cell_s) + ", " + time_text(echo_s));
    figures.record(attack, what + ": worst, cell and echo", time_text(cell.back()) + ", " + time_text(echo.back()));
    figures.at_most(attack, what + ": 99 % of cell / echo", cell_s / echo_s, 3);
}

}  // namespace

void measure_attacks(double seconds, Figures& figures) {
    for (const auto& [kind, name] : rig::all_attacks) {
        const rig::Folder drop;
        Latencies echoed;
        {
            const EchoServer echo;
            echoed = during(kind, echo.port(), 12, seconds);
        }
        CellSim cell(rig::quick_cell(drop.path));
        cell.start();
        Latencies served = during(kind, cell.port(), 11, seconds);
        compare(name, "connected before", served.before, echoed.before, figures);
        compare(name, "arriving", served.anew, echoed.anew, figures);
    }
}

double libmodbus_bytes_per_s() {
    constexpr int registers = 121;
    constexpr int repetitions = 5000;
    constexpr double payload_bytes = 232;
    modbus_t* server = modbus_new_tcp("127.0.0.1", 0);
    int listener = modbus_tcp_listen(server, 1);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    std::thread serving([&] {
        modbus_mapping_t* mapping = modbus_mapping_new(0, 0, 500, 0);
        modbus_tcp_accept(server, &listener);
        std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> request{};
        for (int got = 0; got >= 0;) {
            got = modbus_receive(server, request.data());
            if (got > 0) modbus_reply(server, request.data(), got, mapping);
        }
        modbus_mapping_free(mapping);
    });
    modbus_t* client = modbus_new_tcp("127.0.0.1", ntohs(address.sin_port));
    if (modbus_connect(client) != 0) throw std::runtime_error("libmodbus does not connect");
    const std::array<std::uint16_t, registers> values{};
    const double seconds = best_of(3, wall_s, [&] {
        for (int n = 0; n < repetitions; ++n) {
            if (modbus_write_registers(client, 300, registers, values.data()) != registers) {
                throw std::runtime_error("libmodbus does not write");
            }
        }
        return 0;
    });
    modbus_close(client);
    serving.join();
    close(listener);
    modbus_close(server);
    modbus_free(client);
    modbus_free(server);
    return payload_bytes * repetitions / seconds;
}

}  // namespace qchopper::bench

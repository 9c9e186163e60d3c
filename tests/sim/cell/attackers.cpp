// Non-blocking sockets, in turn. O(attackers) for each turn.

#include "tests/sim/cell/attackers.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "devices/wire/layout.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper::rig {
namespace {

constexpr double slow_s = 0.1;  // between two bytes of a slow sender

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

sockaddr_in at(const std::string& address, std::uint16_t port) {
    sockaddr_in one{};
    one.sin_family = AF_INET;
    one.sin_port = htons(port);
    inet_pton(AF_INET, address.c_str(), &one.sin_addr);
    return one;
}

}  // namespace

Attackers::Attackers(AttackKind kind, std::uint16_t port, int count, bool from_one_address) : kind_(kind), port_(port) {
    for (int n = 0; n < count; ++n) {
        attackers_.emplace_back();
        attackers_.back().address = "127.0.0." + std::to_string(from_one_address ? 1 : n + 2);
    }
    thread_ = std::thread([this] { run(); });
}

Attackers::~Attackers() {
    ends_ = true;
    thread_.join();
    for (Attacker& one : attackers_) drop(one);
}

void Attackers::run() {
    while (!ends_) {
        bool has_done = false;
        for (Attacker& one : attackers_) has_done = step(one) || has_done;
        if (!has_done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

bool Attackers::open(Attacker& one) {
    one.fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (one.fd < 0) return false;
    const int on = 1;
    setsockopt(one.fd, IPPROTO_IP, IP_BIND_ADDRESS_NO_PORT, &on, sizeof on);
    const sockaddr_in from = at(one.address, 0);
    const sockaddr_in to = at("127.0.0.1", port_);
    one.pending.clear();
    one.next_s = now_s();
    const bool is_open =
        bind(one.fd, reinterpret_cast<const sockaddr*>(&from), sizeof from) == 0 &&
        (connect(one.fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 || errno == EINPROGRESS);
    if (!is_open) drop(one);
    if (is_open) ++connections_;
    return is_open;
}

// By a reset, so that no port is kept in TIME_WAIT.
void Attackers::drop(Attacker& one) {
    if (one.fd < 0) return;
    const linger reset{1, 0};
    setsockopt(one.fd, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    close(one.fd);
    one.fd = -1;
}

Bytes Attackers::next_bytes() {
    if (kind_ == AttackKind::garbage) {
        Bytes bytes(1 + random_() % 400);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
        return bytes;
    }
    if (kind_ == AttackKind::garbage_writes) {
        const Block* block = nullptr;
        while (block == nullptr || block->side != Side::holding) block = all_blocks()[random_() % all_blocks().size()];
        Registers registers(block->count);
        for (std::uint16_t& value : registers) value = static_cast<std::uint16_t>(random_());
        return frame(1, write_request(block->base, registers));
    }
    Bytes bytes = frame(1, read_request(4, 0, 100));
    if (kind_ == AttackKind::wrong_headers) {
        const bool is_protocol = random_() % 2 == 0;
        bytes[is_protocol ? 2 : 4] = static_cast<std::uint8_t>(1 + random_() % 255);
    }
    return bytes;
}

bool Attackers::send_some(Attacker& one, std::size_t most) {
    if (one.pending.empty()) one.pending = next_bytes();
    const ssize_t sent = send(one.fd, one.pending.data(), std::min(most, one.pending.size()), MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) drop(one);
    if (sent <= 0) return one.fd < 0;
    bytes_ += static_cast<std::uint64_t>(sent);
    one.pending.erase(one.pending.begin(), one.pending.begin() + sent);
    return true;
}

bool Attackers::step(Attacker& one) {
    if (one.fd < 0 && !open(one)) return false;
    if (kind_ == AttackKind::connect_and_reset) {
        drop(one);
        return true;
    }
    bool has_done = false;
    if (kind_ != AttackKind::never_reading) {
        std::uint8_t buffer[4096];
        const ssize_t got = recv(one.fd, buffer, sizeof buffer, 0);
        has_done = got >= 0;
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
            drop(one);
            return true;
        }
    }
    if (kind_ == AttackKind::idle) return has_done;
    if (kind_ == AttackKind::slow_senders) {
        if (now_s() < one.next_s) return has_done;
        one.next_s = now_s() + slow_s;
        return send_some(one, 1) || has_done;
    }
    return send_some(one, 512) || has_done;
}

}  // namespace qchopper::rig

// Non-blocking POSIX sockets and poll(), with one deadline for connecting and one for a call; one connection and one
// request at a time. A host name is resolved in a thread of its own, because getaddrinfo() has no time limit. O(bytes).

#include "devices/wire/modbus_tcp.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <future>
#include <thread>
#include <vector>

#include "base/error.h"
#include "devices/wire/device_error.h"
#include "devices/wire/modbus_frame.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;
using Deadline = Clock::time_point;

Deadline after(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

int ms_until(Deadline deadline) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    return static_cast<int>(std::max<std::int64_t>(0, left));
}

struct Endpoint {
    int family = AF_INET;
    sockaddr_storage address{};
    socklen_t length = 0;
};

struct Endpoints {
    int fault = 0;  // of getaddrinfo
    std::vector<Endpoint> list;
};

Endpoints resolve(const std::string& host, std::uint16_t port, int flags) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    Endpoints endpoints;
    endpoints.fault = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
    for (const addrinfo* one = found; endpoints.fault == 0 && one != nullptr; one = one->ai_next) {
        Endpoint endpoint{one->ai_family, {}, one->ai_addrlen};
        std::memcpy(&endpoint.address, one->ai_addr, one->ai_addrlen);
        endpoints.list.push_back(endpoint);
    }
    if (found != nullptr) freeaddrinfo(found);
    return endpoints;
}

// In a thread of its own, which is left to end by itself where a name server takes too long.
std::future<Endpoints> resolve_aside(const TcpAddress& address) {
    auto answer = std::make_shared<std::promise<Endpoints>>();
    std::future<Endpoints> future = answer->get_future();
    std::thread([answer, where = address] { answer->set_value(resolve(where.host, where.port, 0)); }).detach();
    return future;
}

// "127.0.0.1:15020", "[::1]:15020"; "" if it is neither.
std::string numeric_text(const Endpoint& endpoint) {
    char host[NI_MAXHOST];
    char port[NI_MAXSERV];
    const auto* address = reinterpret_cast<const sockaddr*>(&endpoint.address);
    const int flags = NI_NUMERICHOST | NI_NUMERICSERV;
    if (getnameinfo(address, endpoint.length, host, sizeof host, port, sizeof port, flags) != 0) return {};
    return (endpoint.family == AF_INET6 ? "[" + std::string(host) + "]" : std::string(host)) + ":" + port;
}

const char* const not_in_time = "no answer in time";

BusAnswer wrong_count() {
    BusAnswer answer;
    answer.end = BusEnd::exception;
    answer.exception = 3;
    answer.why = "wrong count";
    return answer;
}

}  // namespace

struct ModbusTcpBus::Link {
    Link(TcpAddress where, std::uint8_t unit_id, ModbusTimings bounds)
        : address(std::move(where)), unit(unit_id), timings(bounds) {}
    ~Link() { drop(); }
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    std::string text() const { return address.host + ":" + std::to_string(address.port); }

    bool is_watching() const { return cancelled != nullptr && leave_by == Deadline::max(); }

    // The earlier of the deadline and the end that leave_when() sets. Notes when the caller has asked to stop.
    Deadline bounded(Deadline deadline) {
        if (is_watching() && cancelled->load()) leave_by = after(leave_s);
        return std::min(deadline, leave_by);
    }

    double leaving_for_s() {
        bounded(Deadline::max());
        if (cancelled == nullptr || is_watching()) return 0;
        return leave_s - std::chrono::duration<double>(leave_by - Clock::now()).count();
    }

    // Milliseconds until the deadline, or until `cancelled` is to be read again.
    int slice_ms(Deadline deadline) const {
        constexpr int slice = 20;
        return is_watching() ? std::min(slice, ms_until(deadline)) : ms_until(deadline);
    }

    // False if the deadline passed before any of the events.
    bool wait_for(int descriptor, short events, Deadline deadline) {
        for (;;) {
            const Deadline until = bounded(deadline);
            pollfd waiting{descriptor, events, 0};
            const int ready = poll(&waiting, 1, slice_ms(until));
            if (ready > 0 || (ready < 0 && errno != EINTR)) return true;  // the next call reports a fault
            if (Clock::now() >= until) return false;
        }
    }

    Endpoints find(Deadline deadline) {
        Endpoints numeric = resolve(address.host, address.port, AI_NUMERICHOST);
        if (numeric.fault == 0) return numeric;
        std::future<Endpoints> future = resolve_aside(address);
        for (;;) {
            const Deadline until = bounded(deadline);
            const auto slice = std::chrono::milliseconds(slice_ms(until));
            if (future.wait_for(slice) == std::future_status::ready) return future.get();
            if (Clock::now() >= until) return {EAI_AGAIN, {}};
        }
    }

    // One attempt. Returns the descriptor, or -1 and the reason in `why`.
    int connect_one(const Endpoint& endpoint, Deadline deadline, std::string& why) {
        const int descriptor = socket(endpoint.family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        if (descriptor < 0) {
            why = std::strerror(errno);
            return -1;
        }
        const auto fail = [&](const std::string& reason) {
            why = reason;
            close(descriptor);
            return -1;
        };
        const auto* to = reinterpret_cast<const sockaddr*>(&endpoint.address);
        if (::connect(descriptor, to, endpoint.length) != 0) {
            if (errno != EINPROGRESS) return fail(std::strerror(errno));
            if (!wait_for(descriptor, POLLOUT, deadline)) return fail(not_in_time);
            int error = 0;
            socklen_t size = sizeof error;
            if (getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
            if (error != 0) return fail(std::strerror(error));
        }
        const int on = 1;
        setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return descriptor;
    }

    // Returns "" if connected, else the reason.
    std::string open() {
        if (fd >= 0) return {};
        const Deadline deadline = after(timings.connect_s);
        const Endpoints endpoints = find(deadline);
        if (endpoints.fault != 0) return std::string("cannot resolve the name (") + gai_strerror(endpoints.fault) + ")";
        std::string why = not_in_time;
        for (const Endpoint& endpoint : endpoints.list) {
            fd = connect_one(endpoint, deadline, why);
            if (fd < 0) continue;
            peer = numeric_text(endpoint);
            return {};
        }
        return why;
    }

    void drop() {
        if (fd >= 0) close(fd);
        fd = -1;
    }

    // Bytes before a request: answers and requests are out of step. Returns the reason, or "" if there are none.
    std::string unexpected_input() const {
        std::uint8_t byte = 0;
        const ssize_t got = recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
        if (got > 0) return "the other side sent bytes without a request";
        if (got == 0) return "the connection was closed by the other side";
        return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR ? std::string() : std::strerror(errno);
    }

    // Returns "" if everything was sent, else the reason.
    std::string send_all(const Bytes& bytes, Deadline deadline) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t sent = send(fd, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent > 0) {
                done += static_cast<std::size_t>(sent);
            } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
                return std::strerror(errno);
            } else if (!wait_for(fd, POLLOUT, deadline)) {
                return "the request could not be sent in time";
            }
        }
        return {};
    }

    // The answer to the request just sent. Nothing of a wrong frame is used.
    BusAnswer receive(const ModbusRequest& request, Deadline deadline) {
        BusAnswer lost;
        Bytes bytes;
        AnswerSoFar so_far = check_answer(request, bytes);
        const Deadline first_byte = std::min(deadline, after(timings.response_s));
        while (bytes.size() < so_far.wanted) {
            if (!wait_for(fd, POLLIN, bytes.empty() ? first_byte : deadline)) {
                lost.why = bytes.empty() ? not_in_time : "the answer was not complete in time";
                return lost;
            }
            const std::size_t had = bytes.size();
            bytes.resize(so_far.wanted);
            const ssize_t got = recv(fd, bytes.data() + had, bytes.size() - had, MSG_DONTWAIT);
            const int error = errno;
            bytes.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
            if (got == 0) lost.why = "the connection was closed by the other side";
            if (got < 0 && error != EAGAIN && error != EWOULDBLOCK && error != EINTR) lost.why = std::strerror(error);
            if (!lost.why.empty()) return lost;
            so_far = check_answer(request, bytes);
            if (!so_far.wrong.empty()) {
                lost.why = so_far.wrong;
                lost.is_alien = true;
                return lost;
            }
        }
        return decode_answer(request, bytes);
    }

    BusAnswer exchange(const ModbusRequest& request) {
        const Deadline deadline = after(timings.call_s);
        BusAnswer answer;
        answer.why = unexpected_input();
        if (answer.why.empty()) answer.why = send_all(frame_of(request), deadline);
        return answer.why.empty() ? receive(request, deadline) : answer;
    }

    BusAnswer call(ModbusRequest request) {
        BusAnswer answer;
        answer.why = open();
        if (!answer.why.empty()) return answer;
        request.transaction = ++transaction;
        request.unit = unit;
        answer = exchange(request);
        if (answer.end == BusEnd::lost) drop();
        return answer;
    }

    TcpAddress address;
    std::uint8_t unit;
    ModbusTimings timings;
    int fd = -1;
    std::string peer;  // of the last connection
    std::uint16_t transaction = 0;
    const std::atomic<bool>* cancelled = nullptr;
    double leave_s = 0;
    Deadline leave_by = Deadline::max();
};

ModbusTcpBus::ModbusTcpBus(TcpAddress address, std::uint8_t unit, ModbusTimings timings)
    : link_(std::make_unique<Link>(std::move(address), unit, timings)) {}
ModbusTcpBus::~ModbusTcpBus() = default;

void ModbusTcpBus::connect() {
    const std::string why = link_->open();
    if (why.empty()) return;
    throw DeviceError(DeviceFault::unreachable, "no cell at " + link_->text() + ": " + why + "; nothing was sent",
                      "Check that the cell is switched on and that this is its address.");
}

std::string ModbusTcpBus::peer() const {
    return link_->peer;
}

BusAnswer ModbusTcpBus::read_input(std::uint16_t address, std::uint16_t count) {
    if (count == 0 || count > max_read_registers) return wrong_count();
    return link_->call({0, 0, ModbusFunction::read_input, address, count});
}

BusAnswer ModbusTcpBus::read_holding(std::uint16_t address, std::uint16_t count) {
    if (count == 0 || count > max_read_registers) return wrong_count();
    return link_->call({0, 0, ModbusFunction::read_holding, address, count});
}

BusAnswer ModbusTcpBus::write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) {
    if (registers.empty() || registers.size() > max_written_registers) return wrong_count();
    const auto count = static_cast<std::uint16_t>(registers.size());
    return link_->call({0, 0, ModbusFunction::write_holding, address, count, registers});
}

void ModbusTcpBus::leave_when(const std::atomic<bool>* cancelled, double within_s) {
    link_->cancelled = cancelled;
    link_->leave_s = within_s;
    link_->leave_by = Deadline::max();
}

double ModbusTcpBus::leaving_for_s() const {
    return link_->leaving_for_s();
}

std::vector<std::string> numeric_addresses(const TcpAddress& address, double within_s) {
    Endpoints found = resolve(address.host, address.port, AI_NUMERICHOST);
    if (found.fault != 0) {
        std::future<Endpoints> future = resolve_aside(address);
        if (future.wait_until(after(within_s)) != std::future_status::ready) return {};
        found = future.get();
    }
    std::vector<std::string> texts;
    for (const Endpoint& endpoint : found.list) texts.push_back(numeric_text(endpoint));
    return texts;
}

TcpAddress parse_tcp_address(const std::string& text) {
    const auto refuse = [&]() -> InputError {
        return {InputFault::use, "'" + text + "' is not an address of a cell",
                "Give HOST:PORT, for example 127.0.0.1:15020 or [::1]:15020."};
    };
    TcpAddress address;
    std::string port;
    if (!text.empty() && text.front() == '[') {
        const std::size_t end = text.find(']');
        if (end == std::string::npos) throw refuse();
        address.host = text.substr(1, end - 1);
        if (end + 1 < text.size() && text[end + 1] != ':') throw refuse();
        if (end + 1 < text.size()) port = text.substr(end + 2);
        if (end + 1 < text.size() && port.empty()) throw refuse();
    } else if (std::count(text.begin(), text.end(), ':') == 1) {
        address.host = text.substr(0, text.find(':'));
        port = text.substr(text.find(':') + 1);
        if (port.empty()) throw refuse();
    } else {
        address.host = text;
    }
    const bool printable =
        std::all_of(address.host.begin(), address.host.end(), [](unsigned char c) { return c > 0x20 && c < 0x7F; });
    if (address.host.empty() || !printable) throw refuse();
    if (port.empty()) return address;
    const bool digits =
        port.size() <= 5 && std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!digits || std::stoul(port) < 1 || std::stoul(port) > 65535) throw refuse();
    address.port = static_cast<std::uint16_t>(std::stoul(port));
    return address;
}

}  // namespace qchopper

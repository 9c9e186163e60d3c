#include "devices/modbus_tcp.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <modbus.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "devices/device_error.h"
#include "segment/error.h"

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

Endpoints look_up(const std::string& host, std::uint16_t port, int flags) {
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

// A name server may be silent for much longer than we may wait: the question is left behind in its own thread.
Endpoints find(const TcpAddress& where, Deadline deadline) {
    Endpoints numeric = look_up(where.host, where.port, AI_NUMERICHOST);
    if (numeric.fault == 0) return numeric;
    auto answer = std::make_shared<std::promise<Endpoints>>();
    std::future<Endpoints> future = answer->get_future();
    std::thread([answer, where] { answer->set_value(look_up(where.host, where.port, 0)); }).detach();
    if (future.wait_until(deadline) != std::future_status::ready) return {EAI_AGAIN, {}};
    return future.get();
}

// One connection attempt; -1 with `why` filled. Not libmodbus' own: that one aborts on a descriptor of 1024 or more.
int connect_one(const Endpoint& endpoint, Deadline deadline, std::string& why) {
    const int fd = socket(endpoint.family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) {
        why = std::strerror(errno);
        return -1;
    }
    const auto fail = [&](const std::string& reason) {
        why = reason;
        close(fd);
        return -1;
    };
    if (fd >= FD_SETSIZE) return fail("this program has too many files open (1024 or more)");
    if (connect(fd, reinterpret_cast<const sockaddr*>(&endpoint.address), endpoint.length) != 0) {
        if (errno != EINPROGRESS) return fail(std::strerror(errno));
        pollfd waiting{fd, POLLOUT, 0};
        int ready = 0;
        do ready = poll(&waiting, 1, ms_until(deadline));
        while (ready < 0 && errno == EINTR);
        if (ready <= 0) return fail("no answer in time");
        int error = 0;
        socklen_t size = sizeof error;
        if (getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0) return fail(std::strerror(error));
    }
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    // libmodbus polls before it reads, and expects a blocking socket when it writes.
    if (fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) & ~O_NONBLOCK) != 0) return fail(std::strerror(errno));
    return fd;
}

// libmodbus restarts its byte time-out at every byte, so a slow peer could hold a call for minutes. This shuts the
// connection down under it when the time for the whole call is over.
class Watchdog {
 public:
    Watchdog() : thread_([this] { run(); }) {}
    ~Watchdog() {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_all();
        thread_.join();
    }
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    void guard(int fd, Deadline deadline) {
        {
            const std::lock_guard lock(mutex_);
            fd_ = fd;
            deadline_ = deadline;
            fired_ = false;
        }
        wake_.notify_all();
    }
    // True if the time was over. After this the descriptor may be closed.
    bool release() {
        const std::lock_guard lock(mutex_);
        fd_ = -1;
        return fired_;
    }

 private:
    void run() {
        std::unique_lock lock(mutex_);
        while (!ends_) {
            if (fd_ < 0) {
                wake_.wait(lock);
            } else if (Clock::now() >= deadline_) {
                shutdown(fd_, SHUT_RDWR);
                fired_ = true;
                fd_ = -1;
            } else {
                wake_.wait_until(lock, deadline_);
            }
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    int fd_ = -1;
    Deadline deadline_;
    bool fired_ = false;
    bool ends_ = false;
    std::thread thread_;
};

timeval to_timeval(double seconds) {
    const auto micro = static_cast<std::int64_t>(seconds * 1e6);
    return {static_cast<time_t>(micro / 1000000), static_cast<suseconds_t>(micro % 1000000)};
}

}  // namespace

struct ModbusTcpBus::Link {
    Link(TcpAddress where, std::uint8_t unit_id, ModbusTimings bounds)
        : address(std::move(where)), unit(unit_id), timings(bounds) {}
    ~Link() { drop(); }
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    std::string text() const { return address.host + ":" + std::to_string(address.port); }

    // Empty if connected, else why not.
    std::string open() {
        if (context != nullptr) return {};
        const Deadline deadline = after(timings.connect_s);
        const Endpoints endpoints = find(address, deadline);
        if (endpoints.fault != 0) return std::string("the name is not known (") + gai_strerror(endpoints.fault) + ")";
        std::string why = "no answer in time";
        for (const Endpoint& endpoint : endpoints.list) {
            const int fd = connect_one(endpoint, deadline, why);
            if (fd < 0) continue;
            // The address is only for libmodbus' own connect, which is never called.
            context = modbus_new_tcp("127.0.0.1", address.port);
            if (context == nullptr) {
                close(fd);
                return "out of memory";
            }
            const timeval response = to_timeval(timings.response_s);
            modbus_set_slave(context, unit);
            modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE);
            modbus_set_response_timeout(context, static_cast<std::uint32_t>(response.tv_sec),
                                        static_cast<std::uint32_t>(response.tv_usec));
            modbus_set_byte_timeout(context, 0, 500000);
            modbus_set_socket(context, fd);
            return {};
        }
        return why;
    }

    void drop() {
        if (context == nullptr) return;
        modbus_close(context);
        modbus_free(context);
        context = nullptr;
    }

    // `action` returns what libmodbus does: the count of registers, or -1 and errno.
    template <class Action>
    BusAnswer call(int wanted, Action action) {
        BusAnswer answer;
        answer.why = open();
        if (!answer.why.empty()) return answer;
        watchdog.guard(modbus_get_socket(context), after(timings.call_s));
        errno = 0;
        const int count = action(context);
        const int error = errno;
        const bool too_slow = watchdog.release();
        if (count == wanted && !too_slow) {
            answer.end = BusEnd::ok;
            return answer;
        }
        if (count < 0 && !too_slow && error >= EMBXILFUN && error <= EMBXGTAR) {
            answer.end = BusEnd::exception;
            answer.exception = error - MODBUS_ENOBASE;
            answer.why = modbus_strerror(error);
            return answer;
        }
        answer.why = too_slow     ? "the answer was not complete in time"
                     : count >= 0 ? "the answer has another length than was asked for"
                                  : modbus_strerror(error);
        drop();
        return answer;
    }

    TcpAddress address;
    std::uint8_t unit;
    ModbusTimings timings;
    modbus_t* context = nullptr;
    Watchdog watchdog;
};

ModbusTcpBus::ModbusTcpBus(TcpAddress address, std::uint8_t unit, ModbusTimings timings)
    : link_(std::make_unique<Link>(std::move(address), unit, timings)) {}
ModbusTcpBus::~ModbusTcpBus() = default;

void ModbusTcpBus::connect() {
    const std::string why = link_->open();
    if (why.empty()) return;
    throw DeviceError(DeviceFault::unreachable, "no cell at " + link_->text() + ": " + why + "; nothing was sent",
                      "Is the cell switched on, and is this its address?");
}

BusAnswer ModbusTcpBus::read_input(std::uint16_t address, std::uint16_t count) {
    Words words(MODBUS_MAX_READ_REGISTERS);  // of full size: libmodbus has written past short ones
    if (count == 0 || count > words.size()) return {BusEnd::exception, 3, {}, "wrong count"};
    BusAnswer answer = link_->call(
        count, [&](modbus_t* context) { return modbus_read_input_registers(context, address, count, words.data()); });
    if (answer.is_ok()) answer.words.assign(words.begin(), words.begin() + count);
    return answer;
}

BusAnswer ModbusTcpBus::read_holding(std::uint16_t address, std::uint16_t count) {
    Words words(MODBUS_MAX_READ_REGISTERS);
    if (count == 0 || count > words.size()) return {BusEnd::exception, 3, {}, "wrong count"};
    BusAnswer answer = link_->call(
        count, [&](modbus_t* context) { return modbus_read_registers(context, address, count, words.data()); });
    if (answer.is_ok()) answer.words.assign(words.begin(), words.begin() + count);
    return answer;
}

BusAnswer ModbusTcpBus::write_holding(std::uint16_t address, std::span<const std::uint16_t> words) {
    if (words.empty() || words.size() > MODBUS_MAX_WRITE_REGISTERS) return {BusEnd::exception, 3, {}, "wrong count"};
    const int count = static_cast<int>(words.size());
    return link_->call(
        count, [&](modbus_t* context) { return modbus_write_registers(context, address, count, words.data()); });
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

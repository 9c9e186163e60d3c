#include "tests/sim/cell/cell_rig.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <ifaddrs.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "base/files/file.h"

namespace qchopper::rig {
Job make_job(std::size_t bytes, std::uint32_t seconds) {
    Job job;
    Bytes& content = job.file;
    std::uint32_t x = 12345;
    for (std::size_t i = 0; i < bytes; ++i)
        content.push_back(static_cast<std::uint8_t>((x = x * 1664525 + 1013904223) >> 24));
    TicketTemplate& about = job.ticket.about;
    about.piece = "piece 1";
    about.piece_no = 1;
    about.piece_count = 4;
    about.project_id.fill(7);
    about.box = {{-100, -50, 0}, {100, 50, 80.25}};
    about.stock = {220, 120, 100};
    about.material = Material::pu_foam;
    about.tool_no = 3;
    about.tool_diameter = 12;
    about.spindle_max_rpm = 18000;
    about.feed_max_mm_per_min = 6000;
    about.estimated_time_s = seconds;
    job.ticket.file_name = "piece-1.qjob";
    job.ticket.file_size = static_cast<std::uint32_t>(bytes);
    job.ticket.file_sha256 = sha256(content);
    return job;
}

CellSimOptions quick_cell(const std::filesystem::path& drop) {
    CellSimOptions options;
    options.drop_folder = drop;
    options.limits.speed = 100;
    options.limits.acting_ms = 20;
    return options;
}

DispatchOptions quick_dispatch(const std::filesystem::path& drop) {
    DispatchOptions options;
    options.drop_folder = drop;
    options.again = true;  // many tests carve one file twice
    options.timings.poll_s = 0.01;
    return options;
}

std::unique_ptr<ModbusTcpBus> connect(const CellSim& cell) {
    return std::make_unique<ModbusTcpBus>(TcpAddress{"127.0.0.1", cell.port()});
}

std::string own_address() {
    ifaddrs* all = nullptr;
    if (getifaddrs(&all) != 0) return {};
    const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> guard(all, &freeifaddrs);
    for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
        if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
        char text[INET_ADDRSTRLEN] = "";
        inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr, text, sizeof text);
        if (!std::string(text).starts_with("127.")) return text;
    }
    return {};
}

RawSocket::RawSocket(std::uint16_t port, const std::string& host, const std::string& from)
    : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    if (!from.empty()) {
        address.sin_family = AF_INET;
        inet_pton(AF_INET, from.c_str(), &address.sin_addr);
        if (bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("no such address here");
    }
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    inet_pton(AF_INET, host.c_str(), &address.sin_addr);
    if (::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("no connection");
}
RawSocket::~RawSocket() {
    close(fd_);
}

void RawSocket::send(const Bytes& bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t sent = ::send(fd_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (sent <= 0) return;
        done += static_cast<std::size_t>(sent);
    }
}

Bytes RawSocket::receive(std::size_t count, double seconds) const {
    Bytes bytes;
    while (bytes.size() < count) {
        pollfd waiting{fd_, POLLIN, 0};
        if (poll(&waiting, 1, static_cast<int>(1000 * seconds)) <= 0) break;
        std::uint8_t buffer[2048];
        const ssize_t got = recv(fd_, buffer, std::min(sizeof buffer, count - bytes.size()), 0);
        if (got <= 0) break;
        bytes.insert(bytes.end(), buffer, buffer + got);
    }
    return bytes;
}

bool RawSocket::is_closed_within(double seconds) const {
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < until) {
        pollfd waiting{fd_, POLLIN, 0};
        if (poll(&waiting, 1, 20) <= 0) continue;
        std::uint8_t buffer[2048];
        if (recv(fd_, buffer, sizeof buffer, 0) <= 0) return true;
    }
    return false;
}

Bytes frame(std::uint16_t transaction, const Bytes& pdu, std::uint8_t unit) {
    const std::size_t length = pdu.size() + 1;
    Bytes bytes;
    bytes.reserve(6 + length);
    for (const std::size_t value : {std::size_t{transaction}, std::size_t{0}, length}) {
        bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
        bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
    }
    bytes.push_back(unit);
    for (const std::uint8_t byte : pdu) bytes.push_back(byte);
    return bytes;
}

Bytes read_request(std::uint8_t function, std::uint16_t address, std::uint16_t count) {
    return {function, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address & 0xFF),
            static_cast<std::uint8_t>(count >> 8), static_cast<std::uint8_t>(count & 0xFF)};
}

Bytes write_request(std::uint16_t address, const Registers& registers) {
    Bytes pdu = read_request(16, address, static_cast<std::uint16_t>(registers.size()));
    pdu.push_back(static_cast<std::uint8_t>(2 * registers.size()));
    for (const std::uint16_t value : registers) {
        pdu.push_back(static_cast<std::uint8_t>(value >> 8));
        pdu.push_back(static_cast<std::uint8_t>(value & 0xFF));
    }
    return pdu;
}

}  // namespace qchopper::rig

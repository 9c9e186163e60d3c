// Non-blocking POSIX sockets. O(bytes).

#include "sim/cell/link/modbus_connection.h"

#include <errno.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

namespace qchopper {
namespace {

constexpr std::size_t frame_bytes = 260;
constexpr std::size_t output_bytes = 4 * frame_bytes;

}  // namespace

ModbusConnection::ModbusConnection(int socket, std::string address, std::uint64_t running_number, LinkTime now)
    : fd(socket),
      peer(std::move(address)),
      number(running_number),
      last_byte(now),
      frame_began(now),
      output_moved(now) {}

ModbusConnection::~ModbusConnection() {
    close(fd);
}

bool ModbusConnection::is_full() const {
    std::size_t waiting = output_.size();
    for (const Held& part : held_) waiting += part.bytes.size();
    return ends_ || waiting + frame_bytes > output_bytes;
}

bool ModbusConnection::waits_for_turn() const {
    return stream.has_frame() && !is_full();
}

bool ModbusConnection::is_done() const {
    if (!output_.empty()) return false;
    return ends_ || (has_ended_ && held_.empty() && !stream.has_frame());
}

bool ModbusConnection::receive(LinkTime now) {
    std::uint8_t buffer[ModbusStream::input_bytes];
    const std::size_t space = stream.space();
    if (space == 0 || is_full() || has_ended_) return true;
    const ssize_t got = recv(fd, buffer, space, MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    has_ended_ = got == 0;
    if (has_ended_) return true;
    if (stream.is_empty()) frame_began = now;
    last_byte = now;
    stream.add({buffer, static_cast<std::size_t>(got)});
    return true;
}

bool ModbusConnection::flush(LinkTime now) {
    if (output_.empty()) return true;
    const ssize_t sent = send(fd, output_.data(), output_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) return errno == EAGAIN || errno == EINTR;
    if (is_full()) frame_began = now;  // the time without reading does not count
    output_.erase(output_.begin(), output_.begin() + sent);
    output_moved = now;
    return true;
}

bool ModbusConnection::send_due(LinkTime now) {
    const bool was_held = !held_.empty();
    move_due(now);
    return !was_held || flush(now);
}

void ModbusConnection::hold(std::vector<Delivery> parts, LinkTime now) {
    LinkTime due = now;
    if (!held_.empty()) due = std::max(due, held_.back().due);
    for (Delivery& part : parts) {
        due += std::chrono::milliseconds(part.after_ms);
        held_.push_back({due, std::move(part.bytes), part.then_close});
    }
    move_due(now);
}

void ModbusConnection::move_due(LinkTime now) {
    while (!held_.empty() && held_.front().due <= now) {
        const Held& part = held_.front();
        if (output_.empty()) output_moved = now;
        output_.insert(output_.end(), part.bytes.begin(), part.bytes.end());
        ends_ = ends_ || part.then_close;
        held_.pop_front();
    }
}

}  // namespace qchopper

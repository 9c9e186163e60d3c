// Framing and its limits follow Modbus Messaging on TCP/IP Implementation Guide V1.0b (2006). O(bytes).

#include "sim/cell/link/modbus_stream.h"

#include <algorithm>
#include <cassert>

namespace qchopper {
namespace {

constexpr std::size_t head_bytes = 7;   // transaction, protocol, length, unit
constexpr std::size_t before_unit = 6;  // bytes that the length does not count
constexpr std::size_t min_length = 2;   // of unit and PDU
constexpr std::size_t max_length = 254;

}  // namespace

void ModbusStream::add(std::span<const std::uint8_t> bytes) {
    assert(bytes.size() <= space());
    input_.insert(input_.end(), bytes.begin(), bytes.end());
}

bool ModbusStream::is_modbus() const {
    if (input_.size() < head_bytes) return true;
    return input_[2] == 0 && input_[3] == 0 && length() >= min_length && length() <= max_length;
}

bool ModbusStream::has_frame() const {
    return input_.size() >= head_bytes && is_modbus() && input_.size() >= before_unit + length();
}

std::span<const std::uint8_t> ModbusStream::pdu() const {
    assert(has_frame());
    return std::span(input_).subspan(head_bytes, length() - 1);
}

Bytes ModbusStream::answer(const Bytes& pdu) const {
    assert(has_frame());
    const std::size_t out_length = pdu.size() + 1;
    Bytes out(head_bytes + pdu.size(), 0);
    out[0] = input_[0];
    out[1] = input_[1];
    out[4] = static_cast<std::uint8_t>(out_length >> 8U);
    out[5] = static_cast<std::uint8_t>(out_length & 0xFFU);
    out[6] = input_[6];
    std::copy(pdu.begin(), pdu.end(), out.begin() + head_bytes);
    return out;
}

void ModbusStream::pop() {
    assert(has_frame());
    input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(before_unit + length()));
}

}  // namespace qchopper

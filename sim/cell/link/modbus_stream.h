// Cuts the bytes of one client into the frames of Modbus TCP, without a socket.
//
// A frame is MBAP header (transaction, protocol id 0, length 2..254, unit) and PDU. Memory: input_bytes at most.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/files/file.h"

namespace qchopper {

class ModbusStream {
 public:
    static constexpr std::size_t input_bytes = 520;  // two frames of the largest kind

    std::size_t space() const { return input_bytes - input_.size(); }
    bool is_empty() const { return input_.empty(); }
    // Precondition: bytes.size() <= space().
    void add(std::span<const std::uint8_t> bytes);

    // False: the next header is none of Modbus TCP, and what follows cannot be cut into frames. True while it is not
    // complete.
    bool is_modbus() const;
    bool has_frame() const;  // a whole one

    // Of the first frame. Precondition of each: has_frame().
    std::uint8_t unit() const { return input_[6]; }
    std::span<const std::uint8_t> pdu() const;  // 1 to 253 bytes; valid until the stream is changed
    Bytes answer(const Bytes& pdu) const;       // with the transaction and the unit of the frame
    void pop();

 private:
    std::size_t length() const { return (std::size_t{input_[4]} << 8U) | input_[5]; }

    Bytes input_;
};

}  // namespace qchopper

// Frames after the Modbus Application Protocol Specification V1.1b3 (2012): the PDUs of functions 3, 4 and 16 and the
// exceptions; and after Modbus Messaging on TCP/IP Implementation Guide V1.0b (2006): the MBAP header. O(bytes).

#include "devices/wire/modbus_frame.h"

#include <cassert>
#include <iterator>

namespace qchopper {
namespace {

constexpr std::size_t header_bytes = 7;  // MBAP: transaction, protocol, length, unit
[[maybe_unused]] constexpr std::size_t largest_frame = 260;
constexpr std::uint8_t exception_mark = 0x80;

void put_u16(Bytes& bytes, unsigned value) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
}

unsigned u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<unsigned>(bytes[at]) << 8U | bytes[at + 1];
}

bool is_write(const ModbusRequest& request) {
    return request.function == ModbusFunction::write_holding;
}

// The length field of the header; it counts the unit as well.
unsigned length_of_answer(const ModbusRequest& request) {
    return is_write(request) ? 6U : 3U + 2U * request.count;
}
constexpr unsigned length_of_exception = 3;

const char* exception_text(unsigned code) {
    constexpr const char* texts[] = {"no such function is served",
                                     "no such registers, or not all of a block",
                                     "a wrong count or length",
                                     "a failure inside the cell",
                                     "accepted, it takes time",
                                     "the cell is busy",
                                     "not done",
                                     "a fault of its memory",
                                     "an undefined fault",
                                     "the gateway has no path to the cell",
                                     "the cell does not answer the gateway"};  // from exception 1 on
    return code >= 1 && code <= std::size(texts) ? texts[code - 1] : nullptr;
}

std::string difference(const char* what, unsigned is, unsigned wanted) {
    return std::string("an answer with the wrong ") + what + " (" + std::to_string(is) + " for " +
           std::to_string(wanted) + ")";
}

// A field of the answer whose value the request determines.
struct FixedField {
    std::size_t at;    // first byte in the frame
    std::size_t size;  // bytes, 1 or 2
    unsigned value;
    const char* what;
};

// "" if all fields that are in `bytes` already have their values.
std::string first_difference(std::span<const std::uint8_t> bytes, std::span<const FixedField> fields) {
    for (const FixedField& field : fields) {
        if (bytes.size() < field.at + field.size) return {};
        const unsigned is = field.size == 1 ? bytes[field.at] : u16_at(bytes, field.at);
        if (is != field.value) return difference(field.what, is, field.value);
    }
    return {};
}

std::string check_header(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    const FixedField first[] = {{0, 2, request.transaction, "transaction"}, {2, 2, 0, "protocol"}};
    std::string wrong = first_difference(bytes, first);
    if (!wrong.empty() || bytes.size() < 6) return wrong;
    const unsigned length = u16_at(bytes, 4);
    if (length != length_of_answer(request) && length != length_of_exception) {
        return difference("length", length, length_of_answer(request));
    }
    const FixedField unit[] = {{6, 1, request.unit, "unit"}};
    return first_difference(bytes, unit);
}

std::string check_exception(std::span<const std::uint8_t> bytes) {
    if (const unsigned length = u16_at(bytes, 4); length != length_of_exception) {
        return difference("length", length, length_of_exception);
    }
    if (bytes.size() <= header_bytes + 1 || exception_text(bytes[header_bytes + 1]) != nullptr) return {};
    return "an answer with exception " + std::to_string(bytes[header_bytes + 1]) + ", which does not exist";
}

std::string check_body(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    const unsigned length = length_of_answer(request);
    const FixedField common[] = {{7, 1, static_cast<unsigned>(request.function), "function"}, {4, 2, length, "length"}};
    std::string wrong = first_difference(bytes, common);
    if (!wrong.empty()) return wrong;
    if (is_write(request)) {
        const FixedField echo[] = {{8, 2, request.address, "address"}, {10, 2, request.count, "count"}};
        return first_difference(bytes, echo);
    }
    const FixedField count[] = {{8, 1, 2U * request.count, "number of bytes"}};
    return first_difference(bytes, count);
}

bool is_exception(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    return bytes[header_bytes] == (static_cast<std::uint8_t>(request.function) | exception_mark);
}

}  // namespace

Bytes frame_of(const ModbusRequest& request) {
    assert(request.count >= 1 && request.count <= (is_write(request) ? max_written_registers : max_read_registers));
    assert(is_write(request) ? request.registers.size() == request.count : request.registers.empty());
    Bytes bytes;
    put_u16(bytes, request.transaction);
    put_u16(bytes, 0);
    put_u16(bytes, is_write(request) ? 7U + 2U * request.count : 6U);
    bytes.push_back(request.unit);
    bytes.push_back(static_cast<std::uint8_t>(request.function));
    put_u16(bytes, request.address);
    put_u16(bytes, request.count);
    if (is_write(request)) bytes.push_back(static_cast<std::uint8_t>(2 * request.count));
    for (const std::uint16_t value : request.registers) put_u16(bytes, value);
    assert(bytes.size() <= largest_frame);
    return bytes;
}

AnswerSoFar check_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    AnswerSoFar so_far{header_bytes + 1, check_header(request, bytes)};
    if (!so_far.wrong.empty() || bytes.size() <= header_bytes) return so_far;
    const bool refused = is_exception(request, bytes);
    so_far.wanted = header_bytes - 1 + (refused ? length_of_exception : length_of_answer(request));
    so_far.wrong = refused ? check_exception(bytes) : check_body(request, bytes);
    assert(so_far.wanted <= largest_frame);
    return so_far;
}

BusAnswer decode_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    assert(check_answer(request, bytes).wrong.empty() && check_answer(request, bytes).wanted == bytes.size());
    BusAnswer answer;
    if (is_exception(request, bytes)) {
        answer.end = BusEnd::exception;
        answer.exception = bytes[header_bytes + 1];
        answer.why = exception_text(bytes[header_bytes + 1]);
        return answer;
    }
    answer.end = BusEnd::ok;
    if (is_write(request)) return answer;
    for (std::size_t at = header_bytes + 2; at < bytes.size(); at += 2) {
        answer.registers.push_back(static_cast<std::uint16_t>(u16_at(bytes, at)));
    }
    assert(answer.registers.size() == request.count);
    return answer;
}

}  // namespace qchopper

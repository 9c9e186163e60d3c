#include "devices/modbus_frame.h"

#include <cassert>
#include <iterator>

namespace qchopper {
namespace {

constexpr std::size_t header_bytes = 7;  // transaction, protocol, length, unit
[[maybe_unused]] constexpr std::size_t largest_frame = 260;
constexpr std::uint8_t exception_mark = 0x80;

void put(Bytes& bytes, unsigned word) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

unsigned word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<unsigned>(bytes[at]) << 8U | bytes[at + 1];
}

bool is_write(const ModbusRequest& request) {
    return request.function == ModbusFunction::write_holding;
}

// The length of the header counts the unit too.
unsigned length_of_answer(const ModbusRequest& request) {
    return is_write(request) ? 6U : 3U + 2U * request.count;
}
constexpr unsigned length_of_exception = 3;

const char* words_of_exception(unsigned code) {
    constexpr const char* registers[] = {"no such function is served",
                                         "no such registers, or not all of a block",
                                         "a wrong count or length",
                                         "a failure inside the cell",
                                         "accepted, it takes time",
                                         "the cell is busy",
                                         "not done",
                                         "a fault of its memory",
                                         "an undefined fault",
                                         "the gateway has no way to the cell",
                                         "the cell does not answer to the gateway"};
    return code >= 1 && code <= std::size(registers) ? registers[code - 1] : nullptr;
}

std::string differs(const char* what, unsigned is, unsigned wanted) {
    return std::string("an answer with the wrong ") + what + " (" + std::to_string(is) + " for " +
           std::to_string(wanted) + ")";
}

// A field that has to be what the request says, once it has come.
struct Wanted {
    std::size_t at;
    std::size_t size;
    unsigned value;
    const char* what;
};

std::string first_difference(std::span<const std::uint8_t> bytes, std::span<const Wanted> fields) {
    for (const Wanted& field : fields) {
        if (bytes.size() < field.at + field.size) return {};
        const unsigned is = field.size == 1 ? bytes[field.at] : word_at(bytes, field.at);
        if (is != field.value) return differs(field.what, is, field.value);
    }
    return {};
}

std::string check_header(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    const Wanted first[] = {{0, 2, request.transaction, "transaction"}, {2, 2, 0, "protocol"}};
    std::string wrong = first_difference(bytes, first);
    if (!wrong.empty() || bytes.size() < 6) return wrong;
    const unsigned length = word_at(bytes, 4);
    if (length != length_of_answer(request) && length != length_of_exception) {
        return differs("length", length, length_of_answer(request));
    }
    const Wanted unit[] = {{6, 1, request.unit, "unit"}};
    return first_difference(bytes, unit);
}

std::string check_exception(std::span<const std::uint8_t> bytes) {
    if (const unsigned length = word_at(bytes, 4); length != length_of_exception) {
        return differs("length", length, length_of_exception);
    }
    if (bytes.size() <= header_bytes + 1 || words_of_exception(bytes[header_bytes + 1]) != nullptr) return {};
    return "an answer with exception " + std::to_string(bytes[header_bytes + 1]) + ", which does not exist";
}

std::string check_body(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    const unsigned length = length_of_answer(request);
    const Wanted common[] = {{7, 1, static_cast<unsigned>(request.function), "function"}, {4, 2, length, "length"}};
    std::string wrong = first_difference(bytes, common);
    if (!wrong.empty()) return wrong;
    if (is_write(request)) {
        const Wanted echo[] = {{8, 2, request.address, "address"}, {10, 2, request.count, "count"}};
        return first_difference(bytes, echo);
    }
    const Wanted count[] = {{8, 1, 2U * request.count, "number of bytes"}};
    return first_difference(bytes, count);
}

bool is_exception(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    return bytes[header_bytes] == (static_cast<std::uint8_t>(request.function) | exception_mark);
}

}  // namespace

Bytes frame_of(const ModbusRequest& request) {
    assert(request.count >= 1 && request.count <= (is_write(request) ? most_written_registers : most_read_registers));
    assert(is_write(request) ? request.registers.size() == request.count : request.registers.empty());
    Bytes bytes;
    put(bytes, request.transaction);
    put(bytes, 0);
    put(bytes, is_write(request) ? 7U + 2U * request.count : 6U);
    bytes.push_back(request.unit);
    bytes.push_back(static_cast<std::uint8_t>(request.function));
    put(bytes, request.address);
    put(bytes, request.count);
    if (is_write(request)) bytes.push_back(static_cast<std::uint8_t>(2 * request.count));
    for (const std::uint16_t word : request.registers) put(bytes, word);
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

BusAnswer take_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes) {
    assert(check_answer(request, bytes).wrong.empty() && check_answer(request, bytes).wanted == bytes.size());
    BusAnswer answer;
    if (is_exception(request, bytes)) {
        answer.end = BusEnd::exception;
        answer.exception = bytes[header_bytes + 1];
        answer.why = words_of_exception(bytes[header_bytes + 1]);
        return answer;
    }
    answer.end = BusEnd::ok;
    if (is_write(request)) return answer;
    for (std::size_t at = header_bytes + 2; at < bytes.size(); at += 2) {
        answer.registers.push_back(static_cast<std::uint16_t>(word_at(bytes, at)));
    }
    assert(answer.registers.size() == request.count);
    return answer;
}

}  // namespace qchopper

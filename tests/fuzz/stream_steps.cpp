// The framing of sim/cell/link/modbus_stream.h and the handler of modbus_pdu.h, as the server joins them. O(bytes).

#include "tests/fuzz/stream_steps.h"

#include <algorithm>

#include "sim/cell/link/modbus_stream.h"
#include "sim/cell/modbus_pdu.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

struct Streamed {
    Bytes answers;
    std::size_t requests = 0;
    bool is_modbus = true;
    bool operator==(const Streamed&) const = default;
};

void answer_first(ModbusStream& stream, CellState& cell, const CellHooks& hooks, Streamed& end) {
    const auto pdu = stream.pdu();
    demand(!pdu.empty() && pdu.size() <= 253);
    const Bytes answer = answer_pdu(stream.unit(), pdu, cell, {1000000, 1700000000000}, hooks);
    demand(answer.size() >= 2 && answer.size() <= 253);
    const Bytes frame = stream.answer(answer);
    demand(frame.size() == answer.size() + 7);
    end.answers.insert(end.answers.end(), frame.begin(), frame.end());
    ++end.requests;
    stream.pop();
}

Streamed stream_of(std::span<const std::uint8_t> bytes, const std::function<std::size_t()>& piece) {
    CellHooks hooks;
    hooks.save = [](const CellMemory&) { return true; };
    CellState cell = boot({}, {}, 42, {1000000, 1700000000000}, hooks);
    cell.store_free_kib = 1000000;
    ModbusStream stream;
    Streamed end;
    while (!bytes.empty() && end.is_modbus) {
        demand(stream.space() > 0);
        const std::size_t count = std::min({piece(), stream.space(), bytes.size()});
        stream.add(bytes.first(count));
        bytes = bytes.subspan(count);
        while (stream.has_frame()) answer_first(stream, cell, hooks, end);
        end.is_modbus = stream.is_modbus();
    }
    return end;
}

}  // namespace

std::size_t check_stream(std::span<const std::uint8_t> bytes, const std::function<std::size_t()>& piece) {
    const Streamed whole = stream_of(bytes, [] { return ModbusStream::input_bytes; });
    const Streamed pieces = stream_of(bytes, piece);
    demand(whole == pieces);
    return whole.requests;
}

}  // namespace qchopper

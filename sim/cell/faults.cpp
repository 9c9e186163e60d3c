// Armed faults are searched linearly; chances come from SplitMix64. O(bytes of the answer).

#include "sim/cell/faults.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "sim/cell/random.h"

namespace qchopper {
namespace {

constexpr NamedFault fault_rows[] = {
    {Fault::close_before_effect, "close-before-effect", "", 0, "the connection closes, the request was not handled"},
    {Fault::close_before_answer, "close-before-answer", "", 0,
     "the request took effect, the connection closes instead of an answer"},
    {Fault::no_answer, "no-answer", "", 0, "the request takes effect, nothing is answered"},
    {Fault::answer_late, "answer-late", "ms", 1500, "the answer comes so much later"},
    {Fault::answer_bytewise, "answer-bytewise", "ms", 100, "the answer comes byte by byte, so far apart"},
    {Fault::answer_truncated, "answer-truncated", "bytes", 6, "only the first bytes of the answer come"},
    {Fault::wrong_transaction, "wrong-transaction", "", 0, "the answer has another transaction id"},
    {Fault::wrong_protocol, "wrong-protocol", "", 0, "the answer has another protocol id"},
    {Fault::wrong_unit, "wrong-unit", "", 0, "the answer has another unit id"},
    {Fault::wrong_length, "wrong-length", "bytes", 1, "the length in the header of the answer is larger by so much"},
    {Fault::wrong_function, "wrong-function", "", 0, "the answer has another function"},
    {Fault::wrong_echo, "wrong-echo", "", 0, "the answer has another byte count or another address"},
    {Fault::exception, "exception", "code", 6, "the request is not handled, the exception is answered"},
    {Fault::flip_status, "flip-status", "bit", -1, "one bit of STATUS is wrong; below 0: a random one"},
    {Fault::torn_status, "torn-status", "", 0, "STATUS is of two snapshots"},
    {Fault::swap_words, "swap-words", "", 0, "the registers of each pair are swapped, as by a gateway"},
    {Fault::flip_written, "flip-written", "bit", -1, "one bit of what was written is wrong; below 0: a random one"},
    {Fault::zero_holding, "zero-holding", "", 0, "zeros come to all holding registers after the request"},
    {Fault::frozen_heartbeat, "frozen-heartbeat", "", 0, "CELL_HB stands still"},
    {Fault::heartbeat_at, "heartbeat-at", "number", 65530, "CELL_HB is that number now"},
    {Fault::power_cut, "power-cut", "event", 1, "power is cut at the so manyth event from now; what was saved stays"},
    {Fault::power_cut_store_lost, "power-cut-store-lost", "event", 1, "the same, and the store is empty afterwards"},
    {Fault::power_cut_store_back, "power-cut-store-back", "event", 1,
     "the same, and an older copy of the store is back"},
    {Fault::power_cut_all_back, "power-cut-all-back", "event", 1,
     "the same, and an older copy of all that the cell remembers is back"},
    {Fault::disk_full, "disk-full", "", 0, "a write of the cell's memory fails"},
    {Fault::store_full, "store-full", "", 0, "there is no room for a job file"},
    {Fault::no_consent, "no-consent", "", 0, "a question is answered no"},
    {Fault::door_after_consent, "door-after-consent", "", 0, "the door is opened as soon as consent was given"},
    {Fault::tool_fault, "tool-fault", "block", 10, "the tool breaks at this program block"},
    {Fault::e_stop_at, "e-stop-at", "block", 10, "the emergency stop is pressed at this program block"},
    {Fault::spindle_loses_speed, "spindle-loses-speed", "block", 10,
     "the spindle loses its speed at this program block"},
    {Fault::signal_falls, "signal-falls", "input", 0,
     "the program finds this input missing where it waits for it; 0: whichever comes first"},
    {Fault::clock_jump, "clock-jump", "s", 86400, "the time of day jumps by so much"},
};
static_assert(std::size(fault_rows) == static_cast<std::size_t>(Fault::count));

// A place in 0..end - 1: `number`, or a random one if it is below 0. Precondition: end > 0.
std::size_t place(Faults& faults, std::int64_t number, std::size_t end) {
    const std::uint64_t at = number < 0 ? next_random(faults.random) : static_cast<std::uint64_t>(number);
    return static_cast<std::size_t>(at % end);
}

void flip(std::vector<std::uint16_t>& registers, std::size_t bit) {
    registers[bit / 16] = static_cast<std::uint16_t>(registers[bit / 16] ^ 1U << bit % 16);
}

// Changes one byte of the frame if the fault is drawn.
void change(Faults& faults, Fault which, Bytes& frame, std::size_t at, std::uint8_t by) {
    if (take(faults, which) && at < frame.size()) frame[at] = static_cast<std::uint8_t>(frame[at] + by);
}

std::vector<Delivery> bytewise(const Bytes& frame, std::int64_t apart_ms) {
    std::vector<Delivery> parts;
    parts.reserve(frame.size());
    for (const std::uint8_t byte : frame) parts.push_back({apart_ms, {byte}, false});
    return parts;
}

}  // namespace

std::span<const NamedFault> all_faults() {
    return fault_rows;
}

const NamedFault* fault_named(std::string_view name) {
    const auto* const found = std::ranges::find(fault_rows, name, &NamedFault::name);
    return found == std::end(fault_rows) ? nullptr : found;
}

std::optional<std::int64_t> armed(const Faults& faults, Fault which) {
    const auto found = std::ranges::find(faults.armed, which, &ArmedFault::fault);
    return found == faults.armed.end() ? std::nullopt : std::optional(found->number);
}

std::optional<std::int64_t> take(Faults& faults, Fault which) {
    const auto one = std::ranges::find(faults.armed, which, &ArmedFault::fault);
    if (one == faults.armed.end()) return std::nullopt;
    if (one->per_thousand < 1000 && next_random(faults.random) % 1000 >= one->per_thousand) return std::nullopt;
    const std::int64_t number = one->number;
    if (one->times != 0 && --one->times == 0) faults.armed.erase(one);
    return number;
}

void spoil_read(Faults& faults, const Block& block, std::vector<std::uint16_t>& registers) {
    if (&block == &status_block) {
        if (const auto bit = take(faults, Fault::flip_status)) {
            flip(registers, place(faults, *bit, 16 * registers.size()));
        }
        if (take(faults, Fault::torn_status)) ++registers.back();  // SNAP_END of the next snapshot
    }
    if (!take(faults, Fault::swap_words)) return;
    for (std::size_t i = 0; i + 1 < registers.size(); i += 2) std::swap(registers[i], registers[i + 1]);
}

void spoil_written(Faults& faults, std::vector<std::uint16_t>& registers) {
    if (const auto bit = take(faults, Fault::flip_written)) flip(registers, place(faults, *bit, 16 * registers.size()));
}

// Bytes 0 and 1 of the frame are the transaction, 2 and 3 the protocol, 4 and 5 the length, 6 the unit, 7 the function,
// 8 the byte count or the high byte of the address.
std::vector<Delivery> deliver(Faults& faults, Bytes frame) {
    change(faults, Fault::wrong_transaction, frame, 1, 1);
    change(faults, Fault::wrong_protocol, frame, 3, 1);
    change(faults, Fault::wrong_unit, frame, 6, 7);
    change(faults, Fault::wrong_function, frame, 7, 1);
    change(faults, Fault::wrong_echo, frame, 8, 2);
    if (const auto more = take(faults, Fault::wrong_length)) frame[5] = static_cast<std::uint8_t>(frame[5] + *more);
    if (take(faults, Fault::close_before_answer)) return {{0, {}, true}};
    if (take(faults, Fault::no_answer)) return {};
    if (const auto kept = take(faults, Fault::answer_truncated)) {
        frame.resize(std::min(frame.size(), static_cast<std::size_t>(std::max<std::int64_t>(0, *kept))));
    }
    if (const auto apart_ms = take(faults, Fault::answer_bytewise)) return bytewise(frame, *apart_ms);
    const auto late_ms = take(faults, Fault::answer_late);
    return {{late_ms.value_or(0), std::move(frame), false}};
}

}  // namespace qchopper

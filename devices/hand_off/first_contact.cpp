// Tries with growing pauses: 0.25, 0.5, then 1 s, for 2 s.

#include "devices/hand_off/first_contact.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include "devices/wire/registers.h"

namespace qchopper {
namespace {

constexpr double patience_s = 2;
constexpr double pauses_s[] = {0.25, 0.5, 1};

// A server that does not have these registers. The exceptions from 4 on mean that something behind it has failed.
bool lacks_registers(const HandOffInput& failed) {
    return failed.end == BusEnd::exception && failed.exception <= 3;
}

template <class T>
HandOffInput read(RegisterBus& bus, const Block& block, std::optional<T> HandOffInput::*member) {
    HandOffInput input;
    for (int tries = 0; tries < 3; ++tries) {
        const BusAnswer answer = bus.read_input(block.base, block.count);
        input = input_from(answer);
        if (!answer.is_ok()) return input;
        const auto decoded = decode<T>(answer.registers);
        if (decoded.is_ok()) {
            input.*member = decoded.value;
            return input;
        }
        input.fault = decoded.fault;
    }
    input.end = BusEnd::lost;
    input.why = std::string(block.name) + " is " + describe(input.fault);
    return input;
}

}  // namespace

bool is_busy(const HandOffInput& failed) {
    return failed.end == BusEnd::exception && (failed.exception == 5 || failed.exception == 6);
}

HandOffInput input_from(const BusAnswer& answer) {
    HandOffInput input;
    input.end = answer.end;
    input.exception = answer.exception;
    input.is_alien = answer.is_alien;
    input.why = answer.why;
    return input;
}

HandOffInput read_status_block(RegisterBus& bus) {
    return read(bus, status_block, &HandOffInput::status);
}

HandOffInput read_result_block(RegisterBus& bus) {
    return read(bus, result_block, &HandOffInput::result);
}

HandOffInput read_identity_block(RegisterBus& bus) {
    return read(bus, identity_block, &HandOffInput::identity);
}

std::optional<double> pause_before_next_contact(const HandOffInput& failed, int tries, double since_s) {
    // A block with a wrong MAGIC or VERSION may have been damaged on the way, as one with a wrong checksum.
    if (lacks_registers(failed)) return std::nullopt;
    const double pause_s = pauses_s[std::min<std::size_t>(static_cast<std::size_t>(tries), std::size(pauses_s) - 1)];
    if (since_s + pause_s > patience_s) return std::nullopt;
    return pause_s;
}

ContactFailure contact_failure(const HandOffInput& failed) {
    if (failed.fault == BlockFault::version) {
        return {DeviceFault::protocol, "the cell does not follow register map 1.1: its STATUS is of another version",
                "Bring its controller program to register map 1.1 (docs/developer/formats/registers.md); check address "
                "and port."};
    }
    if (failed.fault != BlockFault::none) {
        return {DeviceFault::protocol,
                "what answers is not a QChopper cell: its STATUS is " + std::string(describe(failed.fault)),
                "Check address and port; a gateway in between may swap registers."};
    }
    if (failed.is_alien) {
        return {DeviceFault::protocol, "what answers does not follow Modbus TCP: " + failed.why,
                "Check address and port."};
    }
    const std::string exception =
        "exception " + std::to_string(failed.exception) + " (" + failed.why + ") to the request for its STATUS";
    if (lacks_registers(failed)) {
        return {DeviceFault::protocol, "what answers is not a QChopper cell: " + exception, "Check address and port."};
    }
    if (is_busy(failed)) return {DeviceFault::busy, "the cell is busy: " + exception, "Try again later."};
    if (failed.end == BusEnd::exception) {
        return {DeviceFault::unreachable, "the cell cannot be reached behind what answers: " + exception,
                "Check that the cell itself is switched on and works."};
    }
    return {DeviceFault::unreachable, "the cell does not answer: " + failed.why,
            "Check that the cell is switched on, that this is its address, and that it has a free connection."};
}

std::optional<Status> read_first_status(RegisterBus& bus, const std::string& where, const Context& context) {
    using Clock = std::chrono::steady_clock;
    const auto is_cancelled = [&] { return context.cancelled != nullptr && context.cancelled->load(); };
    const auto seconds_since = [](Clock::time_point then) {
        return std::chrono::duration<double>(Clock::now() - then).count();
    };
    struct LimitRemover {
        RegisterBus& bus;
        ~LimitRemover() { bus.leave_when(nullptr, 0); }
    } const remover{bus};
    bus.leave_when(context.cancelled, HandOffTimings{}.leave_s);
    std::optional<Clock::time_point> failed_at;
    for (int tries = 0; !is_cancelled(); ++tries) {
        const HandOffInput input = read_status_block(bus);
        if (input.status) return input.status;
        if (!failed_at) failed_at = Clock::now();
        const std::optional<double> pause_s = pause_before_next_contact(input, tries, seconds_since(*failed_at));
        if (is_cancelled()) break;
        if (!pause_s) {
            const ContactFailure failure = contact_failure(input);
            throw DeviceError(failure.fault, where + ": " + failure.why, failure.to_do);
        }
        const Clock::time_point began = Clock::now();
        while (seconds_since(began) < *pause_s && !is_cancelled()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
    return std::nullopt;
}

}  // namespace qchopper

// Reads, writes, waits, and the list of rules. O(1) for each call; send() reads STATUS each 0.1 s until it is answered.

#include "devices/link_check/link_checker.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "base/error.h"
#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/random.h"

namespace qchopper::link_check {

std::string hex(std::uint64_t number) {
    char text[24];
    std::snprintf(text, sizeof text, "0x%llX", static_cast<unsigned long long>(number));
    return text;
}

LinkChecker::LinkChecker(RegisterBus& bus, const LinkCheckOptions& options, const Context& context)
    : bus_(bus), options_(options), context_(context) {
    owner = random();
    secret = random();
}

std::uint32_t LinkChecker::random() {
    std::uint32_t number = 0;
    while (number == 0) number = options_.random ? options_.random() : random_number();
    return number;
}

Uuid LinkChecker::random_id() {
    Uuid id{};
    for (std::size_t i = 0; i < id.size(); i += 4) {
        const std::uint32_t number = random();
        for (std::size_t k = 0; k < 4; ++k) id[i + k] = static_cast<std::uint8_t>(number >> (8 * k));
    }
    return id;
}

double LinkChecker::now_s() const {
    if (options_.clock.now_s) return options_.clock.now_s();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void LinkChecker::wait(double seconds) {
    constexpr double step_s = 0.1;
    constexpr double heartbeat_period_s = 0.5;
    const double until_s = now_s() + seconds;
    while (now_s() < until_s) {
        if (context_.cancelled != nullptr && context_.cancelled->load()) throw Cancelled();
        if (keeps_lease && now_s() - heartbeat_s_ >= heartbeat_period_s) send_heartbeat();
        const double pause_s = std::min(step_s, until_s - now_s());
        if (pause_s <= 0) break;
        if (options_.clock.sleep) {
            options_.clock.sleep(pause_s);
        } else {
            std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
        }
    }
}

void LinkChecker::send_heartbeat() {
    heartbeat_s_ = now_s();
    write(heartbeat_block, encode(Heartbeat{epoch, owner, ++counter_}));
}

bool LinkChecker::expect(const Block& block, const char* field, bool holds, const std::string& rule,
                         const std::string& seen) {
    check_.rules.push_back({block.name, address_of(block, field), field, rule, holds, holds ? std::string() : seen});
    return holds;
}

bool LinkChecker::expect_number(const Block& block, const char* field, std::uint64_t seen, std::uint64_t wanted,
                                const std::string& rule) {
    return expect(block, field, seen == wanted, rule, hex(seen) + " in place of " + hex(wanted));
}

bool LinkChecker::expect_result(const Status& status, AckResult wanted, const std::string& after) {
    const bool is_ours = status.ack_owner == owner && status.ack_seq == seq;
    return expect(status_block, "ACK_RESULT", is_ours && status.ack_result == wanted,
                  std::string("is ") + name(wanted) + " after " + after,
                  is_ours ? name(status.ack_result)
                          : "no acknowledgement of it: ACK_OWNER " + hex(status.ack_owner) + ", ACK_SEQ " +
                                std::to_string(status.ack_seq));
}

bool LinkChecker::may(const std::string& question) {
    return options_.consent && options_.consent(question);
}

BusAnswer LinkChecker::read(const Block& block) {
    BusAnswer answer = bus_.read_input(block.base, block.count);
    if (answer.end == BusEnd::lost) {
        expect(block, block.fields.front().name, false, "is answered in time, and the connection stays open",
               answer.why);
        end();
    }
    return answer;
}

Status LinkChecker::status() {
    BlockFault fault = BlockFault::none;
    for (int tries = 0; tries < 3; ++tries) {
        const BusAnswer answer = read(status_block);
        if (!answer.is_ok()) {
            expect(status_block, "MAGIC", false, "is read by function 4 with the 99 registers after it",
                   "exception " + std::to_string(answer.exception));
            end();
        }
        const Decoded<Status> decoded = decode<Status>(answer.registers);
        if (decoded.is_ok()) return decoded.value;
        fault = decoded.fault;
        const auto at = [&](const char* field) { return answer.registers[address_of(status_block, field)]; };
        if (tries < 2) continue;
        if (fault == BlockFault::magic || fault == BlockFault::empty) {
            expect_number(status_block, "MAGIC", at("MAGIC"), cell_magic, "is the mark of the map");
        } else if (fault == BlockFault::version) {
            expect_number(status_block, "VERSION", at("VERSION"), map_version, "is the version of the map, or later");
        } else if (fault == BlockFault::torn) {
            expect_number(status_block, "SNAP_END", at("SNAP_END"), at("SNAP_BEGIN"), "equals SNAP_BEGIN");
        } else {
            const std::size_t place = address_of(status_block, "STATUS_CRC");
            const std::uint32_t crc = std::uint32_t{answer.registers[place]} << 16U | answer.registers[place + 1];
            expect_number(status_block, "STATUS_CRC", crc, crc32_of_registers(std::span(answer.registers).first(place)),
                          "is the CRC-32 of the registers before it");
        }
    }
    end();
}

Status LinkChecker::settled_status() {
    constexpr double shown_within_s = 0.2;
    wait(shown_within_s);
    return status();
}

void LinkChecker::write(const Block& block, const Registers& registers) {
    constexpr double busy_pause_s = 0.05;
    BusAnswer answer = bus_.write_holding(block.base, registers);
    const double began_s = now_s();
    while (is_busy(input_from(answer)) && now_s() - began_s < options_.answer_s) {
        wait(busy_pause_s);
        answer = bus_.write_holding(block.base, registers);
    }
    if (answer.is_ok()) return;
    expect(block, block.fields.front().name, false, "is taken by function 16, as a whole block",
           answer.end == BusEnd::exception ? "exception " + std::to_string(answer.exception) : answer.why);
    end();
}

void LinkChecker::expect_exception(const Block& block, const char* field, const BusAnswer& answer, int wanted,
                                   const std::string& rule) {
    const bool is_so = answer.end == BusEnd::exception && answer.exception == wanted;
    expect(block, field, is_so, rule + " is answered by exception " + std::to_string(wanted),
           answer.is_ok()                    ? "an answer without exception"
           : answer.end == BusEnd::exception ? "exception " + std::to_string(answer.exception)
                                             : answer.why);
    if (answer.end == BusEnd::lost) end();
}

void LinkChecker::check_addresses() {
    const auto beyond = static_cast<std::uint16_t>(status_block.base + status_block.count - 1);
    expect_exception(status_block, "SNAP_END", bus_.read_input(beyond, 2), 2, "a read past the end of the block");
    const BusAnswer part = bus_.write_holding(command_block.base, Registers(command_block.count - 1));
    expect_exception(command_block, "MAGIC", part, 2, "a write of a part of the block");
    const BusAnswer whole = bus_.read_holding(command_block.base, command_block.count);
    const bool is_zero = whole.is_ok() && std::ranges::all_of(whole.registers, [](auto r) { return r == 0; });
    expect(command_block, "MAGIC", is_zero, "is read as 0 by function 3, as the whole block",
           whole.is_ok()                    ? "another value"
           : whole.end == BusEnd::exception ? "exception " + std::to_string(whole.exception)
                                            : whole.why);
}

Command LinkChecker::command(CellCommand what) {
    Command next;
    next.command = what;
    next.epoch = epoch;
    next.owner = owner;
    next.seq = ++seq;
    return next;
}

void LinkChecker::write_command(const Command& command) {
    write(command_block, encode(command));
}

Status LinkChecker::send(const Command& command, double patience_s) {
    constexpr double poll_s = 0.1;
    write_command(command);
    const double began_s = now_s();
    for (;;) {
        Status now = status();
        const bool is_ours = now.ack_owner == command.owner && now.ack_seq == command.seq;
        if (is_ours && now.ack_result != AckResult::pending) return now;
        if (now_s() - began_s > patience_s) return now;
        wait(poll_s);
    }
}

}  // namespace qchopper::link_check

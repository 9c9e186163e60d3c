// What the parts of a check share: the bus, the clock, the sender's numbers, and the list of rules.

#pragma once

#include <optional>
#include <string>

#include "base/context.h"
#include "devices/link_check/checked_rules.h"
#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"
#include "devices/wire/codec.h"

namespace qchopper::link_check {

// The check cannot go on; the reason is in the list of rules, or in `not_checked`.
struct CheckEnds {};

class LinkChecker {
 public:
    LinkChecker(RegisterBus& bus, const LinkCheckOptions& options, const Context& context);

    // Notes that a register follows a rule, or what was seen instead.
    bool expect(const Block& block, const char* field, bool holds, const std::string& rule, const std::string& seen);
    bool expect_number(const Block& block, const char* field, std::uint64_t seen, std::uint64_t wanted,
                       const std::string& rule);
    // Of the last acknowledgement: its result.
    bool expect_result(const Status& status, AckResult wanted, const std::string& after);
    void leave_out(const std::string& why) { check_.not_checked.push_back(why); }
    [[noreturn]] void end() { throw CheckEnds(); }
    bool may(const std::string& question);

    // STATUS, read until it is whole, three times at most. Ends the check if it is not.
    Status status();
    // The same after the time that a cell has to show what a write without acknowledgement did.
    Status settled_status();
    BusAnswer read(const Block& block);
    // A write that must be taken; else the check ends.
    void write(const Block& block, const Registers& registers);
    // A write that must be answered by this exception.
    void expect_exception(const Block& block, const char* field, const BusAnswer& answer, int wanted,
                          const std::string& rule);

    // Reads and writes that miss the blocks.
    void check_addresses();

    // A command under the epoch of the check with its next number; and the STATUS that acknowledges it, or the last one
    // before answer_s, or consent_s, ran out.
    Command command(CellCommand what);
    Status send(const Command& command, double patience_s);
    Status send(const Command& command) { return send(command, options_.answer_s); }
    void write_command(const Command& command);
    // Seconds of the clock; with heartbeats, where they are on.
    void wait(double seconds);
    void send_heartbeat();
    double now_s() const;
    std::uint32_t random();
    Uuid random_id();

    const LinkCheckOptions& options() const { return options_; }
    LinkCheck take() { return std::move(check_); }

    std::uint32_t owner = 0;
    std::uint32_t secret = 0;
    std::uint32_t epoch = 0;
    std::uint32_t seq = 0;
    std::uint32_t grant = 0;
    bool keeps_lease = false;  // the lease is to be kept

 private:
    RegisterBus& bus_;
    const LinkCheckOptions& options_;
    const Context& context_;
    LinkCheck check_;
    double heartbeat_s_ = 0;
    std::uint16_t counter_ = 0;
};

// Each part takes up where the one before ended.
void check_reads(LinkChecker& checker);
void check_frames(LinkChecker& checker);
void check_lease(LinkChecker& checker);
void check_queries(LinkChecker& checker);
void check_job(LinkChecker& checker);  // from Idle to a cancelled job
void check_release(LinkChecker& checker);

std::string hex(std::uint64_t number);

}  // namespace qchopper::link_check

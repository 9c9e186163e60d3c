// The parts of the check that leave machine and jobs alone: reading, frames, lease, queries. O(1) requests; about 20 s
// of the clock, to see a lease live and end.

#include <optional>

#include "devices/link_check/link_checker.h"
#include "devices/wire/device_error.h"

namespace qchopper::link_check {
namespace {

constexpr std::uint16_t no_command = 999;

// The block with its checksum made right again.
Registers sealed(Registers block) {
    const std::uint32_t crc = crc32_of_registers(std::span(block).first(block.size() - 2));
    block[block.size() - 2] = static_cast<std::uint16_t>(crc >> 16U);
    block[block.size() - 1] = static_cast<std::uint16_t>(crc & 0xFFFFU);
    return block;
}

void refuse_busy(const Status& status) {
    if (status.owner_held != 0) {
        throw DeviceError(DeviceFault::busy, "a dispatcher holds the cell, " + hex(status.owner_held),
                          "Wait until its dispatch has ended, then check again.");
    }
    if (status.job_state != JobState::none) {
        throw DeviceError(DeviceFault::busy,
                          "the cell has job " + to_text(status.job_id) + ", which is " + name(status.job_state),
                          "Dispatch again, which brings it to its end, then check.");
    }
}

void check_identity(LinkChecker& checker, const Status& status) {
    const BusAnswer answer = checker.read(identity_block);
    const Decoded<Identity> decoded = decode<Identity>(answer.registers);
    const bool is_read = answer.is_ok() && decoded.is_ok();
    const char* field = decoded.fault == BlockFault::crc       ? "CRC"
                        : decoded.fault == BlockFault::version ? "VERSION"
                                                               : "MAGIC";
    if (!checker.expect(identity_block, field, is_read, "is right: mark, version and CRC-32",
                        answer.is_ok() ? describe(decoded.fault) : "exception " + std::to_string(answer.exception))) {
        return;
    }
    const Identity& identity = decoded.value;
    checker.expect(identity_block, "STORE_ID", identity.store_id != Uuid{}, "is a random number, not 0", "0");
    checker.expect_number(identity_block, "BOOT_COUNT", identity.boot_count, status.boot_count, "is as in STATUS");
    checker.expect_number(identity_block, "EPOCH_HELD", identity.epoch_held, status.epoch_held, "is as in STATUS");
    checker.expect_number(identity_block, "STARTS_TOTAL", identity.starts_total, status.starts_total,
                          "is as in STATUS");
    checker.expect(identity_block, "STORE_CHECK", identity.checks_store <= 1, "is 0 or 1",
                   std::to_string(identity.checks_store));
}

// A frame that must have no effect but the count of BAD_FRAMES.
void expect_bad_frame(LinkChecker& checker, const Registers& frame, AckResult reason, const std::string& what) {
    const Status before = checker.status();
    checker.write(command_block, frame);
    const Status after = checker.settled_status();
    checker.expect_number(status_block, "BAD_FRAMES", after.bad_frames,
                          static_cast<std::uint16_t>(before.bad_frames + 1), "is one more after " + what);
    checker.expect(status_block, "BAD_REASON", after.bad_reason == reason,
                   std::string("is ") + name(reason) + " after " + what, name(after.bad_reason));
    const bool is_same =
        after.ack_seq == before.ack_seq && after.ack_owner == before.ack_owner && after.ack_result == before.ack_result;
    checker.expect(status_block, "ACK_SEQ", is_same, "stays after " + what,
                   "an acknowledgement: " + std::string(name(after.ack_result)));
}

Status claim(LinkChecker& checker, const Status& status) {
    checker.epoch = status.epoch_held + 1;
    Command command = checker.command(CellCommand::claim);
    command.arg1 = checker.secret;
    return checker.send(command);
}

// Of a sender who is not the owner of the lease.
Status send_as(LinkChecker& checker, std::uint32_t owner, std::uint32_t seq, CellCommand what, std::uint32_t epoch) {
    Command command;
    command.command = what;
    command.owner = owner;
    command.seq = seq;
    command.epoch = epoch;
    command.arg1 = owner;
    return checker.send(command);
}

void expect_answer_to(LinkChecker& checker, const Status& status, std::uint32_t owner, AckResult wanted,
                      const std::string& after) {
    const bool is_its = status.ack_owner == owner && status.ack_result == wanted;
    checker.expect(status_block, "ACK_RESULT", is_its, std::string("is ") + name(wanted) + " after " + after,
                   status.ack_owner == owner ? name(status.ack_result) : "no acknowledgement of it");
    checker.expect_number(status_block, "OWNER_HELD", status.owner_held, checker.owner, "stays after " + after);
    checker.expect_number(status_block, "EPOCH_HELD", status.epoch_held, checker.epoch, "stays after " + after);
}

void check_repetition(LinkChecker& checker, const Status& granted) {
    Command again;
    again.command = CellCommand::claim;
    again.owner = checker.owner;
    again.epoch = checker.epoch;
    again.seq = checker.seq;
    again.arg1 = checker.secret;
    checker.write_command(again);
    const Status after = checker.settled_status();
    checker.expect_number(status_block, "ACK_DETAIL", after.ack_detail, granted.ack_detail,
                          "is that of before after the same frame of CLAIM once more");
    checker.expect_number(status_block, "BAD_FRAMES", after.bad_frames, granted.bad_frames,
                          "stays after the same frame once more");
    again.arg0 = 1;
    expect_bad_frame(checker, encode(again), AckResult::stale_seq, "another frame with a CMD_SEQ that was used");
}

void check_others(LinkChecker& checker) {
    const std::uint32_t other = checker.owner ^ 0x55555555U;
    expect_answer_to(checker, send_as(checker, other, 1, CellCommand::claim, checker.epoch + 1), other,
                     AckResult::lease_busy, "CLAIM of another owner while the lease lives");
    expect_answer_to(checker, send_as(checker, other, 2, CellCommand::release, checker.epoch), other,
                     AckResult::not_owner, "RELEASE of another owner");
    Command old = checker.command(CellCommand::release);
    old.epoch = checker.epoch - 1;
    const Status after = checker.send(old);
    checker.expect_result(after, AckResult::stale_epoch, "RELEASE under the epoch before");
    checker.expect_number(status_block, "OWNER_HELD", after.owner_held, checker.owner,
                          "stays after a command of an old epoch");
    Command far = checker.command(CellCommand::claim);
    far.epoch = checker.epoch + (1U << 21U);
    far.arg1 = checker.secret;
    const Status jumped = checker.send(far);
    checker.expect_result(jumped, AckResult::epoch_jump, "CLAIM with an epoch more than 2^20 above EPOCH_HELD");
    checker.expect_number(status_block, "EPOCH_HELD", jumped.epoch_held, checker.epoch, "stays after EPOCH_JUMP");
}

void check_unknown(LinkChecker& checker) {
    checker.expect_result(checker.send(checker.command(static_cast<CellCommand>(no_command))), AckResult::unknown_cmd,
                          "a command that the map does not have");
    const Command command = checker.command(CellCommand::query);
    Registers frame = encode(command);
    frame[address_of(command_block, "CMD_FLAGS")] = 1;
    checker.write(command_block, sealed(frame));
    const Status after = checker.settled_status();
    checker.expect_result(after, AckResult::unknown_cmd, "a COMMAND with a reserved register that is not 0");
    checker.expect_number(status_block, "ACK_DETAIL", after.ack_detail, address_of(command_block, "CMD_FLAGS"),
                          "is the address of the reserved register that is not 0");
}

// A lease lives by heartbeats, and ends without.
void check_heartbeats(LinkChecker& checker) {
    constexpr double longer_than_lease_s = 6;
    constexpr double longer_than_watchdog_s = 3.2;
    checker.wait(longer_than_lease_s);
    const Status kept = checker.status();
    checker.expect_number(status_block, "OWNER_HELD", kept.owner_held, checker.owner, "stays while heartbeats come");
    checker.expect(status_block, "FLAGS", !kept.has(flag::watchdog_expired), "has no b10 while heartbeats come", "b10");
    checker.keeps_lease = false;
    checker.wait(longer_than_watchdog_s);
    checker.expect(status_block, "FLAGS", checker.status().has(flag::watchdog_expired),
                   "has b10 when no heartbeat has come for 2.5 s and a lease is held", "no b10 after 3.2 s");
    checker.wait(longer_than_lease_s - longer_than_watchdog_s);
    const Status after = checker.status();
    checker.expect_number(status_block, "OWNER_HELD", after.owner_held, 0, "is 0 when no heartbeat has come for 5 s");
    checker.expect(status_block, "FLAGS", !after.has(flag::lease_held), "has no b11 without a lease", "b11");
    checker.expect_number(status_block, "EPOCH_HELD", after.epoch_held, checker.epoch, "stays when a lease has ended");
    checker.expect_result(checker.send(checker.command(CellCommand::release)), AckResult::not_owner,
                          "RELEASE when the lease has ended");
}

std::optional<ResultRecord> result_of(LinkChecker& checker, const char* after) {
    const BusAnswer answer = checker.read(result_block);
    const Decoded<ResultRecord> decoded = decode<ResultRecord>(answer.registers);
    const bool is_right = answer.is_ok() && decoded.is_ok();
    checker.expect(result_block, "CRC", is_right, std::string("is right after ") + after,
                   answer.is_ok() ? describe(decoded.fault) : "exception " + std::to_string(answer.exception));
    return is_right ? std::optional(decoded.value) : std::nullopt;
}

}  // namespace

void check_reads(LinkChecker& checker) {
    const Status first = checker.status();
    checker.expect(status_block, "MAGIC", true, "is right, with version, CRC-32 and both numbers of the snapshot", "");
    const auto state = static_cast<std::uint16_t>(first.state);
    checker.expect(status_block, "STATE", state >= 1 && state <= last_pack_state, "is a number of PackML, 1 to 17",
                   std::to_string(state));
    const auto mode = static_cast<std::uint16_t>(first.unit_mode);
    checker.expect(status_block, "UNIT_MODE", mode >= 1 && mode <= 4, "is 1 to 4", std::to_string(mode));
    checker.expect(status_block, "FLAGS", first.has(flag::lease_held) == (first.owner_held != 0),
                   "has b11 where OWNER_HELD is not 0, and only there", hex(first.flags));
    checker.expect(status_block, "TOKEN", (first.token != 0) == (first.job_state == JobState::prepared),
                   "is not 0 where the job is prepared, and only there", hex(first.token));
    refuse_busy(first);
    constexpr double watched_s = 2;
    checker.wait(watched_s);
    const auto beats = static_cast<std::uint16_t>(checker.status().heartbeat - first.heartbeat);
    checker.expect(status_block, "CELL_HB", beats >= 2 && beats <= 6, "is one more each 500 ms",
                   std::to_string(beats) + " more in 2 s");
    check_identity(checker, first);
}

void check_frames(LinkChecker& checker) {
    checker.check_addresses();
    const Status before = checker.status();
    checker.write(command_block, Registers(command_block.count));
    const Status after = checker.settled_status();
    checker.expect_number(status_block, "BAD_FRAMES", after.bad_frames, before.bad_frames,
                          "stays after a COMMAND of zeros");
    Command claim;
    claim.command = CellCommand::claim;
    claim.owner = checker.owner;
    claim.seq = 1;
    claim.epoch = before.epoch_held + 1;
    Registers frame = encode(claim);
    frame.back() ^= 1U;
    expect_bad_frame(checker, frame, AckResult::bad_crc, "a COMMAND with a wrong CRC");
    frame = encode(claim);
    frame[address_of(command_block, "MAGIC")] ^= 1U;
    expect_bad_frame(checker, sealed(frame), AckResult::bad_magic, "a COMMAND with another MAGIC");
}

void check_lease(LinkChecker& checker) {
    const Status granted = claim(checker, checker.status());
    if (!checker.expect_result(granted, AckResult::ok, "CLAIM of a free cell")) checker.end();
    checker.grant = granted.ack_detail;
    checker.keeps_lease = true;
    checker.expect(status_block, "ACK_DETAIL", checker.grant != 0, "is the number of the grant, not 0, after CLAIM",
                   "0");
    checker.expect_number(status_block, "EPOCH_HELD", granted.epoch_held, checker.epoch,
                          "is the epoch of CLAIM after it");
    checker.expect_number(status_block, "OWNER_HELD", granted.owner_held, checker.owner,
                          "is the owner of CLAIM after it");
    checker.expect(status_block, "FLAGS", granted.has(flag::lease_held), "has b11 after CLAIM", "no b11");
    checker.expect(status_block, "LEASE_LEFT", granted.lease_left_ds > 0 && granted.lease_left_ds <= 50,
                   "is at most 5 s, and not 0, after CLAIM", std::to_string(granted.lease_left_ds));
    check_repetition(checker, granted);
    check_others(checker);
    check_unknown(checker);
    check_heartbeats(checker);
    const Status second = claim(checker, checker.status());
    if (!checker.expect_result(second, AckResult::ok, "CLAIM when the lease has ended")) checker.end();
    checker.expect(status_block, "ACK_DETAIL", second.ack_detail != checker.grant,
                   "is another number after another CLAIM", "the same number");
    checker.grant = second.ack_detail;
    checker.keeps_lease = true;
}

void check_queries(LinkChecker& checker) {
    Command query = checker.command(CellCommand::query);
    query.job_id = checker.random_id();
    query.arg0 = checker.grant;
    checker.expect_result(checker.send(query), AckResult::unknown_job, "QUERY of a job that the cell does not know");
    if (const auto result = result_of(checker, "QUERY")) {
        checker.expect_number(result_block, "QUERY_SEQ", result->query_seq, query.seq, "is the CMD_SEQ of QUERY");
        checker.expect_number(result_block, "QUERY_OWNER", result->query_owner, checker.owner, "is the OWNER of QUERY");
        checker.expect_number(result_block, "GRANT_EPOCH", result->grant_epoch, checker.epoch,
                              "is the epoch of the CLAIM whose number is in ARG0 of QUERY");
        checker.expect_number(result_block, "JOB_STATE", static_cast<std::uint64_t>(result->state), 0,
                              "is 0 of a job that the cell does not know");
    }
    query = checker.command(CellCommand::query);
    query.job_id = checker.random_id();
    query.arg0 = checker.grant ^ 1U;
    checker.send(query);
    if (const auto result = result_of(checker, "QUERY with a number of no grant")) {
        checker.expect_number(result_block, "GRANT_EPOCH", result->grant_epoch, 0,
                              "is 0 where no CLAIM had the number");
    }
    Command file = checker.command(CellCommand::query_file);
    file.file_sha256 = sha256(std::span<const std::uint8_t>(query.job_id));
    const Status none = checker.send(file);
    checker.expect_result(none, AckResult::unknown_job, "QUERY_FILE of a file that was never started");
    checker.expect_number(status_block, "ACK_DETAIL", none.ack_detail, 0, "is how often the file was started");
    if (const auto result = result_of(checker, "QUERY_FILE")) {
        checker.expect(result_block, "JOB_ID", result->job_id == Uuid{}, "is 0 where no job had the file", "not 0");
    }
}

void check_release(LinkChecker& checker) {
    const Status before = checker.status();
    const Status after = checker.send(checker.command(CellCommand::release));
    checker.keeps_lease = false;
    checker.expect_result(after, AckResult::ok, "RELEASE");
    checker.expect_number(status_block, "OWNER_HELD", after.owner_held, 0, "is 0 after RELEASE");
    checker.expect_number(status_block, "EPOCH_HELD", after.epoch_held, before.epoch_held, "stays after RELEASE");
}

}  // namespace qchopper::link_check

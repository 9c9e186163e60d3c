// The part of the check with a job: ticket, transfer in chunks, VERIFY, PREPARE, CANCEL. Nothing is started. O(chunks)
// requests, and as long as consent takes.

#include "devices/link_check/link_checker.h"

namespace qchopper::link_check {
namespace {

// Of 600 bytes, in three chunks, for whatever cell this is.
struct TestJob {
    WireTicket ticket;
    std::vector<std::uint8_t> file;
};

TestJob test_job(LinkChecker& checker, const Status& status) {
    constexpr std::size_t bytes = 600;
    TestJob job;
    for (std::size_t i = 0; i < bytes; ++i) job.file.push_back(static_cast<std::uint8_t>(7 * i + checker.random()));
    WireTicket& t = job.ticket;
    t.job_id = checker.random_id();
    t.file_sha256 = sha256(job.file);
    t.file_size = bytes;
    t.transfer = Transfer::chunks;
    t.file_name = "check.qjob";
    t.box_min = {-1000, -1000, 0};
    t.box_max = {1000, 1000, 2000};
    t.stock = {3000, 3000, 3000};
    t.tool_no = 1;
    t.tool_diameter_um = 1000;
    t.estimated_time_s = 60;
    t.piece_no = t.piece_count = 1;
    t.cell_id = status.cell_id;
    t.made_for = status.has(flag::simulated) ? 1 : 0;
    return job;
}

Command command_of(LinkChecker& checker, CellCommand what, const TestJob& job) {
    Command command = checker.command(what);
    command.job_id = job.ticket.job_id;
    command.file_sha256 = job.ticket.file_sha256;
    return command;
}

// False where the cell is not brought to Idle.
bool comes_to_idle(LinkChecker& checker) {
    Status status = checker.status();
    if (status.state == PackState::aborted) {
        if (!checker.may(
                "The cell is aborted. May Clear be sent, after which the operator at the cell must consent?")) {
            return false;
        }
        const Status cleared = checker.send(checker.command(CellCommand::clear), checker.options().consent_s);
        if (!checker.expect_result(cleared, AckResult::ok, "Clear with consent at the cell")) return false;
    }
    status = checker.status();
    for (const double until_s = checker.now_s() + checker.options().answer_s; checker.now_s() < until_s;) {
        if (status.state != PackState::clearing) break;
        checker.wait(0.1);
        status = checker.status();
    }
    if (status.state == PackState::stopped || status.state == PackState::complete) {
        if (!checker.may("May Reset be sent, after which the machine could move to its place of rest?")) return false;
        checker.expect_result(checker.send(checker.command(CellCommand::reset)), AckResult::ok,
                              std::string("Reset in ") + name(status.state));
    }
    for (const double until_s = checker.now_s() + checker.options().answer_s; checker.now_s() < until_s;) {
        status = checker.status();
        if (status.state == PackState::idle) return true;
        checker.wait(0.1);
    }
    checker.expect(status_block, "STATE", false, "comes to Idle after Reset", name(status.state));
    return false;
}

// A ticket that must be refused for one of its fields.
void expect_refused_field(LinkChecker& checker, const TestJob& job, const char* field, const std::string& what,
                          const std::function<void(Registers&)>& change) {
    Registers block = encode(job.ticket);
    change(block);
    const std::uint32_t crc = crc32_of_registers(std::span(block).first(block.size() - 2));
    block[block.size() - 2] = static_cast<std::uint16_t>(crc >> 16U);
    block[block.size() - 1] = static_cast<std::uint16_t>(crc & 0xFFFFU);
    checker.write(ticket_block, block);
    const Status after = checker.send(command_of(checker, CellCommand::store, job));
    checker.expect_result(after, AckResult::ticket_field, "STORE of a ticket with " + what);
    checker.expect_number(status_block, "ACK_DETAIL", after.ack_detail, address_of(ticket_block, field),
                          std::string("is the address of ") + field + " after STORE of a ticket with " + what);
}

void check_wrong_tickets(LinkChecker& checker, const TestJob& job) {
    checker.write(ticket_block, Registers(ticket_block.count));
    checker.expect_result(checker.send(command_of(checker, CellCommand::store, job)), AckResult::no_ticket,
                          "STORE after a TICKET of zeros");
    Registers damaged = encode(job.ticket);
    damaged.back() ^= 1U;
    checker.write(ticket_block, damaged);
    checker.expect_result(checker.send(command_of(checker, CellCommand::store, job)), AckResult::ticket_crc,
                          "STORE of a ticket with a wrong CRC");
    const auto at = [](const char* field) { return address_of(ticket_block, field) - ticket_block.base; };
    expect_refused_field(checker, job, "FILE_SIZE", "FILE_SIZE 0", [&](Registers& block) {
        block[static_cast<std::size_t>(at("FILE_SIZE"))] = block[static_cast<std::size_t>(at("FILE_SIZE")) + 1] = 0;
    });
    expect_refused_field(checker, job, "UNIT", "UNIT 2",
                         [&](Registers& block) { block[static_cast<std::size_t>(at("UNIT"))] = 2; });
    expect_refused_field(checker, job, "CELL_ID", "another CELL_ID",
                         [&](Registers& block) { block[static_cast<std::size_t>(at("CELL_ID"))] ^= 1U; });
    expect_refused_field(checker, job, "MADE_FOR", "the other MADE_FOR",
                         [&](Registers& block) { block[static_cast<std::size_t>(at("MADE_FOR"))] ^= 1U; });
}

// False: the cell demands a signature, or another deviation ends this part.
bool check_store(LinkChecker& checker, const TestJob& job) {
    checker.write(ticket_block, encode(job.ticket));
    const Status stored = checker.send(command_of(checker, CellCommand::store, job));
    if (stored.ack_result == AckResult::bad_signature || stored.ack_result == AckResult::unknown_key) {
        checker.leave_out("No job was stored: the cell takes signed ones only (" +
                          std::string(name(stored.ack_result)) + "). Check it with that policy off.");
        return false;
    }
    if (!checker.expect_result(stored, AckResult::ok, "STORE of a right ticket in Idle")) return false;
    checker.expect_number(status_block, "JOB_STATE", static_cast<std::uint64_t>(stored.job_state), 1,
                          "is 1 (stored) after STORE");
    checker.expect(status_block, "JOB_ID", stored.job_id == job.ticket.job_id, "is the job's after STORE",
                   to_text(stored.job_id));
    checker.expect_number(status_block, "XFER_STATE", static_cast<std::uint64_t>(stored.transfer_state), 1,
                          "is 1 (open) after STORE of a job in chunks");
    checker.expect_number(status_block, "XFER_NEXT", stored.transfer_next, 0, "is 0 after STORE");
    checker.expect_result(checker.send(command_of(checker, CellCommand::store, job)), AckResult::already,
                          "STORE of the same ticket once more");
    return true;
}

Status write_chunk(LinkChecker& checker, const TestJob& job, std::uint32_t offset, bool is_damaged = false) {
    Chunk chunk;
    chunk.offset = offset;
    const std::size_t end = std::min<std::size_t>(job.file.size(), offset + max_chunk_bytes);
    const std::size_t begin = std::min<std::size_t>(offset, end - 1);
    chunk.data.assign(job.file.begin() + static_cast<std::ptrdiff_t>(begin),
                      job.file.begin() + static_cast<std::ptrdiff_t>(end));
    chunk.crc = chunk_crc(checker.epoch, checker.owner, job.ticket.job_id, offset, chunk.data) ^ (is_damaged ? 1U : 0U);
    checker.write(chunk_block, encode(chunk));
    return checker.settled_status();
}

void expect_chunk(LinkChecker& checker, const Status& status, AckResult wanted, std::uint32_t next,
                  const std::string& after) {
    checker.expect(status_block, "XFER_RESULT", status.transfer_result == wanted,
                   std::string("is ") + name(wanted) + " after " + after, name(status.transfer_result));
    checker.expect_number(status_block, "XFER_NEXT", status.transfer_next, next,
                          "is the number of bytes taken so far after " + after);
}

bool check_transfer(LinkChecker& checker, const TestJob& job) {
    expect_chunk(checker, write_chunk(checker, job, 0, true), AckResult::chunk_crc, 0, "a chunk with a wrong CRC");
    expect_chunk(checker, write_chunk(checker, job, max_chunk_bytes), AckResult::wrong_offset, 0,
                 "a chunk whose OFFSET is above XFER_NEXT");
    expect_chunk(checker, write_chunk(checker, job, 0), AckResult::ok, max_chunk_bytes, "the first chunk");
    expect_chunk(checker, write_chunk(checker, job, 0), AckResult::already, max_chunk_bytes,
                 "the first chunk once more");
    checker.expect_result(checker.send(command_of(checker, CellCommand::verify, job)), AckResult::file_missing,
                          "VERIFY before all bytes are there");
    Status status = checker.status();
    while (status.transfer_next < job.file.size()) {
        const std::uint32_t before = status.transfer_next;
        status = write_chunk(checker, job, before);
        if (status.transfer_next <= before) break;
    }
    expect_chunk(checker, status, AckResult::ok, job.ticket.file_size, "the last chunk");
    const Status verified =
        checker.send(command_of(checker, CellCommand::verify, job), 10 * checker.options().answer_s);
    checker.expect(status_block, "FILE_SHA256", verified.file_sha256 == job.ticket.file_sha256,
                   "is the SHA-256 of the bytes that were sent, after VERIFY", to_hex(verified.file_sha256));
    checker.expect_number(status_block, "XFER_STATE", static_cast<std::uint64_t>(verified.transfer_state), 2,
                          "is 2 (complete) after VERIFY");
    return checker.expect_result(verified, AckResult::ok, "VERIFY of a file that is there and right");
}

// Whether the cell cannot carve the test job, which is no deviation.
bool is_unfit(AckResult result) {
    return result == AckResult::envelope || result == AckResult::tool || result == AckResult::stock_too_small ||
           result == AckResult::ticket_field || result == AckResult::rehearsal_required ||
           result == AckResult::no_consent || result == AckResult::safety_open || result == AckResult::local_control;
}

void check_prepare(LinkChecker& checker, const TestJob& job) {
    Command wrong = command_of(checker, CellCommand::prepare, job);
    wrong.file_sha256.bytes[0] ^= 1U;
    checker.expect_result(checker.send(wrong), AckResult::hash_mismatch, "PREPARE with another FILE_SHA256");
    if (!checker.may(
            "May PREPARE be sent? The operator at the cell is asked to consent to a job that is never started.")) {
        checker.leave_out("PREPARE was not sent, because nobody agreed to it here.");
        return;
    }
    const Status prepared = checker.send(command_of(checker, CellCommand::prepare, job), checker.options().consent_s);
    if (is_unfit(prepared.ack_result)) {
        checker.leave_out(std::string("The token was not checked: the cell answered PREPARE with ") +
                          name(prepared.ack_result) + ".");
        return;
    }
    if (!checker.expect_result(prepared, AckResult::ok, "PREPARE with consent at the cell")) return;
    checker.expect_number(status_block, "JOB_STATE", static_cast<std::uint64_t>(prepared.job_state), 2,
                          "is 2 (prepared) after PREPARE");
    checker.expect(status_block, "TOKEN", prepared.token != 0, "is a random number, not 0, after PREPARE", "0");
    checker.expect(status_block, "FLAGS", prepared.has(flag::prepared), "has b1 while the job is prepared", "no b1");
    checker.epoch = prepared.epoch_held + 1;
    Command claim = checker.command(CellCommand::claim);
    claim.arg1 = checker.secret;
    const Status fenced = checker.send(claim);
    checker.expect_result(fenced, AckResult::ok, "CLAIM of the same owner with its secret");
    checker.expect_number(status_block, "JOB_STATE", static_cast<std::uint64_t>(fenced.job_state), 1,
                          "is 1 (stored) when a CLAIM has dropped a prepared job");
    checker.expect_number(status_block, "TOKEN", fenced.token, 0, "is 0 when a CLAIM has dropped a prepared job");
}

void check_cancel(LinkChecker& checker, const TestJob& job) {
    const Status cancelled = checker.send(command_of(checker, CellCommand::cancel, job));
    if (!checker.expect_result(cancelled, AckResult::ok, "CANCEL of a job that was not started")) return;
    checker.expect_number(status_block, "JOB_STATE", static_cast<std::uint64_t>(cancelled.job_state), 0,
                          "is 0 after CANCEL");
    checker.expect(status_block, "JOB_ID", cancelled.job_id == Uuid{}, "is 0 after CANCEL", to_text(cancelled.job_id));
    checker.send(command_of(checker, CellCommand::query, job));
    const Decoded<ResultRecord> result = decode<ResultRecord>(checker.read(result_block).registers);
    checker.expect_number(result_block, "JOB_STATE", static_cast<std::uint64_t>(result.value.state), 7,
                          "is 7 (cancelled) after QUERY of a cancelled job");
    checker.expect_number(result_block, "STARTS", result.value.starts, 0, "is 0 of a job that was not started");
    checker.write(ticket_block, encode(job.ticket));
    checker.expect_result(checker.send(command_of(checker, CellCommand::store, job)), AckResult::cancelled,
                          "STORE of a job id that was cancelled");
}

}  // namespace

void check_job(LinkChecker& checker) {
    const Status before = checker.status();
    if (!comes_to_idle(checker)) {
        checker.leave_out("No job was stored, because the cell was not brought to Idle.");
        return;
    }
    const TestJob job = test_job(checker, before);
    check_wrong_tickets(checker, job);
    if (!check_store(checker, job)) return;
    if (check_transfer(checker, job)) check_prepare(checker, job);
    check_cancel(checker, job);
    checker.expect_number(status_block, "STARTS_TOTAL", checker.status().starts_total, before.starts_total,
                          "stays, because no START was sent");
}

}  // namespace qchopper::link_check

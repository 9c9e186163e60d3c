#include <cstdio>
#include <initializer_list>

#include "devices/registers.h"

namespace qchopper {
namespace {

struct ResultRow {
    AckResult result;
    const char* name;
    const char* words;
};
using enum AckResult;
constexpr ResultRow result_rows[] = {
    {none, "none", "no answer yet"},
    {ok, "OK", "done"},
    {already, "ALREADY", "that is so already"},
    {pending, "PENDING", "taken, not done yet"},
    {bad_magic, "BAD_MAGIC", "the block does not begin with our mark"},
    {bad_version, "BAD_VERSION", "another version of the register map"},
    {bad_crc, "BAD_CRC", "the block was damaged on the way"},
    {unknown_cmd, "UNKNOWN_CMD", "the cell does not know this command"},
    {stale_seq, "STALE_SEQ", "an old command came late"},
    {not_owner, "NOT_OWNER", "somebody else owns the cell, or the lease ran out"},
    {stale_epoch, "STALE_EPOCH", "another dispatcher has taken over since"},
    {lease_busy, "LEASE_BUSY", "another dispatcher owns the cell"},
    {wrong_offset, "WRONG_OFFSET", "the chunk does not follow the one before"},
    {chunk_crc, "CHUNK_CRC", "the chunk was damaged or belongs to another job"},
    {epoch_jump, "EPOCH_JUMP", "the claim's epoch is too far above the one that the cell holds"},
    {wrong_state, "WRONG_STATE", "not in this state of the machine"},
    {wrong_mode, "WRONG_MODE", "the cell is not in production mode"},
    {local_control, "LOCAL_CONTROL", "the cell is under control of its panel"},
    {no_consent, "NO_CONSENT", "the operator at the cell did not consent"},
    {safety_open, "SAFETY_OPEN", "the safety chain of the cell is open"},
    {busy_other_job, "BUSY_OTHER_JOB", "the cell has another job"},
    {wrong_job, "WRONG_JOB", "the command names another job than the cell has"},
    {no_ticket, "NO_TICKET", "no ticket was written before"},
    {ticket_crc, "TICKET_CRC", "the ticket was damaged on the way"},
    {ticket_field, "TICKET_FIELD", "a field of the ticket is wrong"},
    {bad_signature, "BAD_SIGNATURE", "the signature does not fit the ticket"},
    {unknown_key, "UNKNOWN_KEY", "the cell does not know the key of the signature"},
    {hash_mismatch, "HASH_MISMATCH", "the file that the cell has is not the one of the ticket"},
    {file_missing, "FILE_MISSING", "the cell does not find the job file"},
    {file_size, "FILE_SIZE", "the job file has another size than the ticket says"},
    {envelope, "ENVELOPE", "the job leaves the reach of the cell"},
    {tool, "TOOL", "the cell does not have the tool"},
    {store_full, "STORE_FULL", "the cell has no room for the job file"},
    {rehearsal_required, "REHEARSAL_REQUIRED", "a rehearsal must pass first"},
    {job_id_reused, "JOB_ID_REUSED", "this job id was used before"},
    {stock_too_small, "STOCK_TOO_SMALL", "the piece does not fit into the stock"},
    {token_bad, "TOKEN_BAD", "the start token is not the one that was given"},
    {already_finished, "ALREADY_FINISHED", "the job has run before"},
    {unknown_job, "UNKNOWN_JOB", "the cell does not know the job"},
    {cancelled, "CANCELLED", "the job was cancelled"},
    {token_expired, "TOKEN_EXPIRED", "the start came too late after the consent"},
    {internal, "INTERNAL", "a fault inside the controller"},
    {store_io, "STORE_IO", "the cell cannot write its memory"},
    {power_loss_recovered, "POWER_LOSS_RECOVERED", "the cell lost power in between"},
};

constexpr const char* flag_names[] = {"ready for ticket",
                                      "prepared",
                                      "consent present",
                                      "job active",
                                      "result waiting",
                                      "warning",
                                      "fault",
                                      "safety chain open",
                                      "local control",
                                      "simulated",
                                      "PC watchdog expired",
                                      "lease held",
                                      "store full",
                                      "block loaded",
                                      "rehearsal running"};

const char* type_name(FieldType type) {
    switch (type) {
        case FieldType::u16:
            return "u16";
        case FieldType::u32:
            return "u32";
        case FieldType::u64:
            return "u64";
        case FieldType::i32:
            return "i32";
        case FieldType::text:
            return "text";
        case FieldType::bytes:
            return "bytes";
        case FieldType::words:
            return "words";
    }
    return "";
}

// One line of a table.
std::string row(std::initializer_list<std::string> cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line.append(" ").append(cell).append(" |");
    return line.append("\n");
}

std::string number(unsigned value) {
    return std::to_string(value);
}

std::string hex(unsigned value) {
    char buffer[16];
    std::snprintf(buffer, sizeof buffer, "0x%03X", value);
    return buffer;
}

std::string print_block(const Block& block) {
    std::string out = "\n## " + std::string(block.name) + ": " + block.meaning + "\n\n";
    out += block.side == Side::input ? "Input registers (function 4), " : "Holding registers (function 16), ";
    out += "base " + number(block.base) + ", " + number(block.count) + " registers.";
    if (&block == &chunk_block) out += " Atomic: 5 + ceil(LEN/2) registers.";
    if (block.whole && &block != &chunk_block) out += " Atomic: one write of exactly these registers.";
    out += "\n\n| address | type | name | unit, meaning |\n|---|---|---|---|\n";
    for (const Field& field : block.fields) {
        std::string range = number(field.address);
        if (field.count > 1) range.append("-").append(number(field.address + field.count - 1U));
        out += row({range, type_name(field.type), field.name, field.meaning});
    }
    return out;
}

std::string print_words() {
    std::string out = "\n## FLAGS\n\n| bit | meaning |\n|---|---|\n";
    for (unsigned bit = 0; bit < std::size(flag_names); ++bit) out += row({number(bit), flag_names[bit]});
    out += "\n## JOB_STATE and JOB_RESULT\n\n| number | job state | job result |\n|---|---|---|\n";
    for (unsigned n = 0; n <= 8; ++n) {
        out += row({number(n), n <= 7 ? name(static_cast<JobState>(n)) : "", name(static_cast<JobResult>(n))});
    }
    out +=
        "\n## Results\n\nFrom 0x100 on the command was refused and had no effect.\n\n"
        "| number | name | in words |\n|---|---|---|\n";
    for (const ResultRow& one : result_rows) {
        out += row({hex(static_cast<unsigned>(one.result)), one.name, one.words});
    }
    return out;
}

std::string cell_of(PackState state, CellCommand command) {
    const Transition what = transition(state, command);
    switch (what.meeting) {
        case Meeting::refused:
            return "-";
        case Meeting::moves:
            return name(what.to);
        case Meeting::already:
            return "(in place)";
        case Meeting::allowed:
            return "yes";
    }
    return "";
}

std::string print_machine() {
    std::string out =
        "\n## The machine: what a command does in a state\n\nA name is the state that follows; `(in place)` answers "
        "ALREADY; `yes` is taken without leaving the state; `-` answers WRONG_STATE. The last column is where an "
        "acting "
        "state goes by itself.\n\n| state |";
    for (const CellCommand command : all_commands) {
        out += std::string(" ") + name(command) + " " + number(static_cast<unsigned>(command)) + " |";
    }
    out += " done |\n|---|";
    for (std::size_t i = 0; i <= all_commands.size(); ++i) out += "---|";
    out += "\n";
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        const auto state = static_cast<PackState>(n);
        out.append("| ").append(number(n)).append(" ").append(name(state)).append(" |");
        for (const CellCommand command : all_commands) out.append(" ").append(cell_of(state, command)).append(" |");
        const PackState next = after_done(state);
        out.append(" ").append(next == PackState::undefined ? "" : name(next)).append(" |\n");
    }
    return out;
}

const ResultRow& row_of(AckResult result) {
    static constexpr ResultRow unknown{none, "unknown result", "an answer that this program does not know"};
    for (const ResultRow& one : result_rows) {
        if (one.result == result) return one;
    }
    return unknown;
}

}  // namespace

const char* name(AckResult result) {
    return row_of(result).name;
}
const char* words(AckResult result) {
    return row_of(result).words;
}

const char* name(JobState state) {
    constexpr const char* names[] = {"none",
                                     "stored (NotAllowedToStart)",
                                     "prepared (AllowedToStart)",
                                     "running",
                                     "interrupted",
                                     "ended",
                                     "aborted",
                                     "cancelled"};
    const auto n = static_cast<unsigned>(state);
    return n < std::size(names) ? names[n] : "unknown";
}

const char* name(JobResult result) {
    constexpr const char* names[] = {"none", "complete", "stopped",          "aborted",         "power loss",
                                     "tool", "envelope", "rehearsal passed", "rehearsal failed"};
    const auto n = static_cast<unsigned>(result);
    return n < std::size(names) ? names[n] : "unknown";
}

std::string print_registers() {
    std::string out =
        "# Register map of a cell, version 1.0\n\nMade by `print_registers()` from the tables in "
        "`devices/registers.cpp` and `devices/packml.cpp`; a test compares.\n\nModbus TCP, unit 1 or 255, functions 3, "
        "4 "
        "and 16 only. Addresses are 0-based. Numbers of 32 and 64 bits have the high word first; text has two "
        "characters "
        "a register, the first in the high byte, padded with zero bytes; there are no floats. CRC-32 is that of IEEE "
        "802.3 over the bytes in wire order. Reads stay inside one block; holding registers read as zero. Blocks of "
        "zeros "
        "do nothing.\n";
    for (const Block* block : all_blocks()) out += print_block(*block);
    return out + print_words() + print_machine();
}

}  // namespace qchopper

// Tables of texts; a result is searched linearly among 44 rows.

#include "devices/wire/codes.h"

#include <iterator>

namespace qchopper {
namespace {

using enum AckResult;
constexpr ResultCode result_table[] = {
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
    {program_unreadable, "PROGRAM_UNREADABLE", "the cell cannot execute the program of the job"},
    {token_bad, "TOKEN_BAD", "the start token is not the one that was given"},
    {already_finished, "ALREADY_FINISHED", "the job has run before"},
    {unknown_job, "UNKNOWN_JOB", "the cell does not know the job"},
    {cancelled, "CANCELLED", "the job was cancelled"},
    {token_expired, "TOKEN_EXPIRED", "the start came too late after the consent"},
    {internal, "INTERNAL", "a fault inside the controller"},
    {store_io, "STORE_IO", "the cell cannot write its memory"},
    {power_loss_recovered, "POWER_LOSS_RECOVERED", "the cell lost power in between"},
};

constexpr const char* flag_table[] = {"ready for ticket",
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

}  // namespace

std::span<const ResultCode> result_codes() {
    return result_table;
}

namespace {

const ResultCode& row_of(AckResult result) {
    static constexpr ResultCode unknown{none, "unknown result", "a result that the register map does not define"};
    for (const ResultCode& one : result_codes()) {
        if (one.result == result) return one;
    }
    return unknown;
}

}  // namespace

std::span<const char* const> flag_names() {
    return flag_table;
}

const char* name(AckResult result) {
    return row_of(result).name;
}
const char* describe(AckResult result) {
    return row_of(result).meaning;
}

const char* describe(AckResult result, std::uint32_t detail) {
    if (result == bad_signature && detail == signature_detail::unsigned_ticket) return "the ticket is not signed";
    if (result == unknown_key && detail == signature_detail::revoked_key) return "the key of the signature is revoked";
    return describe(result);
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

}  // namespace qchopper

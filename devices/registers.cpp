#include "devices/registers.h"

#include <array>
#include <cstring>

namespace qchopper {
namespace {

using enum FieldType;

constexpr Field status_fields[] = {
    {0, 1, u16, "MAGIC", "0x5143"},
    {1, 1, u16, "VERSION", "0x0100, major.minor"},
    {2, 1, u16, "SNAP_BEGIN", "number of the snapshot; if it differs from SNAP_END: read again"},
    {3, 1, u16, "CELL_HB", "+1 each 500 ms, wraps"},
    {4, 2, u32, "BOOT_COUNT", "+1 at each start of the controller, persistent"},
    {6, 1, u16, "UNIT_MODE", "1 production, 2 maintenance, 3 manual, 4 rehearsal"},
    {7, 1, u16, "STATE", "PackML number, see below"},
    {8, 1, u16, "STATE_PREV", "PackML number"},
    {9, 1, u16, "FLAGS", "bits, see below"},
    {10, 2, u32, "EPOCH_HELD", "highest epoch ever granted, 0 none"},
    {12, 1, u16, "LEASE_LEFT", "0.1 s"},
    {13, 1, u16, "CELL_ID", "configured identity"},
    {14, 2, u32, "ACK_SEQ", "CMD_SEQ of the command answered last"},
    {16, 1, u16, "ACK_CMD", "its command"},
    {17, 1, u16, "ACK_RESULT", "see the table of results"},
    {18, 2, u32, "ACK_DETAIL", "an address, an offset, a receipt"},
    {20, 8, bytes, "JOB_ID", "job stored, prepared, active, or finished and not cleared; 0 none"},
    {28, 2, u32, "TOKEN", "one-shot start token, never 0 when prepared"},
    {30, 1, u16, "JOB_STATE", "see below"},
    {31, 1, u16, "JOB_RESULT", "see below"},
    {32, 1, u16, "PROGRESS", "0..10000 = 0.01 %"},
    {33, 2, u32, "ELAPSED", "s"},
    {35, 2, u32, "REMAINING", "s, 0xFFFFFFFF unknown"},
    {37, 2, u32, "BLOCK_NO", "program block being executed"},
    {39, 1, u16, "TOOL_NO", "in the spindle"},
    {40, 2, i32, "TIP_X", "0.01 mm, base frame of the cell"},
    {42, 2, i32, "TIP_Y", "0.01 mm"},
    {44, 2, i32, "TIP_Z", "0.01 mm"},
    {46, 1, u16, "FEED_OVR", "0.01 %"},
    {47, 1, u16, "SPINDLE", "rpm"},
    {48, 1, u16, "ALARMS", "number active"},
    {49, 2, u32, "ALARM_CODE", "of the first alarm"},
    {51, 2, u32, "ALARM_BLOCK", "program block of the first alarm"},
    {53, 8, text, "ALARM_TEXT", "of the first alarm"},
    {61, 1, u16, "XFER_STATE", "0 idle, 1 open, 2 complete, 3 hash mismatch"},
    {62, 2, u32, "XFER_NEXT", "bytes accepted so far, the next OFFSET"},
    {64, 1, u16, "XFER_RESULT", "result of the last chunk"},
    {65, 2, u32, "STORE_FREE", "KiB"},
    {67, 2, u32, "EVENT_NO", "head of the cell's event log"},
    {69, 16, bytes, "FILE_SHA256", "computed by the cell over what it stored"},
    {85, 2, u32, "STARTS_TOTAL", "starts since first boot, persistent"},
    {87, 4, u64, "CELL_TIME", "unix ms"},
    {91, 2, u32, "OWNER_HELD", "owner of the lease, 0 without one"},
    {93, 2, u32, "ACK_OWNER", "whose command ACK_* answer"},
    {95, 1, u16, "BAD_FRAMES", "commands that could not be trusted, wraps"},
    {96, 2, u32, "STATUS_CRC", "CRC-32 over 0..95"},
    {98, 1, u16, "BAD_REASON", "why the last of BAD_FRAMES"},
    {99, 1, u16, "SNAP_END", "equals SNAP_BEGIN"},
};

constexpr Field result_fields[] = {
    {200, 8, bytes, "JOB_ID", "that was asked for"},
    {208, 1, u16, "JOB_STATE", "0: the cell does not know it"},
    {209, 1, u16, "JOB_RESULT", ""},
    {210, 2, u32, "STARTS", "0 or 1"},
    {212, 2, u32, "START_EPOCH", ""},
    {214, 2, u32, "START_SEQ", ""},
    {216, 4, u64, "START_TIME", "unix ms"},
    {220, 4, u64, "END_TIME", "unix ms"},
    {224, 16, bytes, "FILE_SHA256", "of what was carved"},
    {240, 2, u32, "LAST_BLOCK", ""},
    {242, 2, u32, "QUERY_SEQ", "CMD_SEQ of the query"},
    {244, 2, u32, "QUERY_OWNER", "who asked"},
    {246, 12, words, "reserved", "0"},
    {258, 2, u32, "CRC", "CRC-32 over 200..257"},
};

constexpr Field command_fields[] = {
    {0, 1, u16, "MAGIC", "0x5143"},
    {1, 1, u16, "VERSION", "0x0100"},
    {2, 2, u32, "EPOCH", "fencing number"},
    {4, 2, u32, "CMD_SEQ", "1.., strictly rising over the owner's life"},
    {6, 1, u16, "CMD", "see below"},
    {7, 1, u16, "CMD_FLAGS", "reserved 0"},
    {8, 8, bytes, "JOB_ID", "0 for Reset, Clear, SET_MODE; all ones: any job (Abort)"},
    {16, 2, u32, "TOKEN", "for Start"},
    {18, 2, u32, "ARG0", "CLAIM: takeover code; SET_MODE: mode; PREPARE: receipt"},
    {20, 2, u32, "ARG1", "CLAIM: the owner's secret"},
    {22, 16, bytes, "FILE_SHA256", "checked by STORE, VERIFY, PREPARE, Start"},
    {38, 2, u32, "OWNER", "random, not 0"},
    {40, 18, words, "reserved", "0"},
    {58, 2, u32, "CRC", "CRC-32 over 0..57"},
};

constexpr Field ticket_fields[] = {
    {100, 1, u16, "TICKET_VERSION", "1"},
    {101, 8, bytes, "JOB_ID", "UUID"},
    {109, 16, bytes, "FILE_SHA256", ""},
    {125, 2, u32, "FILE_SIZE", "bytes"},
    {127, 1, u16, "TRANSFER", "1 drop folder, 2 chunks"},
    {128, 16, text, "FILE_NAME", "1 to 32 of A-Z a-z 0-9 . _ -, not beginning with a dot"},
    {144, 1, u16, "UNIT", "1 mm"},
    {145, 2, i32, "BOX_MIN_X", "0.01 mm, base frame of the program"},
    {147, 2, i32, "BOX_MIN_Y", "0.01 mm"},
    {149, 2, i32, "BOX_MIN_Z", "0.01 mm"},
    {151, 2, i32, "BOX_MAX_X", "0.01 mm"},
    {153, 2, i32, "BOX_MAX_Y", "0.01 mm"},
    {155, 2, i32, "BOX_MAX_Z", "0.01 mm"},
    {157, 2, i32, "STOCK_X", "0.01 mm"},
    {159, 2, i32, "STOCK_Y", "0.01 mm"},
    {161, 2, i32, "STOCK_Z", "0.01 mm"},
    {163, 1, u16, "MATERIAL", "0 unspecified, 1 PU foam, 2 EPS, 3 XPS, 4 other"},
    {164, 1, u16, "TOOL_NO", "first tool"},
    {165, 2, u32, "TOOL_DIAMETER", "0.001 mm, largest"},
    {167, 1, u16, "SPINDLE_MAX", "rpm"},
    {168, 2, u32, "FEED_MAX", "mm/min"},
    {170, 2, u32, "EST_TIME", "s"},
    {172, 1, u16, "BASE_PLANE", "index of the cap in the manifest, 0xFFFF none"},
    {173, 1, u16, "PIECE_NO", "1.."},
    {174, 1, u16, "PIECE_COUNT", ""},
    {175, 8, bytes, "PROJECT_ID", ""},
    {183, 4, u64, "CREATED", "unix ms"},
    {187, 1, u16, "ON_LINK_LOSS", "0 continue, 1 hold"},
    {188, 1, u16, "REQUIREMENTS", "b0 rehearsal required"},
    {189, 4, words, "reserved", "0"},
    {193, 1, u16, "CELL_ID", "of the cell it is made for"},
    {194, 1, u16, "MADE_FOR", "b0 a simulated cell"},
    {195, 2, u32, "KEY_ID", "first 4 bytes of the SHA-256 of the public key"},
    {197, 1, words, "reserved", "0"},
    {198, 2, u32, "CRC", "CRC-32 over 100..197"},
};

constexpr Field signature_fields[] = {
    {200, 32, bytes, "SIGNATURE", "Ed25519 over \"QCHOPPER-TICKET-1\" and the bytes of 100..197; all zero: unsigned"},
};

constexpr Field chunk_fields[] = {
    {300, 2, u32, "OFFSET", "must be XFER_NEXT"},
    {302, 1, u16, "LEN", "1..232 bytes"},
    {303, 2, u32, "CRC", "CRC-32 over EPOCH, OWNER, JOB_ID, OFFSET, LEN and the data"},
    {305, 116, bytes, "DATA", "ceil(LEN/2) registers of it are written"},
};

constexpr Field heartbeat_fields[] = {
    {500, 2, u32, "EPOCH", ""},
    {502, 2, u32, "OWNER", ""},
    {504, 1, u16, "COUNTER", "any, then it must change"},
};

}  // namespace

constexpr Block status_block{"STATUS", Side::input, 0, 100, false, status_fields, "what the cell says of itself"};
constexpr Block result_block{"RESULT", Side::input, 200, 60, false, result_fields, "the answer to QUERY"};
constexpr Block command_block{"COMMAND", Side::holding, 0, 60, true, command_fields, "one command"};
constexpr Block ticket_block{"TICKET", Side::holding, 100, 100, true, ticket_fields, "the job in numbers"};
constexpr Block signature_block{"SIGNATURE", Side::holding, 200, 32, true, signature_fields, "of the ticket"};
constexpr Block chunk_block{"CHUNK", Side::holding, 300, 121, true, chunk_fields, "a slice of the job file"};
constexpr Block heartbeat_block{"HEARTBEAT", Side::holding, 500, 5, true, heartbeat_fields, "keeps the lease"};

std::span<const Block* const> all_blocks() {
    static constexpr std::array<const Block*, 7> blocks{&status_block,    &result_block, &command_block,  &ticket_block,
                                                        &signature_block, &chunk_block,  &heartbeat_block};
    return blocks;
}

const Field* field_named(const Block& block, const char* field_name) {
    for (const Field& field : block.fields) {
        if (std::strcmp(field.name, field_name) == 0) return &field;
    }
    return nullptr;
}

}  // namespace qchopper

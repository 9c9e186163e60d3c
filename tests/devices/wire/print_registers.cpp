// Prints the tables of registers.cpp, codes.cpp and packml.cpp as Markdown. O(characters).

#include "tests/devices/wire/print_registers.h"

#include <cstdio>
#include <initializer_list>

#include "devices/wire/program_block.h"
#include "devices/wire/registers.h"

namespace qchopper {
namespace {

const char* type_name(FieldType type) {
    constexpr const char* names[] = {"u16",  "u32",   "u64",  "i32",
                                     "text", "bytes", "words"};  // in the order of FieldType
    return names[static_cast<std::size_t>(type)];
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

std::string print_codes() {
    std::string out = "\n## FLAGS\n\n| bit | meaning |\n|---|---|\n";
    for (unsigned bit = 0; bit < flag_names().size(); ++bit) out += row({number(bit), flag_names()[bit]});
    out += "\n## JOB_STATE and JOB_RESULT\n\n| number | job state | job result |\n|---|---|---|\n";
    for (unsigned n = 0; n <= 8; ++n) {
        out += row({number(n), n <= 7 ? name(static_cast<JobState>(n)) : "", name(static_cast<JobResult>(n))});
    }
    out += "\n## Results\n\nFrom 0x100 on the command was refused and had no effect.\n\n";
    out += "| number | name | in words |\n|---|---|---|\n";
    for (const ResultCode& one : result_codes()) {
        out += row({hex(static_cast<unsigned>(one.result)), one.name, one.meaning});
    }
    out += "\nACK_DETAIL says more of a signature: ";
    out += number(signature_detail::unsigned_ticket) +
           " of BAD_SIGNATURE: " + describe(AckResult::bad_signature, signature_detail::unsigned_ticket) + "; ";
    out += number(signature_detail::revoked_key) +
           " of UNKNOWN_KEY: " + describe(AckResult::unknown_key, signature_detail::revoked_key) +
           ". Of PROGRAM_UNREADABLE it is the line, in the file that the log of the cell names; 0: of no line.\n";
    out +=
        "\nSTORE takes the TICKET and the SIGNATURE that came last over its own connection; one that wrote neither "
        "takes "
        "what any wrote last.\n";
    return out;
}

std::string cell_of(PackState state, CellCommand command) {
    const Transition what = transition(state, command);
    switch (what.kind) {
        case TransitionKind::refused:
            return "-";
        case TransitionKind::moves:
            return name(what.to);
        case TransitionKind::already:
            return "(in place)";
        case TransitionKind::allowed:
            return "yes";
    }
    return "";
}

std::string print_machine() {
    std::string out =
        "\n## The machine: what a command does in a state\n\nA name is the state that follows; `(in place)` answers "
        "ALREADY; `yes` is taken without leaving the state; `-` answers WRONG_STATE. The last column is where an "
        "acting state goes by itself.\n\n| state |";
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

const char* const what_is_kept =
    "\n## What the cell keeps, and where\n\nIn its store, over every loss of power: STORE_ID, BOOT_COUNT, EPOCH_HELD, "
    "STARTS_TOTAL, every job id that was ever started or cancelled, with its RESULT, and every grant: a random number "
    "that is drawn at each CLAIM that is granted, with its epoch. What changes the store is written before it is "
    "acknowledged and before anything moves.\n\nEach write also holds a new random mark of 64 bits. A cell with "
    "STORE_CHECK 1 keeps two marks in another memory, which no backup of the store holds (retentive memory of the "
    "controller, not its disk): before a write the mark to come as the second one, after it, and before the "
    "acknowledgement and the motion, the same mark as both. A store whose mark is neither of the two when the "
    "controller starts is an older copy or a foreign one: the cell draws another STORE_ID.\n\nThe grant of a CLAIM is "
    "in ACK_DETAIL of its acknowledgement. The dispatcher keeps it, and asks for it in ARG0 of its next QUERY. A cell "
    "that does not know it has a memory from before that CLAIM, even if all that it remembers was put back and "
    "EPOCH_HELD was raised again since. A copy from between a CLAIM and its START shows by its mark; with STORE_CHECK "
    "0 "
    "the dispatcher says UNKNOWN of a START around which the cell was restarted. Not found is one case: store and "
    "marks "
    "are both put back to a copy that was taken between a CLAIM and its START.\n";

std::string print_blocks() {
    const std::string chunk = number(lines_per_block_chunk);
    return "\n## BLOCK_NO\n\nA cell that knows which line of the program it executes publishes chunk * " + chunk +
           " + line in BLOCK_NO, ALARM_BLOCK and LAST_BLOCK: the chunk counted from 1 in the order of the job's "
           "manifest, 0 the main program, and the line in its file, counted from 1. " +
           number(program_block(3, 412)) +
           " is line 412 of chunk 3. A cell that does not know it counts blocks in its own way, below " + chunk +
           ". TIP is in the frame in which the lines of the program state their points, that of the ticket's BOX.\n";
}

}  // namespace

std::string print_registers() {
    std::string out =
        "# Register map of a cell, version 1.1\n\nMade by `print_registers()` from the tables in "
        "`devices/wire/registers.cpp` and `devices/wire/packml.cpp`; a test compares.\n\nModbus TCP, unit 1 or 255, "
        "functions "
        "3, 4 and 16 only. Addresses are 0-based. Numbers of 32 and 64 bits have the high word first; text has two "
        "characters a register, the first in the high byte, padded with zero bytes; there are no floats. CRC-32 is "
        "that of IEEE 802.3 over the bytes in wire order. Reads stay inside one block; holding registers read as "
        "zero. Blocks of zeros do nothing.\n\nReserved registers are written as 0. What a cell publishes there is "
        "ignored: a later version may use it. A cell does nothing of a COMMAND or TICKET with another value there, "
        "because it may ask for more than the cell knows: it answers UNKNOWN_CMD or TICKET_FIELD, with the address in "
        "ACK_DETAIL.\n\nA later version 1.x adds to this one and is served; a cell that publishes an older VERSION is "
        "refused.\n";
    for (const Block* block : all_blocks()) out += print_block(*block);
    return out + print_blocks() + what_is_kept + print_codes() + print_machine();
}

}  // namespace qchopper

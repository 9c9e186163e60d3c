// Prints the tables of registers.cpp, codes.cpp and packml.cpp, and the steps of a job. O(characters).

#include "tests/devices/wire/print_structured_text.h"

#include <cctype>

#include "devices/wire/registers.h"

namespace qchopper {
namespace {

std::string number(std::uint32_t value) {
    return std::to_string(value);
}

// "WRONG_STATE", "POWER_LOSS" of "power loss".
std::string identifier(const std::string& words) {
    std::string out = "QC_";
    for (const char c : words.substr(0, words.find(" ("))) {
        out += std::isalnum(static_cast<unsigned char>(c)) != 0
                   ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                   : '_';
    }
    return out;
}

std::string type_of(const Field& field) {
    const std::string last = number(field.count - 1U);
    switch (field.type) {
        case FieldType::u16:
            return "UINT";
        case FieldType::u32:
            return "UDINT";
        case FieldType::u64:
            return "ULINT";
        case FieldType::i32:
            return "DINT";
        case FieldType::text:
            return "STRING[" + number(2U * field.count) + "]";
        case FieldType::bytes:
            return "ARRAY [0.." + number(2U * field.count - 1U) + "] OF BYTE";
        case FieldType::words:
            return "ARRAY [0.." + last + "] OF WORD";
    }
    return {};
}

// Reserved fields of a block have one name in the map.
std::string name_of(const Field& field) {
    return field.type == FieldType::words ? "RESERVED_" + number(field.address) : field.name;
}

std::string print_block(const Block& block) {
    std::string out = "  QC_" + std::string(block.name) + " : STRUCT (* " + block.meaning + "; " +
                      (block.side == Side::input ? "input" : "holding") + " registers from " + number(block.base) +
                      " *)\n";
    for (const Field& field : block.fields) {
        out += "    " + name_of(field) + " : " + type_of(field) + "; (* " + number(field.address) +
               (field.meaning[0] == '\0' ? "" : ": " + std::string(field.meaning)) + " *)\n";
    }
    return out + "  END_STRUCT;\n";
}

// One name and number of an enumeration.
std::string constant(const std::string& name, std::uint32_t value, const char* comment = "") {
    const std::string note = comment[0] == '\0' ? "" : std::string(" (* ") + comment + " *)";
    return "  " + name + " : UINT := " + number(value) + ";" + note + "\n";
}

std::string print_constants() {
    std::string out = "VAR_GLOBAL CONSTANT\n";
    for (const Block* block : all_blocks()) {
        const std::string name = "QC_" + std::string(block->name);
        out += constant(name + "_BASE", block->base) + constant(name + "_COUNT", block->count);
    }
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        out += constant(identifier(std::string("STATE_") + name(static_cast<PackState>(n))), n);
    }
    for (const CellCommand command : all_commands) {
        out += constant(identifier(std::string("CMD_") + name(command)), static_cast<std::uint32_t>(command));
    }
    for (std::uint16_t n = 0; n <= 7; ++n) {
        out += constant(identifier(std::string("JOB_") + name(static_cast<JobState>(n))), n);
    }
    for (std::uint16_t n = 0; n <= 8; ++n) {
        out += constant(identifier(std::string("RESULT_") + name(static_cast<JobResult>(n))), n);
    }
    for (const ResultCode& one : result_codes()) {
        out +=
            constant(identifier(std::string("ACK_") + one.name), static_cast<std::uint32_t>(one.result), one.meaning);
    }
    for (std::uint32_t bit = 0; bit < flag_names().size(); ++bit) {
        out += constant(identifier(std::string("FLAG_") + flag_names()[bit]), 1U << bit);
    }
    return out + "END_VAR\n";
}

std::string print_machine() {
    std::string out =
        "VAR_GLOBAL CONSTANT\n  (* QC_MACHINE[STATE, CMD]: the state that follows; 0: WRONG_STATE; -1: ALREADY. *)\n"
        "  QC_MACHINE : ARRAY [1..17, 1..10] OF INT := [\n";
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        const auto state = static_cast<PackState>(n);
        out += "   ";
        for (std::uint16_t c = 1; c <= 10; ++c) {
            const Transition what = transition(state, static_cast<CellCommand>(c));
            const int next = what.kind == TransitionKind::moves     ? static_cast<int>(what.to)
                             : what.kind == TransitionKind::already ? -1
                                                                    : 0;
            out += " " + std::to_string(next) + (n == last_pack_state && c == 10 ? "" : ",");
        }
        out += std::string(" (* ") + name(state) + " *)\n";
    }
    out +=
        "  ];\n  (* QC_AFTER[STATE]: where an acting state goes by itself; 0: it waits. *)\n"
        "  QC_AFTER : ARRAY [1..17] OF INT := [";
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        out += (n == 1 ? "" : ", ") + number(static_cast<std::uint32_t>(after_done(static_cast<PackState>(n))));
    }
    out +=
        "];\n  (* QC_TAKEN[STATE, CMD]: a job command is taken in this state. *)\n"
        "  QC_TAKEN : ARRAY [1..17, 100..110] OF BOOL := [\n";
    for (std::uint16_t n = 1; n <= last_pack_state; ++n) {
        const auto state = static_cast<PackState>(n);
        out += "   ";
        for (std::uint16_t c = 100; c <= 110; ++c) {
            const bool is_taken = transition(state, static_cast<CellCommand>(c)).kind != TransitionKind::refused;
            out += std::string(is_taken ? " TRUE" : " FALSE") + (n == last_pack_state && c == 110 ? "" : ",");
        }
        out += std::string(" (* ") + name(state) + " *)\n";
    }
    return out + "  ];\nEND_VAR\n";
}

struct SequenceRow {
    JobState before;
    CellCommand command;
    JobState after;
    const char* first;  // what is done before the acknowledgement
};
using enum JobState;
constexpr SequenceRow sequence[] = {
    {none, CellCommand::store, stored, "the fields of the ticket are right"},
    {stored, CellCommand::verify, stored, "FILE_SHA256 is computed over the bytes that will run"},
    {stored, CellCommand::prepare, prepared, "the operator has consented; a new TOKEN"},
    {prepared, CellCommand::claim, stored, "the TOKEN is gone"},
    {prepared, CellCommand::release, stored, "the TOKEN is gone"},
    {prepared, CellCommand::start, running, "the job and STARTS_TOTAL are on the disk; then it moves"},
    {stored, CellCommand::cancel, none, "the id is on the disk as cancelled"},
    {prepared, CellCommand::cancel, none, "the id is on the disk as cancelled"},
    {ended, CellCommand::clear_result, none, "the record stays"},
    {aborted, CellCommand::clear_result, none, "the record stays"},
};

std::string print_sequence() {
    const std::string count = number(std::size(sequence));
    std::string out =
        "TYPE\n  QC_STEP : STRUCT\n    BEFORE : UINT;\n    CMD : UINT;\n    AFTER : UINT;\n  END_STRUCT;\nEND_TYPE\n"
        "VAR_GLOBAL CONSTANT\n  (* What a job command makes of JOB_STATE; everything else leaves it as it is. *)\n"
        "  QC_SEQUENCE : ARRAY [1.." +
        count + "] OF QC_STEP := [\n";
    for (const SequenceRow& row : sequence) {
        out += "    (BEFORE := " + number(static_cast<std::uint32_t>(row.before)) +
               ", CMD := " + number(static_cast<std::uint32_t>(row.command)) +
               ", AFTER := " + number(static_cast<std::uint32_t>(row.after)) + ")" +
               (&row == std::end(sequence) - 1 ? "" : ",") + " (* " + name(row.before) + ", " + name(row.command) +
               ", " + name(row.after) + ": " + row.first + " *)\n";
    }
    return out + "  ];\nEND_VAR\n";
}

}  // namespace

std::string print_structured_text() {
    std::string out =
        "(* Register map of a cell, version 1.1, for controllers after IEC 61131-3. Made by print_structured_text() "
        "from "
        "the\n   tables of docs/developer/formats/registers.md; a test compares. No compiler has seen it: a grammar of "
        "our "
        "own has,\n   which knows declarations only. Numbers of 32 and 64 bits have the high word first. *)\n\nTYPE\n";
    for (const Block* block : all_blocks()) out += print_block(*block);
    return out + "END_TYPE\n\n" + print_constants() + "\n" + print_machine() + "\n" + print_sequence();
}

}  // namespace qchopper

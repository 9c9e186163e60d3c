// Tables. O(1).

#include "devices/hand_off/operator_text.h"

#include <cstdio>

#include "base/text.h"
#include "devices/wire/program_block.h"

namespace qchopper {

const char* foam_in(PackState state) {
    constexpr const char* none = "the cell cuts no foam";
    constexpr const char* cuts = "the cell is cutting foam";
    constexpr const char* ends = "the machine is coming to a stop";
    constexpr const char* held_up = "the cell cuts no foam while its job is held";
    constexpr const char* clauses[] = {"whether the cell cuts foam is not known",
                                       none,     // Clearing
                                       none,     // Stopped
                                       cuts,     // Starting
                                       none,     // Idle
                                       held_up,  // Suspended
                                       cuts,     // Execute
                                       ends,     // Stopping
                                       ends,     // Aborting
                                       none,     // Aborted
                                       ends,     // Holding
                                       held_up,  // Held
                                       cuts,     // Unholding
                                       ends,     // Suspending
                                       cuts,     // Unsuspending
                                       none,     // Resetting
                                       cuts,     // Completing
                                       none};    // Complete
    const auto number = static_cast<std::uint16_t>(state);
    return clauses[number <= last_pack_state ? number : 0];
}

std::string in_words(CellCommand command) {
    struct Row {
        CellCommand command;
        const char* words;
    };
    constexpr Row rows[] = {{CellCommand::claim, "take this computer as its dispatcher"},
                            {CellCommand::release, "end its lease"},
                            {CellCommand::store, "take the ticket"},
                            {CellCommand::verify, "check the job file"},
                            {CellCommand::rehearse, "rehearse the job"},
                            {CellCommand::prepare, "ask its operator for consent"},
                            {CellCommand::cancel, "drop the job"},
                            {CellCommand::query, "tell what became of the job"},
                            {CellCommand::query_file, "tell whether the file was carved"},
                            {CellCommand::clear_result, "clear the result"}};
    for (const Row& row : rows) {
        if (row.command == command) return std::string(name(command)) + " (" + row.words + ")";
    }
    return name(command);
}

std::string program_place(const Status& status) {
    const std::uint32_t chunk = chunk_of_block(status.block_no);
    std::string text = chunk > 0 ? "chunk " + std::to_string(chunk) + ", line " : std::string("block ");
    text += std::to_string(line_of_block(status.block_no)) + ", tool " + std::to_string(status.tool_no) + " at";
    constexpr const char* axes[] = {" X ", " Y ", " Z "};
    for (std::size_t axis = 0; axis < 3; ++axis) text += axes[axis] + fixed(status.tip[axis] / 100.0, 2);
    text += " mm";
    if (status.remaining_s == Status::unknown_s) return text;
    return text + ", " + duration(status.remaining_s) + " left";
}

std::string dispatcher_name(std::uint32_t owner) {
    char text[32];
    std::snprintf(text, sizeof text, "dispatcher 0x%08X", owner);
    return text;
}

Sentence carve_again() {
    return Sentence::with_key("carve_again", {}, "Ask for it to be carved again if it is to be carved once more.");
}

Sentence wait_or_take_over(const std::string& address) {
    return Sentence::with_key(
        "wait_or_take_over", {address},
        "Wait until the other dispatcher has finished, or end its lease by the code of the panel.");
}

}  // namespace qchopper

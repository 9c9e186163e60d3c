// Sentences and tests of what is there.

#include "cam/post/post_signals.h"

#include "base/error.h"
#include "base/text.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& what) {
    throw InputError(InputFault::config, "the cell file names no signal " + key + ": " + what,
                     "add " + key + " to the cell file");
}

}  // namespace

void check_signals(const CellMachine& machine) {
    const Spindle& spindle = machine.spindle;
    if (!spindle.on) refuse("spindle.on", "no program can start the spindle");
    if (!spindle.at_speed) refuse("spindle.at_speed", "no program can wait for the speed of the spindle");
    if (!spindle.off && spindle.on->kind == SignalKind::call) refuse("spindle.off", "no program can stop the spindle");
}

std::string tool_question(const CuttingTool& tool) {
    return "tool " + std::to_string(tool.number) + " (" + tool.name + ") is in the spindle, " +
           fixed(gauge_length(tool), 2) + " mm from the nose to the tip: check its length";
}

std::string tool_words(const CuttingTool& tool) {
    return "tool " + std::to_string(tool.number) + ", " + tool.name + ": " + fixed(gauge_length(tool), 2) +
           " mm from the nose to the tip, stick-out " + fixed(tool.stick_out, 2) + " mm";
}

std::vector<std::string> krl_tool_questions(const CuttingTool& tool) {
    constexpr std::size_t longest_name = 45;
    const std::string number = std::to_string(tool.number);
    return {"Put tool " + number + " (" + tool.name.substr(0, longest_name) + ") into the spindle.",
            "Measure tool " + number + ": " + fixed(gauge_length(tool), 2) + " mm from nose to tip, stick-out " +
                fixed(tool.stick_out, 2) + " mm."};
}

std::string part_question(std::size_t part) {
    return "part " + std::to_string(part) + " has ended, and this is the same block, not moved";
}

std::string restart_question(const std::string& chunk) {
    return "the chunks before " + chunk + " have ended, and this is the same block, not moved";
}

}  // namespace qchopper

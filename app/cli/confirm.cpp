// One question and its answer, with a look at the signals in between.

#include "app/cli/confirm.h"

#include <unistd.h>

#include <chrono>
#include <iostream>
#include <optional>
#include <thread>

#include "app/cli/standard_input_lines.h"
#include "app/cli/terminal.h"
#include "base/error.h"
#include "base/printable.h"

namespace qchopper {

bool is_confirmed(const std::string& question) {
    if (::isatty(STDIN_FILENO) == 0) {
        throw InputError(InputFault::use,
                         "a real cell is set in motion only after a question, and there is no terminal for the answer",
                         "pass --yes if that is meant");
    }
    std::cerr << printable(question) << " [y/N] " << std::flush;
    StandardInputLines input;
    while (!Terminal::is_cancelled()) {
        if (const std::optional<std::string> line = input.next()) return *line == "y" || *line == "Y" || *line == "yes";
        if (input.has_ended()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    throw Cancelled();
}

Operator operator_at_terminal() {
    return {::isatty(STDIN_FILENO) != 0, is_confirmed};
}

}  // namespace qchopper

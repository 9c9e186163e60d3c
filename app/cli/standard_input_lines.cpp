// poll() and read() on the descriptor. O(bytes).

#include "app/cli/standard_input_lines.h"

#include <poll.h>
#include <unistd.h>

namespace qchopper {

void StandardInputLines::read_more() {
    if (has_ended_) return;
    // Negative: not a terminal, or one that does not control this process and so stops no reader.
    const pid_t foreground = ::tcgetpgrp(STDIN_FILENO);
    if (foreground >= 0 && foreground != ::getpgrp()) return;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, 0) <= 0) return;
    char buffer[4096];
    const ssize_t got = ::read(STDIN_FILENO, buffer, sizeof buffer);
    if (got <= 0) has_ended_ = true;
    if (got > 0) rest_.append(buffer, static_cast<std::size_t>(got));
}

std::optional<std::string> StandardInputLines::next() {
    if (rest_.find('\n') == std::string::npos) read_more();
    const std::size_t end = rest_.find('\n');
    if (end == std::string::npos && (!has_ended_ || rest_.empty())) return std::nullopt;
    std::string line = rest_.substr(0, end);
    rest_.erase(0, end == std::string::npos ? end : end + 1);
    return line;
}

}  // namespace qchopper

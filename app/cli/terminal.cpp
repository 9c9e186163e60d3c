// The signal handler sets atomics; the context's flag is one of them, so that long work polls it. Progress is drawn at
// most ten times a second.

#include "app/cli/terminal.h"

#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "app/cli/exit_code.h"
#include "app/report/timings_report.h"
#include "base/text.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> cancelled{false};
std::atomic<int> signal_number{0};
std::atomic<long> first_signal_s{0};

// Only what may be done in a signal handler: atomics, clock_gettime, _exit.
void on_signal(int number) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (number == SIGINT && cancelled && now.tv_sec - first_signal_s <= 2) _exit(exit_interrupted);
    first_signal_s = now.tv_sec;
    signal_number = number;
    cancelled = true;
}

bool is_plain_terminal() {
    const char* term = std::getenv("TERM");
    return isatty(STDERR_FILENO) != 0 && (term == nullptr || std::strcmp(term, "dumb") != 0);
}

}  // namespace

std::string time_left(std::size_t done, std::size_t total, double elapsed_s) {
    constexpr double most_s = 99 * 3600;
    if (elapsed_s < 1 || done == 0 || done >= total) return {};
    const double left_s = elapsed_s * static_cast<double>(total - done) / static_cast<double>(done);
    if (left_s > most_s) return {};
    return ", about " + duration(static_cast<std::uint32_t>(std::ceil(left_s))) + " left";
}

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    signal(SIGPIPE, SIG_IGN);
}

Terminal::Terminal(bool json) : json_(json), shows_progress_(is_plain_terminal()) {}

void Terminal::set_quiet() {
    quiet_ = true;
    shows_progress_ = false;
}

void Terminal::set_timings() {
    timings_.emplace();
}

bool Terminal::is_cancelled() {
    return cancelled;
}

int Terminal::cancel_code() {
    return signal_number == SIGTERM ? exit_terminated : exit_interrupted;
}

void Terminal::clear_line() {
    if (has_line_) std::cerr << "\r\033[K";
    has_line_ = false;
}

void Terminal::message(const std::string& line) {
    if (!quiet_) error(line);
}

void Terminal::warn(const std::string& line) {
    error("warning: " + line);
}

void Terminal::warn(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) warn(line);
}

void Terminal::error(const std::string& line) {
    clear_line();
    std::cerr << line << std::endl;
}

void Terminal::show(const std::vector<std::string>& lines, const std::string& document) {
    std::optional<RunTimes> times;
    if (timings_) times = timings_->so_far();
    clear_line();
    if (json_) {
        json(times ? with_timings(document, *times) : document);
    } else {
        for (const std::string& line : lines) std::cout << line << std::endl;
    }
    if (!times) return;
    for (const std::string& line : table(*times)) error(line);
}

void Terminal::json(const std::string& document) {
    if (json_) std::cout << document << std::endl;
}

void Terminal::progress(const Progress& progress) {
    if (!shows_progress_) return;
    const auto now = Clock::now();
    if (what_ != progress.what || progress.done < done_) {  // other work, or the same once more
        what_ = progress.what;
        started_ = now;
        done_at_start_ = progress.done;
        drawn_ = {};
    }
    done_ = progress.done;
    const bool is_last = progress.total > 0 && progress.done >= progress.total;
    if (!is_last && now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    std::string line = with_commas(progress.done);
    if (progress.total > 0) line += " of " + with_commas(progress.total);
    const std::size_t total_left = progress.total > done_at_start_ ? progress.total - done_at_start_ : 0;
    const double elapsed_s = std::chrono::duration<double>(now - started_).count();
    line += " " + progress.what + "  " + fixed(std::floor(elapsed_s), 0) + " s" +
            time_left(progress.done - done_at_start_, total_left, elapsed_s);
    winsize size{};
    const std::size_t width = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 10 ? size.ws_col - 1U : 79;
    clear_line();
    std::cerr << line.substr(0, width) << std::flush;
    has_line_ = true;
    if (is_last) clear_line();
}

ProjectContext Terminal::context() {
    ProjectContext context;
    context.cancelled = &cancelled;
    context.timings = timings_ ? &*timings_ : nullptr;
    context.on_progress = [this](const Progress& p) { progress(p); };
    context.on_message = [this](const std::string& line) { message(line); };
    context.on_warning = [this](const std::string& line) { warn(line); };
    context.on_saved = [this](const std::string& sentence) { unchanged = sentence; };
    return context;
}

}  // namespace qchopper

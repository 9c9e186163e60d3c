// The signal handler sets atomics; the context's flag is one of them, so that long work polls it. It also wakes a
// thread, which otherwise sleeps, or on a terminal draws the progress twice a second. Progress is drawn at most ten
// times a second. A second Ctrl-C ends the process inside the handler, which then writes the document itself if none
// has been begun; one that is being printed is finished first.

#include "app/cli/terminal.h"

#include <poll.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <utility>

#include "app/cli/exit_code.h"
#include "app/report/command_line_text.h"
#include "app/report/timings_report.h"
#include "base/files/unfinished.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr std::chrono::milliseconds time_to_answer{80};  // for the work itself
constexpr std::chrono::milliseconds draw_every{100};     // at most
constexpr std::chrono::milliseconds draw_again{500};     // where no count has changed
constexpr std::chrono::milliseconds write_again{2000};   // the same of --progress json

std::atomic<bool> cancelled{false};
std::atomic<int> signal_number{0};
std::atomic<long> first_signal_s{0};

// The one document of --json.
enum class DocumentState : int { none, begun, printed, by_handler };
std::atomic<bool> has_document{false};  // --json
std::atomic<DocumentState> document_state{DocumentState::none};
std::atomic<bool> ends_after_document{false};
static_assert(std::atomic<DocumentState>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

constexpr char document_of_second_signal[] =
    R"({"schema":"qchopper-error-1","error":"stopped by a second signal","unchanged":"What was saved is kept.",)"
    R"("to_do":"","remedy":null,"exit_code":130})"
    "\n";
static_assert(exit_interrupted == 130);

// A semaphore that a signal handler may post to, which those of the standard library promise not.
class WakeUp {
 public:
    WakeUp() { sem_init(&semaphore_, 0, 0); }
    void post() { sem_post(&semaphore_); }
    void wait() {
        while (sem_wait(&semaphore_) != 0 && errno == EINTR) {
        }
    }
    void wait_for(std::chrono::milliseconds time) {
        timespec until{};
        clock_gettime(CLOCK_REALTIME, &until);
        const long nanoseconds = until.tv_nsec + 1'000'000L * time.count();
        until.tv_sec += nanoseconds / 1'000'000'000L;
        until.tv_nsec = nanoseconds % 1'000'000'000L;
        while (sem_timedwait(&semaphore_, &until) != 0 && errno == EINTR) {
        }
    }

 private:
    sem_t semaphore_{};
};

WakeUp wake_up;

// Ends the process, unless a document is being printed: then the thread that prints it ends the process, or a third
// signal.
void end_in_handler() {
    DocumentState state = DocumentState::none;
    if (has_document && document_state.compare_exchange_strong(state, DocumentState::by_handler)) {
        const ssize_t ignored = ::write(STDOUT_FILENO, document_of_second_signal, sizeof document_of_second_signal - 1);
        static_cast<void>(ignored);
    }
    if (state == DocumentState::begun && !ends_after_document.exchange(true)) return;
    _exit(exit_interrupted);
}

// Only what may be done in a signal handler: atomics, clock_gettime, sem_post, write, _exit.
void on_signal(int number) {
    const int error = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (number == SIGINT && cancelled && now.tv_sec - first_signal_s <= 2) end_in_handler();
    first_signal_s = now.tv_sec;
    signal_number = number;
    cancelled = true;
    wake_up.post();
    errno = error;
}

// A terminal that was closed, or whose line was cut.
bool has_hung_up(int descriptor) {
    pollfd state{descriptor, 0, 0};
    return ::poll(&state, 1, 0) > 0 && (state.revents & (POLLHUP | POLLERR)) != 0;
}

bool is_plain_terminal() {
    const char* term = std::getenv("TERM");
    return isatty(STDERR_FILENO) != 0 && (term == nullptr || std::strcmp(term, "dumb") != 0);
}

// As time_left() says; nothing where that is empty.
std::optional<double> time_left_s(std::size_t done, std::size_t total, double elapsed_s) {
    constexpr double max_s = 99 * 3600;
    if (elapsed_s < 1 || done == 0 || done >= total) return {};
    const double left_s = elapsed_s * static_cast<double>(total - done) / static_cast<double>(done);
    if (left_s > max_s) return {};
    return left_s;
}

}  // namespace

std::string time_left(std::size_t done, std::size_t total, double elapsed_s) {
    const std::optional<double> left_s = time_left_s(done, total, elapsed_s);
    return left_s ? ", about " + duration(static_cast<std::uint32_t>(std::ceil(*left_s))) + " left" : std::string();
}

std::string progress_text(const Progress& progress) {
    const bool is_counted = progress.total > 0 && !progress.what.starts_with('%');
    return with_commas(progress.done) + (is_counted ? " of " + with_commas(progress.total) : std::string()) + " " +
           progress.what;
}

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before {};
    // Ignored by nohup, and then still.
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(SIGHUP, &action, nullptr);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

Terminal::Terminal(bool json)
    : json_(json),
      shows_progress_(is_plain_terminal()),
      watcher_([this](const std::stop_token& stop) { watch(stop); }) {
    for (int descriptor = 0; descriptor <= STDERR_FILENO; ++descriptor) {
        if (isatty(descriptor) != 0) terminals_.push_back(descriptor);
    }
    has_document = json;
}

Terminal::~Terminal() {
    begin_end();
}

void Terminal::set_unchanged(const std::string& sentence) {
    const std::lock_guard lock(changing_);
    unchanged_ = sentence;
}

std::string Terminal::unchanged() const {
    const std::lock_guard lock(changing_);
    return unchanged_;
}

void Terminal::end_when_stopped(std::function<void()> report) {
    const std::lock_guard lock(changing_);
    report_stop_ = std::move(report);
    wake_up.post();  // a signal may have come before
}

void Terminal::begin_end() {
    const std::lock_guard lock(changing_);  // held for good by end_at_once()
    is_ending_ = true;
    last_ = {};
}

void Terminal::watch(const std::stop_token& stop) {
    const std::stop_callback wake(stop, [] { wake_up.post(); });
    bool is_noticed = false;
    const auto ends_when_stopped = [this] {
        const std::lock_guard lock(changing_);
        return static_cast<bool>(report_stop_);
    };
    while (!stop.stop_requested()) {
        // Such as a console that was killed: its page shows the work no more, and could not stop it.
        if (!cancelled && ends_when_stopped() && has_lost_reader()) {
            signal_number = SIGHUP;
            cancelled = true;
        }
        if (cancelled && !is_noticed && ends_when_stopped()) {
            is_noticed = true;
            wake_up.wait_for(time_to_answer);
            const std::lock_guard lock(changing_);
            if (report_stop_ && !is_ending_) end_at_once();
        } else if (shows_progress_) {
            wake_up.wait_for(draw_again);
        } else {
            wake_up.wait();
        }
        const std::lock_guard lock(changing_);
        const auto now = Clock::now();
        const auto again = writes_lines_ ? write_again : draw_again;
        if (shows_progress_ && !last_.what.empty() && now - drawn_ >= again) draw_line(now);
    }
}

bool Terminal::has_lost_reader() const {
    const std::lock_guard lock(changing_);
    return writes_lines_ && has_hung_up(STDERR_FILENO);
}

void Terminal::end_at_once() {
    remove_unfinished_and_block();
    report_stop_();
    std::_Exit(cancel_code());
}

void Terminal::set_quiet() {
    const std::lock_guard lock(changing_);
    quiet_ = true;
    shows_progress_ = false;
}

void Terminal::set_progress_json() {
    const std::lock_guard lock(changing_);
    writes_lines_ = true;
    shows_progress_ = !quiet_;
    wake_up.post();  // from now on the watch is kept at intervals
}

void Terminal::set_timings() {
    timings_.emplace();
}

bool Terminal::is_cancelled() {
    return cancelled;
}

int Terminal::cancel_code() {
    return signal_number == SIGTERM ? exit_terminated : signal_number == SIGHUP ? exit_hung_up : exit_interrupted;
}

bool Terminal::is_gone() const {
    return has_lost_reader() || std::any_of(terminals_.begin(), terminals_.end(), has_hung_up);
}

bool Terminal::is_output_lost() {
    if (std::cout.flush()) return false;
    return !has_hung_up(STDOUT_FILENO);  // what read it, as head does, wanted no more
}

void Terminal::clear_line() {
    if (has_line_) std::cerr << "\r\033[K";
    has_line_ = false;
}

void Terminal::message(const std::string& line) {
    if (!quiet_) say(NoticeKind::message, line);
}

void Terminal::warn(const std::string& line) {
    say(NoticeKind::warning, line);
}

void Terminal::warn(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) warn(line);
}

void Terminal::error(const std::string& line) {
    say(NoticeKind::error, line);
}

void Terminal::say(NoticeKind kind, const std::string& line) {
    const std::lock_guard lock(changing_);
    clear_line();
    if (writes_lines_) {
        std::cerr << text_of(notice_document(kind, line)) << std::endl;
    } else {
        std::cerr << (kind == NoticeKind::warning ? "warning: " : "") << printable_lines(line) << std::endl;
    }
}

void Terminal::show(const std::vector<std::string>& lines, const Document& document) {
    begin_end();
    const std::lock_guard lock(changing_);
    std::optional<RunTimes> times;
    if (timings_) times = timings_->so_far();
    clear_line();
    if (json_) {
        json(times ? with_timings(document, *times) : document);
    } else {
        for (const std::string& line : lines) std::cout << printable_lines(line) << std::endl;
    }
    if (!times) return;
    for (const std::string& line : table(*times)) say(NoticeKind::message, line);
}

void Terminal::json(const Document& document) {
    if (!json_) return;
    while (document_state.exchange(DocumentState::begun) == DocumentState::by_handler)
        pause();  // the process is ending
    std::cout << text_of(document) << std::endl;
    document_state = DocumentState::printed;
    if (ends_after_document) _exit(exit_interrupted);
}

void Terminal::progress(const Progress& progress) {
    if (!shows_progress_) return;
    const std::lock_guard lock(changing_);
    const auto now = Clock::now();
    if (last_.what != progress.what || progress.done < last_.done) {  // other work, or the same once more
        started_ = now;
        done_at_start_ = progress.done;
        drawn_ = {};
    }
    last_ = progress;
    const bool is_last = progress.total > 0 && progress.done >= progress.total;
    if (!is_last && now - drawn_ < draw_every) return;
    draw_line(now);
    if (is_last) clear_line();
}

void Terminal::draw_line(Clock::time_point now) {
    drawn_ = now;
    const std::size_t total_left = last_.total > done_at_start_ ? last_.total - done_at_start_ : 0;
    const double elapsed_s = std::chrono::duration<double>(now - started_).count();
    if (writes_lines_) {
        ProgressState state{last_.what, last_.done, {}, std::round(10 * elapsed_s) / 10, {}};
        if (last_.total > 0) state.total = last_.total;
        state.left_s = time_left_s(last_.done - done_at_start_, total_left, elapsed_s);
        if (state.left_s) state.left_s = std::ceil(*state.left_s);
        std::cerr << text_of(document(state)) << std::endl;
        return;
    }
    const std::string line = progress_text(last_) + "  " + fixed(std::floor(elapsed_s), 0) + " s" +
                             time_left(last_.done - done_at_start_, total_left, elapsed_s);
    winsize size{};
    const std::size_t width = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 10 ? size.ws_col - 1U : 79;
    clear_line();
    std::cerr << line.substr(0, width) << std::flush;
    has_line_ = true;
}

ProjectContext Terminal::context() {
    ProjectContext context;
    context.cancelled = &cancelled;
    context.timings = timings_ ? &*timings_ : nullptr;
    context.on_progress = [this](const Progress& p) { progress(p); };
    context.on_message = [this](const std::string& line) { message(line); };
    context.on_warning = [this](const Sentence& line) { warn(command_line_text(line)); };
    context.on_saved = [this](const Sentence& sentence) { set_unchanged(command_line_text(sentence)); };
    return context;
}

}  // namespace qchopper

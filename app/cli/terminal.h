// Output of the program: results on stdout, messages on stderr, progress with counts and the time left on a terminal,
// or as JSON. And the answer to Ctrl-C, also while work does not look for it.
//
// A thread of its own keeps the time in the progress line moving and watches for Ctrl-C; its users are one thread.

#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/report/notices.h"
#include "app/store/project_context.h"
#include "base/timings.h"

namespace qchopper {

// ", about 12 s left", for work whose items take the same time each. Empty in the first second, where `total` is not
// known (0), before the first item is done, after the last one, and for more than 99 hours. Precondition: elapsed_s >=
// 0.
std::string time_left(std::size_t done, std::size_t total, double elapsed_s);

// "2,351 of 10,560 planes evaluated"; of per cent the total is no news: "23 % of the job".
std::string progress_text(const Progress& progress);

class Terminal {
 public:
    // With `json`, stdout holds exactly one JSON document.
    explicit Terminal(bool json);
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    // A line for the operator, on stderr. Messages are left out when quiet, warnings and errors never.
    void message(const std::string& line);
    void warn(const std::string& line);
    void warn(const std::vector<std::string>& lines);
    void error(const std::string& line);
    // The result of a command, on stdout: the document with --json, else the lines. With timings a table of them
    // follows on stderr, and the document has a key for them.
    void show(const std::vector<std::string>& lines, const Document& document);
    // The one JSON document, on stdout; left out without --json.
    void json(const Document& document);

    void set_quiet();
    // From now on stderr holds a JSON document a line: how far work is, messages, warnings and errors
    // (docs/user/troubleshooting.md). Where its reader is gone, what end_when_stopped() allows is stopped as by SIGHUP.
    void set_progress_json();
    // From now on contexts measure the time of stages.
    void set_timings();

    // One sentence for the message of an error: what is unchanged or kept on disk; "Nothing was written." at first.
    void set_unchanged(const std::string& sentence);
    std::string unchanged() const;

    // From now on a stop that is not answered at once ends the process: unfinished files are removed (unfinished.h),
    // `report` prints why, and no destructor runs. For commands that a kill at any moment does not harm; not for those
    // that lead a milling cell.
    void end_when_stopped(std::function<void()> report);
    // The program is about to report its end itself. Does not return if that has been done meanwhile.
    void begin_end();

    // Shows progress in the terminal's last line, messages and warnings as above, and stores what is saved by
    // set_unchanged(). With the timings, if they are set. Cancelled by Ctrl-C and SIGTERM. Valid while this object
    // lives.
    ProjectContext context();
    static bool is_cancelled();
    // The exit code for the last signal: 130, 143 for SIGTERM, 129 for SIGHUP.
    static int cancel_code();
    // One of standard input, output and error was a terminal at first, and that terminal is gone; or the reader of
    // --progress json is.
    bool is_gone() const;
    // Something that was printed on stdout could not be written: the disk is full, or a limit of its size is reached.
    static bool is_output_lost();

 private:
    using Clock = std::chrono::steady_clock;

    void say(NoticeKind kind, const std::string& line);
    void progress(const Progress& progress);
    void draw_line(Clock::time_point now);
    void clear_line();
    void watch(const std::stop_token& stop);
    void end_at_once();
    bool has_lost_reader() const;

    // Recursive, because the report of a stop is printed by the public functions.
    mutable std::recursive_mutex changing_;

    bool json_;
    bool quiet_ = false;
    bool writes_lines_ = false;  // --progress json
    std::atomic<bool> shows_progress_;
    bool has_line_ = false;
    std::optional<Timings> timings_;
    std::string unchanged_ = "Nothing was written.";
    Progress last_;                  // progress; without a name if no work is under way
    std::size_t done_at_start_ = 0;  // when this work was first reported, at started_
    Clock::time_point started_;
    Clock::time_point drawn_;
    std::function<void()> report_stop_;  // empty: a stop waits until work looks for it
    bool is_ending_ = false;
    std::vector<int> terminals_;
    std::jthread watcher_;  // the last member: it ends before the others
};

// From now on Ctrl-C, SIGTERM and SIGHUP cancel long work, and a second Ctrl-C within 2 s ends the program at once,
// with
// --json after one whole document. SIGPIPE and SIGXFSZ are ignored: the write fails.
void catch_signals();

}  // namespace qchopper

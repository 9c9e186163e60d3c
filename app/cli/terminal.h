// Output of the program: results on stdout, messages on stderr, progress with counts and the time left on a terminal
// only.
//
// Not for several threads at once.

#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project_context.h"
#include "base/timings.h"

namespace qchopper {

// ", about 12 s left", for work whose items take the same time each. Empty in the first second, where `total` is not
// known (0), before the first item is done, after the last one, and for more than 99 hours. Precondition: elapsed_s >=
// 0.
std::string time_left(std::size_t done, std::size_t total, double elapsed_s);

class Terminal {
 public:
    // With `json`, stdout holds exactly one JSON document.
    explicit Terminal(bool json);
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    // A line for the operator, on stderr. Messages are left out when quiet, warnings and errors never.
    void message(const std::string& line);
    void warn(const std::string& line);
    void warn(const std::vector<std::string>& lines);
    void error(const std::string& line);
    // The result of a command, on stdout: the document with --json, else the lines. With timings a table of them
    // follows on stderr, and the document has a key for them.
    void show(const std::vector<std::string>& lines, const std::string& document);
    // The one JSON document, on stdout; left out without --json.
    void json(const std::string& document);

    void set_quiet();
    // From now on contexts measure the time of stages.
    void set_timings();

    // One sentence for the message of an error: what is unchanged or kept on disk.
    std::string unchanged = "Nothing was written.";

    // Shows progress in the terminal's last line, messages and warnings as above, and stores what is saved in
    // `unchanged`. With the timings, if they are set. Cancelled by Ctrl-C and SIGTERM. Valid while this object lives.
    ProjectContext context();
    static bool is_cancelled();
    // The exit code for the last signal: 130, or 143 for SIGTERM.
    static int cancel_code();

 private:
    void progress(const Progress& progress);
    void clear_line();

    bool json_;
    bool quiet_ = false;
    bool shows_progress_;
    bool has_line_ = false;
    std::optional<Timings> timings_;
    std::string what_;  // of the last progress
    std::size_t done_ = 0;
    std::size_t done_at_start_ = 0;  // when this work was first reported, at started_
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point drawn_;
};

// From now on Ctrl-C and SIGTERM cancel long work, a second Ctrl-C within 2 s ends the program at once, and SIGPIPE is
// ignored.
void catch_signals();

}  // namespace qchopper

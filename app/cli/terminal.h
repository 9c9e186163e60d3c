// How the program speaks: results on stdout, words on stderr, progress with counts on a terminal only.

#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "base/context.h"

namespace qchopper {

class Terminal {
 public:
    explicit Terminal(bool json);
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    // A line for the operator, on stderr. Plain ones are left out when quiet.
    void say(const std::string& line);
    void warn(const std::string& line);
    void warn(const std::vector<std::string>& lines);
    void error(const std::string& line);
    // A result for the operator, on stdout; left out with --json.
    void show(const std::string& text);
    void show(const std::vector<std::string>& lines);
    // The one JSON document, on stdout; left out without --json.
    void json(const std::string& document);

    bool is_json() const { return json_; }
    void be_quiet();

    // For errors: what is unchanged. Commands set it as soon as there is something to keep.
    std::string unchanged = "Nothing was written.";

    // Progress goes to the terminal's last line; cancelled by Ctrl-C and SIGTERM.
    Context context();
    static bool is_cancelled();
    // The exit code for the signal that came: 130 or 143.
    static int cancel_code();

 private:
    void progress(const Progress& progress);
    void clear_line();

    bool json_;
    bool quiet_ = false;
    bool shows_progress_;
    bool has_line_ = false;
    std::string what_;
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point drawn_;
};

// Ctrl-C and SIGTERM ask long work to stop; a second Ctrl-C within 2 s ends at once.
void catch_signals();

}  // namespace qchopper

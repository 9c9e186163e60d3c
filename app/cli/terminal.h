// Output of the program: results on stdout, messages on stderr, progress with counts on a terminal only.
//
// Not for several threads at once.

#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "app/project/project_context.h"

namespace qchopper {

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
    // The result of a command, on stdout: the document with --json, else the lines.
    void show(const std::vector<std::string>& lines, const std::string& document);
    // The one JSON document, on stdout; left out without --json.
    void json(const std::string& document);

    void set_quiet();

    // One sentence for the message of an error: what is unchanged or kept on disk.
    std::string unchanged = "Nothing was written.";

    // Shows progress in the terminal's last line, messages and warnings as above, and stores what is saved in
    // `unchanged`. Cancelled by Ctrl-C and SIGTERM. Valid while this object lives.
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
    std::string what_;
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point drawn_;
};

// From now on Ctrl-C and SIGTERM cancel long work, a second Ctrl-C within 2 s ends the program at once, and SIGPIPE is
// ignored.
void catch_signals();

}  // namespace qchopper

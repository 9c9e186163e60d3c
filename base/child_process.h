// Other programs: run to their end for what they say, or beside this one (tests/base/child_process_test.cpp).

#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace qchopper {

struct ChildOutput {
    int code = 0;  // its exit code; 127 if there is no such program, 128 + signal if it was killed
    std::string out;
    std::string err;
};

// `words` are the program, searched in PATH, and its arguments; its standard input is empty. It is killed after the
// limit. Precondition: there is a word. Throws std::system_error if no process can be made.
ChildOutput run_child(const std::vector<std::string>& words, std::chrono::milliseconds limit);

// A program that runs beside this one, with both outputs at the end of a file.
class Child {
 public:
    // Words as above. Throws std::system_error if no process can be made, or the file cannot be opened.
    Child(const std::vector<std::string>& words, const std::filesystem::path& output);
    // Kills it if it still runs.
    ~Child();
    Child(Child&& other) noexcept;
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    Child& operator=(Child&&) = delete;

    // As ChildOutput::code; nothing while it runs.
    std::optional<int> code();
    // Sends SIGTERM.
    void stop();

 private:
    int process_ = 0;
    std::optional<int> code_;
};

// Starts a program that goes on when this one ends, in a session of its own, with both outputs at the end of a file;
// returns its number. Words and errors as those of Child; 0 if there is no such program.
int start_detached(const std::vector<std::string>& words, const std::filesystem::path& output);
// The exit code of a program that start_detached() has started in this process; nothing while it runs, or if it was
// another process that started it.
std::optional<int> code_of_detached(int process);

// A program that is spoken to line by line. Functions may be called from several threads, each by one at a time.
class TalkingChild {
 public:
    struct Line {
        std::string text;       // without its end
        bool is_error = false;  // from its standard error
    };

    // Words as of run_child(). Throws std::system_error if no process can be made.
    explicit TalkingChild(const std::vector<std::string>& words);
    // Kills it if it still runs.
    ~TalkingChild();
    TalkingChild(const TalkingChild&) = delete;
    TalkingChild& operator=(const TalkingChild&) = delete;

    // To its standard input; false if that is closed.
    bool write_line(const std::string& line);
    // The next line that it has written; nothing if there is none within the limit, or it has ended.
    std::optional<Line> read_line(std::chrono::milliseconds limit);
    // Whether both outputs are closed and all that was written is read.
    bool has_ended() const { return is_closed_; }
    // As ChildOutput::code; waits for its end.
    int code();
    void stop();  // SIGTERM
    void kill();  // SIGKILL

 private:
    struct Ends;
    void signal(int number);

    std::unique_ptr<Ends> ends_;
    std::mutex reaping_;
    int process_ = 0;  // 0: it has ended, and its number may be another's
    std::optional<int> code_;
    std::atomic<bool> is_closed_ = false;
};

}  // namespace qchopper

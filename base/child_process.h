// Other programs: run to their end for what they say, or beside this one (tests/base/child_process_test.cpp).

#pragma once

#include <chrono>
#include <filesystem>
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

}  // namespace qchopper

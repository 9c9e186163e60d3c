// Runs the real program in a process of its own, and what the tests of it share.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/folder.h"

namespace qchopper::program {

using qchopper::Folder;

using Arguments = std::vector<std::string>;

struct RunOptions {
    std::filesystem::path folder;                 // where it runs
    std::string input = {};                       // what stdin holds; then it ends
    bool one_core = false;                        // may use one core only
    std::filesystem::path temporary_folder = {};  // TMPDIR; empty: as here
    std::uint64_t largest_file = 0;               // bytes of a file that it may write; 0: no limit
    bool has_terminal = false;                    // stdin is a terminal on which the input is typed
};

struct Ended {
    int code = -1;        // exit code
    int killed_by = 0;    // signal that ended it; 0: it ended by itself
    bool in_time = true;  // false: it was killed because it took too long
    std::string out;
    std::string err;
};

class Process {
 public:
    Process(const Arguments& arguments, const RunOptions& options);
    ~Process();  // kills it
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const;
    // Until it has installed its handlers of SIGINT and SIGTERM.
    bool waits_until_signals_are_caught();
    // Until the text is on stdout or stderr; false if the program ends before or it takes too long.
    bool waits_until_out(const std::string& text, double seconds = 120);
    bool waits_until_err(const std::string& text, double seconds = 120);
    bool waits_until_there(const std::filesystem::path& file, double seconds = 120);
    Ended wait(double seconds = 240);
    std::string out() const;
    std::string err() const;

 private:
    bool has_ended();

    Folder streams_;
    int keyboard_ = -1;  // the other end of the terminal on stdin
    pid_t pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
};

// Fails where a document other than that of an error names an option.
Ended run(const Arguments& arguments, const RunOptions& options);
// Waits until a cell-sim says where it listens: HOST:PORT, or "" and a failed test.
std::string address_of(Process& cell);

// Every file and folder in a folder with its bytes.
using Contents = std::map<std::string, std::string>;
Contents contents(const std::filesystem::path& folder);
// The names of those that are in one only, or differ: "+new -gone !changed"; empty if there are none.
std::string difference(const Contents& before, const Contents& after);
std::string bytes_in(const std::filesystem::path& file);
void put(const std::filesystem::path& file, const std::string& bytes);

// The cell file that comes with the project.
std::filesystem::path foam_cell();
// A folder with scan.ply (vertebra, 3,000 faces) and scan.qch, prepared with two cuts by the preset thesis, of which
// every piece has several caps and much out of reach. Only read. ctest makes it once for all suites and names it in
// QCHOPPER_PREPARED; without that it is made once per process.
const std::filesystem::path& prepared();
void make_prepared(const std::filesystem::path& folder);
// The arguments of prepare for it, without the output.
Arguments prepare_arguments(const std::string& scan);

}  // namespace qchopper::program

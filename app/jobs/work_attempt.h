// What becomes of each attempt to make the programs of an item: a file of its own beside the results, which is written
// again while the work goes on and tells after a kill where it stood.
//
// Files attempts/RESULT-HOST-PROCESS-NUMBER.json (docs/developer/formats/work-folder.md). Nothing depends on them but
// what people are told, and which pieces are not tried again (tests/app/jobs/work_attempt_test.cpp).

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/files/unfinished.h"

namespace qchopper {

enum class AttemptState : std::uint8_t { at_work, made, failed };

struct WorkAttempt {
    std::string piece;
    AttemptState state = AttemptState::at_work;
    std::string stage;    // what it did last, as progress says
    std::string because;  // of `failed`
    std::string host;
    std::uint64_t process = 0;
    std::string libraries;            // that bytes of results depend on: png_libraries()
    double process_cpu_s = 0;         // of the process and all that it has made
    std::uint64_t process_bytes = 0;  // its peak memory
};

// One attempt, from its beginning on. Its file goes if it is not ended, and if the program is stopped by a signal: only
// what was killed leaves one that says "at work". Failing to write throws as write_file does.
class AttemptRecord {
 public:
    // `result` is the name of the file that is to be made, `attempts` the folder, which is made.
    AttemptRecord(std::string piece, const std::string& result, const std::filesystem::path& attempts);

    ~AttemptRecord();
    AttemptRecord(const AttemptRecord&) = delete;
    AttemptRecord& operator=(const AttemptRecord&) = delete;

    // The same context, of which each report of progress counts as a sign of life: every five seconds it is written, or
    // after one where a new stage begins. The record must outlive it. Called from one thread at a time.
    Context watched(const Context& context);

    void end(AttemptState state, const std::string& because = {});

 private:
    void write();

    WorkAttempt attempt_;
    std::filesystem::path file_;
    std::optional<Unfinished> unfinished_;
    std::chrono::steady_clock::time_point written_;
};

struct SeenAttempt {
    WorkAttempt attempt;
    double age_s = 0;        // of its last sign of life, by the clocks of this machine and of the files
    bool has_ended = false;  // nobody goes on with it: it says so, or its process is not there, as far as is known
};

// Of the result of a name, those that can be read; the others are passed over. An attempt `at_work` on another host
// that has given no sign of life for two minutes counts as ended. By file name. O(files in the folder).
std::vector<SeenAttempt> attempts_at(const std::string& result, const std::filesystem::path& attempts);

// How many of them have ended without a result.
std::size_t failures(const std::vector<SeenAttempt>& attempts);

}  // namespace qchopper

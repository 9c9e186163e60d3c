// How a hand-off ended.
//
// Seconds. devices/hand_off/dispatch.h defines STARTED, NOT STARTED and UNKNOWN.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/sentence.h"
#include "cam/job/ticket.h"
#include "devices/wire/codes.h"

namespace qchopper {

enum class StartOutcome { started, not_started, unknown };

// STARTED, NOT STARTED, UNKNOWN: ask the cell.
constexpr const char* describe(StartOutcome start_outcome) {
    constexpr const char* texts[] = {"STARTED", "NOT STARTED",
                                     "UNKNOWN: ask the cell"};  // in the order of StartOutcome
    return texts[static_cast<std::size_t>(start_outcome)];
}

// What the hand-off itself finds.
struct HandOffEnd {
    StartOutcome start_outcome = StartOutcome::unknown;
    AckResult refusal = AckResult::none;  // the result with which the cell refused the job
    bool cancelled = false;               // ended because the caller asked to stop
    bool store_is_lost = false;           // CELL_STORE_LOST
    double elapsed_s = 0;                 // of the job, counted by the cell
    std::string why;                      // one sentence: how it ended
    Sentence to_do;                       // may be empty
};

struct JobOutcome : HandOffEnd {
    JobState job_state = JobState::none;     // the last one read, of this job
    JobResult job_result = JobResult::none;  // complete: the cell milled the job to its end
    Uuid job_id{};
    std::uint32_t starts = 0;      // STARTS in the cell's RESULT for this job: 0 or 1
    bool starts_known = false;     // that RESULT was read
    bool milled_before = false;    // not started, because the cell has started a job with this file before
    bool milled_complete = false;  // and the last of these ended complete
    bool may_be_milled = false;    // not started, because whether the cell has milled this file is UNKNOWN
    std::uint16_t cell_id = 0;
    bool simulated = false;
    double took_s = 0;             // of the whole hand-off
    std::vector<std::string> log;  // the steps, one line each

    // Nothing is left to look at: not if the cell lost its memory, whatever became of the job.
    bool is_complete() const {
        return start_outcome == StartOutcome::started && job_state == JobState::ended &&
               job_result == JobResult::complete && !store_is_lost;
    }
};

}  // namespace qchopper

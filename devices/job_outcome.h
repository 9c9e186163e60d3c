// How a hand-off ended.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cam/job/ticket.h"
#include "devices/codes.h"

namespace qchopper {

enum class StartVerdict { started, not_started, unknown };

// STARTED, NOT STARTED, UNKNOWN: ask the cell.
const char* describe(StartVerdict verdict);

struct JobOutcome {
    StartVerdict verdict = StartVerdict::unknown;
    JobState job_state = JobState::none;     // last known
    JobResult job_result = JobResult::none;  // complete: the cell carved the job to its end
    Uuid job_id{};
    std::uint32_t starts = 0;             // STARTS of the cell's own RESULT for this job: 0 or 1
    bool starts_known = false;            // the RESULT was read at the end
    AckResult refusal = AckResult::none;  // what the cell answered when it refused
    bool cancelled = false;               // ended because the caller asked
    std::uint16_t cell_id = 0;
    bool simulated = false;
    double elapsed_s = 0;          // of the job, as the cell counts
    double took_s = 0;             // of the whole hand-off, by our clock
    std::string why;               // one sentence: how it ended
    std::string to_do;             // one sentence, may be empty
    std::vector<std::string> log;  // the steps, one line each

    bool is_complete() const {
        return verdict == StartVerdict::started && job_state == JobState::ended && job_result == JobResult::complete;
    }
};

}  // namespace qchopper

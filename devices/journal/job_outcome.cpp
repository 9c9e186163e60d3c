// One name for each verdict. O(1).

#include "devices/journal/job_outcome.h"

namespace qchopper {

const char* describe(StartOutcome start_outcome) {
    constexpr const char* texts[] = {"STARTED", "NOT STARTED",
                                     "UNKNOWN: ask the cell"};  // in the order of StartOutcome
    return texts[static_cast<std::size_t>(start_outcome)];
}

}  // namespace qchopper

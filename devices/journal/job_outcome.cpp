// One name for each verdict. O(1).

#include "devices/journal/job_outcome.h"

namespace qchopper {

const char* describe(StartVerdict verdict) {
    constexpr const char* texts[] = {"STARTED", "NOT STARTED",
                                     "UNKNOWN: ask the cell"};  // in the order of StartVerdict
    return texts[static_cast<std::size_t>(verdict)];
}

}  // namespace qchopper

// The result of dry-run and dispatch: a table for people, one JSON document for programs. O(jobs).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"
#include "app/dispatch/restart_dispatch.h"
#include "app/report/document.h"

namespace qchopper {

struct DispatchReport {
    std::vector<DispatchedJob> handed;
    std::size_t wanted = 0;         // jobs to be handed over; handed has at most as many
    bool is_simulated = false;      // the cell
    std::vector<Sentence> refused;  // why none was sent (unreachable_jobs), or empty
    Sentence next;                  // what comes next, if all ended complete; may be empty
    std::optional<MadeRestart> restart = {};
    // All jobs that are wanted ended complete, now or before.
    bool is_complete() const;
    bool is_cancelled() const;
};

std::vector<std::string> lines(const DispatchReport& report);
// `schema`: "qchopper-dry-run-2" or "qchopper-dispatch-2".
Document document(const DispatchReport& report, const std::string& schema);

}  // namespace qchopper

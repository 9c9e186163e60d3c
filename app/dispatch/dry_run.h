// Hands the jobs of a project to a simulated cell in this process, over TCP.
//
// What dispatch would refuse is warned of and rehearsed all the same; of an unfinished project the jobs that are
// written so far. The user's journals are never touched (tests/app/cli/dispatch_jobs_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"
#include "app/store/project_context.h"

namespace qchopper {

struct DryRunRequest {
    std::filesystem::path project;
    std::optional<std::string> piece;  // nothing: all
    double speed = 100'000;            // simulated seconds per second
};

struct DryRunAnswer {
    std::vector<DispatchedJob> handed;
    std::size_t wanted = 0;  // jobs to be handed over
    // To hand the jobs to a cell, what the cell file does not tell in capitals, for a person to fill in; empty if
    // dispatch would refuse one.
    Sentence next;
};

// Throws what jobs_of and dispatch_jobs throw.
DryRunAnswer dry_run(const DryRunRequest& request, const ProjectContext& context);

}  // namespace qchopper

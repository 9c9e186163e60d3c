// What would be handed to a cell, and what speaks against it, before anything is sent.
//
// The hand-off checks all of it again (dispatch_project.h), and more: this is what a person sees before deciding.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/vec3.h"

namespace qchopper {

struct PlanOrder {
    std::vector<std::string> pieces;  // empty: all
    bool is_for_real_cell = false;
    bool is_again = false;  // also what the cell has carved before
    bool accept_unreachable = false;
};

struct PlannedJob {
    std::string piece;
    std::uint16_t part = 1;
    std::uint16_t parts = 1;
    std::string file;  // its name in the folder jobs
    std::string job;   // the SHA-256 of that file
    Vec3 block;        // mm
    double time_s = 0;
    bool is_proven = false;
};

struct DispatchPlan {
    std::string cell;  // its name
    std::vector<PlannedJob> jobs;
    std::vector<std::string> refused;  // sentences; empty: the jobs may be handed over
};

// Throws what jobs_of throws (app/dispatch/dispatch_jobs.h); InputError (use) for a piece without a job.
DispatchPlan plan_dispatch(const std::filesystem::path& project, const PlanOrder& order, const Context& context);

}  // namespace qchopper

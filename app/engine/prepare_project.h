// The whole way from a scan, or from a project that is not finished, to pieces, jobs and pictures.
//
// After every round the best segmentation is saved; an interrupted run goes on with prepare_project and ends with the
// same bytes (tests/app/cli/same_bytes_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/engine/discard_request.h"
#include "app/engine/make_project.h"

namespace qchopper {

struct PrepareOptions {
    std::string program_version;         // is written into the jobs
    std::optional<double> time_limit_s;  // of all cutting; the round that is being made is finished
    // Whether jobs get robot programs, where the cell allows it, from now on; nothing: as the project says, and those
    // of a new one do.
    std::optional<bool> has_programs = {};
    std::optional<DiscardRequest> discard = {};  // decided before the search
    bool has_items = false;                      // whether items are written in place of jobs (work_project.h)
};

// Makes a project of a scan. Without a stop rule in the choices, or with those of the preset carve, every piece must
// fit the cell. Precondition: choices.cell_file is given. Throws what draft_project and make_project throw, InputError
// (mesh) for a scan that holds nothing but fragments, and Cancelled.
PreparedProject prepare_scan(const ProjectChoices& choices, const PrepareOptions& options,
                             const ProjectContext& context);

// Goes on with a project. Throws what LockedProject throws, InputError (use) for a project without a cell, what the
// import of its scan throws, and Cancelled.
PreparedProject prepare_project(const std::filesystem::path& folder,
                                const std::optional<std::filesystem::path>& cell_file, const PrepareOptions& options,
                                const ProjectContext& context);

}  // namespace qchopper

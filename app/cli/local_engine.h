// The items of a project made by several processes on this machine (qchopper submit --engine local).

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/cli/terminal.h"
#include "app/engine/work_project.h"

namespace qchopper {

struct LocalLimits {
    std::optional<std::size_t> processes;  // nothing: as many as processors
    double bytes = 0;                      // of memory for all together; 0: four fifths of what is free
    bool has_retry = false;                // as WorkOptions::has_retry
};

// How many processes may make the items that are left at once: the largest of them fit into the memory together, but
// one process always runs. Precondition: processes > 0, bytes > 0.
std::size_t processes_for(const std::vector<ItemEstimate>& items, std::size_t processes, double bytes);

// Runs a process of `work` for each shard to its end; outputs go to work/local-I.log, and a process that ends otherwise
// than well is warned of. Throws Cancelled when the program is to stop, after they have.
void work_locally(const std::filesystem::path& project, const std::vector<ItemEstimate>& items,
                  const LocalLimits& limits, Terminal& terminal);

}  // namespace qchopper

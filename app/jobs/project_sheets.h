// The setup sheets of a project's jobs as one document, sheets.html in its folder.
//
// Never stale, as the jobs are: it is removed when one of them changes and written when they are
// (tests/app/cli/sheets_test.cpp).

#pragma once

#include <filesystem>

#include "app/store/project.h"
#include "base/context.h"

namespace qchopper {

// Reads the recorded jobs, one at a time. Throws what read_job, parse_job, read_verdict and write_file throw.
void write_sheets(const std::filesystem::path& folder, const Project& project, const Context& context);

void remove_sheets(const std::filesystem::path& folder);

}  // namespace qchopper

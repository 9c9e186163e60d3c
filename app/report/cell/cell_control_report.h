// What `qchopper cell` shows: what the cell says of itself, how it answered a command, or what deviates. O(rules).

#pragma once

#include <string>
#include <vector>

#include "app/dispatch/cell_commands.h"
#include "app/report/document.h"
#include "devices/link_check/link_check.h"

namespace qchopper {

std::vector<std::string> lines(const CellStatusReport& report);
Document document(const CellStatusReport& report);

std::vector<std::string> lines(const CellControlReport& report);
Document document(const CellControlReport& report);

// What `qchopper cell check` found.
struct LinkCheckReport {
    std::string endpoint;
    LinkCheck check;
};

std::vector<std::string> lines(const LinkCheckReport& report);
Document document(const LinkCheckReport& report);

}  // namespace qchopper

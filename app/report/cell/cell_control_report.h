// What `qchopper cell` shows: what the cell says of itself, or how it answered a command. O(1).

#pragma once

#include <string>
#include <vector>

#include "app/dispatch/cell_commands.h"
#include "app/report/document.h"

namespace qchopper {

std::vector<std::string> lines(const CellStatusReport& report);
Document document(const CellStatusReport& report);

std::vector<std::string> lines(const CellControlReport& report);
Document document(const CellControlReport& report);

}  // namespace qchopper

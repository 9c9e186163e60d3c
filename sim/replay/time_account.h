// Where the machine time of a program goes: by kind of operation and tool, and in these by what the machine does.
//
// Seconds, mm, mm3. Times are those of path_time.h, the foam is that of mill_stock.h. A line counts for the chunk that
// it stands in; a joint move between chunks for the one before it, a tool change for the first one with the tool. The
// rows add up to the time, the length and the volume of the whole (tests/sim/replay/time_account_test.cpp, which holds
// the times against a script that reads the text on its own).

#pragma once

#include <vector>

#include "cam/cell/cell.h"
#include "cam/cell/machine_time.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/path_time.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// One row for each of ToolPath::uses. Preconditions: `time` and `milling` are of the path, its tools are those of the
// machine. O(lines).
std::vector<MachineTime> account_of(const ToolPath& path, const PathTime& time, const MillingFigures& milling,
                                    const CellMachine& machine);

}  // namespace qchopper

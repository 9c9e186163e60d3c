// A ready cell as a piece is planned in it that short tools mill: without the long ones of a kind.

#pragma once

#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

inline Cell with_short_tools(Cell cell) {
    constexpr double longest = 200;  // mm
    if (cell.machine) {
        std::erase_if(cell.machine->tools, [](const CuttingTool& tool) { return tool.stick_out > longest; });
    }
    return cell;
}

}  // namespace qchopper

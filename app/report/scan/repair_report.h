// The result of repair: lines for people, one JSON document for programs. O(holes + places).

#pragma once

#include <string>
#include <vector>

#include "app/engine/repair_file.h"
#include "app/report/document.h"

namespace qchopper {

// A line for each step that changed something, the distance, the volume and a verdict.
std::vector<std::string> lines(const RepairedScan& scan, const RepairRequest& request);
// The document qchopper-repair-3 (docs/user/repair.md).
Document document(const RepairedScan& scan, const RepairRequest& request);

}  // namespace qchopper

// Whether a tool removes foam faster than the cell file allows it.
//
// mm, mm3/s. The rate is that of a way as long as the tool is wide, at the feeds that the program states: slower
// corners are not counted. Of drills the feed window is the bound, because they cut their own section alone. O(lines)
// (tests/sim/replay/removal_rate_test.cpp).

#pragma once

#include <vector>

#include "sim/replay/finding.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/scene.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// A rate of so much more than the tool's is a finding: cells and rounded corners move foam from line to line.
constexpr double removal_tolerance = 0.1;

// `cuts` are those of the lines of the path. Finds FindingKind::removal_rate.
void check_removal_rate(const ToolPath& path, const std::vector<LineCut>& cuts, const ReplayScene& scene,
                        FindingLog& log);

}  // namespace qchopper

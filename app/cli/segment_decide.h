// The decisions of segment on an open project: each takes what was typed and gives an answer.

#pragma once

#include "app/cli/arguments.h"
#include "app/cli/terminal.h"
#include "app/project/open_project.h"
#include "app/report/segment_report.h"

namespace qchopper {

// Does what the arguments say, the new weights first. Throws InputError (use) for what this project does not have: a
// piece of that name, a place in the ranking, a stop rule to go on to.
SegmentAnswer decide(OpenProject& project, const SegmentArguments& arguments, const FitsCell& fits_cell,
                     Terminal& terminal);

}  // namespace qchopper

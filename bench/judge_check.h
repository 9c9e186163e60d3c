// Holds the judge of reach_judge.h against a shape whose area out of reach is known exactly.

#pragma once

#include <iosfwd>

namespace qchopper::bench {

// A long block with a slot along its side, lying on a cap: a table of what the judge finds out of reach, in mm2 per mm
// of length, beside the exact figure, at 45 to 80 degrees.
void print_judge_check(std::ostream& out);

}  // namespace qchopper::bench

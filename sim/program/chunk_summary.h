// What a manifest says of a chunk, as parsed back from its text.
//
// mm, in the coordinates of $BASE, which are setup coordinates. O(steps) (tests/sim/program/chunk_summary_test.cpp).

#pragma once

#include <vector>

#include "base/box.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

struct ChunkSummary {
    std::string file;
    std::size_t moves = 0;  // PTP and LIN
    double length = 0;      // of the LIN but those from the end of a PTP
    Box box;                // of the ends of LIN; empty of a chunk without any: the origin
    Vec3 first;             // end of the first LIN
    Vec3 last;              // end of the last one
    bool operator==(const ChunkSummary&) const = default;
};

// Of all chunks but the main program, in the order of execution.
std::vector<ChunkSummary> summarise_chunks(const ParsedProgram& program);

}  // namespace qchopper

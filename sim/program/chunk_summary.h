// What a manifest says of a chunk, as parsed back from its text.
//
// mm, in the coordinates of $BASE, which are setup coordinates. O(steps) (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <vector>

#include "base/box.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

struct ChunkSummary {
    std::string file;
    std::size_t moves = 0;  // rapid and straight
    double length = 0;      // of the straight moves but those from the end of a rapid
    Box box;                // of the ends of straight moves; empty of a chunk without any: the origin
    Vec3 first;             // end of the first straight move
    Vec3 last;              // end of the last one
    bool operator==(const ChunkSummary&) const = default;
};

// Of all chunks but the main program, in the order of execution.
std::vector<ChunkSummary> summarise_chunks(const ParsedProgram& program);

}  // namespace qchopper

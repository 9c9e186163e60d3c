// Where the time of a command went: a table for people, a key of its document for programs. O(stages + document).

#pragma once

#include <string>
#include <vector>

#include "base/timings.h"

namespace qchopper {

// A row per stage with its share of the wall time, what is in no stage, the whole, and the peak memory.
std::vector<std::string> table(const RunTimes& times);

// The document with one key more: "timings": { stages: [ { name, wall_s, cpu_s } ... ], wall_s, cpu_s,
// peak_memory_bytes }. Precondition: it is a JSON object. A document of one line stays one.
std::string with_timings(const std::string& document, const RunTimes& times);

}  // namespace qchopper

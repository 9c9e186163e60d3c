// Where the time of a command went: a table for people, a key of its document for programs. O(stages + document).

#pragma once

#include <string>
#include <vector>

#include "app/report/document.h"
#include "base/timings.h"

namespace qchopper {

// A row per stage with its share of the wall time, what is in no stage, the whole, and the peak memory.
std::vector<std::string> table(const RunTimes& times);

// The document with one key more: "timings": { stages: [ { name, wall_s, cpu_s } ... ], wall_s, cpu_s,
// peak_memory_bytes }. Precondition: it is an object.
Document with_timings(const Document& document, const RunTimes& times);

}  // namespace qchopper

// The first inputs of the fuzzers of everything but meshes. Encoded::reader is the name of the fuzzer.

#pragma once

#include <vector>

#include "tests/segment/io/encodings.h"

namespace qchopper {

// Of job files and cell files.
std::vector<Encoded> job_seeds();
// Of project.json, plans and kept evaluations.
std::vector<Encoded> project_seeds();
// Of what crosses the wire, and of the simulated cell's memory.
std::vector<Encoded> link_seeds();

}  // namespace qchopper

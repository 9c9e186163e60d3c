// The first inputs of all fuzzers but those of meshes. Encoded::reader is the name of the fuzzer.

#pragma once

#include <vector>

#include "tests/segment/io/encodings.h"

namespace qchopper {

// Of job files and cell files.
std::vector<Encoded> job_seeds();
// Of project.json, plans, kept evaluations and display meshes.
std::vector<Encoded> project_seeds();
// Of register blocks, requests, and the simulated cell's memory.
std::vector<Encoded> link_seeds();

}  // namespace qchopper

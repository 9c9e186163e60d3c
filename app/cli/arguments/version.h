// The version of the program and what it was built from. Only for sources of qchopper_cli.

#pragma once

#include <string>

namespace qchopper {

// "0.1.0+1a2b3c4d5e6f": the version of CMakeLists.txt, and as build metadata (Semantic Versioning 2.0.0, 10) the first
// digits of the build id that the linker wrote (NT_GNU_BUILD_ID): the same for the same program to the byte. Jobs and
// verdicts record it. "0.1.0" of a program without a build id.
const std::string& version();

}  // namespace qchopper

// The version of the program, as CMakeLists.txt has it.

#pragma once

namespace qchopper {

constexpr const char* version = QCHOPPER_VERSION;

}  // namespace qchopper

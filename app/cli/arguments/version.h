// The version of the program, set in CMakeLists.txt. Only for sources of qchopper_cli.

#pragma once

namespace qchopper {

constexpr const char* version = QCHOPPER_VERSION;

}  // namespace qchopper

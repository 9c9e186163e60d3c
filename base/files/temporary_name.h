// The names under which files and folders are written before they are renamed to their own.
//
// Several machines may write into one folder: a name holds its machine, so that none removes what another is writing,
// and a random part, so that processes of the same number do not meet (tests/base/files/temporary_name_test.cpp).

#pragma once

#include <string>

namespace qchopper {

// "NAME.tmp.HOST.4711.1a2b3c4d-9e8f7a6b": the machine, the process, a random number and a checksum of all that. A new
// one at each call. It is at most 60 characters longer than `name`.
std::string temporary_name(const std::string& name);

// Whether temporary_name made it in a process of this machine that has ended.
bool is_leftover(const std::string& file_name);

}  // namespace qchopper

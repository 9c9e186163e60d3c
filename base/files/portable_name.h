// File names that every system, controller and ZIP reader accepts (tests/base/text_test.cpp).

#pragma once

#include <string_view>

namespace qchopper {

// Whether it is 1 to 32 characters of the portable set (POSIX.1-2017, 3.282: A-Z a-z 0-9 . _ -), not beginning with a
// dot. So are the names of job files and of the entries in them, on disk and on the wire.
bool is_portable_name(std::string_view name);

}  // namespace qchopper

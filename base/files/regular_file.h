// Whether a file may be read whole: a named pipe would block, a device may have no end.

#pragma once

#include <sys/types.h>

#include <filesystem>

namespace qchopper {

// Throws InputError (missing), naming the file and what it is, unless a file of this mode (st_mode) is a regular one.
void refuse_irregular(const std::filesystem::path& path, mode_t mode);

// For libraries that open a file by its name: the same for what is there, links followed; nothing if nothing is there
// (tests/base/files/file_test.cpp).
void check_regular_file(const std::filesystem::path& path);

}  // namespace qchopper

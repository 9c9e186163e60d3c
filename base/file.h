// Bytes on disk: read a file whole, write one so that a crash leaves the old file or the new one.
//
// Only regular files are read: a named pipe would block, a device may have no end (tests/base/file_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace qchopper {

using Bytes = std::vector<std::uint8_t>;

// How many bytes of one kind of file are read at most, and the fault of a larger one.
struct SizeLimit {
    std::uint64_t bytes = 0;
    InputFault fault = InputFault::mesh;
};
constexpr SizeLimit scan_limit{std::uint64_t{16} << 30, InputFault::mesh};
constexpr SizeLimit job_limit{(std::uint64_t{4} << 30) - 1, InputFault::mesh};   // FILE_SIZE has 32 bits
constexpr SizeLimit record_limit{std::uint64_t{256} << 20, InputFault::config};  // projects, plans, memories
constexpr SizeLimit settings_limit{std::uint64_t{1} << 20, InputFault::config};  // cell files

// Opened once; what is read is what was looked at. Throws InputError: missing if the file is not there, is no regular
// file or cannot be read, limit.fault if it is larger than the limit.
Bytes read_file(const std::filesystem::path& path, SizeLimit limit = scan_limit);

// Whatever standard input is, to its end.
Bytes read_standard_input(SizeLimit limit = scan_limit);

// Writes name.tmp.<pid> in the same folder, fsyncs it, renames it to `path` and fsyncs the folder.
// Throws InputError (create, io); nothing half-written stays behind.
void write_file(const std::filesystem::path& path, const Bytes& bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace qchopper

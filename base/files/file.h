// Reads whole files, and writes them so that a crash leaves the old content or the new one.
//
// Only regular files are read: a named pipe would block, a device may have no end (tests/base/files/file_test.cpp).

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace qchopper {

using Bytes = std::vector<std::uint8_t>;

// The largest size of one kind of file that is read, and the fault of a larger one.
struct SizeLimit {
    std::uint64_t bytes = 0;
    InputFault fault = InputFault::mesh;
};
constexpr SizeLimit scan_limit{std::uint64_t{16} << 30, InputFault::mesh};
constexpr SizeLimit job_limit{(std::uint64_t{4} << 30) - 1, InputFault::mesh};   // FILE_SIZE has 32 bits
constexpr SizeLimit record_limit{std::uint64_t{256} << 20, InputFault::config};  // projects, plans, a cell's memory
constexpr SizeLimit settings_limit{std::uint64_t{1} << 20, InputFault::config};  // cell files

// All bytes of a file, opened once: what is checked is what is read. Links are followed. Throws InputError: missing if
// the file does not exist, is no regular file or cannot be read, limit.fault if it is larger than limit.bytes.
Bytes read_file(const std::filesystem::path& path, SizeLimit limit = scan_limit);

// All bytes of standard input, of whatever kind it is, to its end. Throws InputError as read_file does.
Bytes read_standard_input(SizeLimit limit = scan_limit);

// For libraries that open a file by its name: throws InputError (missing), naming the file and what it is, unless it is
// a regular one, links followed; nothing if nothing is there.
void check_regular_file(const std::filesystem::path& path);

// Writes it under a temporary name (temporary_name.h), fsyncs it, renames it to `path` and fsyncs the folder. A file or
// link at `path` is replaced. Throws InputError: create if the file cannot be created or replaced, io if it cannot be
// written; then `path` is unchanged and the temporary file is removed.
void write_file(const std::filesystem::path& path, const Bytes& bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace qchopper

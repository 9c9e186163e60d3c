// Bytes on disk: read a file whole, write one so that a crash leaves the old file or the new one.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace qchopper {

using Bytes = std::vector<std::uint8_t>;

// Throws InputError (missing) if the file is not there, is a folder, or cannot be read.
Bytes read_file(const std::filesystem::path& path);

// Writes name.tmp.<pid> in the same folder, fsyncs it, renames it to `path` and fsyncs the folder.
// Throws InputError (create, io); nothing half-written stays behind.
void write_file(const std::filesystem::path& path, const Bytes& bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace qchopper

// The cell's memory on disk: what must outlive a power cut, as one JSON file that is replaced whole.
//
// Loading what was saved gives it back; a crash while saving leaves the old file or the new one
// (tests/sim/memory_test.cpp).

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/machine.h"

namespace qchopper {

// Ends in a SHA-256 of itself: one damaged byte may be the id of a job that ran.
std::string to_json(const CellMemory& memory);

// Throws InputError (config) naming `name` if it is not what to_json makes, to the last byte.
CellMemory memory_from_json(std::string_view text, const std::string& name);

// An empty memory if the file is not there. Throws InputError (config) if it is damaged: a memory that cannot be read
// must not be taken for an empty one, or a job could start twice.
CellMemory load_memory(const std::filesystem::path& file);

// Throws InputError (create, io).
void save_memory(const std::filesystem::path& file, const CellMemory& memory);

}  // namespace qchopper

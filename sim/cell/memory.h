// Reads and writes the memory of the simulated cell: one JSON file that is replaced whole.
//
// Loading what was saved gives it back; a crash while saving leaves the old file or the new one. Every changed byte is
// found, because a wrong job id would allow a second start (tests/sim/cell/memory_test.cpp).

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/cell/machine.h"

namespace qchopper {

// The last key is the SHA-256 of the text without it.
std::string to_json(const CellMemory& memory);

// Throws InputError (config) naming `name` unless `text` equals, byte for byte, what to_json() returns for some memory.
CellMemory memory_from_json(std::string_view text, const std::string& name);

// An empty memory if there is no file. Throws InputError if it cannot be read (missing, config): it must not count as
// empty, or a job could start twice.
CellMemory load_memory(const std::filesystem::path& file);

// Throws InputError (create, io); then the old file is unchanged.
void save_memory(const std::filesystem::path& file, const CellMemory& memory);

// The marks of the store, in a file of their own. None if it is missing or damaged: then the store counts as older.
SaveMarks load_marks(const std::filesystem::path& file);
void save_marks(const std::filesystem::path& file, const SaveMarks& marks);  // throws InputError

}  // namespace qchopper

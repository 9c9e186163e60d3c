// What the simulated controller needs from outside: a store, a log, the check of a file.

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "sim/cell/cell_state.h"

namespace qchopper {

// The answer to a pending VERIFY.
struct FileCheck {
    enum class End { ok, missing, io_error };
    End end = End::missing;
    std::uint64_t size = 0;  // bytes
    Sha256 sha256{};         // of the copy in the store, if its size is right
};

// Called from the functions of machine.h, in their thread. Any of them may be empty.
struct CellHooks {
    // Writes the memory so that it outlives a power cut. False: it could not, and the command is refused.
    std::function<bool(const CellMemory&)> save;
    std::function<void(const std::string&)> log;
    // Removes copies of finished jobs until so many bytes are free or none is left; returns the free KiB.
    std::function<std::uint32_t(const CellMemory&, std::uint64_t bytes)> remove_old_copies;
    // The marks of the store, in another memory. Both or none; without them the cell does not find an older copy.
    std::function<SaveMarks()> read_marks;
    std::function<bool(const SaveMarks&)> write_marks;  // false: it could not
};

}  // namespace qchopper

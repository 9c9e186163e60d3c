// The outside world of the simulated controller: its store, its log, its files.

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "sim/cell_state.h"

namespace qchopper {

struct FileCheck {
    enum class End { ok, missing, io_error };
    End end = End::missing;
    std::uint64_t size = 0;
    Sha256 sha256{};
};

struct CellHooks {
    // Puts the memory where a power cut cannot reach it; false: it could not, and the command is refused. May be empty.
    std::function<bool(const CellMemory&)> save;
    std::function<void(const std::string&)> log;  // may be empty
    // Lets copies of finished jobs go until so many bytes are free, or none is left; returns how many KiB are free
    // then. May be empty: nothing is let go.
    std::function<std::uint32_t(const CellMemory&, std::uint64_t bytes)> make_room;
};

}  // namespace qchopper

// The cell's folder: its memory, its lock, the copies of the files that it runs.
//
// Copies of finished jobs are removed for new ones, the oldest first; the ids of their jobs stay in the memory
// (tests/sim/cell/store_test.cpp). One program at a time holds a folder.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "base/files/temporary_folder.h"
#include "sim/cell/machine.h"

namespace qchopper {

class Store {
 public:
    // An empty path: a temporary folder, removed at the end. `max_bytes`: of all copies together. Throws InputError
    // (create, busy): the folder cannot be made or locked, or another program holds it.
    Store(const std::filesystem::path& folder, std::uint64_t max_bytes);
    ~Store();
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;

    std::filesystem::path memory() const { return folder_ / "memory.json"; }
    // Of the marks: beside the folder, so that an older copy of the folder does not bring them back.
    std::filesystem::path marks() const;
    std::filesystem::path job(const Uuid& id) const;  // of the copy of a job's file
    std::uint32_t free_kib() const;                   // 0 if that cannot be read
    void empty() const;                               // memory and copies are lost
    // Removes copies until so many bytes are free or none is left. Precondition: the cell has no job.
    void remove_old_copies(const CellMemory& memory, std::uint64_t bytes) const;

 private:
    std::uint64_t free_bytes() const;

    std::unique_ptr<TemporaryFolder> own_;
    std::filesystem::path folder_;
    std::uint64_t max_bytes_;
    int lock_ = -1;
};

}  // namespace qchopper

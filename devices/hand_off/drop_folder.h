// The folder from which a cell fetches job files, while a dispatcher uses it.
//
// A file is written under a staging name that begins with a dot, which no cell reads, and renamed when it is complete.
// A dispatcher that was killed leaves such files behind; the next one removes them, unless another still uses the
// folder (tests/devices/hand_off/drop_folder_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/files/file.h"
#include "cam/job/ticket.h"

namespace qchopper {

// ".C.qjob.<job id>" for the job file "C.qjob".
std::string staging_name(const std::string& file_name, const Uuid& job_id);

// Why no job file can be written into the folder, as a clause: it is not there, is no folder, or may not be written to.
// "" if nothing speaks against it.
std::string fault_of_drop_folder(const std::filesystem::path& folder);

// Holds a shared lock on the folder as long as it lives.
class DropFolderUse {
 public:
    // Waits for the lock, at most a second. Never throws for a folder that is missing or cannot be locked: it goes on
    // without a lock, and the write into the folder reports the fault.
    explicit DropFolderUse(const std::filesystem::path& folder);
    ~DropFolderUse();
    DropFolderUse(const DropFolderUse&) = delete;
    DropFolderUse& operator=(const DropFolderUse&) = delete;

 private:
    int lock_;  // descriptor of the folder, or -1
};

// The job file in the drop folder: written under its staging name, then renamed. A file that was not renamed is removed
// when this ends.
class StagedFile {
 public:
    StagedFile() = default;
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    // Returns why the file cannot be written, else "".
    std::string stage(const std::filesystem::path& folder, const std::string& file_name, const Uuid& job_id,
                      const Bytes& bytes);
    // Renames it to its name. Returns the reason if that fails, else "".
    std::string put();
    bool is_staged() const { return !staged_.empty(); }

 private:
    std::optional<DropFolderUse> use_;
    std::filesystem::path staged_;
    std::filesystem::path target_;
};

}  // namespace qchopper

// A folder that is filled under a temporary name and then renamed, so that it appears complete or not at all.
//
// A run that is killed leaves its temporary folder; the next run that makes one beside it removes it. Only folders that
// this program made and no run uses any more are removed: the name is one of this machine, whose process has ended
// (temporary_name.h), and the lock on the folder is free (tests/base/files/staged_folder_test.cpp).

#pragma once

#include <filesystem>

#include "base/files/unfinished.h"

namespace qchopper {

class StagedFolder {
 public:
    // Makes an empty folder beside `place`, whose parent must exist. Throws std::filesystem::filesystem_error.
    explicit StagedFolder(const std::filesystem::path& place);
    // Removes the folder unless it has been moved.
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    // Where to put the files; gone after move_to_its_place().
    const std::filesystem::path& path() const { return path_; }
    // Renames it to `place`, where there may be an empty folder at most. Throws std::filesystem::filesystem_error.
    void move_to_its_place();

 private:
    std::filesystem::path place_;
    std::filesystem::path path_;
    Unfinished listed_;
    int descriptor_ = -1;
    bool is_moved_ = false;
};

}  // namespace qchopper

// A folder that is made aside and appears whole at its place, or not at all.
//
// A run that is killed leaves it behind; the next that makes one in the same place removes it. Removed is only what
// this program made and no run holds any more: the name carries the process and a checksum of itself, the process has
// ended, and the lock on the folder is free (tests/base/staged_folder_test.cpp).

#pragma once

#include <filesystem>

namespace qchopper {

class StagedFolder {
 public:
    // Beside `place`. Throws std::filesystem::filesystem_error.
    explicit StagedFolder(const std::filesystem::path& place);
    // Removes it unless it has become what it was made for.
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    // Throws std::filesystem::filesystem_error.
    void move_to_its_place();

 private:
    std::filesystem::path place_;
    std::filesystem::path path_;
    int descriptor_ = -1;
    bool is_there_ = false;  // at its place
};

}  // namespace qchopper

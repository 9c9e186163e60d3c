// A folder for one run of the program, removed when the run ends.
//
// A run that is killed cannot remove its folder; the next one with the same prefix does. A run holds a lock on its
// folder, which the system releases when the run ends (tests/base/files/temporary_folder_test.cpp).

#pragma once

#include <filesystem>
#include <string>

namespace qchopper {

class TemporaryFolder {
 public:
    // Makes an empty folder, named by `prefix` and six random characters, in the folder for temporary files (TMPDIR).
    // Throws InputError (create).
    explicit TemporaryFolder(const std::string& prefix);
    // Removes the folder and all in it.
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace qchopper

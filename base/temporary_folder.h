// A folder for one run of the program, gone when the run is over, however it ended.
//
// A run that is killed cannot remove its folder; the next one with the same prefix does. Whoever uses a folder holds a
// lock on it, which dies with the program (tests/base/temporary_folder_test.cpp).

#pragma once

#include <filesystem>
#include <string>

namespace qchopper {

class TemporaryFolder {
 public:
    // <temporary folder>/<prefix>XXXXXX. Throws InputError (create).
    explicit TemporaryFolder(const std::string& prefix);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace qchopper

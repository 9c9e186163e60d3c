// What other programs change in a folder of projects, told as it happens.
//
// Where the system cannot tell (a network folder, too many watches of this user), wait() lasts to its limit, so that
// who looks after each call sees every change all the same (tests/app/console/folder_watch_test.cpp).

#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

namespace qchopper {

class FolderWatch {
 public:
    explicit FolderWatch(const std::filesystem::path& folder);
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    // Also these project folders: their project.json, lock and cell.toml. One that is watched already stays so.
    void add(const std::vector<std::filesystem::path>& projects) const;
    // True as soon as something has changed since the last call; false after the limit, or when stop() was called.
    bool wait(std::chrono::milliseconds limit) const;
    // From any thread: wait() returns at once from now on.
    void stop() const;

 private:
    bool take_changes() const;

    int notices_;       // of inotify; -1: there are none
    int stop_;          // eventfd; -1: none could be made
    int folder_watch_;  // of the folder itself, whose every new or removed entry counts
};

}  // namespace qchopper

// The folder from which a cell fetches job files, while a dispatcher uses it.
//
// A file on its way has a name with a dot in front, at which no cell looks. A dispatcher that was killed leaves such
// files; the next one removes them, unless another still uses the folder (tests/devices/drop_folder_test.cpp).

#pragma once

#include <filesystem>
#include <string>

#include "cam/job/ticket.h"

namespace qchopper {

// ".C.qjob.<job id>": what a job file is called before it is delivered.
std::string name_on_its_way(const std::string& file_name, const Uuid& job_id);

class DropFolderUse {
 public:
    // A folder that is not there or cannot be locked is left as it is: whoever writes into it will tell.
    explicit DropFolderUse(const std::filesystem::path& folder);
    ~DropFolderUse();
    DropFolderUse(const DropFolderUse&) = delete;
    DropFolderUse& operator=(const DropFolderUse&) = delete;

 private:
    int lock_;
};

}  // namespace qchopper

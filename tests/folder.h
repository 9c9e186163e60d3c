// A folder for one test, removed at its end.

#pragma once

#include <filesystem>

#include "base/files/temporary_folder.h"

namespace qchopper {

class Folder {
    TemporaryFolder owner_{"qchopper-test-"};

 public:
    const std::filesystem::path path = owner_.path();
};

}  // namespace qchopper

// A new folder for readers that take a file instead of bytes; removed by the destructor. Aborts if it cannot be
// created.

#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace qchopper {

struct MemoryFolder {
    MemoryFolder() {
        // In memory where that is possible: each file is synced, and a disk can do that about thirty times a second.
        const std::filesystem::path memory = "/dev/shm";
        std::error_code error;
        const bool has_memory = std::filesystem::is_directory(memory, error);
        const auto parent = has_memory ? memory : std::filesystem::temp_directory_path();
        std::string pattern = (parent / "qchopper-fuzz-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        path = pattern;
    }
    ~MemoryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;
    std::filesystem::path path;
};

}  // namespace qchopper
